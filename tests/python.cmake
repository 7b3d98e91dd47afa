# The Python module, with the Python that it is built for.
if(NOT TARGET polylidar_python)
  if(HULLBENCH_PYTHON)
    hullbench_skipped_test(python.module "this build does not have the Python module; it needs pybind11 and Python's headers")
  endif()
  return()
endif()
set(python_environment "PYTHONPATH=${PROJECT_BINARY_DIR}/python")
if(TARGET hullbench)
  list(APPEND python_environment "HULLBENCH=$<TARGET_FILE:hullbench>")
endif()
hullbench_tool_test(NAME python.module NEEDS "${POLYLIDAR_PYTHON}:numpy" "${POLYLIDAR_PYTHON}:shapely"
  COMMAND "${POLYLIDAR_PYTHON}" -B -m unittest test_python_module)
set_tests_properties(python.module PROPERTIES LABELS python TIMEOUT 120 ENVIRONMENT "${python_environment}"
  WORKING_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}")
