#include "benchmarks/tune/limit_case.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "benchmarks/metrics/triangle_areas.hpp"
#include "benchmarks/tune/vertex_spacing.hpp"
#include "core/src/filter_rules.hpp"

namespace hullbench::tune {

using polylidar::detail::Mesh;

LimitCase::LimitCase(std::span<const Point> points, const MultiPolygon& truth) {
  builder_.build(points, pool_);
  const Mesh& mesh = builder_.mesh();
  std::vector<Mesh::Index> finite;
  std::vector<std::array<Point, 3>> triangles;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.is_ghost(t)) continue;
    std::array<Point, 3> corners;
    for (Mesh::Index k = 0; k < 3; ++k)
      corners[k] = points[builder_.caller_index()[mesh.origin(Mesh::kStride * t + k)]];
    finite.push_back(t);
    triangles.push_back(corners);
  }
  if (triangles.empty()) throw std::invalid_argument("there is no triangle to choose from");
  const std::vector<double> within = metrics::areas_within(triangles, truth);
  const double truth_area = polylidar::area(truth);
  change_.assign(mesh.triangle_count(), 0);
  for (std::size_t i = 0; i < finite.size(); ++i) {
    const double area = polylidar::signed_area(triangles[i]);
    change_[finite[i]] = (area - 2 * within[i]) / truth_area;
    const polylidar::detail::Triangle triangle(mesh, builder_.vertices(), finite[i]);
    by_perimeter_.push_back({triangle.perimeter(), area, change_[finite[i]]});
  }
  std::ranges::sort(by_perimeter_, [](const Sized& a, const Sized& b) { return a.perimeter < b.perimeter; });
}

double LimitCase::error(const polylidar::detail::AutomaticConstants& constants) {
  limit_.choose(builder_, 1, pool_, constants);
  return error_of_chosen();
}

double LimitCase::error_by_blocks(const polylidar::detail::AutomaticConstants& constants) {
  limit_.choose_by_blocks(builder_, 1, pool_, constants);
  return error_of_chosen();
}

double LimitCase::error_of_chosen() {
  filter_.run(builder_.mesh(), builder_.vertices(), limit_.field(), true, pool_, boundary_);
  return error_of_kept();
}

double LimitCase::best_error_of_one_limit() const {
  double error = 1;  // of no triangle
  double least = error;
  for (std::size_t i = 0; i < by_perimeter_.size(); ++i) {
    error += by_perimeter_[i].change;
    const bool is_limit =
        i + 1 == by_perimeter_.size() || by_perimeter_[i].perimeter < by_perimeter_[i + 1].perimeter;
    if (is_limit) least = std::min(least, error);
  }
  return least;
}

double LimitCase::error_of_former_default() {
  const auto rules = polylidar::detail::filter_rules(
      {.max_perimeter = std::ldexp(former_limit(), builder_.scale_exponent())});
  filter_.run(builder_.mesh(), builder_.vertices(), rules, true, pool_, boundary_);
  return error_of_kept();
}

/// In medians of the perimeters, the limit p of the least (d log A / d log p + still) exp(pull log^2(p /
/// usual)), with A(p) the area of the triangles below it; on a grid of 16 limits to the octave.
double LimitCase::former_limit() const {
  constexpr double kUsual = 1.6;
  constexpr double kPull = 2;
  constexpr double kStill = 0.003;
  constexpr double kLeast = 1.1;
  constexpr double kMost = 6;
  constexpr std::size_t kBelow = 10;  // cells over which the growth is taken
  constexpr std::size_t kAbove = 2;
  constexpr std::size_t kCells = 64;
  constexpr double kFirst = 0.93 / 2;
  const double median = by_perimeter_[by_perimeter_.size() / 2].perimeter;
  std::vector<double> limits(kCells);
  std::vector<double> log_areas(kCells);
  std::size_t i = 0;
  double area = 0;
  for (std::size_t c = 0; c < kCells; ++c) {
    limits[c] = std::ldexp(kFirst * (1 + static_cast<double>(c % 16) / 16), static_cast<int>(c / 16));
    while (i < by_perimeter_.size() && by_perimeter_[i].perimeter < limits[c] * median)
      area += by_perimeter_[i++].area;
    log_areas[c] = std::log(area);
  }
  double least_cost = std::numeric_limits<double>::infinity();
  double best = kUsual;
  for (std::size_t c = kBelow; c + kAbove < kCells; ++c) {
    if (limits[c] < kLeast || limits[c] > kMost) continue;
    const double growth =
        (log_areas[c + kAbove] - log_areas[c - kBelow]) / std::log(limits[c + kAbove] / limits[c - kBelow]);
    const double distance = std::log(limits[c] / kUsual);
    const double cost = (growth + kStill) * std::exp(kPull * distance * distance);
    if (cost < least_cost) {  // no where it is infinite or NaN
      least_cost = cost;
      best = limits[c];
    }
  }
  return std::ldexp(best * median, -builder_.scale_exponent());
}

double LimitCase::error_of_vertex_spacing() const {
  const std::vector<bool> kept = kept_by_vertex_spacing(builder_.mesh(), builder_.vertices());
  double error = 1;
  for (std::size_t t = 0; t < kept.size(); ++t) {
    if (kept[t]) error += change_[t];
  }
  return error;
}

double LimitCase::error_of_kept() const {
  double error = 1;
  for (Mesh::Index t = 0; t < builder_.mesh().triangle_count(); ++t) {
    if (builder_.mesh().is_kept(t)) error += change_[t];
  }
  return error;
}

}  // namespace hullbench::tune
