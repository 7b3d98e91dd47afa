#include "tool/hull/degrees.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polylidar::tool {

std::optional<double> middle_latitude(const Crs& crs, std::span<const Point> points) {
  if (!crs.is_geographic || points.empty()) return {};
  const Box box = bounding_box(points);
  if (box.min.x < -360 || box.max.x > 360 || box.min.y < -90 || box.max.y > 90) return {};
  return (box.min.y + box.max.y) / 2;
}

std::vector<Point> to_metres(std::span<const Point> points, double latitude) {
  constexpr double kRadians = std::numbers::pi / 180;
  constexpr double kMetresADegree = 6371008.8 * kRadians;
  const double x_scale = kMetresADegree * std::cos(latitude * kRadians);
  std::vector<Point> metres(points.size());
  std::transform(points.begin(), points.end(), metres.begin(), [&](const Point& p) {
    return Point{p.x * x_scale, p.y * kMetresADegree};
  });
  return metres;
}

}  // namespace polylidar::tool
