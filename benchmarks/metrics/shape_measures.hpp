// What is read off the rings of a shape.
#pragma once

#include <cstddef>
#include <span>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// Length of all rings, in the unit of the points.
double perimeter(const MultiPolygon& shape);

/// Shells less holes; 0 when a coordinate is not finite, and where the holes of an invalid shape have more
/// than its shells.
double area_of_result(const MultiPolygon& shape);

std::size_t count_holes(const MultiPolygon& shape);

/// 0 of points without an area.
double convex_hull_area(std::span<const Point> points);

/// Whether every coordinate is a number below infinity.
bool has_finite_coordinates(const MultiPolygon& shape);

/// Calls `visit(ring)` for the shell and then the holes of every polygon.
template <typename Visit>
void for_each_ring(const MultiPolygon& shape, const Visit& visit) {
  for (const Polygon& polygon : shape) {
    visit(polygon.shell);
    for (const Ring& hole : polygon.holes) visit(hole);
  }
}

/// Calls `visit(from, to)` for the edges of every ring in order, the closing one last.
template <typename Visit>
void for_each_edge(const MultiPolygon& shape, const Visit& visit) {
  for_each_ring(shape, [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  });
}

}  // namespace hullbench::metrics
