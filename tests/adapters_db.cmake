# The database adapters and the servers they use.
if(TARGET hullbench_adapter_spatialite)
  hullbench_test(test_spatialite SOURCES test_spatialite.cpp test_spatialite_steps.cpp
    LIBRARIES hullbench_adapter_spatialite_steps hullbench_adapter_spatialite hullbench_adapter_interface
      hullbench::datasets)
else()
  hullbench_skipped_test(test_spatialite "this build does not have the methods of SpatiaLite")
endif()

if(TARGET hullbench_adapter_postgis)
  hullbench_test(test_private_postgres SOURCES test_private_postgres.cpp
    LIBRARIES hullbench_adapter_postgis hullbench_adapter_interface LIGHT)

  # One entry for all its cases: they share a server, which takes seconds to start.
  add_executable(test_postgis test_postgis.cpp test_postgis_steps.cpp)
  target_link_libraries(test_postgis PRIVATE hullbench_adapter_postgis_legacy hullbench_adapter_postgis_steps
    hullbench_adapter_postgis hullbench_adapter_geos_concave_hull hullbench_adapter_polylidar hullbench_adapter_interface hullbench_test_support
    hullbench::datasets PkgConfig::LIBPQ GTest::gtest hullbench::compile_options)
  set_target_properties(test_postgis PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  add_test(NAME test_postgis COMMAND test_postgis)
  set_tests_properties(test_postgis PROPERTIES TIMEOUT 300 COST ${HULLBENCH_COST_OF_LONG_TESTS})
else()
  hullbench_skipped_test(test_postgis "this build does not have the methods of PostGIS")
endif()

hullbench_tool_test(NAME docker_compose NEEDS docker-compose "${SYSTEM_PYTHON}:yaml"
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_SOURCE_DIR}/check_compose.py" "${PROJECT_SOURCE_DIR}/docker-compose.yml")
