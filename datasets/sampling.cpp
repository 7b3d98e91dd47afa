#include "datasets/sampling.hpp"

#include <stdexcept>

#include "datasets/point_locator.hpp"
#include "datasets/random.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;

namespace {

constexpr double kMinCoverage = 1e-6;

}  // namespace

std::vector<Point> sample_uniform(const MultiPolygon& shape, std::size_t n, std::uint64_t seed) {
  const PointLocator locator(shape);
  const Box& box = locator.bounds();
  const double width = box.max.x - box.min.x;
  const double height = box.max.y - box.min.y;
  const double area = polylidar::area(shape);
  // Written so that an infinite or undefined size is refused too.
  if (!(area > 0 && area > kMinCoverage * width * height)) {
    throw std::invalid_argument(
        "cannot draw points in a shape that covers less than a millionth of its bounding box; "
        "give a shape with a larger area");
  }
  std::vector<Point> points;
  points.reserve(n);
  Random random(seed);
  while (points.size() < n) {
    const double x = box.min.x + width * random.uniform();
    const double y = box.min.y + height * random.uniform();
    if (const Point point{x, y}; locator.contains(point)) points.push_back(point);
  }
  return points;
}

}  // namespace hullbench
