#include "benchmarks/statistics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hullbench::statistics {
namespace {

/// Exact below 2^53 ns, which is 104 days.
std::vector<double> as_doubles(std::span<const std::int64_t> times) {
  return {times.begin(), times.end()};
}

void throw_if_none(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("A statistic of no values is not defined.");
}

}  // namespace

double quantile(std::span<const double> values, double q) {
  throw_if_none(values);
  if (!(q >= 0 && q <= 1)) throw std::invalid_argument("A quantile must lie between 0 and 1.");
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  // Between infinite values, and beside one, the formula would give NaN.
  if (position == static_cast<double>(below) || sorted[below] == sorted[above]) return sorted[below];
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double median(std::span<const std::int64_t> values) {
  return quantile(as_doubles(values), 0.5);
}

double median(std::span<const double> values) {
  return quantile(values, 0.5);
}

double median_absolute_deviation(std::span<const std::int64_t> values) {
  const double middle = median(values);
  std::vector<double> deviations = as_doubles(values);
  for (double& one : deviations) one = std::abs(one - middle);
  return median(deviations);
}

double mean(std::span<const double> values) {
  throw_if_none(values);
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<double> standard_deviation(std::span<const double> values) {
  const double centre = mean(values);
  if (values.size() == 1) return std::nullopt;
  double sum = 0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

Statistics describe(std::span<const std::int64_t> values) {
  Statistics result;
  result.median = median(values);
  result.median_interval = median_interval(values);
  result.count = values.size();
  result.mad = median_absolute_deviation(values);
  const auto [minimum, maximum] = std::ranges::minmax_element(values);
  result.minimum = *minimum;
  result.maximum = *maximum;
  result.mean = mean(as_doubles(values));
  result.standard_deviation = standard_deviation(as_doubles(values));
  return result;
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t x, std::size_t y) { return p_values[x] < p_values[y]; });
  std::vector<double> result(p_values.size());
  double largest = 0;
  for (std::size_t place = 0; place < order.size(); ++place) {
    const double adjusted = p_values[order[place]] * static_cast<double>(order.size() - place);
    largest = std::min(1.0, std::max(largest, adjusted));
    result[order[place]] = largest;
  }
  return result;
}

}  // namespace hullbench::statistics
