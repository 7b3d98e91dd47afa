#include "benchmarks/statistics/rank_test.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace hullbench::statistics {
namespace {

using Times = std::vector<double>;  // sorted

/// The work for the exact distribution grows with the fourth power of the number of times.
constexpr std::size_t kMostExactTimes = 20;

Times sorted_times(std::span<const std::int64_t> values) {
  if (values.empty()) throw std::invalid_argument("Without a time there is no ratio of times.");
  Times result(values.begin(), values.end());
  std::ranges::sort(result);
  return result;
}

/// How many ratios of a time of b to one of a are at most `limit`.
std::size_t count_ratios(const Times& a, const Times& b, double limit) {
  std::size_t count = 0;
  std::size_t below = 0;  // of b; grows with a
  for (const double by : a) {
    while (below < b.size() && b[below] / by <= limit) ++below;
    count += below;
  }
  return count;
}

/// The `rank`-th smallest ratio, from 1. Positive doubles are ordered as their bits are, so halving the bits
/// ends at the ratio itself after 63 steps at most.
double ratio_at(const Times& a, const Times& b, std::size_t rank) {
  auto low = std::bit_cast<std::uint64_t>(b.front() / a.back());
  auto high = std::bit_cast<std::uint64_t>(b.back() / a.front());
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    if (count_ratios(a, b, std::bit_cast<double>(middle)) >= rank) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return std::bit_cast<double>(low);
}

/// P(U <= u) for all u < n * m, when the lists, of n and m values, do not differ. The largest of all values
/// is of the first list with probability n / (n + m), and then exceeds all m of the other.
std::vector<double> exact_distribution(std::size_t n, std::size_t m) {
  std::vector<std::vector<double>> shorter(m + 1, {1.0});  // P(U = u) by m, then u, with a value fewer in n
  for (std::size_t i = 1; i <= n; ++i) {
    std::vector<std::vector<double>> row = {{1.0}};
    for (std::size_t j = 1; j <= m; ++j) {
      std::vector<double> density(i * j + 1);
      const double share = static_cast<double>(i) / static_cast<double>(i + j);
      for (std::size_t u = 0; u <= (i - 1) * j; ++u) density[u + j] += share * shorter[j][u];
      for (std::size_t u = 0; u <= i * (j - 1); ++u) density[u] += (1 - share) * row[j - 1][u];
      row.push_back(std::move(density));
    }
    shorter = std::move(row);
  }
  std::vector<double> result = shorter[m];
  std::partial_sum(result.begin(), result.end(), result.begin());
  return result;
}

/// P(U <= u) when the lists do not differ.
class NullDistribution {
 public:
  NullDistribution(std::size_t n, std::size_t m)
      : mean_(static_cast<double>(n) * static_cast<double>(m) / 2),
        deviation_(std::sqrt(mean_ * static_cast<double>(n + m + 1) / 6)) {
    if (std::max(n, m) <= kMostExactTimes) exact_ = exact_distribution(n, m);
  }

  double operator()(std::size_t u) const {
    if (!exact_.empty()) return u < exact_.size() ? exact_[u] : 1;
    return std::erfc((mean_ - static_cast<double>(u) - 0.5) / (deviation_ * std::sqrt(2.0))) / 2;
  }

 private:
  double mean_;
  double deviation_;
  std::vector<double> exact_;
};

}  // namespace

std::optional<RatioOfTimes> ratio_of_times(std::span<const std::int64_t> a_values,
                                           std::span<const std::int64_t> b_values) {
  const Times a = sorted_times(a_values);
  const Times b = sorted_times(b_values);
  if (a.front() <= 0 || b.front() <= 0) return std::nullopt;
  const std::size_t pairs = a.size() * b.size();
  const NullDistribution at_most(a.size(), b.size());
  RatioOfTimes result;
  result.ratio = (ratio_at(a, b, (pairs + 1) / 2) + ratio_at(a, b, pairs / 2 + 1)) / 2;
  const std::size_t at_most_one = count_ratios(a, b, 1);
  const std::size_t below_one = count_ratios(a, b, std::nextafter(1.0, 0.0));
  result.p_value = std::min(1.0, 2 * at_most(std::min(at_most_one, pairs - below_one)));
  std::size_t rejected = 0;  // so many ratios at each end are rejected
  while (2 * at_most(rejected) < 1 - kConfidence) ++rejected;
  if (rejected > 0) result.interval = {ratio_at(a, b, rejected), ratio_at(a, b, pairs + 1 - rejected)};
  return result;
}

}  // namespace hullbench::statistics
