#include "benchmarks/gate/probe/measured_steps.hpp"

extern "C" void gate_step(hullbench::Step step, hullbench::StepData& data) {
  if (step == hullbench::Step::kTriangulation) {
    data.extractor.triangulate(data.points);
  } else {
    data.extractor.extract_regions({.alpha = data.alpha});
    data.shape = &data.extractor.extract_polygons();
  }
}
