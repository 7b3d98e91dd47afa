# Scores, and the adapter that the core is compared with.
hullbench_test(test_area_scores SOURCES test_area_scores.cpp
  LIBRARIES hullbench_test_support hullbench::metrics hullbench::datasets Boost::headers LABELS metrics)
hullbench_test(test_metrics SOURCES test_metrics.cpp boost_checks.cpp
  LIBRARIES hullbench_test_support hullbench::metrics hullbench::datasets Boost::headers LABELS metrics)
hullbench_test(test_metric_table SOURCES test_metric_table.cpp LIBRARIES hullbench::metrics LABELS metrics)

if(TARGET hullbench_adapter_cgal_alpha_shape)
  hullbench_test(test_cgal_alpha_shape SOURCES test_cgal_alpha_shape.cpp
    LIBRARIES hullbench_test_support hullbench_adapter_cgal_alpha_shape hullbench_adapter_interface
      hullbench::metrics hullbench::datasets CGAL::CGAL
    LABELS adapters)
  hullbench_test(test_cgal_delaunay SOURCES test_cgal_delaunay.cpp
    LIBRARIES hullbench_test_support hullbench_adapter_cgal_delaunay hullbench_adapter_interface hullbench::metrics
    LABELS adapters)
endif()
if(TARGET hullbench_adapter_sfcgal_alpha_shape)
  hullbench_test(test_sfcgal_alpha_shape SOURCES test_sfcgal_alpha_shape.cpp
    LIBRARIES hullbench_test_support hullbench_adapter_sfcgal_alpha_shape hullbench_adapter_interface
      hullbench::datasets
    LABELS adapters)
endif()

hullbench_test(test_hexbin SOURCES test_hexbin.cpp LIBRARIES hullbench::footprint hullbench::metrics LABELS metrics)
