# Plans, workers, the runner and the command line.
add_library(hullbench_test_program STATIC "${CMAKE_CURRENT_LIST_DIR}/program.cpp")
target_include_directories(hullbench_test_program PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_test_program PRIVATE GTest::gtest hullbench::compile_options)
target_compile_definitions(hullbench_test_program PRIVATE NEEDS_SCRIPT="${CMAKE_CURRENT_LIST_DIR}/needs.sh")

add_executable(misbehaving_worker "${CMAKE_CURRENT_LIST_DIR}/misbehaving_worker.cpp")
set_target_properties(misbehaving_worker PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
target_link_libraries(misbehaving_worker PRIVATE hullbench::worker hullbench::compile_options)

hullbench_test(test_plan SOURCES test_plan.cpp
  LIBRARIES hullbench::plan hullbench::record hullbench::hash LABELS harness)

file(GLOB plans CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/benchmarks/plans/*.json")
list(FILTER plans EXCLUDE REGEX "schema.json$")
hullbench_tool_test(NAME plans.python_takes_them NEEDS "${SYSTEM_PYTHON}:jsonschema"
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/validate_report.py" ${plans})

foreach(part IN ITEMS shard point_parts canary parallel)
  hullbench_test(test_${part} SOURCES test_${part}.cpp LIBRARIES hullbench::run LABELS harness)
endforeach()

hullbench_test(test_row_store SOURCES test_row_store.cpp
  LIBRARIES hullbench::run hullbench_test_program LABELS harness)

hullbench_test(test_worker SOURCES test_worker.cpp
  LIBRARIES hullbench::worker hullbench::base hullbench_test_program LABELS harness)
target_compile_definitions(test_worker PRIVATE MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>")
add_dependencies(test_worker misbehaving_worker)

hullbench_test(test_runner SOURCES test_runner.cpp
  LIBRARIES hullbench::run hullbench::report LABELS harness RUNS_HULLBENCH)
target_compile_definitions(test_runner PRIVATE MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>")
add_dependencies(test_runner misbehaving_worker)

hullbench_test(test_pictures SOURCES test_pictures.cpp
  LIBRARIES hullbench::run hullbench::report LABELS harness RUNS_HULLBENCH)
hullbench_test(test_league SOURCES test_league.cpp
  LIBRARIES hullbench::league hullbench::tune hullbench::report LABELS harness)
hullbench_test(test_submission SOURCES test_submission.cpp
  LIBRARIES hullbench::record hullbench::hash LABELS harness RUNS_HULLBENCH TIMEOUT 600)
target_compile_definitions(test_submission PRIVATE SYSTEM_PYTHON="${SYSTEM_PYTHON}")
hullbench_test(test_suite SOURCES test_suite.cpp LIBRARIES hullbench::record LABELS harness RUNS_HULLBENCH)
hullbench_test(test_readme SOURCES test_readme.cpp
  LIBRARIES hullbench::run hullbench_invented_run LABELS harness RUNS_HULLBENCH)
hullbench_test(test_machines SOURCES test_machines.cpp
  LIBRARIES hullbench::run hullbench_invented_run hullbench::report LABELS harness)
hullbench_test(test_compare SOURCES test_compare.cpp
  LIBRARIES hullbench::report hullbench_invented_run LABELS harness RUNS_HULLBENCH)

# Google Benchmark's own tool, and the Python that its package brings the libraries for.
find_file(COMPARE_PY compare.py PATHS /usr/share/benchmark PATH_SUFFIXES tools NO_DEFAULT_PATH)
if(NOT COMPARE_PY)
  set(COMPARE_PY compare.py)
endif()
hullbench_test(test_gbench_export SOURCES test_gbench_export.cpp
  LIBRARIES hullbench::report hullbench_invented_run LABELS harness RUNS_HULLBENCH)
target_compile_definitions(test_gbench_export PRIVATE COMPARE_PY="${COMPARE_PY}")

# The search for parameters.
hullbench_test(test_tune_search SOURCES test_tune_search.cpp LIBRARIES hullbench::tune LABELS harness)
hullbench_test(test_rule_fit SOURCES test_rule_fit.cpp
  LIBRARIES hullbench::tune hullbench::adapters hullbench::metrics hullbench::datasets LABELS harness)
hullbench_test(test_limit_fit SOURCES test_limit_fit.cpp
  LIBRARIES hullbench::tune hullbench::metrics hullbench::datasets LABELS harness)
hullbench_test(test_tune SOURCES test_tune.cpp
  LIBRARIES hullbench::record hullbench::run hullbench::metrics LABELS harness RUNS_HULLBENCH)

hullbench_test(test_command_line SOURCES test_command_line.cpp LIBRARIES hullbench::record LABELS harness RUNS_HULLBENCH)

add_test(NAME evaluate.searches_measures_and_judges
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/check_evaluate.sh" "${PROJECT_SOURCE_DIR}")
set_tests_properties(evaluate.searches_measures_and_judges PROPERTIES LABELS harness)

# The reference run: what may become it, what it is, and that the README shows its numbers.
add_test(NAME reference.is_of_this_revision
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/check_reference.sh" "${PROJECT_SOURCE_DIR}")
set_tests_properties(reference.is_of_this_revision PROPERTIES SKIP_RETURN_CODE 77)
hullbench_test(test_reference SOURCES test_reference.cpp
  LIBRARIES hullbench::league hullbench::report hullbench_test_program LABELS harness TIMEOUT 300 IN_ONE)
add_test(NAME readme.has_the_reference_run
  COMMAND hullbench readme --check results/reference README.md
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")

# Methods that are added: manifests, the skeletons of `hullbench adapter new`, and the contract.
hullbench_test(test_manifest SOURCES test_manifest.cpp
  LIBRARIES hullbench::run hullbench_test_program LABELS harness)
hullbench_test(test_adapter_command SOURCES test_adapter_command.cpp LABELS harness RUNS_HULLBENCH STARTS_EARLY)

# The methods in JavaScript and Python that filter triangles, against the core.
hullbench_test(test_triangle_methods SOURCES test_triangle_methods.cpp
  LIBRARIES hullbench::run hullbench::metrics hullbench_test_support LABELS harness)

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
foreach(method IN ITEMS polylidar polylidar_steps cgal_alpha_shape cgal_delaunay sfcgal_alpha_shape spatialite geos_concave_hull chi_shape
    knn_hull convex_hull concaveman delaunator hull_js turf_concave jts_concave_hull scipy_alpha_shape shrink_boundary)
  add_test(NAME contract.${method} COMMAND hullbench adapter test ${method})
  set_tests_properties(contract.${method} PROPERTIES SKIP_RETURN_CODE 6)
endforeach()
# These two make an invalid polygon of 20000 points, which is a row of its own in every table; a version that is mended keeps
# the whole contract. What is found invalid first, and its name, are for the version of GEOS.
set_tests_properties(contract.spatialite contract.turf_concave PROPERTIES PASS_REGULAR_EXPRESSION
  "FAIL  20000 points within the limits invalid polygon, .*keeps part of the contract: 19 of 20;keeps the contract: ")
# SFCGAL up to 2.0 puts two shells into one ring.
set_tests_properties(contract.sfcgal_alpha_shape PROPERTIES PASS_REGULAR_EXPRESSION
  "keeps the contract: ;FAIL  two clusters far apart .*keeps part of the contract: 19 of 20")
