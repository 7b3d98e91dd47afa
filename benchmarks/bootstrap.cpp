#include "benchmarks/bootstrap.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>

namespace hullbench {
namespace {

using Clusters = std::vector<std::vector<double>>;  // by cluster, then value; sorted within a cluster

/// What may lie beyond each end.
constexpr double kTail = (1 - kConfidence) / 2;

/// The work for the exact distribution grows with the cube of the number of clusters.
constexpr std::size_t kMostExactClusters = 100;

/// P(the `rank`-th smallest of `n` draws from n values is one of the `k` smallest values): that at least
/// `rank` draws are, a binomial tail.
double order_statistic_probability(std::size_t n, std::size_t rank, std::size_t k) {
  return boost::math::ibeta(static_cast<double>(rank), static_cast<double>(n - rank + 1),
                            static_cast<double>(k) / static_cast<double>(n));
}

/// Of a resampled cluster: how many more of its values are at most `limit` than above it.
double surplus(const std::vector<double>& cluster, double limit) {
  const auto above = std::upper_bound(cluster.begin(), cluster.end(), limit);
  return static_cast<double>(2 * (above - cluster.begin())) - static_cast<double>(cluster.size());
}

/// P(sum of the surpluses of as many drawn clusters as there are >= 0), exact.
double exact_probability(const std::vector<double>& surpluses) {
  std::map<std::ptrdiff_t, double> draw;  // probability by surplus
  for (const double value : surpluses)
    draw[static_cast<std::ptrdiff_t>(value)] += 1 / static_cast<double>(surpluses.size());
  const std::ptrdiff_t lowest = std::min<std::ptrdiff_t>(0, draw.begin()->first);
  const std::ptrdiff_t highest = std::max<std::ptrdiff_t>(0, draw.rbegin()->first);
  const auto draws = static_cast<std::ptrdiff_t>(surpluses.size());
  const auto width = static_cast<std::size_t>(draws * (highest - lowest) + 1);
  std::vector<double> sums(width);  // probability by sum, from draws * lowest on
  sums[static_cast<std::size_t>(-draws * lowest)] = 1;
  for (std::ptrdiff_t drawn = 0; drawn < draws; ++drawn) {
    std::vector<double> next(width);
    for (std::size_t place = 0; place < width; ++place) {
      if (sums[place] == 0) continue;
      for (const auto& [value, probability] : draw) {
        next[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(place) + value)] +=
            probability * sums[place];
      }
    }
    sums = std::move(next);
  }
  return std::accumulate(sums.begin() - draws * lowest, sums.end(), 0.0);
}

/// The same by the central limit theorem. The sum moves in steps of two or, of clusters of different sizes,
/// of one; the correction for continuity is that of one.
double normal_probability(const std::vector<double>& surpluses) {
  double sum = 0;
  double squares = 0;
  for (const double value : surpluses) {
    sum += value;
    squares += value * value;
  }
  const double variance = squares - sum * sum / static_cast<double>(surpluses.size());
  if (variance <= 0) return sum >= 0 ? 1 : 0;
  return std::erfc(-(sum + 0.5) / std::sqrt(2 * variance)) / 2;
}

/// P(the lower middle one of the values of resampled clusters <= limit): at least half of them are.
double middle_probability(const Clusters& clusters, double limit) {
  std::vector<double> surpluses;
  surpluses.reserve(clusters.size());
  for (const auto& cluster : clusters) surpluses.push_back(surplus(cluster, limit));
  return clusters.size() <= kMostExactClusters ? exact_probability(surpluses) : normal_probability(surpluses);
}

/// The smallest value that the lower middle one does not exceed with the probability of a tail.
double lower_end(Clusters clusters) {
  std::vector<double> values;
  for (auto& cluster : clusters) {
    std::sort(cluster.begin(), cluster.end());
    values.insert(values.end(), cluster.begin(), cluster.end());
  }
  std::sort(values.begin(), values.end());
  return *std::partition_point(values.begin(), std::prev(values.end()),
                               [&](double value) { return middle_probability(clusters, value) < kTail; });
}

}  // namespace

std::optional<Interval> median_interval(std::span<const std::int64_t> values) {
  const std::size_t n = values.size();
  if (n < 2) return std::nullopt;
  std::size_t k = 1;
  while (order_statistic_probability(n, (n + 1) / 2, k) < kTail) ++k;
  std::vector<std::int64_t> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return Interval{static_cast<double>(sorted[k - 1]), static_cast<double>(sorted[n - k])};
}

std::optional<Interval> clustered_median_interval(const Clusters& clusters) {
  Clusters filled;
  std::copy_if(clusters.begin(), clusters.end(), std::back_inserter(filled),
               [](const auto& cluster) { return !cluster.empty(); });
  if (filled.size() < 2) return std::nullopt;
  const double low = lower_end(filled);
  // The upper end is the lower one of the values with their signs turned.
  for (auto& cluster : filled) {
    for (double& value : cluster) value = -value;
  }
  return Interval{low, -lower_end(std::move(filled))};
}

}  // namespace hullbench
