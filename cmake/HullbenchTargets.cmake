# One place for what every target of this project is compiled with, so that our code and the header-only
# libraries measured beside it (CGAL) get the same flags.

# A project that embeds this one decides itself.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# Warnings are errors with the compilers that the project is checked with; a newer one may warn of more, which is no
# reason for a reader's build to stop.
set(werror_default OFF)
if((CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    OR (CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 15))
  set(werror_default ON)
endif()
option(HULLBENCH_WERROR "Treat compiler warnings as errors" ${werror_default})

add_library(hullbench_compile_options INTERFACE)
add_library(hullbench::compile_options ALIAS hullbench_compile_options)
target_compile_features(hullbench_compile_options INTERFACE cxx_std_20)
target_compile_options(hullbench_compile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
  $<$<BOOL:${HULLBENCH_WERROR}>:-Werror>
  # GCC 12 sees overlapping copies in std::string's own operator+ and assignment, where there are none (its bug 105651).
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>
  # A fused multiply-add rounds once where the predicates' error bounds and expansions count on two
  # roundings; contraction would also make coordinates differ between machines.
  -ffp-contract=off
  # The compiler begins to collect its own garbage at 512 MiB instead of 128: a tenth less time for a tenth of a gigabyte.
  $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=524288>
  # Square roots are one instruction where none of a negative number has to be reported in errno.
  -fno-math-errno)
if(HULLBENCH_NATIVE)
  target_compile_options(hullbench_compile_options INTERFACE -march=native)
endif()

option(HULLBENCH_COMPILE_TOGETHER "Compile several files of a library or a test in one go; OFF: each file alone" ON)
mark_as_advanced(HULLBENCH_COMPILE_TOGETHER)

# hullbench_compile_together(target [count]): compiles twelve, or so many, files of the target in one go, since most of the time
# goes into the headers that they share. So two of its files may not use one name for two things, not even in unnamed
# namespaces. Without it (make build-clang) each file is compiled alone, which shows that it includes what it needs. Not for a
# method that is timed.
function(hullbench_compile_together target)
  set(count 12)
  if(ARGC GREATER 1)
    set(count ${ARGV1})
  endif()
  if(HULLBENCH_COMPILE_TOGETHER)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${count})
  endif()
endfunction()

# hullbench_test_header(name level): GoogleTest's header and those that most tests include beside it, parsed once for all tests of
# hullbench_test that are compiled at that level of optimisation. Every file still includes what it needs: the clang build has no
# such header.
function(hullbench_test_header name level)
  file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp" CONTENT "")
  add_library(${name} STATIC EXCLUDE_FROM_ALL "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
  target_link_libraries(${name} PRIVATE GTest::gtest hullbench::compile_options)
  target_compile_options(${name} PRIVATE ${level})
  set(headers <gtest/gtest.h> <algorithm> <cmath> <filesystem> <functional> <limits> <map> <optional> <set> <sstream> <string> <vector>)
  if(TARGET nlohmann_json::nlohmann_json)
    target_link_libraries(${name} PRIVATE nlohmann_json::nlohmann_json)
    list(APPEND headers <nlohmann/json.hpp>)
  endif()
  target_precompile_headers(${name} PRIVATE ${headers})
endfunction()

# Groups with tests that take ten seconds or more have this COST: ctest starts them first, and none is left for the end.
set(HULLBENCH_COST_OF_LONG_TESTS 100)

# hullbench_test(NAME SOURCES... LIBRARIES... [LABELS...] [TIMEOUT seconds] [RUNS_HULLBENCH] [STARTS_EARLY] [IN_ONE] [LIGHT]): one
# GoogleTest program from one or more files, which are compiled together; its cases appear in ctest one by one. All know the
# folders of the sources and the plans, where the program is and which Python the system has; with RUNS_HULLBENCH the program is
# built first. STARTS_EARLY is for tests that take long. IN_ONE is for tests that share what takes long to prepare: one entry in
# ctest for all. LIGHT is for tests that compute little by themselves, as they start programs or compare texts: they are not
# optimised, which compiles them in half the time.
function(hullbench_test name)
  cmake_parse_arguments(TEST "RUNS_HULLBENCH;STARTS_EARLY;IN_ONE;LIGHT" "TIMEOUT" "SOURCES;LIBRARIES;LABELS" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_compile_definitions(${name} PRIVATE
    # Boost 1.74's Geometry includes headers of its own that announce themselves as deprecated in every compilation.
    BOOST_ALLOW_DEPRECATED_HEADERS
    HULLBENCH_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}"
    HULLBENCH_PLAN_FOLDER="${PROJECT_SOURCE_DIR}/benchmarks/plans"
    HULLBENCH="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/hullbench"
    SYSTEM_PYTHON="${SYSTEM_PYTHON}")
  # What is tested is optimised as always; the tests themselves are many. GCC 12 sees std::string copied out of bounds, where it
  # is not, in some of the files that are compiled together.
  set(level -O1)
  set(header hullbench_test_header)
  if(TEST_LIGHT)
    set(level -O0)
    set(header hullbench_light_test_header)
  endif()
  target_compile_options(${name} PRIVATE ${level}
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-array-bounds>)
  target_precompile_headers(${name} REUSE_FROM ${header})
  hullbench_compile_together(${name} 7)  # more would be one long compilation at a build's end
  target_link_libraries(${name} PRIVATE ${TEST_LIBRARIES} GTest::gtest_main hullbench::compile_options)
  if(TEST_RUNS_HULLBENCH)
    target_link_libraries(${name} PRIVATE hullbench_test_program)
    add_dependencies(${name} hullbench)
  endif()
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  add_dependencies(test_programs ${name})
  set(cost 0)
  if(TEST_STARTS_EARLY)
    set(cost ${HULLBENCH_COST_OF_LONG_TESTS})
  endif()
  if(TEST_IN_ONE)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${TEST_TIMEOUT} COST ${cost} LABELS "${TEST_LABELS}")
  else()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60
      PROPERTIES TIMEOUT ${TEST_TIMEOUT} COST ${cost} LABELS "${TEST_LABELS}")
  endif()
endfunction()
