# Records, statistics, reports, tables and their validation.
add_library(hullbench_invented_run STATIC "${CMAKE_CURRENT_LIST_DIR}/invented_run.cpp")
target_include_directories(hullbench_invented_run PUBLIC "${CMAKE_CURRENT_LIST_DIR}")
target_link_libraries(hullbench_invented_run PUBLIC hullbench::report PRIVATE hullbench::compile_options)

hullbench_test(test_report
  SOURCES
    test_bootstrap.cpp
    test_class_tables.cpp
    test_collection_tables.cpp
    test_core_verdicts.cpp
    test_curve_table.cpp
    test_document.cpp
    test_judge.cpp
    test_noise.cpp
    test_overview_tables.cpp
    test_paper_comparison.cpp
    test_rank_test.cpp
    test_real_table.cpp
    test_record.cpp
    test_report.cpp
    test_statistics.cpp
    test_tables.cpp
    test_xz_file.cpp
    test_zoo_table.cpp
  LIBRARIES hullbench_invented_run hullbench::report hullbench::core_verdicts hullbench::hash hullbench_test_program
  LIGHT)

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
