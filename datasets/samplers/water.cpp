#include "datasets/samplers/water.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "datasets/samplers/scan.hpp"
#include "datasets/sampling.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;

Lakes::Lakes(const MultiPolygon& shape, double level, std::uint64_t seed)
    : centres_(sample_uniform(shape, kLakes, derive_seed(seed, "water"))),
      radius_(std::sqrt(level / 100 * polylidar::area(shape) / (kLakes * std::numbers::pi))) {}

bool Lakes::contain(const Point& point) const {
  return std::any_of(centres_.begin(), centres_.end(), [&](const Point& centre) {
    const double dx = point.x - centre.x;
    const double dy = point.y - centre.y;
    return dx * dx + dy * dy < radius_ * radius_;
  });
}

std::vector<Point> draw_beside(const Lakes& lakes, std::size_t n, std::uint64_t seed,
                               const std::function<std::vector<Point>(std::size_t)>& draw) {
  std::size_t asked = n;
  while (true) {
    std::vector<Point> points = draw(asked);
    std::erase_if(points, [&](const Point& point) { return lakes.contain(point); });
    if (points.size() >= n) {
      Random random(derive_seed(seed, "dry"));
      return lose_points(points, n, random);
    }
    // A fiftieth more than the share of what was dry says, so that chance does not make it too few again.
    const double dry = static_cast<double>(points.size() + 1) / static_cast<double>(asked + 1);
    asked = static_cast<std::size_t>(static_cast<double>(n) * 1.02 / dry) + 2;
  }
}

}  // namespace hullbench
