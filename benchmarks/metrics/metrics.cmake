# hullbench::metrics: scores of a result against its ground truth, with GEOS. METRICS.md defines them.
find_package(GEOS CONFIG REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)

add_library(hullbench_metrics STATIC
  metrics/anchors.cpp
  metrics/area.cpp
  metrics/boundary.cpp
  metrics/boundary_band.cpp
  metrics/geos_session.cpp
  metrics/metric_table.cpp
  metrics/metric_table_output.cpp
  metrics/metrics.cpp
  metrics/output_contract.cpp
  metrics/prepared_truth.cpp
  metrics/segment_tree.cpp
  metrics/shape_measures.cpp
  metrics/topology.cpp
  metrics/triangle_outline.cpp
  metrics/validity.cpp)
add_library(hullbench::metrics ALIAS hullbench_metrics)
target_include_directories(hullbench_metrics PUBLIC "${PROJECT_SOURCE_DIR}")
target_link_libraries(hullbench_metrics
  PUBLIC polylidar::core nlohmann_json::nlohmann_json
  PRIVATE hullbench::datasets GEOS::geos_c hullbench::compile_options)
