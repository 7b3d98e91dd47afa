#include "datasets/sampling.hpp"

#include <cmath>
#include <stdexcept>

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;

namespace {

constexpr double kMinCoverage = 1e-6;

}  // namespace

double spacing(const MultiPolygon& shape, std::size_t n) {
  return std::sqrt(polylidar::area(shape) / static_cast<double>(n));
}

UniformPoints::UniformPoints(const MultiPolygon& shape, std::uint64_t seed) : locator_(shape), random_(seed) {
  const Box& box = locator_.bounds();
  const double area = polylidar::area(shape);
  // Written so that an infinite or undefined size is refused too.
  if (!(area > 0 && area > kMinCoverage * (box.max.x - box.min.x) * (box.max.y - box.min.y))) {
    throw std::invalid_argument(
        "cannot draw points in a shape that covers less than a millionth of its bounding box; "
        "give a shape with a larger area");
  }
}

Point UniformPoints::next() {
  const Box& box = locator_.bounds();
  const double width = box.max.x - box.min.x;
  const double height = box.max.y - box.min.y;
  while (true) {
    const double x = box.min.x + width * random_.uniform();
    const double y = box.min.y + height * random_.uniform();
    if (const Point point{x, y}; locator_.contains(point)) return point;
  }
}

std::vector<Point> sample_uniform(const MultiPolygon& shape, std::size_t n, std::uint64_t seed) {
  UniformPoints uniform(shape, seed);
  std::vector<Point> points(n);
  for (Point& point : points) point = uniform.next();
  return points;
}

}  // namespace hullbench
