// What every hull that is one simple polygon round all its points must be.
#pragma once

#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::testing {

/// One valid polygon without holes, in the opinion of two libraries, counter-clockwise, whose vertices are
/// among `points`, with every point in it or on it.
void expect_one_simple_polygon_round(const std::vector<polylidar::Point>& points,
                                     const polylidar::MultiPolygon& hull);

}  // namespace hullbench::testing
