// The Delaunay triangulation of a point set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "polylidar/geometry.hpp"

namespace polylidar {

/// "No half-edge", "no vertex".
inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// The most points that are accepted; with more, half-edges would not fit into 32 bits.
inline constexpr std::size_t kMaxPoints = std::size_t{1} << 28U;

/// A triangulation as half-edges (the paper's section III-A, Figure 2). Half-edge `e` belongs to triangle `e
/// / 3` and the next one round that triangle is `3 * (e / 3) + (e + 1) % 3`. Triangles run counter-clockwise.
struct Triangulation {
  /// Half-edge -> the vertex where it starts, as an index into the caller's points. 3 entries for each
  /// triangle.
  std::vector<std::uint32_t> triangles;
  /// Half-edge -> its twin in the neighbouring triangle; kNone on the convex hull. 3 entries for each
  /// triangle.
  std::vector<std::uint32_t> halfedges;
};

/// The Delaunay triangulation of `points` with exact predicates. Only the lowest index of equal points
/// appears. Fewer than 3 distinct points, or points all on a line, give no triangles. If more than 3 points
/// lie on an empty circle, their triangles all meet in the least of them by x, then y, so the triangles
/// depend on the points only. Throws as concave_hull does. O(n log n).
Triangulation delaunay(std::span<const Point> points);

}  // namespace polylidar
