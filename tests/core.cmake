# The core's tests. Those that need nothing but the core are built in a core-only build too; there the predicates'
# test joins them when Boost's headers are at hand.
add_library(hullbench_test_support STATIC point_sets.cpp hull_oracle.cpp)
target_include_directories(hullbench_test_support PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_test_support PUBLIC polylidar::core PRIVATE hullbench::compile_options)

hullbench_test(test_delaunay SOURCES test_delaunay.cpp LIBRARIES hullbench_test_support LABELS core)
hullbench_test(test_concave_hull SOURCES test_concave_hull.cpp LIBRARIES hullbench_test_support LABELS core)

if(HULLBENCH_CORE_ONLY)
  find_package(Boost QUIET)
else()
  find_package(Boost REQUIRED)
endif()
if(Boost_FOUND)
  hullbench_test(test_predicates SOURCES test_predicates.cpp
    LIBRARIES hullbench_test_support Boost::headers LABELS core)
else()
  message(STATUS "test_predicates: not built, Boost's headers are missing (apt-get install libboost-dev)")
endif()

if(NOT HULLBENCH_CORE_ONLY)
  find_package(CGAL REQUIRED)
  hullbench_test(test_delaunay_against_cgal SOURCES test_delaunay_against_cgal.cpp
    LIBRARIES hullbench_test_support CGAL::CGAL LABELS core)
  hullbench_test(test_concave_hull_validity SOURCES test_concave_hull_validity.cpp
    LIBRARIES hullbench_test_support hullbench::metrics Boost::headers LABELS core)
endif()
