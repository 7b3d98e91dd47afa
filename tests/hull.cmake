# Points from files, and `hullbench hull`, which makes polygons of them.
find_package(GEOS CONFIG REQUIRED)

hullbench_test(test_point_files SOURCES test_point_files.cpp LIBRARIES hullbench::point_files LABELS hull)
target_include_directories(test_point_files PRIVATE "${PROJECT_SOURCE_DIR}")

hullbench_test(test_hull_command SOURCES test_hull_command.cpp
  LIBRARIES hullbench::hull hullbench::metrics hullbench_adapter_interface hullbench_test_program
    nlohmann_json::nlohmann_json GEOS::geos_c
  LABELS hull)
target_compile_definitions(test_hull_command PRIVATE HULLBENCH="$<TARGET_FILE:hullbench>")
add_dependencies(test_hull_command hullbench)

hullbench_test(test_points_command SOURCES test_points_command.cpp
  LIBRARIES hullbench::point_files hullbench::datasets hullbench_test_program LABELS hull)
target_compile_definitions(test_points_command PRIVATE HULLBENCH="$<TARGET_FILE:hullbench>")
add_dependencies(test_points_command hullbench)
