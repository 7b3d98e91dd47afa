#include "datasets/samplers/regular.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "datasets/portable_math.hpp"
#include "datasets/random.hpp"
#include "datasets/samplers/draw.hpp"
#include "datasets/sampling.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

namespace {

/// Points by squares of a grid, to find those near a place.
class NearPoints {
 public:
  /// For distances up to `reach`, and points in `box`.
  NearPoints(const Box& box, double reach)
      : origin_(box.min),
        reach_(reach),
        columns_(cell(box.max.x - box.min.x) + 1),
        rows_(cell(box.max.y - box.min.y) + 1),
        cells_(columns_ * rows_) {}

  bool is_one_near(const Point& point) const {
    const std::size_t column = cell(point.x - origin_.x);
    const std::size_t row = cell(point.y - origin_.y);
    for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, rows_ - 1); ++r) {
      for (std::size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, columns_ - 1); ++c) {
        for (const Point& other : cells_[r * columns_ + c]) {
          const double dx = other.x - point.x;
          const double dy = other.y - point.y;
          if (dx * dx + dy * dy < reach_ * reach_) return true;
        }
      }
    }
    return false;
  }

  void add(const Point& point) {
    cells_[cell(point.y - origin_.y) * columns_ + cell(point.x - origin_.x)].push_back(point);
  }

 private:
  std::size_t cell(double offset) const { return static_cast<std::size_t>(offset / reach_); }

  Point origin_;
  double reach_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<std::vector<Point>> cells_;  ///< row by row from the origin
};

/// The points of one lattice that lie in the shape; fewer or more than n by chance.
std::vector<Point> draw_lattice(const PointLocator& locator, double side, double jitter, Random& random) {
  const Box& box = locator.bounds();
  const Point along = unit_vector(random.between(0.01, 0.04));
  const double minus_sine = -along.y;  // sums in both coordinates: see turned()
  const Point origin = {(box.min.x + box.max.x) / 2 + side * random.uniform(),
                        (box.min.y + box.max.y) / 2 + side * random.uniform()};
  const double width = box.max.x - box.min.x;
  const double height = box.max.y - box.min.y;
  // Rows and columns either side of the middle that reach the box's corners, and past them by what the origin
  // and the points are moved.
  const auto reach = static_cast<int>(std::ceil(std::sqrt(width * width + height * height) / (2 * side))) + 3;
  std::vector<Point> points;
  for (int row = -reach; row <= reach; ++row) {
    for (int column = -reach; column <= reach; ++column) {
      const double u = side * (column + jitter * random.between(-1, 1));
      const double v = side * (row + jitter * random.between(-1, 1));
      const Point point = {origin.x + u * along.x + v * minus_sine, origin.y + u * along.y + v * along.x};
      if (locator.contains(point)) points.push_back(point);
    }
  }
  return points;
}

}  // namespace

std::vector<Point> sample_poisson(const MultiPolygon& shape, std::size_t n, double level,
                                  std::uint64_t seed) {
  constexpr std::size_t kMaxDarts = 1'000'000;
  const PointLocator locator(shape);
  const Box& box = locator.bounds();
  NearPoints near(box, level * spacing(shape, n));
  Random random(derive_seed(seed, "poisson"));
  std::vector<Point> points;
  for (std::size_t misses = 0; points.size() < n; ++misses) {
    if (misses > kMaxDarts) {
      throw std::runtime_error("no room for another point after " + std::to_string(kMaxDarts) +
                               " tries; ask for a lower level of poisson");
    }
    const Point point = uniform_in(box, random);
    if (!locator.contains(point) || near.is_one_near(point)) continue;
    near.add(point);
    points.push_back(point);
    misses = 0;
  }
  return points;
}

std::vector<Point> sample_lattice(const MultiPolygon& shape, std::size_t n, double level,
                                  std::uint64_t seed) {
  constexpr int kMaxLattices = 10'000;
  const PointLocator locator(shape);
  const double side = spacing(shape, n);
  Random random(derive_seed(seed, "lattice"));
  for (int attempt = 0; attempt < kMaxLattices; ++attempt) {
    std::vector<Point> points = draw_lattice(locator, side, level, random);
    if (points.size() == n) return points;
  }
  throw std::runtime_error("none of " + std::to_string(kMaxLattices) + " lattices has exactly " +
                           std::to_string(n) + " points in the shape; ask for another number of them");
}

}  // namespace hullbench
