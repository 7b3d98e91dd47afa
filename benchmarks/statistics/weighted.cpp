#include "benchmarks/statistics/weighted.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>

namespace hullbench::statistics {
namespace {

using Clusters = std::vector<std::vector<WeightedValue>>;

constexpr double kTail = (1 - kConfidence) / 2;
constexpr std::size_t kSamples = 2000;
/// Sums of weights such as a third are equal when they differ by no more of themselves.
constexpr double kRounding = 1e-9;

Clusters filled(Clusters clusters) {
  std::erase_if(clusters, [](const auto& cluster) { return cluster.empty(); });
  return clusters;
}

std::vector<WeightedValue> all_of(const Clusters& clusters) {
  std::vector<WeightedValue> values;
  for (const auto& cluster : clusters) values.insert(values.end(), cluster.begin(), cluster.end());
  return values;
}

/// The median of values in ascending order, as weighted_median says; those without weight do not count.
double median_of_sorted(const std::vector<WeightedValue>& values) {
  double total = 0;
  for (const WeightedValue& one : values) total += one.weight;
  double below = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].weight <= 0) continue;
    below += values[i].weight;
    if (std::abs(below - total / 2) <= kRounding * total) {
      std::size_t next = i + 1;
      while (values[next].weight <= 0) ++next;
      return (values[i].value + values[next].value) / 2;
    }
    if (below > total / 2) return values[i].value;
  }
  return values.back().value;
}

}  // namespace

double weighted_median(std::vector<WeightedValue> values) {
  std::ranges::sort(values, [](const auto& a, const auto& b) { return a.value < b.value; });
  return median_of_sorted(values);
}

double weighted_mean(const std::vector<WeightedValue>& values) {
  double sum = 0;
  double weight = 0;
  for (const WeightedValue& one : values) {
    sum += one.weight * one.value;
    weight += one.weight;
  }
  return sum / weight;
}

std::optional<Interval> weighted_median_interval(const Clusters& all) {
  const Clusters clusters = filled(all);
  if (clusters.size() < 2) return std::nullopt;
  std::vector<std::pair<WeightedValue, std::size_t>> sorted;  // value, cluster
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    for (const WeightedValue& one : clusters[c]) sorted.emplace_back(one, c);
  }
  std::ranges::stable_sort(sorted,
                           [](const auto& a, const auto& b) { return a.first.value < b.first.value; });
  std::mt19937_64 random;  // whose numbers, unlike the library's distributions, are the same everywhere
  std::vector<double> medians(kSamples);
  std::vector<WeightedValue> sample(sorted.size());
  for (double& median : medians) {
    std::vector<double> drawn(clusters.size());
    for (std::size_t k = 0; k < clusters.size(); ++k) drawn[random() % clusters.size()] += 1;
    for (std::size_t i = 0; i < sorted.size(); ++i)
      sample[i] = {sorted[i].first.value, sorted[i].first.weight * drawn[sorted[i].second]};
    median = median_of_sorted(sample);
  }
  std::ranges::sort(medians);
  const auto beyond = static_cast<std::size_t>(kTail * kSamples);
  return Interval{medians[beyond], medians[kSamples - 1 - beyond]};
}

std::optional<Interval> weighted_mean_interval(const Clusters& all) {
  const Clusters clusters = filled(all);
  if (clusters.size() < 2) return std::nullopt;
  const double mean = weighted_mean(all_of(clusters));
  double weight = 0;
  double squares = 0;
  for (const auto& cluster : clusters) {
    double deviation = 0;
    for (const WeightedValue& one : cluster) {
      deviation += one.weight * (one.value - mean);
      weight += one.weight;
    }
    squares += deviation * deviation;
  }
  const auto count = static_cast<double>(clusters.size());
  const double t = boost::math::quantile(boost::math::students_t(count - 1), 1 - kTail);
  const double half_width = t * std::sqrt(squares * count / (count - 1)) / weight;
  return Interval{mean - half_width, mean + half_width};
}

}  // namespace hullbench::statistics
