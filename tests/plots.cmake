# What is drawn of a run: figures, the HTML report and the comparison, with Debian's Python, for which matplotlib is
# installed, and in Debian's browser. What is missing fails the test: a page that nobody has opened is not tested.
find_program(DEBIAN_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
find_program(BASH_PROGRAM bash REQUIRED)
foreach(part IN ITEMS records figures html_report pictures comparison)
  add_test(NAME plots.${part} COMMAND "${DEBIAN_PYTHON}" -B -m unittest test_${part}_py
    WORKING_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}")
  set_tests_properties(plots.${part} PROPERTIES LABELS plots TIMEOUT 900 ENVIRONMENT "HULLBENCH=$<TARGET_FILE:hullbench>")
endforeach()
foreach(page IN ITEMS report comparison)
  add_test(NAME plots.${page}_in_browser
    COMMAND "${BASH_PROGRAM}" "${CMAKE_CURRENT_LIST_DIR}/report/run.sh" ${page}
            "$<TARGET_FILE:hullbench>" "$<TARGET_FILE:write_invented_report>" "${CMAKE_BINARY_DIR}/tests/${page}_in_browser")
  set_tests_properties(plots.${page}_in_browser PROPERTIES LABELS plots TIMEOUT 1200)
endforeach()
