# Plans, workers, the runner and the command line.
add_library(hullbench_test_program STATIC "${CMAKE_CURRENT_LIST_DIR}/program.cpp")
target_include_directories(hullbench_test_program PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_test_program PRIVATE GTest::gtest hullbench::compile_options)

add_executable(misbehaving_worker "${CMAKE_CURRENT_LIST_DIR}/misbehaving_worker.cpp")
set_target_properties(misbehaving_worker PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
target_link_libraries(misbehaving_worker PRIVATE hullbench::worker hullbench::compile_options)

hullbench_test(test_plan SOURCES test_plan.cpp LIBRARIES hullbench::runner LABELS harness)
target_compile_definitions(test_plan PRIVATE HULLBENCH_PLAN_FOLDER="${PROJECT_SOURCE_DIR}/benchmarks/plans")

hullbench_test(test_shard SOURCES test_shard.cpp LIBRARIES hullbench::runner LABELS harness)

hullbench_test(test_parallel SOURCES test_parallel.cpp LIBRARIES hullbench::runner LABELS harness)

hullbench_test(test_worker SOURCES test_worker.cpp
  LIBRARIES hullbench::worker hullbench_test_program LABELS harness)
target_compile_definitions(test_worker PRIVATE MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>")
add_dependencies(test_worker misbehaving_worker)

hullbench_test(test_runner SOURCES test_runner.cpp
  LIBRARIES hullbench::runner hullbench::report hullbench_test_program LABELS harness)
target_compile_definitions(test_runner PRIVATE
  MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>" HULLBENCH="$<TARGET_FILE:hullbench>")
add_dependencies(test_runner misbehaving_worker hullbench)

hullbench_test(test_suite SOURCES test_suite.cpp LIBRARIES hullbench::record hullbench_test_program LABELS harness)
hullbench_test(test_readme SOURCES test_readme.cpp
  LIBRARIES hullbench::runner hullbench_invented_run hullbench_test_program LABELS harness)
hullbench_test(test_machines SOURCES test_machines.cpp
  LIBRARIES hullbench::runner hullbench_invented_run hullbench::report LABELS harness)
hullbench_test(test_compare SOURCES test_compare.cpp
  LIBRARIES hullbench::report hullbench_invented_run hullbench_test_program LABELS harness)

# Google Benchmark's own tool, and the Python that its package brings the libraries for.
find_file(COMPARE_PY compare.py PATHS /usr/share/benchmark PATH_SUFFIXES tools NO_DEFAULT_PATH REQUIRED)
find_program(DEBIAN_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
hullbench_test(test_gbench_export SOURCES test_gbench_export.cpp
  LIBRARIES hullbench::report hullbench_invented_run hullbench_test_program LABELS harness)
target_compile_definitions(test_gbench_export PRIVATE COMPARE_PY="${COMPARE_PY}" DEBIAN_PYTHON="${DEBIAN_PYTHON}")

foreach(part IN ITEMS suite readme compare gbench_export)
  target_compile_definitions(test_${part} PRIVATE HULLBENCH="$<TARGET_FILE:hullbench>")
  add_dependencies(test_${part} hullbench)
endforeach()

hullbench_test(test_command_line SOURCES test_command_line.cpp
  LIBRARIES hullbench::record hullbench_test_program LABELS harness)
target_compile_definitions(test_command_line PRIVATE HULLBENCH="$<TARGET_FILE:hullbench>")
add_dependencies(test_command_line hullbench)

# The reference run, and that the README shows its numbers.
hullbench_test(test_reference SOURCES test_reference.cpp
  LIBRARIES hullbench::runner hullbench::report hullbench_test_program LABELS harness)
target_compile_definitions(test_reference PRIVATE HULLBENCH_SOURCE_DIRECTORY="${PROJECT_SOURCE_DIR}")
add_test(NAME readme.has_the_reference_run
  COMMAND hullbench readme --check results/reference README.md
  WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
