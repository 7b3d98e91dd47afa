#include "outliers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "automatic_constants.hpp"
#include "log_cells.hpp"
#include "quantile.hpp"

namespace polylidar::detail {

namespace {

/// Fourth powers of lengths, counted on a logarithmic scale.
class Histogram {
 public:
  static constexpr std::size_t kCells = 128;  // two octaves of lengths below 1 and six above
  using Density = std::array<double, kCells>;
  static constexpr double kSmoothedOver = 10;  ///< cells, as 1 / the sum of the squared weights

  void add(double length4) {
    ++counts_[static_cast<std::size_t>(std::clamp<std::int64_t>(log_cell(length4) - kFirst, 0, kCells - 1))];
  }
  /// The fourth power of the length at which the cell begins.
  static double begin4(std::size_t cell) { return log_cell_begin(kFirst + static_cast<std::int64_t>(cell)); }
  std::size_t count(std::size_t cell) const { return counts_[cell]; }
  /// Numbers in a mean cell, smoothed by a bell whose deviation is about three cells.
  Density smoothed() const;

 private:
  static constexpr std::int64_t kFirst = log_cell(1) - static_cast<std::int64_t>(kCells / 4);

  std::array<std::uint32_t, kCells> counts_{};
};

Histogram::Density Histogram::smoothed() const {
  // The cells of an octave of fourth powers, [1, 1.25), [1.25, 1.5) and so on, as parts of a mean one.
  constexpr std::array<double, 4> kWidth = {1.288, 1.052, 0.890, 0.770};
  Density density{};
  for (std::size_t c = 0; c < kCells; ++c) density[c] = counts_[c] / kWidth[c % kWidth.size()];
  constexpr std::size_t kHalf = 2;
  for (int pass = 0; pass < 4; ++pass) {  // means of five cells, four times
    double sum = 0;
    Density mean{};
    for (std::size_t c = 0; c < kHalf; ++c) sum += density[c];
    for (std::size_t c = 0; c < kCells; ++c) {
      if (c + kHalf < kCells) sum += density[c + kHalf];
      if (c > kHalf) sum -= density[c - kHalf - 1];
      mean[c] = sum / (2 * kHalf + 1);
    }
    density = mean;
  }
  return density;
}

/// A place between two peaks that is lower than both.
struct Valley {
  std::size_t cell = 0;
  double sureness = 0;  ///< how much lower it is than both peaks, in standard deviations
};

/// The surest valley that leaves 3 to 30 % of so many numbers beyond it.
Valley surest_valley(const Histogram& histogram, std::size_t numbers) {
  constexpr double kLeastBeyond = 0.03;
  constexpr double kMostBeyond = 0.3;
  const Histogram::Density density = histogram.smoothed();
  std::array<double, Histogram::kCells + 1> peak_from{};
  for (std::size_t c = Histogram::kCells; c-- > 0;) peak_from[c] = std::max(peak_from[c + 1], density[c]);
  Valley surest;
  double peak_before = 0;
  std::size_t before = 0;
  for (std::size_t c = 0; c < Histogram::kCells; ++c) {
    const double lower_peak = std::min(peak_before, peak_from[c]);
    const double beyond = static_cast<double>(numbers - before) / static_cast<double>(numbers);
    if (beyond < kLeastBeyond) break;
    if (beyond <= kMostBeyond && lower_peak > density[c]) {
      const double deviation = std::sqrt((lower_peak + density[c]) / Histogram::kSmoothedOver);
      const double sureness = (lower_peak - density[c]) / deviation;
      if (sureness > surest.sureness) surest = {c, sureness};
    }
    peak_before = std::max(peak_before, density[c]);
    before += histogram.count(c);
  }
  return surest;
}

/// Whether most points with at least this spacing have a much nearer neighbour, as those on scan lines have.
bool are_on_lines(const Spacings& spacings, double spacing4) {
  constexpr double kMostRatio = 2.7;  // points at random: about 2
  std::vector<double> ratios4;
  for (const Around& around : spacings.around) {
    if (around.spacing4 < spacing4 || !std::isfinite(around.spacing4) || around.nearest4 == 0) continue;
    ratios4.push_back(around.spacing4 / around.nearest4);
  }
  return !ratios4.empty() && quantile_of(ratios4, 0.5) > fourth_power(kMostRatio);
}

/// Whether nine tenths of the points on the convex hull have at least this spacing.
bool are_on_hull(const SizedMesh& sized, double spacing4) {
  const Mesh& mesh = sized.mesh;
  std::size_t on_hull = 0;
  std::size_t sparse = 0;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.is_ghost(t)) continue;
    for (Mesh::Index e = Mesh::kStride * t; e < Mesh::kStride * t + 3; ++e) {
      // A ghost has one hull edge, an unused record none.
      if (mesh.origin(e) == kNone || mesh.origin(Mesh::next(e)) == kNone) continue;
      const double at_start = look_around(sized, e).spacing4;
      if (!std::isfinite(at_start)) continue;
      ++on_hull;
      sparse += at_start >= spacing4 ? 1U : 0U;
    }
  }
  return on_hull > 0 && 10 * sparse >= 9 * on_hull;
}

