#include "benchmarks/micro/point_sets.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "datasets/datasets.hpp"
#include "datasets/random.hpp"

namespace hullbench::micro {

namespace {

constexpr std::uint64_t kSeed = 1;

std::vector<Point> make_lattice(std::size_t columns, std::size_t n, double jitter, Random& random) {
  std::vector<Point> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row = i / columns;
    points[i] = {static_cast<double>(i % columns), static_cast<double>(row)};
    if (jitter == 0) continue;
    points[i].x += jitter * random.uniform();
    points[i].y += jitter * random.uniform();
  }
  return points;
}

constexpr std::size_t kIslands = 4000;
constexpr std::size_t kColumns = 80;

SpeedPointSet make_islands(std::size_t n, Random& random) {
  // With the rule's factor 2 a point at the rim of a square now and then stands apart from the rest.
  const double alpha = 2.5 / std::sqrt(static_cast<double>(n) / kIslands);
  // A triangle between two squares has an edge longer than 2 * alpha, so a circumradius above alpha.
  const double period = 1 + 3 * alpha;
  std::vector<Point> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t island = i % kIslands;
    const std::size_t row = island / kColumns;
    points[i].x = static_cast<double>(island % kColumns) * period + random.uniform();
    points[i].y = static_cast<double>(row) * period + random.uniform();
  }
  return {std::move(points), alpha, kIslands};
}

SpeedPointSet make_sieve(std::size_t n, Random& random) {
  const double alpha = 2.5 / std::sqrt(static_cast<double>(n) / kIslands);
  const double period = std::sqrt(2.0);  // a hole of area 1, and as much round it
  const double rim = (period - 1) / 2;
  const auto is_in_hole = [rim](double offset) { return offset > rim && offset < 1 + rim; };
  std::vector<Point> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t hole = i % kIslands;
    const std::size_t row = hole / kColumns;
    double x = 0;
    double y = 0;
    do {
      x = period * random.uniform();
      y = period * random.uniform();
    } while (is_in_hole(x) && is_in_hole(y));
    points[i].x = static_cast<double>(hole % kColumns) * period + x;
    points[i].y = static_cast<double>(row) * period + y;
  }
  return {std::move(points), alpha, 1};
}

/// Points of which most are near an outline, or there more than once: leaving the interior out does not pay.
std::vector<Point> make_outline_points(const std::string& name, std::size_t n, Random& random) {
  std::vector<Point> points(n);
  constexpr std::size_t kClusters = 50;
  constexpr double kDeviation = 0.01;
  const std::size_t copies = name == "repeats8" ? 8 : name == "repeats" ? 4 : 1;
  std::vector<Point> centres(kClusters);
  for (Point& p : centres) p = {random.uniform(), random.uniform()};
  for (std::size_t i = 0; i < n; ++i) {
    const double x = random.uniform();
    if (name == "clusters") {
      const Point& centre = centres[i % kClusters];
      points[i] = {centre.x + kDeviation * random.normal(), centre.y + kDeviation * random.normal()};
    } else if (name == "circle") {
      points[i] = {std::cos(2 * std::numbers::pi * x), std::sin(2 * std::numbers::pi * x)};
    } else if (name == "parabola") {
      points[i] = {x, x * x};
    } else {
      points[i] = i % copies == 0 ? Point{x, random.uniform()} : points[i - 1];
    }
  }
  return points;
}

}  // namespace

SpeedPointSet make_speed_point_set(const std::string& name, std::size_t n) {
  Random random(derive_seed(kSeed, name));
  if (name == "ca" || name == "airborne" || name == "gradient" || name == "gradient64") {
    const std::string dataset = name == "ca"         ? "ca"
                                : name == "airborne" ? "ca~airborne:2"
                                : name == "gradient" ? "ca~gradient:16"
                                                     : "ca~gradient:64";
    PointSet set = make_point_set(dataset, false, n, kSeed);
    return {std::move(set.points), 2 * std::sqrt(set.ground_truth_area / static_cast<double>(n)), 0};
  }
  if (name == "uniform") {
    std::vector<Point> points(n);
    for (Point& p : points) p = {random.uniform(), random.uniform()};
    return {std::move(points), 2 / std::sqrt(static_cast<double>(n)), 0};
  }
  if (name == "lattice") {
    const auto columns = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
    return {make_lattice(columns, n, 0, random), 2, 0};
  }
  if (name == "rgbd") return {make_lattice(424, n, 0.1, random), 2, 0};
  if (name == "islands") return make_islands(n, random);
  if (name == "sieve") return make_sieve(n, random);
  if (name == "clusters" || name == "circle" || name == "parabola" || name == "repeats" ||
      name == "repeats8" || name == "tight") {
    const bool is_curve = name == "circle" || name == "parabola";  // of which small triangles have no part
    const double spacings = name == "tight" ? 1.2 : 2;
    return {make_outline_points(name, n, random), is_curve ? 2 : spacings / std::sqrt(static_cast<double>(n)),
            0};
  }
  throw std::invalid_argument(
      "no point set is called '" + name +
      "': ca, airborne, gradient, gradient64, uniform, lattice, rgbd, islands, sieve, clusters, "
      "circle, parabola, repeats, repeats8, tight");
}

}  // namespace hullbench::micro
