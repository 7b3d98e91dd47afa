# The gate on speed: its statistics, its rules, its program with scripted probes, its script, and the workflow that calls it.
hullbench_test(test_gate
  SOURCES test_gate_program.cpp test_gate_script.cpp test_gate_statistics.cpp test_gate_verdict.cpp
  LIBRARIES hullbench::gate hullbench_test_program nlohmann_json::nlohmann_json LABELS gate LIGHT)
target_compile_definitions(test_gate PRIVATE
  BENCH_GATE="$<TARGET_FILE:bench_gate>" GATE_SCRIPT="${PROJECT_SOURCE_DIR}/benchmarks/gate/gate.sh")
add_dependencies(test_gate bench_gate)

hullbench_tool_test(NAME gate.workflow NEEDS "${SYSTEM_PYTHON}:yaml"
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/check_workflow.py"
          "${PROJECT_SOURCE_DIR}/.github/workflows" "${PROJECT_SOURCE_DIR}/Makefile")
set_tests_properties(gate.workflow PROPERTIES LABELS gate TIMEOUT 60)

# The changed cores of "make test-gate" are patches of this one.
foreach(patch IN ITEMS ten-percent-more-work five-percent-more-work changed-result broken)
  hullbench_tool_test(NAME gate.${patch}_fits NEEDS git
    COMMAND git apply --check "${CMAKE_CURRENT_LIST_DIR}/gate/${patch}.patch")
  set_tests_properties(gate.${patch}_fits PROPERTIES
    LABELS gate TIMEOUT 60 WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}")
endforeach()
