#include "benchmarks/statistics/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hullbench::statistics {
namespace {

template <typename T>
std::vector<double> sorted_copy(std::span<const T> values) {
  if (values.empty()) throw std::invalid_argument("A statistic of no values is not defined.");
  std::vector<double> sorted;
  sorted.reserve(values.size());
  // Exact below 2^53 ns, which is 104 days.
  for (const T value : values) sorted.push_back(static_cast<double>(value));
  std::ranges::sort(sorted);
  return sorted;
}

double quantile_of_sorted(const std::vector<double>& sorted, double q) {
  if (!(q >= 0 && q <= 1)) throw std::invalid_argument("A quantile must lie between 0 and 1.");
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  // Between infinite values, and beside one, the formula would give NaN.
  if (position == static_cast<double>(below) || sorted[below] == sorted[above]) return sorted[below];
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

template <typename Value>
double mean_of(std::span<const Value> values) {
  if (values.empty()) throw std::invalid_argument("A statistic of no values is not defined.");
  double sum = 0;
  for (const Value value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

template <typename Value>
std::optional<double> standard_deviation_of(std::span<const Value> values) {
  const double centre = mean_of(values);
  if (values.size() == 1) return std::nullopt;
  double sum = 0;
  for (const Value value : values) {
    const double deviation = static_cast<double>(value) - centre;
    sum += deviation * deviation;
  }
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

}  // namespace

double quantile(std::span<const std::int64_t> values, double q) {
  return quantile_of_sorted(sorted_copy(values), q);
}

double quantile(std::span<const double> values, double q) {
  return quantile_of_sorted(sorted_copy(values), q);
}

double median(std::span<const std::int64_t> values) {
  return quantile_of_sorted(sorted_copy(values), 0.5);
}

double median(std::span<const double> values) {
  return quantile_of_sorted(sorted_copy(values), 0.5);
}

double median_absolute_deviation(std::span<const std::int64_t> values) {
  const double middle = median(values);
  std::vector<double> deviations;
  deviations.reserve(values.size());
  for (const std::int64_t value : values) deviations.push_back(std::abs(static_cast<double>(value) - middle));
  return median(std::span<const double>(deviations));
}

double mean(std::span<const std::int64_t> values) {
  return mean_of(values);
}
double mean(std::span<const double> values) {
  return mean_of(values);
}

std::optional<double> standard_deviation(std::span<const std::int64_t> values) {
  return standard_deviation_of(values);
}
std::optional<double> standard_deviation(std::span<const double> values) {
  return standard_deviation_of(values);
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
  result.mean = mean(values);
  result.standard_deviation = standard_deviation(values);
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
