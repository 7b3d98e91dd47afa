#include "benchmarks/statistics/sign_test.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace hullbench::statistics {
namespace {

/// How likely at most `k` of `n` fair coins show heads.
double at_most_heads(std::size_t n, std::size_t k) {
  if (k >= n) return 1;
  return boost::math::ibetac(static_cast<double>(k + 1), static_cast<double>(n - k), 0.5);
}

}  // namespace

Interval sign_interval(std::span<const double> values, double confidence) {
  if (!(confidence > 0 && confidence < 1)) {
    throw std::invalid_argument("A confidence must lie between 0 and 1.");
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Interval interval = {-kInfinity, kInfinity};
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const std::size_t n = sorted.size();
  for (std::size_t k = 0; k < n / 2; ++k) {
    if (2 * at_most_heads(n, k) > 1 - confidence) break;
    interval = {sorted[k], sorted[n - 1 - k]};
  }
  return interval;
}

double sign_test_above(std::span<const double> values, double threshold) {
  const auto above = std::ranges::count_if(values, [&](double value) { return value > threshold; });
  const auto below = std::ranges::count_if(values, [&](double value) { return value < threshold; });
  return at_most_heads(static_cast<std::size_t>(above + below), static_cast<std::size_t>(below));
}

}  // namespace hullbench::statistics
