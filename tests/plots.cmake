# What is made of a run in Python: what is kept of it, figures, the HTML report and the comparison, with the
# distribution's Python, for which matplotlib is installed, and in its browser.
set(needs_of_records "${SYSTEM_PYTHON}:matplotlib")
set(needs_of_results)
set(needs_of_figures "${SYSTEM_PYTHON}:matplotlib" "${SYSTEM_PYTHON}:scipy")
set(needs_of_paper "${SYSTEM_PYTHON}:matplotlib" "${SYSTEM_PYTHON}:scipy")
set(needs_of_html_report esbuild "${SYSTEM_PYTHON}:scipy")
set(needs_of_pictures)
set(needs_of_comparison esbuild "${PROJECT_SOURCE_DIR}/plots/node_modules")
set(needs_of_ratings "${SYSTEM_PYTHON}:scipy")
set(needs_of_front "${SYSTEM_PYTHON}:scipy")
set(needs_of_site esbuild "${SYSTEM_PYTHON}:scipy")
foreach(part IN ITEMS records results ratings front figures paper html_report pictures comparison site)
  hullbench_tool_test(NAME plots.${part} NEEDS "${SYSTEM_PYTHON}:jsonschema" ${needs_of_${part}}
    COMMAND "${SYSTEM_PYTHON}" -B -m unittest test_${part}_py)
  set_tests_properties(plots.${part} PROPERTIES LABELS plots TIMEOUT 900 COST ${HULLBENCH_COST_OF_LONG_TESTS}
    WORKING_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}" ENVIRONMENT "HULLBENCH=$<TARGET_FILE:hullbench>")
endforeach()
foreach(page IN ITEMS report comparison site)
  hullbench_tool_test(NAME plots.${page}_in_browser
    NEEDS "${SYSTEM_PYTHON}:jsonschema" esbuild node "${BROWSERS}"
      "${PROJECT_SOURCE_DIR}/plots/node_modules" "${CMAKE_CURRENT_LIST_DIR}/report/node_modules"
    COMMAND ${CMAKE_COMMAND} -E env "HULLBENCH=$<TARGET_FILE:hullbench>" "PYTHON=${SYSTEM_PYTHON}"
            "WRITE_INVENTED_REPORT=$<TARGET_FILE:write_invented_report>" "OUTPUT=${CMAKE_BINARY_DIR}/tests/${page}_in_browser"
            node --test --test-reporter=spec "${CMAKE_CURRENT_LIST_DIR}/report/${page}.test.mjs")
  set_tests_properties(plots.${page}_in_browser PROPERTIES LABELS plots TIMEOUT 1200 COST ${HULLBENCH_COST_OF_LONG_TESTS})
endforeach()
hullbench_tool_test(NAME plots.choice_in_browser
  NEEDS node "${BROWSERS}" "${CMAKE_CURRENT_LIST_DIR}/report/node_modules"
  COMMAND ${CMAKE_COMMAND} -E env "HULLBENCH=$<TARGET_FILE:hullbench>" "OUTPUT=${CMAKE_BINARY_DIR}/tests/choice_in_browser"
          node --test --test-reporter=spec "${CMAKE_CURRENT_LIST_DIR}/report/choice.test.mjs")
set_tests_properties(plots.choice_in_browser PROPERTIES LABELS plots TIMEOUT 600 COST ${HULLBENCH_COST_OF_LONG_TESTS})
# The README's picture of a concave hull is what the program makes now.
hullbench_tool_test(NAME plots.concept NEEDS "${SYSTEM_PYTHON}"
  COMMAND bash -c "\"$0\" -B \"$3/make_concept.py\" \"$1\" \"$2\" && cmp \"$2\" \"$3/concept.svg\""
          "${SYSTEM_PYTHON}" "$<TARGET_FILE:hullbench>" "${CMAKE_BINARY_DIR}/tests/concept.svg" "${PROJECT_SOURCE_DIR}/plots")
set_tests_properties(plots.concept PROPERTIES LABELS plots)
# The picture of the samplers; what the points are is tested elsewhere.
hullbench_tool_test(NAME plots.samplers NEEDS "${SYSTEM_PYTHON}:matplotlib" "${SYSTEM_PYTHON}:numpy"
  COMMAND "${SYSTEM_PYTHON}" -B "${PROJECT_SOURCE_DIR}/plots/make_samplers.py" --hullbench "$<TARGET_FILE:hullbench>"
          --out "${CMAKE_BINARY_DIR}/tests/samplers.png")
set_tests_properties(plots.samplers PROPERTIES LABELS plots TIMEOUT 300)
