# The gate on speed: its statistics, its rules, its program with scripted probes, its script, and the workflow that calls it.
hullbench_test(test_gate_statistics SOURCES test_gate_statistics.cpp LIBRARIES hullbench::gate LABELS gate)
hullbench_test(test_gate_verdict SOURCES test_gate_verdict.cpp LIBRARIES hullbench::gate LABELS gate)
hullbench_test(test_gate_program SOURCES test_gate_program.cpp
  LIBRARIES hullbench_test_program nlohmann_json::nlohmann_json LABELS gate)
target_compile_definitions(test_gate_program PRIVATE BENCH_GATE="$<TARGET_FILE:bench_gate>")
add_dependencies(test_gate_program bench_gate)
hullbench_test(test_gate_script SOURCES test_gate_script.cpp LIBRARIES hullbench_test_program LABELS gate)
target_compile_definitions(test_gate_script PRIVATE GATE_SCRIPT="${PROJECT_SOURCE_DIR}/benchmarks/gate/gate.sh")

hullbench_tool_test(NAME gate.workflow NEEDS "${SYSTEM_PYTHON}:yaml"
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/check_workflow.py"
          "${PROJECT_SOURCE_DIR}/.github/workflows" "${PROJECT_SOURCE_DIR}/Makefile")
set_tests_properties(gate.workflow PROPERTIES LABELS gate TIMEOUT 60)
