# Scores, and the adapter that the core is compared with.
hullbench_test(test_metrics SOURCES test_metrics.cpp
  LIBRARIES hullbench_test_support hullbench::metrics hullbench::datasets Boost::headers LABELS metrics)

if(TARGET hullbench_adapter_cgal_alpha_shape)
  hullbench_test(test_cgal_alpha_shape SOURCES test_cgal_alpha_shape.cpp
    LIBRARIES hullbench_test_support hullbench_adapter_cgal_alpha_shape hullbench_adapter_interface
      hullbench::metrics CGAL::CGAL
    LABELS adapters)
endif()
