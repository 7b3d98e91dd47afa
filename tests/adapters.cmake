# The methods that run in this process and need no database.
foreach(part IN ITEMS geos_concave_hull chi_shape knn_hull convex_hull)
  if(NOT TARGET hullbench_adapter_${part})
    hullbench_skipped_test(test_${part} "this build does not have the method ${part}")
    continue()
  endif()
  hullbench_test(test_${part} SOURCES test_${part}.cpp
    LIBRARIES hullbench_adapter_${part} hullbench_adapter_interface hullbench_boost_checks hullbench_test_support LABELS adapters)
endforeach()
if(TARGET test_geos_concave_hull)
  target_link_libraries(test_geos_concave_hull PRIVATE hullbench_adapter_chi_shape)
endif()

hullbench_test(test_ring_nesting SOURCES test_ring_nesting.cpp ../adapters/ring_nesting.cpp
  LIBRARIES hullbench_test_support LABELS adapters)
add_test(NAME adapters.source_hashes
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/check_source_hashes.sh" "${PROJECT_SOURCE_DIR}/adapters/hash_sources.cmake")
set_tests_properties(adapters.source_hashes PROPERTIES LABELS adapters)
if(TARGET hullbench_adapter_pcl_concave_hull)
  hullbench_test(test_pcl_concave_hull SOURCES test_pcl_concave_hull.cpp
    LIBRARIES hullbench_adapter_pcl_concave_hull hullbench_adapter_interface hullbench_test_support hullbench::metrics
    LABELS adapters)
  add_test(NAME contract.pcl_concave_hull COMMAND hullbench adapter test pcl_concave_hull)
endif()

hullbench_test(test_adapter_module SOURCES test_adapter_module.cpp LIBRARIES hullbench::adapters LABELS adapters)
hullbench_test(test_method_contracts SOURCES test_method_contracts.cpp LIBRARIES hullbench::adapters LABELS adapters)