/// Whether points with at least this spacing are spread over the whole convex hull, as points at random are:
/// triangles much larger than their median spacing hold little of it. A sparse part of the shape leaves empty
/// what is outside the shape.
bool fill_hull(const SizedMesh& sized, const Spacings& spacings, double spacing4) {
  constexpr double kLarge = 2.5;       // median spacings
  constexpr double kMostShare = 0.16;  // of the convex hull's area
  std::vector<double> beyond4;
  for (const Around& around : spacings.around) {
    if (around.spacing4 >= spacing4 && std::isfinite(around.spacing4)) beyond4.push_back(around.spacing4);
  }
  if (beyond4.empty()) return false;
  const double large4 = fourth_power(kLarge) * quantile_of(beyond4, 0.5);
  double hull = 0;
  double in_large = 0;
  for (Mesh::Index t = 0; t < sized.mesh.triangle_count(); ++t) {
    if (sized.mesh.is_ghost(t)) continue;
    const double twice_area = sized.triangle(t).twice_area();
    hull += twice_area;
    if (sized.size4_of(t) > large4) in_large += twice_area;
  }
  return in_large <= kMostShare * hull;
}

}  // namespace

std::optional<double> spacing4_of_outliers(const SizedMesh& sized, const Spacings& spacings,
                                           double sureness) {
  const auto is_known = [](const Around& around) {
    return std::isfinite(around.spacing4) && around.spacing4 > 0;
  };
  constexpr std::size_t kForUnit = 64;
  if (spacings.around.size() < kForUnit) return {};
  std::vector<double> some;
  for (std::size_t i = 0; i < spacings.around.size(); i += spacings.around.size() / kForUnit) {
    if (is_known(spacings.around[i])) some.push_back(spacings.around[i].spacing4);
  }
  if (some.empty()) return {};
  const double unit4 = quantile_of(some, 0.5) / kInCell;
  const double per_unit4 = 1 / unit4;
  Histogram histogram;
  std::size_t numbers = 0;
  for (const Around& around : spacings.around) {
    if (!is_known(around)) continue;
    histogram.add(around.spacing4 * per_unit4);
    ++numbers;
  }
  const Valley valley = surest_valley(histogram, numbers);
  if (valley.sureness < sureness) return {};
  const double spacing4 = Histogram::begin4(valley.cell) * unit4;
  if (are_on_lines(spacings, spacing4) || !are_on_hull(sized, spacing4)) return {};
  if (!fill_hull(sized, spacings, spacing4)) return {};
  return spacing4;
}

}  // namespace polylidar::detail
