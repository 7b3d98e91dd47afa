# Scores, and the adapter that the core is compared with.

# Boost.Geometry's opinion, compiled once for all tests that ask for it.
add_library(hullbench_boost_checks STATIC
  "${CMAKE_CURRENT_LIST_DIR}/boost_checks.cpp" "${CMAKE_CURRENT_LIST_DIR}/simple_hull.cpp")
target_link_libraries(hullbench_boost_checks PRIVATE
  hullbench_test_support hullbench::metrics Boost::headers GTest::gtest hullbench::compile_options)
target_compile_definitions(hullbench_boost_checks PRIVATE BOOST_ALLOW_DEPRECATED_HEADERS)
# g++ 12 finds uninitialised values in Boost.Geometry 1.74 where there are none.
target_compile_options(hullbench_boost_checks PRIVATE -O1 "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>")

hullbench_test(test_metrics
  SOURCES test_area_scores.cpp test_hexbin.cpp test_metric_table.cpp test_metrics.cpp
  LIBRARIES hullbench_boost_checks hullbench_test_support hullbench::footprint hullbench::metrics hullbench::datasets
  LABELS metrics)

if(TARGET hullbench_adapter_cgal_alpha_shape)
  hullbench_test(test_cgal_methods SOURCES test_cgal_alpha_shape.cpp test_cgal_delaunay.cpp
    LIBRARIES hullbench_test_support hullbench_adapter_cgal_alpha_shape hullbench_adapter_cgal_delaunay
      hullbench_adapter_interface hullbench::metrics hullbench::datasets CGAL::CGAL
    LABELS adapters)
endif()
if(TARGET hullbench_adapter_sfcgal_alpha_shape)
  hullbench_test(test_sfcgal_alpha_shape SOURCES test_sfcgal_alpha_shape.cpp
    LIBRARIES hullbench_test_support hullbench_adapter_sfcgal_alpha_shape hullbench_adapter_interface
      hullbench::datasets
    LABELS adapters)
endif()
