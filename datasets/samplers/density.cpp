#include "datasets/samplers/density.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "datasets/random.hpp"
#include "datasets/samplers/draw.hpp"
#include "datasets/sampling.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;

Point drawn_place(const MultiPolygon& shape, std::uint64_t seed) {
  return UniformPoints(shape, derive_seed(seed, "place")).next();
}

/// Thins the uniform sample.
std::vector<Point> sample_gradient(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  UniformPoints uniform(shape, seed);
  const Box& bounds = uniform.locator().bounds();
  const double width = bounds.max.x - bounds.min.x;
  Random random(derive_seed(seed, "gradient"));
  std::vector<Point> points;
  points.reserve(n);
  while (points.size() < n) {
    const Point point = uniform.next();
    const double density = 1 + (level - 1) * (bounds.max.x - point.x) / width;
    if (level * random.uniform() < density) points.push_back(point);
  }
  return points;
}

/// Mixes the uniform sample with a Gaussian of which only the part in the shape is kept. A Gaussian of
/// standard deviation s with the mass 2 pi s^2 (level - 1) has the height level - 1 over a background of 1,
/// whose mass is the area.
std::vector<Point> sample_hotspot(const MultiPolygon& shape, std::size_t n, double level,
                                  std::uint64_t seed) {
  UniformPoints background(shape, seed);
  const Point middle = drawn_place(shape, seed);
  const double deviation = kHotSpotDeviation * std::sqrt(polylidar::area(shape));
  const double bump = 2 * std::numbers::pi * kHotSpotDeviation * kHotSpotDeviation * (level - 1);
  const double bump_share = bump / (1 + bump);
  Random random(derive_seed(seed, "hotspot"));
  std::vector<Point> points;
  points.reserve(n);
  while (points.size() < n) {
    if (random.uniform() >= bump_share) {
      points.push_back(background.next());
      continue;
    }
    const Point point = moved_by_gaussian(middle, deviation, random);
    if (background.locator().contains(point)) points.push_back(point);
  }
  return points;
}

std::vector<Point> sample_clusters(const MultiPolygon& shape, std::size_t n, double level,
                                   std::uint64_t seed) {
  const PointLocator locator(shape);
  const double h = spacing(shape, n);
  const Box box = grown(locator.bounds(), 6 * h);
  const double box_area = (box.max.x - box.min.x) * (box.max.y - box.min.y);
  const double count = static_cast<double>(n) / level * (box_area / polylidar::area(shape));
  Random random(derive_seed(seed, "clusters"));
  std::vector<Point> centres(static_cast<std::size_t>(std::ceil(count)));
  for (Point& centre : centres) centre = uniform_in(box, random);
  constexpr std::size_t kMaxMisses = 10'000'000;
  std::vector<Point> points;
  for (std::size_t misses = 0; points.size() < n; ++misses) {
    if (misses > kMaxMisses) {
      throw std::runtime_error("none of " + std::to_string(centres.size()) +
                               " clusters reaches into the shape; ask for more points or a lower level");
    }
    const Point point = moved_by_gaussian(centres[random.below(centres.size())], h, random);
    if (!locator.contains(point)) continue;
    points.push_back(point);
    misses = 0;
  }
  return points;
}

Cascade::Cascade(const MultiPolygon& shape, double level, Random& random)
    : frame_(shape, random.uniform()), dense_share_(level / (level + 1)) {
  for (bool& is_second_dense : is_second_dense_) is_second_dense = random.below(2) == 1;
}

double Cascade::density(const Point& point) const {
  Box box = frame_.bounds();
  const Point at = frame_.in_frame(point);
  double density = 1;
  for (std::size_t part = 1, halving = 0; halving < kHalvings; ++halving) {
    const bool is_across = halving % 2 == 0;
    double& least = is_across ? box.min.x : box.min.y;
    double& most = is_across ? box.max.x : box.max.y;
    const double middle = least + (most - least) / 2;
    const bool is_second = (is_across ? at.x : at.y) >= middle;
    density *= 2 * (is_second == is_second_dense_[part] ? dense_share_ : 1 - dense_share_);
    (is_second ? least : most) = middle;
    part = 2 * part + (is_second ? 1 : 0);
  }
  return density;
}

Point Cascade::draw(Random& random) const {
  Box box = frame_.bounds();
  for (std::size_t part = 1, halving = 0; halving < kHalvings; ++halving) {
    const bool is_across = halving % 2 == 0;
    double& least = is_across ? box.min.x : box.min.y;
    double& most = is_across ? box.max.x : box.max.y;
    const bool is_second = (random.uniform() < dense_share_) == is_second_dense_[part];
    (is_second ? least : most) = least + (most - least) / 2;
    part = 2 * part + (is_second ? 1 : 0);
  }
  return frame_.in_plane(uniform_in(box, random));
}

std::vector<Point> sample_cascade(const MultiPolygon& shape, std::size_t n, double level,
                                  std::uint64_t seed) {
  Random random(derive_seed(seed, "cascade"));
  const Cascade cascade(shape, level, random);
  const PointLocator locator(shape);
  std::vector<Point> points;
  points.reserve(n);
  while (points.size() < n) {
    const Point point = cascade.draw(random);
    if (locator.contains(point)) points.push_back(point);
  }
  return points;
}

}  // namespace hullbench
