#include "datasets/samplers/rotating.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "datasets/portable_math.hpp"
#include "datasets/samplers/density.hpp"
#include "datasets/samplers/scan.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;
using polylidar::Polygon;

LidarRings lidar_rings(const MultiPolygon& shape, const Point& foot, double pitch, double level) {
  LidarRings rings;
  for (const Polygon& polygon : shape) {
    for (const Point& corner : polygon.shell) {
      const double dx = corner.x - foot.x;
      const double dy = corner.y - foot.y;
      rings.range = std::max(rings.range, std::sqrt(dx * dx + dy * dy));
    }
  }
  // A ring of radius r = height * tan(angle) is (r^2 + height^2) / height from the next for a step of 1.
  const double height = kLidarHeight * rings.range;
  const double radius = rings.range / 2;
  const double full_turn = 2 * std::numbers::pi;
  const double along = pitch / std::sqrt(level);
  const double across = pitch * std::sqrt(level);
  rings.beam_step = across * height / (radius * radius + height * height) / full_turn;
  rings.shots = static_cast<std::size_t>(std::max(std::round(full_turn * radius / along), 3.0));
  return rings;
}

std::vector<Point> rotate_lidar(const MultiPolygon& shape, const Point& foot, const LidarRings& rings,
                                Random& random) {
  const PointLocator locator(shape);
  std::vector<Point> points;
  const double phase = random.uniform();
  for (int beam = 0; (beam + phase) * rings.beam_step < 0.25; ++beam) {
    const Point down_and_out = unit_vector((beam + phase) * rings.beam_step);
    const double radius = kLidarHeight * rings.range * down_and_out.y / down_and_out.x;
    if (radius > rings.range) break;
    const double start = random.uniform();
    for (std::size_t shot = 0; shot < rings.shots; ++shot) {
      const Point to = unit_vector((static_cast<double>(shot) + start) / static_cast<double>(rings.shots));
      const Point point = {foot.x + radius * to.x, foot.y + radius * to.y};
      if (locator.contains(point)) points.push_back(point);
    }
  }
  return points;
}

std::vector<Point> sample_rotating(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  const Point foot = drawn_place(shape, seed);
  return scan_exactly(shape, n, derive_seed(seed, "rotating"), [&](double pitch, Random& random) {
    return rotate_lidar(shape, foot, lidar_rings(shape, foot, pitch, level), random);
  });
}

}  // namespace hullbench
