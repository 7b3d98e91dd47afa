# Points from files, and `polylidar hull`, which makes polygons of them.
find_package(GEOS CONFIG REQUIRED)

hullbench_test(test_point_files SOURCES test_point_files.cpp LIBRARIES polylidar::tool LABELS hull)

hullbench_test(test_hull_command SOURCES test_hull_command.cpp
  LIBRARIES polylidar::tool hullbench::metrics hullbench_adapter_interface hullbench_test_program
    nlohmann_json::nlohmann_json GEOS::geos_c
  LABELS hull)
target_compile_definitions(test_hull_command PRIVATE
  HULLBENCH="$<TARGET_FILE:hullbench>" POLYLIDAR="$<TARGET_FILE:polylidar>")
add_dependencies(test_hull_command hullbench polylidar)

hullbench_test(test_choose_command SOURCES test_choose_command.cpp
  LIBRARIES polylidar::tool hullbench::run LABELS hull RUNS_HULLBENCH)
target_compile_definitions(test_choose_command PRIVATE MISBEHAVING_WORKER="$<TARGET_FILE:misbehaving_worker>")
add_dependencies(test_choose_command misbehaving_worker polylidar)

hullbench_test(test_points_command SOURCES test_points_command.cpp
  LIBRARIES polylidar::tool hullbench::datasets hullbench_test_program LABELS hull)
target_compile_definitions(test_points_command PRIVATE HULLBENCH="$<TARGET_FILE:hullbench>")
add_dependencies(test_points_command hullbench)

hullbench_test(test_shard_file SOURCES test_shard_file.cpp LIBRARIES polylidar::tool LABELS hull)
hullbench_test(test_simplify SOURCES test_simplify.cpp LIBRARIES polylidar::tool hullbench::metrics LABELS hull)

hullbench_test(test_las_points SOURCES test_las_points.cpp LIBRARIES polylidar::tool LABELS hull)
hullbench_test(test_crs SOURCES test_crs.cpp LIBRARIES polylidar::tool LABELS hull)
hullbench_test(test_group_hulls SOURCES test_group_hulls.cpp LIBRARIES polylidar::tool LABELS hull)
hullbench_test(test_footprint_command SOURCES test_footprint_command.cpp
  LIBRARIES polylidar::tool hullbench_test_program nlohmann_json::nlohmann_json LABELS hull)
target_compile_definitions(test_footprint_command PRIVATE POLYLIDAR="$<TARGET_FILE:polylidar>")
add_dependencies(test_footprint_command polylidar)
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
    LABELS hull)
  target_compile_definitions(test_vector_formats PRIVATE
    POLYLIDAR_WITH_GDAL="$<TARGET_FILE:${with_gdal}>" $<$<BOOL:${postgres}>:HULLBENCH_HAS_POSTGRES>)
  add_dependencies(test_vector_formats ${with_gdal})
else()
  hullbench_skipped_test(vector_formats "GDAL is missing (apt-get install libgdal-dev)")
endif()
if(POLYLIDAR_WITH_GDAL)
  target_compile_definitions(test_footprint_command PRIVATE HAS_GDAL)
endif()

foreach(test point_files shard_file simplify las_points crs group_hulls)
  target_include_directories(test_${test} PRIVATE "${PROJECT_SOURCE_DIR}")
endforeach()
