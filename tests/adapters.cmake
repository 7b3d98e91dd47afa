# The methods that run in this process and need no database.
set(sources "")
set(libraries "")
foreach(part IN ITEMS geos_concave_hull chi_shape knn_hull convex_hull)
  if(TARGET hullbench_adapter_${part})
    list(APPEND sources test_${part}.cpp)
    list(APPEND libraries hullbench_adapter_${part})
  else()
    hullbench_skipped_test(test_${part} "this build does not have the method ${part}")
  endif()
endforeach()
hullbench_test(test_adapters
  SOURCES ${sources} test_adapter_module.cpp test_method_contracts.cpp test_ring_nesting.cpp test_wkb.cpp
    ../adapters/ring_nesting.cpp
  LIBRARIES ${libraries} hullbench::adapters hullbench_adapter_interface hullbench_boost_checks hullbench_test_support
  LABELS adapters)
add_test(NAME adapters.source_hashes
  COMMAND "${CMAKE_CURRENT_LIST_DIR}/check_source_hashes.sh" "${PROJECT_SOURCE_DIR}/adapters/hash_sources.cmake")
set_tests_properties(adapters.source_hashes PROPERTIES LABELS adapters)
# What workers in other languages do off the clock.
set(check_helpers "${CMAKE_CURRENT_LIST_DIR}/check_worker_helpers.sh")
hullbench_tool_test(NAME workers.javascript NEEDS node python3 COMMAND "${check_helpers}" javascript)
hullbench_tool_test(NAME workers.python NEEDS "${SYSTEM_PYTHON}:numpy" COMMAND "${check_helpers}" python)
hullbench_tool_test(NAME workers.java
  NEEDS javac java python3 /usr/share/java/jts-core.jar /usr/share/java/gson.jar COMMAND "${check_helpers}" java)
set_tests_properties(workers.javascript workers.python workers.java PROPERTIES LABELS adapters)
if(TARGET hullbench_adapter_pcl_concave_hull)
  hullbench_test(test_pcl_concave_hull SOURCES test_pcl_concave_hull.cpp
    LIBRARIES hullbench_adapter_pcl_concave_hull hullbench_adapter_interface hullbench_test_support hullbench::metrics
    LABELS adapters)
endif()
