# hullbench::metrics: scores of a result against its ground truth, with GEOS.
find_package(GEOS CONFIG REQUIRED)

add_library(hullbench_metrics STATIC metrics.cpp)
add_library(hullbench::metrics ALIAS hullbench_metrics)
target_include_directories(hullbench_metrics PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_metrics
  PUBLIC polylidar::core PRIVATE GEOS::geos_c hullbench::compile_options)
