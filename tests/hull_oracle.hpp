// What a concave hull must be, worked out from the triangles alone: no half-edges, regions or rings.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"

namespace polylidar::testing {

/// Options that keep every triangle.
inline constexpr Options kConvexHull{.alpha = kNoLimit};

/// `options` in words, for messages.
std::string describe(const Options& options);

/// `options` for points that are `scale` times as far apart. Limits that are not given stay so.
Options scaled(Options options, double scale);

/// Area and counts of the shape that the kept triangles form.
struct ExpectedShape {
  double area = 0;
  std::size_t polygons = 0;
  std::size_t holes = 0;
};

/// Keeps the triangles of `triangulation` that the limits given in `options` allow, counts their
/// edge-connected components through a map of edges, and their holes by Euler's formula.
ExpectedShape expected_shape(std::span<const Point> points, const Triangulation& triangulation,
                             const Options& options);

/// Options that keep some of the triangles, from few to all, with no triangle so near a limit that rounding
/// to double could decide about it: implementations that filter in another order of operations still agree.
std::vector<Options> clear_options(std::span<const Point> points, const Triangulation& triangulation);

/// The core's shape of `points`, in coordinates.
MultiPolygon core_hull(std::span<const Point> points, const Options& options);

/// `shape` with rings starting at their lexicographically smallest vertex, and holes and polygons sorted:
/// equal for equal shapes.
MultiPolygon canonical(MultiPolygon shape);

/// Whether no four points of two neighbouring triangles lie on a circle, so that the Delaunay triangulation
/// is the only one. `points` are in the predicates' range.
bool is_unique(std::span<const Point> points, const Triangulation& triangulation);

/// How far areas of shapes of `points` may be off by rounding: some thousand terms, each off by at most an
/// ulp of the squared extent.
double area_tolerance(std::span<const Point> points);

/// The number of holes of all polygons.
inline std::size_t hole_count(const MultiPolygon& shape) {
  std::size_t count = 0;
  for (const Polygon& polygon : shape) count += polygon.holes.size();
  return count;
}

/// The convex hull's corners by a monotone chain, counter-clockwise from the lexicographically smallest.
/// `points` are in the predicates' range and not all equal.
Ring convex_corners(std::vector<Point> points);

/// `ring` without the vertices that lie on a line with their neighbours.
Ring strict_corners(const Ring& ring);

}  // namespace polylidar::testing
