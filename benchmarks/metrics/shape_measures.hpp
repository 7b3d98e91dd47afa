// What is read off the rings of a shape.
#pragma once

#include <cstddef>

#include "polylidar/geometry.hpp"

namespace hullbench::metrics {

/// Length of all rings, in the unit of the points.
double perimeter(const polylidar::MultiPolygon& shape);

/// Shells less holes; 0 when a coordinate is not finite, and where the holes of an invalid shape have more
/// than its shells.
double area_of_result(const polylidar::MultiPolygon& shape);

std::size_t count_holes(const polylidar::MultiPolygon& shape);

/// Whether every coordinate is a number below infinity.
bool has_finite_coordinates(const polylidar::MultiPolygon& shape);

/// Calls `visit(ring)` for the shell and then the holes of every polygon.
template <typename Visit>
void for_each_ring(const polylidar::MultiPolygon& shape, const Visit& visit) {
  for (const polylidar::Polygon& polygon : shape) {
    visit(polygon.shell);
    for (const polylidar::Ring& hole : polygon.holes) visit(hole);
  }
}

/// Calls `visit(from, to)` for the edges of every ring in order, the closing one last.
template <typename Visit>
void for_each_edge(const polylidar::MultiPolygon& shape, const Visit& visit) {
  for_each_ring(shape, [&](const polylidar::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  });
}

}  // namespace hullbench::metrics
