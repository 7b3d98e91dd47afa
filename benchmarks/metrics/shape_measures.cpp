#include "benchmarks/metrics/shape_measures.hpp"

#include <algorithm>
#include <cmath>

#include "polylidar/concave_hull.hpp"

namespace hullbench::metrics {

double perimeter(const MultiPolygon& shape) {
  double length = 0;
  for_each_edge(
      shape, [&](const Point& from, const Point& to) { length += std::hypot(to.x - from.x, to.y - from.y); });
  return length;
}

double area_of_result(const MultiPolygon& shape) {
  const double area = polylidar::area(shape);
  return std::isfinite(area) ? std::max(0.0, area) : 0;
}

std::size_t count_holes(const MultiPolygon& shape) {
  std::size_t holes = 0;
  for (const Polygon& polygon : shape) holes += polygon.holes.size();
  return holes;
}

bool has_finite_coordinates(const MultiPolygon& shape) {
  bool finite = true;
  for_each_ring(shape, [&](const Ring& ring) {
    for (const Point& point : ring) finite = finite && std::isfinite(point.x) && std::isfinite(point.y);
  });
  return finite;
}

double convex_hull_area(std::span<const Point> points) {
  const auto hull = polylidar::concave_hull(points, {.alpha = polylidar::kNoLimit});
  return polylidar::area(polylidar::to_coordinates(hull, points));
}

}  // namespace hullbench::metrics
