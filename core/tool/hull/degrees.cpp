#include "tool/hull/degrees.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace polylidar::tool {
namespace {

constexpr double kRadius = 6371007.2;  // metres
constexpr double kRadians = std::numbers::pi / 180;

/// Metres east and north of a degree.
Point metres_a_degree(double latitude) {
  constexpr double kMetresADegree = kRadius * kRadians;
  return {kMetresADegree * std::cos(latitude * kRadians), kMetresADegree};
}

bool is_before(const Point& a, const Point& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

}  // namespace

bool could_be_degrees(const Box& box) {
  return box.min.x >= -360 && box.max.x <= 360 && box.min.y >= -90 && box.max.y <= 90;
}

bool look_like_degrees(const Box& box) {
  const bool is_in_range = box.min.x >= -180 && box.max.x <= 180 && box.min.y >= -90 && box.max.y <= 90;
  const double reach = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  if (!is_in_range || reach <= 0) return false;  // of none or one, too
  const double from_origin =
      std::hypot(std::max({box.min.x, -box.max.x, 0.0}), std::max({box.min.y, -box.max.y, 0.0}));
  const std::array corners = {box.min.x, box.min.y, box.max.x, box.max.y};
  const bool is_fine = std::any_of(corners.begin(), corners.end(), [](double value) {
    return std::abs(1000 * value - std::round(1000 * value)) > 1e-6;
  });
  return from_origin >= std::max(reach, 10.0) && is_fine;
}

std::optional<double> middle_latitude(const Crs& crs, std::span<const Point> points) {
  if (!crs.is_geographic || points.empty()) return {};
  const Box box = bounding_box(points);
  return (box.min.y + box.max.y) / 2;
}

std::vector<Point> to_metres(std::span<const Point> points, double latitude) {
  const Point scale = metres_a_degree(latitude);
  std::vector<Point> metres(points.size());
  std::transform(points.begin(), points.end(), metres.begin(), [&](const Point& p) {
    return Point{p.x * scale.x, p.y * scale.y};
  });
  return metres;
}

double signed_area_on_sphere(const Ring& metres, double latitude) {
  // Between an edge and the equator lies R^2 times its length in longitude times the mean of the sines of its
  // latitudes, which is sin(middle) * sin(half) / half.
  double sum = 0;
  for (std::size_t i = 0; i < metres.size(); ++i) {
    const Point& from = metres[i];
    const Point& to = metres[i + 1 < metres.size() ? i + 1 : 0];
    const double middle = (from.y + to.y) / 2 / kRadius;
    const double half = (to.y - from.y) / 2 / kRadius;
    const double mean_sine = std::sin(middle) * (half == 0 ? 1 : std::sin(half) / half);
    sum += (from.x - to.x) * mean_sine;
  }
  return kRadius * sum / std::cos(latitude * kRadians);
}

MultiPolygon to_degrees(MultiPolygon shape, std::span<const Point> points, double latitude) {
  const std::vector<Point> metres = to_metres(points, latitude);
  const Point scale = metres_a_degree(latitude);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return is_before(metres[a], metres[b]); });
  const auto turn = [&](Ring& ring) {
    for (Point& vertex : ring) {
      const auto found =
          std::lower_bound(order.begin(), order.end(), vertex,
                           [&](std::size_t i, const Point& point) { return is_before(metres[i], point); });
      const bool is_point = found != order.end() && metres[*found] == vertex;
      vertex = is_point ? points[*found] : Point{vertex.x / scale.x, vertex.y / scale.y};
    }
  };
  for (Polygon& polygon : shape) {
    turn(polygon.shell);
    for (Ring& hole : polygon.holes) turn(hole);
  }
  return shape;
}

}  // namespace polylidar::tool
