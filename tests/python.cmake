# The Python module, with the Python that it is built for.
if(NOT TARGET polylidar_python)
  return()
endif()
set(python_environment "PYTHONPATH=${PROJECT_BINARY_DIR}/python")
if(TARGET hullbench)
  list(APPEND python_environment "HULLBENCH=$<TARGET_FILE:hullbench>")
endif()
add_test(NAME python.module COMMAND "${POLYLIDAR_PYTHON}" -B -m unittest test_python_module
  WORKING_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}")
set_tests_properties(python.module PROPERTIES LABELS python TIMEOUT 120 ENVIRONMENT "${python_environment}")
