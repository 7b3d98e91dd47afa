find_package(Boost REQUIRED)
find_package(nlohmann_json REQUIRED)

hullbench_test(test_datasets
  SOURCES
    boost_checks.cpp
    test_datasets.cpp
    test_holes.cpp
    test_point_locator.cpp
    test_random.cpp
    test_sampling.cpp
    test_sha256.cpp
    test_shapes.cpp
  LIBRARIES hullbench::datasets hullbench::hash nlohmann_json::nlohmann_json Boost::headers
  LABELS datasets)
# g++ 12 finds uninitialised values in Boost.Geometry 1.74 where there are none.
set_source_files_properties(boost_checks.cpp PROPERTIES
  COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>")
