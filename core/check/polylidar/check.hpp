// Independent checks of what the core produces, for tests: a library of its own, which is not installed. Slow
// on purpose: they share no code with the algorithms they check except the predicates.
#pragma once

#include <span>
#include <string>

#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "polylidar/geometry.hpp"

namespace polylidar {

/// Empty when `triangulation` is the Delaunay triangulation of `points` (twins match, triangles
/// counter-clockwise, every distinct point used, hull convex, Euler's formula, every edge locally Delaunay),
/// else one sentence that names the first fault. O(n log n).
std::string check_triangulation(std::span<const Point> points, const Triangulation& triangulation);

/// Empty when `shape` is a valid multipolygon over `points`: indices in range, rings of at least 3 distinct
/// vertices, orientation, no two edges that cross or overlap, rings that touch at most in vertices, holes
/// inside their shell, connected interiors; else one sentence that names the first fault. O(m^2) in the worst
/// case, m vertices.
std::string check_polygon(std::span<const Point> points, const IndexedMultiPolygon& shape);

}  // namespace polylidar
