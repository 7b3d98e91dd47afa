#include "polylidar/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polylidar {

Box bounding_box(std::span<const Point> points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Box box{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Point& p : points) {
    box.min.x = std::min(box.min.x, p.x);
    box.min.y = std::min(box.min.y, p.y);
    box.max.x = std::max(box.max.x, p.x);
    box.max.y = std::max(box.max.y, p.y);
  }
  return box;
}

Box joined(const Box& a, const Box& b) {
  return {{std::min(a.min.x, b.min.x), std::min(a.min.y, b.min.y)},
          {std::max(a.max.x, b.max.x), std::max(a.max.y, b.max.y)}};
}

double signed_area(std::span<const Point> ring) {
  if (ring.size() < 3) return 0;
  // Relative to the first vertex: far from the origin the shoelace terms would cancel.
  const Point origin = ring[0];
  double twice_area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double ax = ring[i].x - origin.x;
    const double ay = ring[i].y - origin.y;
    const double bx = ring[i + 1].x - origin.x;
    const double by = ring[i + 1].y - origin.y;
    twice_area += ax * by - ay * bx;
  }
  return twice_area / 2;
}

double area(const MultiPolygon& shape) {
  double total = 0;
  for (const Polygon& polygon : shape) {
    total += std::abs(signed_area(polygon.shell));
    for (const Ring& hole : polygon.holes) total -= std::abs(signed_area(hole));
  }
  return total;
}

std::size_t vertex_count(const MultiPolygon& shape) {
  std::size_t count = 0;
  for (const Polygon& polygon : shape) {
    count += polygon.shell.size();
    for (const Ring& hole : polygon.holes) count += hole.size();
  }
  return count;
}

}  // namespace polylidar
