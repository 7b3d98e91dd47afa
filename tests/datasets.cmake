find_package(PNG REQUIRED)

hullbench_test(test_datasets
  SOURCES
    test_datasets.cpp
    test_families.cpp
    test_holes.cpp
    test_portable_math.cpp
    test_random.cpp
    test_recordings.cpp
    test_rgbd.cpp
    test_sampling.cpp
    test_sha256.cpp
    test_shapes.cpp
    test_star_polygons.cpp
    test_stress.cpp
    test_stress_sensors.cpp
    test_stress_shapes.cpp
    test_tangled_shapes.cpp
    test_tissue.cpp
    test_towns.cpp
    test_world_shapes.cpp
  LIBRARIES hullbench_boost_checks hullbench_test_support hullbench::datasets hullbench::hash nlohmann_json::nlohmann_json Boost::headers PNG::PNG
  LABELS datasets)
foreach(golden IN ITEMS golden_hashes golden_stress)
  add_test(NAME datasets.${golden}
    COMMAND "${SYSTEM_PYTHON}" -B "${CMAKE_CURRENT_LIST_DIR}/${golden}.py" --check)
  set_tests_properties(datasets.${golden} PROPERTIES LABELS datasets TIMEOUT 600 COST ${HULLBENCH_COST_OF_LONG_TESTS})
endforeach()
hullbench_test(test_real_points
  SOURCES test_real_points.cpp
  LIBRARIES hullbench_test_program hullbench::datasets nlohmann_json::nlohmann_json
  LABELS datasets LIGHT)
target_compile_definitions(test_real_points PRIVATE
  HULLBENCH_REAL_PAGE="${PROJECT_SOURCE_DIR}/datasets/real/README.md"
  HULLBENCH_REAL_PLAN="${PROJECT_SOURCE_DIR}/benchmarks/plans/real.json")
hullbench_test(test_zoo
  SOURCES test_zoo.cpp
  LIBRARIES hullbench::datasets hullbench::hash polylidar::check nlohmann_json::nlohmann_json
  LABELS datasets)
target_compile_definitions(test_zoo PRIVATE
  HULLBENCH_ZOO_HASHES="${CMAKE_CURRENT_LIST_DIR}/data/zoo_hashes.txt"
  HULLBENCH_ZOO_PLAN="${PROJECT_SOURCE_DIR}/benchmarks/plans/zoo.json")
