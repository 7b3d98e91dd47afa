// Points that break assumptions: too few of them, all on a line, all the same, far from the origin.
#pragma once

#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// One such set of points.
struct DegenerateInput {
  std::string name;   ///< of the data set: "degenerate_collinear"
  std::string title;  ///< as printed in tables
  std::vector<polylidar::Point> points;
  /// What the points came from; empty when that has no area: then nothing can be scored, and the only result
  /// that is right is an empty one.
  polylidar::MultiPolygon ground_truth;
};

/// Every one, the same bits on every machine. Points on a line or a circle are on it exactly: their
/// coordinates are whole numbers.
const std::vector<DegenerateInput>& degenerate_inputs();

}  // namespace hullbench
