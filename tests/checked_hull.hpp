// The concave hull, after the core's own checks of it.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"

namespace polylidar::testing {

/// Keeps the triangles of a unit lattice's cells (circumradius 0.707) and no others (the next is 1).
/// Whichever diagonal a cell got, both of its triangles are kept: the shape is unique although the
/// triangulation is not.
inline constexpr Options kUnitCells{.alpha = 0.75};

inline MultiPolygon checked_hull(const std::vector<Point>& points, const Options& options = {}) {
  const IndexedMultiPolygon shape = concave_hull(points, options);
  EXPECT_EQ(check_polygon(points, shape), "");
  return to_coordinates(shape, points);
}

}  // namespace polylidar::testing
