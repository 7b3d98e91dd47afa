#include "automatic_limit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "filter_rules.hpp"

namespace polylidar::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The rule's constants; lengths are in medians.
constexpr double kUsual = 1.6;
constexpr double kPull = 2;
constexpr double kStill = 0.003;
constexpr double kLeast = 1.1;
constexpr double kMost = 6;
/// Cells of the grid below and above a limit over which the growth is taken.
constexpr std::size_t kBelow = 10;
constexpr std::size_t kAbove = 2;

// The grid of limits: an octave has 16 cells of equal width. Four octaves are enough for all limits and the
// cells about them. All cells begin at whole steps of the narrowest ones' width, and areas are summed up by
// these. The unit of lengths moves the cells so that the median itself, which is every triangle's perimeter
// in a lattice, and its simple multiples do not lie where one ends.
constexpr std::size_t kCells = 64;
constexpr std::size_t kSteps = 256;
constexpr double kStep = 0.93 / 32;  // in medians

/// Step -> area of the triangles whose perimeter lies in it, from 0 on.
using StepAreas = std::array<double, kSteps>;

/// At which step cell `c` begins.
constexpr std::size_t first_step(std::size_t c) {
  return (16 + c % 16) << (c / 16);
}

/// The limit of the least cost, in medians; kUsual where all areas are zero, as those of triangles that are
/// flat up to rounding.
double steadiest_limit(const StepAreas& area) {
  std::array<double, kCells> log_limit{};
  std::array<double, kCells> log_area{};  // below the limit
  double below = 0;
  for (std::size_t c = 0, step = 0; c < kCells; ++c) {
    for (; step < first_step(c); ++step) below += std::max(area[step], 0.0);
    log_limit[c] = std::log(kStep * static_cast<double>(step));
    log_area[c] = std::log(below);
  }
  double least_cost = kInfinity;
  double steadiest = kUsual;
  for (std::size_t c = kBelow; c + kAbove < kCells; ++c) {
    const double limit = kStep * static_cast<double>(first_step(c));
    if (limit < kLeast || limit > kMost) continue;
    const double growth =
        (log_area[c + kAbove] - log_area[c - kBelow]) / (log_limit[c + kAbove] - log_limit[c - kBelow]);
    const double distance = log_limit[c] - std::log(kUsual);
    const double cost = std::log(growth + kStill) + kPull * distance * distance;
    if (cost < least_cost) {  // no: without an area below, where it is infinite or NaN
      least_cost = cost;
      steadiest = limit;
    }
  }
  return steadiest;
}

}  // namespace

/// Measures every `step`-th triangle.
void AutomaticLimit::look_at(const Mesh& mesh, const Point* vertices, std::size_t step) {
  count_ = (mesh.triangle_count() + step - 1) / step;
  finite_count_ = 0;
  double* const perimeter = perimeters_.reserve(count_);
  double* const twice_area = twice_areas_.reserve(count_);
  double* const finite = finite_.reserve(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const auto t = static_cast<Mesh::Index>(i * step);
    perimeter[i] = kInfinity;
    twice_area[i] = 0;
    if (mesh.is_ghost(t)) continue;
    const Triangle triangle(mesh, vertices, t);
    perimeter[i] = triangle.perimeter();
    twice_area[i] = triangle.twice_area();
    finite[finite_count_++] = perimeter[i];
  }
}

double AutomaticLimit::choose(const Mesh& mesh, const Point* vertices) {
  // Odd, as records come in pairs, of which an even step would only see the first.
  std::size_t step = (mesh.triangle_count() / kSample) | 1U;
  look_at(mesh, vertices, step);
  // Points that repeat others leave records unused.
  if (step > 1 && finite_count_ < kSample / 4) {
    step = 1;
    look_at(mesh, vertices, step);
  }
  is_complete_ = step == 1 && finite_count_ > 0;
  if (finite_count_ == 0) return kInfinity;
  double* const finite = finite_.data();
  double* const middle = finite + finite_count_ / 2;
  std::nth_element(finite, middle, finite + finite_count_);
  const double median = *middle;

  StepAreas area{};
  const double steps_per_length = 1 / (kStep * median);
  for (std::size_t i = 0; i < count_; ++i) {
    const double place = perimeters_.data()[i] * steps_per_length;
    if (place < kSteps) area[static_cast<std::size_t>(place)] += twice_areas_.data()[i];
  }
  return steadiest_limit(area) * median;
}

}  // namespace polylidar::detail
