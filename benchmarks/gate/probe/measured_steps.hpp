// The calls that are measured.
#pragma once

#include <span>

#include "polylidar/concave_hull.hpp"

namespace hullbench {

enum class Step {
  kTriangulation,  ///< the Delaunay triangulation, on one thread
  kOutline         ///< what follows it: regions and polygons
};

/// What a step works on and makes.
struct StepData {
  polylidar::Extractor extractor;
  std::span<const polylidar::Point> points;
  double alpha = 0;
  /// The result of the last kOutline, valid until the extractor's next call.
  const polylidar::IndexedMultiPolygon* shape = nullptr;
};

}  // namespace hullbench

/// One function for all steps, in a file of its own so that it is never inlined: callgrind finds it by name
/// and counts in it alone. (With two functions named, callgrind 3.19 gave wrong counts: zero, or the
/// program's start among them.)
extern "C" void gate_step(hullbench::Step step, hullbench::StepData& data);
