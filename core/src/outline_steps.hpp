// Whether all points may lie on outlines, and how far apart neighbours on these may then be.
#pragma once

#include <optional>

#include "half_edge.hpp"
#include "polylidar/geometry.hpp"

namespace polylidar::detail {

/// A flat triangle's height over its longest edge, at most. Half of the triangles of points at random have
/// 0.4 or more.
inline constexpr double kFlat = 0.17;

/// Whether a triangle with this doubled area and square of the longest edge is flat.
inline bool is_flat(double twice_area, double squared_longest, double share = kFlat) {
  return twice_area <= share * squared_longest;
}

/// If all points lie on curves, most triangles have an edge that is far longer than the distance between
/// neighbours on a curve. The gaps between n random points on a line are exponential: half of them are longer
/// than log 2 times their mean, the largest is about log n times their mean, and in one set of 20 it is more
/// than log n + 3 times. If half of the triangles are flat, and many have two edges longer than log n +
/// `step` mean distances, OutlineFill finds what the curves enclose.
///
/// Returns the square of that length if some of the triangles tell so, and there are 32 points at least:
/// fewer of a thin shape lie alike. If all of 8 to 255 points lie on their convex hull, it is enough that
/// half of the triangles are flat, here up to 0.25, and the hull is what they enclose (infinity). `points`:
/// how many do not repeat others.
std::optional<double> squared_outline_step(const Mesh& mesh, const Point* vertices, double points,
                                           double step);

}  // namespace polylidar::detail
