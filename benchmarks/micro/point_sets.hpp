// The point sets on which the core's speed is measured.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// Points, and the alpha that the paper's rule 2 * sqrt(area / n) gives for the area they fill.
struct SpeedPointSet {
  std::vector<polylidar::Point> points;
  double alpha = 0;
};

/// About `n` points of one of the sets "ca" (uniform in California), "uniform" (in the unit square),
/// "lattice" (a square integer lattice) and "rgbd" (424 columns, jittered by a tenth of their spacing, as a
/// depth image of a floor gives). The same bytes at every call. Throws std::invalid_argument for another
/// name.
SpeedPointSet make_speed_point_set(const std::string& name, std::size_t n);

}  // namespace hullbench
