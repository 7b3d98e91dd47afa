# Points from files, and `polylidar hull`, which makes polygons of them.
find_package(GEOS CONFIG REQUIRED)

hullbench_test(test_tool
  SOURCES
    test_crs.cpp
    test_group_hulls.cpp
    test_las_points.cpp
    test_point_files.cpp
    test_shard_file.cpp
    test_simplify.cpp
    test_free_memory.cpp
    test_status_line.cpp
  LIBRARIES polylidar::tool hullbench::metrics LABELS hull)
target_include_directories(test_tool PRIVATE "${PROJECT_SOURCE_DIR}")

hullbench_test(test_tool_commands
  SOURCES test_choose_command.cpp test_footprint_command.cpp test_hull_command.cpp test_points_command.cpp
  LIBRARIES polylidar::tool_commands hullbench::run hullbench::metrics hullbench::datasets hullbench_adapter_interface
    nlohmann_json::nlohmann_json GEOS::geos_c
  LABELS hull RUNS_HULLBENCH LIGHT)
target_compile_definitions(test_tool_commands PRIVATE
  POLYLIDAR="$<TARGET_FILE:polylidar>" MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>")
add_dependencies(test_tool_commands misbehaving_worker polylidar)
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
