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

namespace {

/// Twice the signed area of a ring of three or more vertices, times `scale` squared.
double shoelace(std::span<const Point> ring, double scale) {
  // Relative to the first vertex: far from the origin the shoelace terms would cancel.
  const Point origin{ring[0].x * scale, ring[0].y * scale};
  double twice_area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const double ax = ring[i].x * scale - origin.x;
    const double ay = ring[i].y * scale - origin.y;
    const double bx = ring[i + 1].x * scale - origin.x;
    const double by = ring[i + 1].y * scale - origin.y;
    twice_area += ax * by - ay * bx;
  }
  return twice_area;
}

}  // namespace

double signed_area(std::span<const Point> ring) {
  if (ring.size() < 3) return 0;
  const double twice_area = shoelace(ring, 1);
  if (std::isfinite(twice_area)) return twice_area / 2;
  // Products of large coordinates overflow, though the area itself may not.
  constexpr int kExponent = 520;
  return std::ldexp(shoelace(ring, std::ldexp(1.0, -kExponent)), 2 * kExponent - 1);
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
