# The JavaScript package, built here with its own compiler, in Node and in the browser.
add_executable(write_native_hulls "${CMAKE_CURRENT_LIST_DIR}/js/write_native_hulls.cpp")
target_link_libraries(write_native_hulls PRIVATE hullbench_test_support hullbench::compile_options)
set_target_properties(write_native_hulls PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")

set(js_build "${CMAKE_BINARY_DIR}/js")
set(js_needs clang++ wasm-ld llvm-ar /usr/include/wasm32-wasi/c++ esbuild node)
hullbench_tool_test(NAME js.build NEEDS ${js_needs}
  COMMAND bash -c "'${CMAKE_COMMAND}' --preset js -B '${js_build}' && '${CMAKE_COMMAND}' --build '${js_build}'")
set_tests_properties(js.build PROPERTIES LABELS js TIMEOUT 900 FIXTURES_SETUP js_package COST ${HULLBENCH_COST_OF_LONG_TESTS}
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")

set(needs_of_browser "${BROWSERS}" "${CMAKE_CURRENT_LIST_DIR}/report/node_modules")
set(needs_of_demo ${needs_of_browser} "${PROJECT_SOURCE_DIR}/adapters/manifests/node_modules")
set(needs_of_types "${CMAKE_CURRENT_LIST_DIR}/report/node_modules/typescript")
foreach(part IN ITEMS node browser demo types)
  hullbench_tool_test(NAME js.${part} NEEDS ${js_needs} ${needs_of_${part}}
    COMMAND node --test --test-reporter=spec "${CMAKE_CURRENT_LIST_DIR}/js/${part}.test.mjs")
  set_tests_properties(js.${part} PROPERTIES LABELS js TIMEOUT 600 COST ${HULLBENCH_COST_OF_LONG_TESTS} FIXTURES_REQUIRED js_package ENVIRONMENT
    "PACKAGE=${js_build}/polylidar;PAGE=${js_build}/demo.html;WRITE_NATIVE_HULLS=$<TARGET_FILE:write_native_hulls>;OUTPUT=${CMAKE_BINARY_DIR}/tests/js_${part}")
endforeach()
# The page's readers of files are plain JavaScript.
hullbench_tool_test(NAME js.readers NEEDS node
  COMMAND node --test --test-reporter=spec "${CMAKE_CURRENT_LIST_DIR}/js/readers.test.mjs")
set_tests_properties(js.readers PROPERTIES LABELS js TIMEOUT 120)
hullbench_tool_test(NAME js.make NEEDS node make
  COMMAND node --test --test-reporter=spec "${CMAKE_CURRENT_LIST_DIR}/js/make.test.mjs")
set_tests_properties(js.make PROPERTIES LABELS js TIMEOUT 120)
