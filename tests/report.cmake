# Records, statistics, reports, tables and their validation.
add_library(hullbench_invented_run STATIC "${CMAKE_CURRENT_LIST_DIR}/invented_run.cpp")
target_include_directories(hullbench_invented_run PUBLIC "${CMAKE_CURRENT_LIST_DIR}")
target_link_libraries(hullbench_invented_run PUBLIC hullbench::report PRIVATE hullbench::compile_options)

foreach(part IN ITEMS record statistics bootstrap rank_test judge noise report tables collection_tables class_tables overview_tables
                      curve_table paper_comparison real_table zoo_table)
  hullbench_test(test_${part}
    SOURCES "${CMAKE_CURRENT_LIST_DIR}/test_${part}.cpp"
    LIBRARIES hullbench_invented_run hullbench::report hullbench::hash)
endforeach()

target_link_libraries(test_record PRIVATE hullbench_test_program)

hullbench_test(test_document SOURCES "${CMAKE_CURRENT_LIST_DIR}/test_document.cpp"
  LIBRARIES hullbench::report hullbench_test_program)

hullbench_test(test_xz_file SOURCES "${CMAKE_CURRENT_LIST_DIR}/test_xz_file.cpp"
  LIBRARIES hullbench_invented_run hullbench::report hullbench_test_program)

hullbench_test(test_core_verdicts SOURCES "${CMAKE_CURRENT_LIST_DIR}/test_core_verdicts.cpp"
  LIBRARIES hullbench::core_verdicts)

# The same reports through an independent validator.
add_executable(write_invented_report "${CMAKE_CURRENT_LIST_DIR}/write_invented_report.cpp")
target_link_libraries(write_invented_report PRIVATE hullbench_invented_run hullbench::compile_options)
set_target_properties(write_invented_report PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")

set(invented_report "${CMAKE_BINARY_DIR}/tests/invented_report.json")
add_test(NAME report.write_invented COMMAND write_invented_report "${invented_report}")
set_tests_properties(report.write_invented PROPERTIES FIXTURES_SETUP invented_report)
hullbench_tool_test(NAME report.python_takes_it NEEDS "${SYSTEM_PYTHON}:jsonschema"
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/validate_report.py"
          "${invented_report}" "${CMAKE_BINARY_DIR}/tests/invented_report_run/runs.jsonl")
hullbench_tool_test(NAME report.python_rejects_broken NEEDS "${SYSTEM_PYTHON}:jsonschema"
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/validate_report.py" --broken
          "${CMAKE_CURRENT_LIST_DIR}/data/broken_reports.json" "${invented_report}")
set_tests_properties(report.python_takes_it report.python_rejects_broken PROPERTIES
  FIXTURES_REQUIRED invented_report)

# Merged reports are tried with both validators, and with records as a reference run keeps them.
hullbench_test(test_merge SOURCES "${CMAKE_CURRENT_LIST_DIR}/test_merge.cpp"
  LIBRARIES hullbench::record LABELS harness RUNS_HULLBENCH)
target_compile_definitions(test_merge PRIVATE VALIDATE_REPORT="${CMAKE_CURRENT_LIST_DIR}/validate_report.py")
