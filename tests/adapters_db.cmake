# The database adapters, the bytes they exchange and the servers they use.
foreach(part IN ITEMS spatialite spatialite_steps postgis postgis_legacy postgis_steps)
  if(NOT TARGET hullbench_adapter_${part})
    message(FATAL_ERROR "The tests need the adapter ${part}: install what the line above names, or configure with -DHULLBENCH_TESTS=OFF")
  endif()
endforeach()

hullbench_test(test_wkb SOURCES test_wkb.cpp LIBRARIES hullbench_adapter_interface)
hullbench_test(test_spatialite SOURCES test_spatialite.cpp
  LIBRARIES hullbench_adapter_spatialite hullbench_adapter_interface)
hullbench_test(test_spatialite_steps SOURCES test_spatialite_steps.cpp
  LIBRARIES hullbench_adapter_spatialite_steps hullbench_adapter_spatialite hullbench_adapter_interface
    hullbench::datasets)
hullbench_test(test_private_postgres SOURCES test_private_postgres.cpp
  LIBRARIES hullbench_adapter_postgis hullbench_adapter_interface)

# One entry for all its cases: they share a server, which takes seconds to start.
add_executable(test_postgis test_postgis.cpp test_postgis_steps.cpp)
target_link_libraries(test_postgis PRIVATE hullbench_adapter_postgis_legacy hullbench_adapter_postgis_steps
  hullbench_adapter_postgis hullbench_adapter_polylidar hullbench_adapter_interface hullbench_test_support
  hullbench::datasets PkgConfig::LIBPQ GTest::gtest hullbench::compile_options)
set_target_properties(test_postgis PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
add_test(NAME test_postgis COMMAND test_postgis)
set_tests_properties(test_postgis PROPERTIES TIMEOUT 300)

# The system's Python: the one that docker-compose and its YAML module belong to.
find_program(SYSTEM_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
add_test(NAME docker_compose
  COMMAND "${SYSTEM_PYTHON}" "${CMAKE_CURRENT_SOURCE_DIR}/check_compose.py" "${PROJECT_SOURCE_DIR}/docker-compose.yml")
