# Plans, workers, the runner and the command line.
add_library(hullbench_test_program STATIC "${CMAKE_CURRENT_LIST_DIR}/program.cpp")
target_include_directories(hullbench_test_program PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_test_program PRIVATE GTest::gtest hullbench::compile_options)
target_compile_definitions(hullbench_test_program PRIVATE NEEDS_SCRIPT="${CMAKE_CURRENT_LIST_DIR}/needs.sh")

add_executable(misbehaving_worker "${CMAKE_CURRENT_LIST_DIR}/misbehaving_worker.cpp")
set_target_properties(misbehaving_worker PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
target_link_libraries(misbehaving_worker PRIVATE hullbench::worker hullbench::compile_options)

# What needs no program: plans, the pieces of a run, the search for parameters, the league.
hullbench_test(test_harness
  SOURCES
    test_canary.cpp
    test_league.cpp
    test_limit_fit.cpp
    test_machines.cpp
    test_manifest.cpp
    test_parallel.cpp
    test_plan.cpp
    test_point_parts.cpp
    test_row_store.cpp
    test_rule_fit.cpp
    test_shard.cpp
    test_triangle_methods.cpp
    test_tune_search.cpp
    test_worker.cpp
  LIBRARIES hullbench::league hullbench::tune hullbench::run hullbench::report hullbench::worker hullbench::adapters
    hullbench::metrics hullbench::datasets hullbench::hash hullbench_invented_run hullbench_test_program hullbench_test_support
  LABELS harness LIGHT)
target_compile_definitions(test_harness PRIVATE MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>")
add_dependencies(test_harness misbehaving_worker)

file(GLOB plans CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/benchmarks/plans/*.json")
list(FILTER plans EXCLUDE REGEX "schema.json$")
hullbench_tool_test(NAME plans.python_takes_them NEEDS "${SYSTEM_PYTHON}:jsonschema"
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/validate_report.py" ${plans})

# Google Benchmark's own tool, and the Python that its package brings the libraries for.
find_file(COMPARE_PY compare.py PATHS /usr/share/benchmark PATH_SUFFIXES tools NO_DEFAULT_PATH)
if(NOT COMPARE_PY)
  set(COMPARE_PY compare.py)
endif()
# What starts the program.
hullbench_test(test_program
  SOURCES
    test_command_line.cpp
    test_compare.cpp
    test_gbench_export.cpp
    test_merge.cpp
    test_pictures.cpp
    test_readme.cpp
    test_runner.cpp
    test_submission.cpp
    test_suite.cpp
    test_tune.cpp
  LIBRARIES hullbench::record hullbench::run hullbench::report hullbench::metrics hullbench::hash hullbench_invented_run
  LABELS harness RUNS_HULLBENCH TIMEOUT 600 LIGHT)
target_compile_definitions(test_program PRIVATE
  COMPARE_PY="${COMPARE_PY}" MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>"
  VALIDATE_REPORT="${CMAKE_CURRENT_LIST_DIR}/validate_report.py")
add_dependencies(test_program misbehaving_worker)

add_test(NAME evaluate.searches_measures_and_judges
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/check_evaluate.sh" "${PROJECT_SOURCE_DIR}")
set_tests_properties(evaluate.searches_measures_and_judges PROPERTIES LABELS harness)

# The reference run: what may become it, what it is, and that the README shows its numbers.
add_test(NAME reference.is_of_this_revision
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/check_reference.sh" "${PROJECT_SOURCE_DIR}")
set_tests_properties(reference.is_of_this_revision PROPERTIES SKIP_RETURN_CODE 77)
hullbench_test(test_reference SOURCES test_reference.cpp
  LIBRARIES hullbench::league hullbench::report hullbench_test_program LABELS harness TIMEOUT 300 IN_ONE STARTS_EARLY)

# Methods that are added: the skeletons of `hullbench adapter new`, and the contract.
hullbench_test(test_adapter_command SOURCES test_adapter_command.cpp LIBRARIES hullbench::base LABELS harness RUNS_HULLBENCH STARTS_EARLY LIGHT)

# The README's checklist for a method in C++, walked with a sample: hullbench writes it, add_adapter() takes it, and the
# program that has it keeps the contract with it.
set(sample_folder "${CMAKE_CURRENT_BINARY_DIR}/sample_method")
add_custom_command(OUTPUT "${sample_folder}/sample_hull.cpp"
  COMMAND ${CMAKE_COMMAND} -E rm -rf "${sample_folder}"
  COMMAND hullbench adapter new sample_hull --lang cpp --out "${sample_folder}"
  DEPENDS hullbench "${PROJECT_SOURCE_DIR}/benchmarks/skeletons/skeleton.cpp.in"
  VERBATIM)
add_adapter(NAME sample_hull TITLE "sample_hull" SOURCES "${sample_folder}/sample_hull.cpp")
hullbench_adapter_registry(adapters_with_sample)
add_executable(hullbench_with_sample)
set_target_properties(hullbench_with_sample PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
target_link_libraries(hullbench_with_sample PRIVATE
  hullbench_program adapters_with_sample)
add_test(NAME sample_method.keeps_the_contract COMMAND hullbench_with_sample adapter test sample_hull)

# Real methods, the harness and all; a method that is not installed ends with 6.
set(options_of_postgis_legacy --timeout 600 --points 1000)  # is slow where points are many
foreach(method IN ITEMS polylidar polylidar_steps cgal_alpha_shape cgal_delaunay sfcgal_alpha_shape spatialite spatialite_steps
    postgis postgis_legacy postgis_steps geos_concave_hull chi_shape knn_hull pcl_concave_hull convex_hull concaveman delaunator
    hull_js turf_concave jts_concave_hull scipy_alpha_shape shrink_boundary)
  add_test(NAME contract.${method} COMMAND hullbench adapter test ${method} ${options_of_${method}})
  set_tests_properties(contract.${method} PROPERTIES SKIP_RETURN_CODE 6)
endforeach()
set_tests_properties(contract.postgis_legacy PROPERTIES TIMEOUT 1200 COST ${HULLBENCH_COST_OF_LONG_TESTS})
# These make an invalid polygon of 20000 points, which is a row of its own in every table; a version that is mended keeps the
# whole contract. What is found invalid first, and its name, are for the version of GEOS.
set_tests_properties(contract.spatialite contract.spatialite_steps contract.turf_concave PROPERTIES PASS_REGULAR_EXPRESSION
  "FAIL  20000 points within the limits invalid polygon, .*keeps part of the contract: 19 of 20;keeps the contract: ")
# SFCGAL up to 2.0 puts two shells into one ring.
set_tests_properties(contract.sfcgal_alpha_shape PROPERTIES PASS_REGULAR_EXPRESSION
  "keeps the contract: ;FAIL  two clusters far apart .*keeps part of the contract: 19 of 20")
