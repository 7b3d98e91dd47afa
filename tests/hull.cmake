# Points from files, and `polylidar hull`, which makes polygons of them.
find_package(GEOS CONFIG REQUIRED)

# LAZ files by an encoder of our own.
add_library(hullbench_laz_files STATIC laz_file.cpp laz_samples.cpp)
target_include_directories(hullbench_laz_files PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_laz_files PUBLIC polylidar::core PRIVATE hullbench::compile_options)

hullbench_test(test_tool
  SOURCES
    test_crs.cpp
    test_group_hulls.cpp
    test_las_points.cpp
    test_laz_points.cpp
    test_point_files.cpp
    test_shard_file.cpp
    test_simplify.cpp
    test_free_memory.cpp
    test_status_line.cpp
  LIBRARIES hullbench_laz_files polylidar::tool hullbench::metrics LABELS hull)
target_include_directories(test_tool PRIVATE "${PROJECT_SOURCE_DIR}")

hullbench_test(test_tool_commands
  SOURCES test_choose_command.cpp test_footprint_command.cpp test_hull_command.cpp test_points_command.cpp
  LIBRARIES hullbench_laz_files polylidar::tool_commands hullbench::run hullbench::metrics hullbench::datasets hullbench_adapter_interface
    nlohmann_json::nlohmann_json GEOS::geos_c
  LABELS hull RUNS_HULLBENCH LIGHT)
target_compile_definitions(test_tool_commands PRIVATE
  POLYLIDAR="$<TARGET_FILE:polylidar>" MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>")
add_dependencies(test_tool_commands misbehaving_worker polylidar)
# Our LAZ encoder and decoder by the decoder of laz-perf, so that they cannot be wrong together.
add_executable(write_laz_files write_laz_files.cpp)
target_link_libraries(write_laz_files PRIVATE hullbench_laz_files hullbench::compile_options)
add_executable(print_laz_points print_laz_points.cpp)
target_link_libraries(print_laz_points PRIVATE polylidar::tool hullbench::compile_options)
set_target_properties(write_laz_files print_laz_points PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
hullbench_tool_test(NAME hull.laz_perf NEEDS node "${CMAKE_CURRENT_LIST_DIR}/report/node_modules/laz-perf"
  COMMAND ${CMAKE_COMMAND} -E env "WRITE_LAZ_FILES=$<TARGET_FILE:write_laz_files>"
          "PRINT_LAZ_POINTS=$<TARGET_FILE:print_laz_points>" "OUTPUT=${CMAKE_BINARY_DIR}/tests/laz_files"
          node --test --test-reporter=spec "${CMAKE_CURRENT_LIST_DIR}/report/laz.test.mjs")
set_tests_properties(hull.laz_perf PROPERTIES LABELS hull TIMEOUT 120)
# With GDAL, where it is found: the program as a build with POLYLIDAR_WITH_GDAL has it.
if(TARGET polylidar_gdal)
  set(with_gdal polylidar)
  if(TARGET polylidar_with_gdal)
    set(with_gdal polylidar_with_gdal)
  endif()
  set(postgres "")
  if(TARGET hullbench_adapter_postgis)
    set(postgres hullbench_adapter_postgis)
  endif()
  hullbench_test(test_vector_formats SOURCES test_vector_formats.cpp
    LIBRARIES ${postgres} hullbench_adapter_interface polylidar::core hullbench_test_program GDAL::GDAL nlohmann_json::nlohmann_json
    LABELS hull LIGHT)
  target_compile_definitions(test_vector_formats PRIVATE
    POLYLIDAR_WITH_GDAL="$<TARGET_FILE:${with_gdal}>" $<$<BOOL:${postgres}>:HULLBENCH_HAS_POSTGRES>)
  add_dependencies(test_vector_formats ${with_gdal})
else()
  hullbench_skipped_test(vector_formats "GDAL is missing (apt-get install libgdal-dev)")
endif()
if(POLYLIDAR_WITH_GDAL)
  target_compile_definitions(test_tool_commands PRIVATE HAS_GDAL)
endif()
