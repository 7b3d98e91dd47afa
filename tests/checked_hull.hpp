// The concave hull, after the core's own checks of it, and against its triangles.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/hull_oracle.hpp"

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

/// Squares of coordinates, and so areas, are doubles within this extent.
inline bool has_representable_area(const std::vector<Point>& points) {
  const Box box = bounding_box(points);
  const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  return points.empty() || (extent < 1e150 && extent > 1e-150);
}

/// Expects that the hull under each of these options is the shape of the triangles that they keep.
inline void expect_the_shapes_of_their_triangles(const std::vector<Point>& points,
                                                 const std::vector<Options>& all) {
  const Triangulation triangulation = delaunay(points);
  for (const Options& options : all) {
    SCOPED_TRACE(describe(options));
    const MultiPolygon shape = checked_hull(points, options);
    const ExpectedShape expected = expected_shape(points, triangulation, options);
    EXPECT_EQ(shape.size(), expected.polygons);
    EXPECT_EQ(hole_count(shape), expected.holes);
    if (has_representable_area(points)) {
      EXPECT_NEAR(area(shape), expected.area, area_tolerance(points));
    }
  }
}

}  // namespace polylidar::testing
