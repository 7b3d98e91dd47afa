#include "benchmarks/statistics/bootstrap.hpp"

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace hullbench::statistics {
namespace {

using Clusters = std::vector<std::vector<Passes>>;  // by cluster, case, pass, round

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

/// By how many more of some resampled values are at most a limit than above it: the chance of each number
/// from `lowest` on.
struct Surplus {
  std::ptrdiff_t lowest = 0;
  std::vector<double> chances = {1};
};

/// Of two that are independent, together.
Surplus sum_of(const Surplus& one, const Surplus& other) {
  Surplus sum = {one.lowest + other.lowest,
                 std::vector<double>(one.chances.size() + other.chances.size() - 1)};
  for (std::size_t i = 0; i < one.chances.size(); ++i) {
    if (one.chances[i] == 0) continue;
    for (std::size_t k = 0; k < other.chances.size(); ++k)
      sum.chances[i + k] += one.chances[i] * other.chances[k];
  }
  return sum;
}

/// Of a single value that is at most the limit with this chance.
Surplus surplus_of_one(double chance) {
  if (chance <= 0) return {-1, {1}};
  if (chance >= 1) return {1, {1}};
  return {-1, {1 - chance, 0, chance}};
}

/// Of one of `all`, each drawn as likely as the others.
Surplus drawn_from(const std::vector<Surplus>& all) {
  Surplus draw = {all.front().lowest, {}};
  for (const Surplus& one : all) draw.lowest = std::min(draw.lowest, one.lowest);
  for (const Surplus& one : all) {
    const auto begin = static_cast<std::size_t>(one.lowest - draw.lowest);
    draw.chances.resize(std::max(draw.chances.size(), begin + one.chances.size()));
    for (std::size_t i = 0; i < one.chances.size(); ++i)
      draw.chances[begin + i] += one.chances[i] / static_cast<double>(all.size());
  }
  return draw;
}

/// P(surplus >= 0): at least half of the values are at most the limit, so the lower middle one is.
double chance_of_half(const Surplus& surplus) {
  const std::ptrdiff_t below = std::max<std::ptrdiff_t>(0, -surplus.lowest);
  if (below >= static_cast<std::ptrdiff_t>(surplus.chances.size())) return 0;
  return std::accumulate(surplus.chances.begin() + below, surplus.chances.end(), 0.0);
}

/// The same of as many draws from `all` as there are, exactly.
double exact_chance(const std::vector<Surplus>& all) {
  const Surplus draw = drawn_from(all);
  Surplus sum;
  for (std::size_t drawn = 0; drawn < all.size(); ++drawn) sum = sum_of(sum, draw);
  return chance_of_half(sum);
}

/// The same by the central limit theorem. The sum moves in steps of two or, of clusters of different sizes,
/// of one; the correction for continuity is that of one.
double normal_chance(const std::vector<Surplus>& all) {
  double sum = 0;
  double squares = 0;
  for (const Surplus& surplus : all) {
    for (std::size_t i = 0; i < surplus.chances.size(); ++i) {
      const auto value = static_cast<double>(surplus.lowest + static_cast<std::ptrdiff_t>(i));
      sum += surplus.chances[i] * value;
      squares += surplus.chances[i] * value * value;
    }
  }
  const double variance = squares - sum * sum / static_cast<double>(all.size());
  if (variance <= 0) return sum >= 0 ? 1 : 0;
  return std::erfc(-(sum + 0.5) / std::sqrt(2 * variance)) / 2;
}

/// P(the lower middle one of a resampled case's values <= limit).
double chance_of_case(const Passes& passes, double limit) {
  std::vector<Surplus> surpluses;
  surpluses.reserve(passes.size());
  for (const auto& pass : passes) {
    const auto below = std::ranges::count_if(pass, [&](double value) { return value <= limit; });
    const Surplus one = surplus_of_one(static_cast<double>(below) / static_cast<double>(pass.size()));
    Surplus rounds;
    for (std::size_t round = 0; round < pass.size(); ++round) rounds = sum_of(rounds, one);
    surpluses.push_back(std::move(rounds));
  }
  return exact_chance(surpluses);
}

/// P(the lower middle one of the cases of resampled clusters <= limit).
double middle_chance(const Clusters& clusters, double limit) {
  std::vector<Surplus> surpluses;
  surpluses.reserve(clusters.size());
  for (const auto& cluster : clusters) {
    Surplus cases;
    for (const Passes& one : cluster) cases = sum_of(cases, surplus_of_one(chance_of_case(one, limit)));
    surpluses.push_back(std::move(cases));
  }
  return clusters.size() <= kMostExactClusters ? exact_chance(surpluses) : normal_chance(surpluses);
}

/// All values, sorted.
std::vector<double> values_of(const Clusters& clusters) {
  std::vector<double> values;
  for (const auto& cluster : clusters) {
    for (const Passes& passes : cluster) {
      for (const auto& pass : passes) values.insert(values.end(), pass.begin(), pass.end());
    }
  }
  std::ranges::sort(values);
  return values;
}

/// The smallest value that the lower middle one does not exceed with the probability of a tail.
double lower_end(const Clusters& clusters) {
  const std::vector<double> values = values_of(clusters);
  return *std::partition_point(values.begin(), std::prev(values.end()),
                               [&](double value) { return middle_chance(clusters, value) < kTail; });
}

/// `clusters` without what has no values.
Clusters filled(Clusters clusters) {
  for (auto& cluster : clusters) {
    for (Passes& passes : cluster) std::erase_if(passes, [](const auto& pass) { return pass.empty(); });
    std::erase_if(cluster, [](const Passes& passes) { return passes.empty(); });
  }
  std::erase_if(clusters, [](const auto& cluster) { return cluster.empty(); });
  return clusters;
}

}  // namespace

std::optional<Interval> median_interval(std::span<const std::int64_t> values) {
  const std::size_t n = values.size();
  if (n < 2) return std::nullopt;
  std::size_t k = 1;
  while (order_statistic_probability(n, (n + 1) / 2, k) < kTail) ++k;
  std::vector<std::int64_t> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return Interval{static_cast<double>(sorted[k - 1]), static_cast<double>(sorted[n - k])};
}

std::optional<Interval> nested_median_interval(const Clusters& all) {
  Clusters clusters = filled(all);
  if (values_of(clusters).size() < 2) return std::nullopt;
  const double low = lower_end(clusters);
  // The upper end is the lower one of the values with their signs turned.
  for (auto& cluster : clusters) {
    for (Passes& passes : cluster) {
      for (auto& pass : passes) std::ranges::transform(pass, pass.begin(), std::negate<>());
    }
  }
  return Interval{low, -lower_end(clusters)};
}

std::optional<Interval> clustered_median_interval(const std::vector<std::vector<double>>& clusters) {
  Clusters cases;
  for (const auto& cluster : clusters) {
    if (cluster.empty()) continue;
    auto& values = cases.emplace_back();
    for (const double value : cluster) values.push_back({{value}});
  }
  if (cases.size() < 2) return std::nullopt;
  return nested_median_interval(cases);
}

}  // namespace hullbench::statistics
