# The Python module, with the Python that it is built for.
if(NOT TARGET polylidar_python)
  if(HULLBENCH_PYTHON)
    foreach(test IN ITEMS module examples types wheel)
      hullbench_skipped_test(python.${test} "this build does not have the Python module; it needs pybind11 and Python's headers")
    endforeach()
  endif()
  return()
endif()
set(python_environment "PYTHONPATH=${PROJECT_BINARY_DIR}/python")
if(TARGET hullbench)
  list(APPEND python_environment "HULLBENCH=$<TARGET_FILE:hullbench>")
endif()

# hullbench_python_test(NAME module NEEDS need...): the test python.NAME, which is test_python_NAME.py. A need that begins
# with ":" is a module of the Python.
function(hullbench_python_test name)
  cmake_parse_arguments(TEST "" "TIMEOUT" "NEEDS;ENVIRONMENT" ${ARGN})
  list(TRANSFORM TEST_NEEDS REPLACE "^:" "${POLYLIDAR_PYTHON}:")
  hullbench_tool_test(NAME python.${name} NEEDS ${TEST_NEEDS}
    COMMAND "${POLYLIDAR_PYTHON}" -B -m unittest test_python_${name})
  set_tests_properties(python.${name} PROPERTIES LABELS python TIMEOUT ${TEST_TIMEOUT}
    ENVIRONMENT "${python_environment};${TEST_ENVIRONMENT}" WORKING_DIRECTORY "${CMAKE_CURRENT_FUNCTION_LIST_DIR}")
endfunction()

hullbench_python_test(module TIMEOUT 120 NEEDS :numpy :shapely)
hullbench_python_test(examples TIMEOUT 120 NEEDS :numpy :shapely :matplotlib :geopandas ENVIRONMENT MPLBACKEND=Agg)
hullbench_python_test(types TIMEOUT 300 NEEDS :numpy :mypy)
# Compiles the core a second time, without the debugging symbols that Python's own flags ask for.
hullbench_python_test(wheel TIMEOUT 900 NEEDS :numpy :shapely :pip :setuptools :wheel :pybind11
  ENVIRONMENT "HULLBENCH_BUILD=${PROJECT_BINARY_DIR}" "CC=${CMAKE_CXX_COMPILER_LAUNCHER} ${CMAKE_CXX_COMPILER}"
    "CXX=${CMAKE_CXX_COMPILER_LAUNCHER} ${CMAKE_CXX_COMPILER}" "CFLAGS=-g0" "POLYLIDAR_JOBS=2")
set_tests_properties(python.wheel PROPERTIES COST ${HULLBENCH_COST_OF_LONG_TESTS})
