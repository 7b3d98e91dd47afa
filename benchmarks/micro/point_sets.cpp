#include "benchmarks/micro/point_sets.hpp"

#include <cmath>
#include <stdexcept>

#include "datasets/datasets.hpp"
#include "datasets/random.hpp"

namespace hullbench {

namespace {

constexpr std::uint64_t kSeed = 1;

std::vector<polylidar::Point> make_lattice(std::size_t columns, std::size_t n, double jitter,
                                           Random& random) {
  std::vector<polylidar::Point> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = {static_cast<double>(i % columns), static_cast<double>(i / columns)};
    if (jitter == 0) continue;
    points[i].x += jitter * random.uniform();
    points[i].y += jitter * random.uniform();
  }
  return points;
}

}  // namespace

SpeedPointSet make_speed_point_set(const std::string& name, std::size_t n) {
  Random random(derive_seed(kSeed, name));
  if (name == "ca") {
    PointSet set = make_point_set("ca", false, n, kSeed);
    return {std::move(set.points), 2 * std::sqrt(set.ground_truth_area / static_cast<double>(n))};
  }
  if (name == "uniform") {
    std::vector<polylidar::Point> points(n);
    for (polylidar::Point& p : points) p = {random.uniform(), random.uniform()};
    return {std::move(points), 2 / std::sqrt(static_cast<double>(n))};
  }
  if (name == "lattice") {
    const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    return {make_lattice(columns, n, 0, random), 2};
  }
  if (name == "rgbd") return {make_lattice(424, n, 0.1, random), 2};
  throw std::invalid_argument("no point set is called '" + name + "': ca, uniform, lattice, rgbd");
}

}  // namespace hullbench
