// Point sets and checks that the tests of every adapter share.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/hull_oracle.hpp"

namespace hullbench {

// Each is in the file of its method; a test links those that it makes.
std::unique_ptr<Adapter> make_cgal_alpha_shape();
std::unique_ptr<Adapter> make_cgal_delaunay();
std::unique_ptr<Adapter> make_chi_shape();
std::unique_ptr<Adapter> make_convex_hull();
std::unique_ptr<Adapter> make_geos_concave_hull();
std::unique_ptr<Adapter> make_knn_hull();
std::unique_ptr<Adapter> make_pcl_concave_hull();
std::unique_ptr<Adapter> make_polylidar();
std::unique_ptr<Adapter> make_postgis();
std::unique_ptr<Adapter> make_postgis_legacy();
std::unique_ptr<Adapter> make_postgis_steps();
std::unique_ptr<Adapter> make_sfcgal_alpha_shape();
std::unique_ptr<Adapter> make_spatialite();
std::unique_ptr<Adapter> make_spatialite_steps();

}  // namespace hullbench

namespace hullbench::testing {

using polylidar::testing::canonical;
using polylidar::testing::core_hull;
using polylidar::testing::hole_count;

/// Steps that remembers what it was told, in order.
class StepNames final : public Steps {
 public:
  void begin(std::string_view name) override { names_.emplace_back(name); }
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
};

/// Area of the square hole that `square_points` leaves out.
inline constexpr double kHoleArea = 0.4 * 0.4;

/// Enough points for a hull that is close to the square, few enough for a slow method.
inline constexpr std::size_t kPoints = 2000;

/// How far from the true area a hull of `kPoints` such points may be. Its rings run through points, so it
/// misses a rim about one point spacing (1 / sqrt(n) = 0.022) wide along the square's sides (4) and the
/// hole's (1.6).
inline constexpr double kAreaTolerance = 0.022 * (4 + 1.6);

/// `count` uniform points in the unit square; with `hole`, none in its middle square of side 0.4.
inline std::vector<Point> square_points(std::size_t count, std::uint64_t seed, bool hole) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  const auto in_hole = [](double value) { return value > 0.3 && value < 0.7; };
  std::vector<Point> points;
  while (points.size() < count) {
    const double x = uniform();
    const double y = uniform();
    if (!(hole && in_hole(x) && in_hole(y))) points.push_back({x, y});
  }
  return points;
}

/// The hull of `points` in one call.
inline MultiPolygon hull_of(Adapter& adapter, const std::vector<Point>& points,
                            const Parameters& parameters) {
  NoSteps steps;
  adapter.load(points);
  adapter.run(parameters, steps);
  return adapter.extract(steps);
}

/// The limits that `options` give, as parameters of a method that has them all.
inline Parameters parameters_of(const polylidar::Options& options) {
  Parameters parameters;
  if (options.alpha) parameters["alpha"] = *options.alpha;
  if (options.max_edge_length) parameters["max_edge_length"] = *options.max_edge_length;
  if (options.max_perimeter) parameters["max_perimeter"] = *options.max_perimeter;
  return parameters;
}

/// Inputs without an area, each with the name a failing test prints.
struct Degenerate {
  const char* name;
  std::vector<Point> points;
};

inline std::vector<Degenerate> degenerate_inputs() {
  return {
      {"no points", {}},
      {"one point", {{1, 2}}},
      {"two points", {{1, 2}, {3, 4}}},
      {"one point five times", {{1, 2}, {1, 2}, {1, 2}, {1, 2}, {1, 2}}},
      {"two points, repeated", {{1, 2}, {3, 4}, {1, 2}, {3, 4}}},
      {"collinear", {{0, 0}, {1, 1}, {2, 2}, {3, 3}, {5, 5}}},
  };
}

}  // namespace hullbench::testing
