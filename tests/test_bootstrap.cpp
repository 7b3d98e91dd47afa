// Intervals of medians: by hand, and against every resample there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "benchmarks/statistics/bootstrap.hpp"
#include "tests/infinity.hpp"

namespace hullbench::testing {
namespace {

using Times = std::vector<std::int64_t>;
using Clusters = std::vector<std::vector<double>>;
using Nested = std::vector<std::vector<statistics::Passes>>;

void expect_interval(const std::optional<statistics::Interval>& interval, double low, double high) {
  ASSERT_TRUE(interval.has_value());
  EXPECT_EQ(interval->low, low);
  EXPECT_EQ(interval->high, high);
}

/// The value that a share of 2.5 % of `sorted` does not exceed.
double smallest_but_tail(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t tail = (values.size() * 25 + 999) / 1000;  // rounded up, at least one
  return values[tail - 1];
}

/// Calls `take` with every choice of one of `counts[i]` for each i.
template <typename Take>
void for_each_choice(const std::vector<std::size_t>& counts, const Take& take) {
  std::vector<std::size_t> chosen(counts.size(), 0);
  for (bool more = true; more;) {
    take(chosen);
    more = false;
    for (std::size_t place = 0; place < counts.size() && !more; ++place) {
      more = ++chosen[place] < counts[place];
      if (!more) chosen[place] = 0;
    }
  }
}

/// The interval from all resamples of whole clusters, each written out.
statistics::Interval brute_force(const Clusters& clusters) {
  std::vector<double> lower;
  std::vector<double> negated_upper;
  for_each_choice(std::vector<std::size_t>(clusters.size(), clusters.size()), [&](const auto& drawn) {
    std::vector<double> values;
    for (const std::size_t which : drawn)
      values.insert(values.end(), clusters[which].begin(), clusters[which].end());
    std::ranges::sort(values);
    lower.push_back(values[(values.size() - 1) / 2]);
    negated_upper.push_back(-values[values.size() / 2]);
  });
  return {smallest_but_tail(lower), -smallest_but_tail(negated_upper)};
}

/// The middle of every resample of a case, the upper one of two or the lower, each written out with how
/// likely it is.
std::vector<std::pair<double, double>> resampled_case(const statistics::Passes& passes, bool upper) {
  std::vector<std::pair<double, double>> result;
  for_each_choice(std::vector<std::size_t>(passes.size(), passes.size()), [&](const auto& drawn) {
    std::vector<std::size_t> counts;
    double chance = std::pow(1.0 / static_cast<double>(passes.size()), passes.size());
    for (const std::size_t pass : drawn) {
      counts.insert(counts.end(), passes[pass].size(), passes[pass].size());
      chance /= std::pow(static_cast<double>(passes[pass].size()), passes[pass].size());
    }
    for_each_choice(counts, [&](const auto& rounds) {
      std::vector<double> values;
      for (const std::size_t pass : drawn) {
        for (std::size_t k = 0; k < passes[pass].size(); ++k)
          values.push_back(passes[pass][rounds[values.size()]]);
      }
      std::ranges::sort(values);
      result.emplace_back(values[upper ? values.size() / 2 : (values.size() - 1) / 2], chance);
    });
  });
  return result;
}

/// The median of every resample of clusters, cases, passes and rounds with how likely it is.
std::vector<std::pair<double, double>> resampled(const Nested& clusters, bool upper) {
  std::vector<std::pair<double, double>> result;
  for_each_choice(std::vector<std::size_t>(clusters.size(), clusters.size()), [&](const auto& drawn) {
    std::vector<std::vector<std::pair<double, double>>> cases;
    std::vector<std::size_t> counts;
    for (const std::size_t which : drawn) {
      for (const statistics::Passes& passes : clusters[which]) {
        cases.push_back(resampled_case(passes, upper));
        counts.push_back(cases.back().size());
      }
    }
    const double chance = std::pow(1.0 / static_cast<double>(clusters.size()), clusters.size());
    for_each_choice(counts, [&](const auto& chosen) {
      double together = chance;
      std::vector<double> middles;
      for (std::size_t i = 0; i < cases.size(); ++i) {
        middles.push_back(cases[i][chosen[i]].first);
        together *= cases[i][chosen[i]].second;
      }
      std::ranges::sort(middles);
      result.emplace_back(middles[upper ? middles.size() / 2 : (middles.size() - 1) / 2], together);
    });
  });
  return result;
}

/// The interval from all of these.
statistics::Interval brute_force(const Nested& clusters) {
  const auto end = [](std::vector<std::pair<double, double>> medians, double sign) {
    for (auto& [value, chance] : medians) value *= sign;
    std::ranges::sort(medians);
    double sum = 0;
    for (const auto& [value, chance] : medians) {
      sum += chance;
      if (sum >= 0.025) return sign * value;
    }
    return sign * medians.back().first;
  };
  return {end(resampled(clusters, false), 1), end(resampled(clusters, true), -1)};
}

TEST(NestedMedianInterval, AgreesWithEveryResample) {
  const std::vector<Nested> all = {
      {{{{1, 2, 3}}}, {{{2.5, 4, 5}}}},               // two shapes, one case and pass each
      {{{{1, 2}, {3, 9}}}},                           // one case of two passes
      {{{{1}, {7}, {4}}}, {{{2}, {3}}}},              // passes of one round
      {{{{1, 2}}, {{5, 8}}}, {{{4}, {6}}}},           // two cases of one shape
      {{{{1, 6}, {2}}}, {{{3, 5}}}, {{{4}, {0.5}}}},  // different numbers of rounds
      {{{{2, 2}, {2, 3}}}, {{{1, kInfinity}}}}};      // ties and a failure
  for (const Nested& clusters : all) {
    const statistics::Interval expected = brute_force(clusters);
    expect_interval(statistics::nested_median_interval(clusters), expected.low, expected.high);
  }
}

// The same fifteen values as three passes that differ, and as one.
TEST(NestedMedianInterval, HasWhatVariesBetweenPasses) {
  const statistics::Passes apart = {
      {1.00, 1.01, 1.02, 1.03, 1.04}, {2.00, 2.01, 2.02, 2.03, 2.04}, {3.00, 3.01, 3.02, 3.03, 3.04}};
  statistics::Passes together = {{}};
  for (const auto& pass : apart) together[0].insert(together[0].end(), pass.begin(), pass.end());
  const auto wide = statistics::nested_median_interval({{apart}});
  const auto narrow = statistics::nested_median_interval({{together}});
  ASSERT_TRUE(wide && narrow);
  EXPECT_LT(wide->low, narrow->low);
  EXPECT_GT(wide->high, narrow->high);
}

TEST(NestedMedianInterval, OfSingleValuesIsTheClusteredOne) {
  const auto nested = statistics::nested_median_interval({{{{1}}, {{2}}, {{3}}}, {{{10}}, {{11}}, {{12}}}});
  const auto clustered = statistics::clustered_median_interval({{1, 2, 3}, {10, 11, 12}});
  ASSERT_TRUE(nested && clustered);
  EXPECT_EQ(nested->low, clustered->low);
  EXPECT_EQ(nested->high, clustered->high);
}

TEST(NestedMedianInterval, OneValueHasNone) {
  EXPECT_FALSE(statistics::nested_median_interval({}).has_value());
  EXPECT_FALSE(statistics::nested_median_interval({{{{1}}}, {{{}}}, {}}).has_value());
}

TEST(MedianInterval, ByHand) {
  // P(a middle one of three is the smallest) = 7 / 27, of five 0.058: both above 0.025, so the whole range.
  expect_interval(statistics::median_interval(Times{30, 10, 20}), 10, 30);
  expect_interval(statistics::median_interval(Times{5, 4, 1, 3, 2}), 1, 5);
  // Of seven 35 / 7^4 (6/7)^3 + ... = 0.0102, and of the two smallest 0.11.
  expect_interval(statistics::median_interval(Times{1, 2, 3, 4, 5, 6, 7}), 2, 6);
  expect_interval(statistics::median_interval(Times{1, 2}), 1, 2);
}

TEST(MedianInterval, OfTwentyValuesIsFromTheSixthToTheFifteenth) {
  Times values(20);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i + 1);
  // P(Bin(20, 5/20) >= 10) = 0.0139, P(Bin(20, 6/20) >= 10) = 0.0480.
  expect_interval(statistics::median_interval(values), 6, 15);
}

TEST(MedianInterval, OneValueHasNone) {
  EXPECT_FALSE(statistics::median_interval(Times{7}).has_value());
  EXPECT_FALSE(statistics::median_interval(Times{}).has_value());
}

TEST(MedianInterval, EqualValuesHaveAnIntervalOfOnePoint) {
  expect_interval(statistics::median_interval(Times{4, 4, 4, 4}), 4, 4);
}

TEST(MedianInterval, AgreesWithEveryResample) {
  for (std::size_t n = 2; n <= 7; ++n) {
    Times values;
    Clusters single;
    for (std::size_t i = 0; i < n; ++i) {
      values.push_back(static_cast<std::int64_t>((i * 5) % 11 * 10 + 1));
      single.push_back({static_cast<double>(values.back())});
    }
    const statistics::Interval expected = brute_force(single);
    expect_interval(statistics::median_interval(values), expected.low, expected.high);
    expect_interval(statistics::clustered_median_interval(single), expected.low, expected.high);
  }
}

TEST(ClusteredMedianInterval, AgreesWithEveryResample) {
  const std::vector<Clusters> all = {{{1, 2, 3}, {10, 11, 12}},
                                     {{1}, {2, 3}, {4, 5, 6}, {7, 8, 9, 10}},
                                     {{1, 1, 5}, {2, 2}, {1, 9, 9, 9}, {3}, {4, 4}},
                                     {{5, 6}, {1, 2}, {3, 4}, {9, 9}, {7, 0.5}, {2, 8}}};
  for (const Clusters& clusters : all) {
    const statistics::Interval expected = brute_force(clusters);
    expect_interval(statistics::clustered_median_interval(clusters), expected.low, expected.high);
  }
}

// Two clusters, drawn twice: both the first with probability 1/4, and then the middle is 2; both the
// second, 11.
TEST(ClusteredMedianInterval, OfTwoClustersByHand) {
  expect_interval(statistics::clustered_median_interval({{1, 2, 3}, {10, 11, 12}}), 2, 11);
}

TEST(ClusteredMedianInterval, IsWiderThanThatOfIndependentValues) {
  const Times values = {10, 11, 12, 13, 20, 21, 22, 23, 30, 31, 32, 33};
  const auto independent = statistics::median_interval(values);
  const auto clustered =
      statistics::clustered_median_interval({{10, 11, 12, 13}, {20, 21, 22, 23}, {30, 31, 32, 33}});
  ASSERT_TRUE(independent && clustered);
  EXPECT_LT(clustered->low, independent->low);
  EXPECT_GT(clustered->high, independent->high);
}

TEST(ClusteredMedianInterval, OneClusterHasNone) {
  EXPECT_FALSE(statistics::clustered_median_interval({{1, 2, 3}}).has_value());
  EXPECT_FALSE(statistics::clustered_median_interval({{1, 2, 3}, {}}).has_value());
  EXPECT_FALSE(statistics::clustered_median_interval({}).has_value());
}

TEST(ClusteredMedianInterval, BesideTheLimitOfExactnessBothWaysAgree) {
  for (const std::size_t n : {100U, 101U, 1000U}) {
    Times values;
    Clusters single;
    for (std::size_t i = 0; i < n; ++i) {
      values.push_back(static_cast<std::int64_t>(i));
      single.push_back({static_cast<double>(i)});
    }
    const auto exact = statistics::median_interval(values);
    const auto clustered = statistics::clustered_median_interval(single);
    ASSERT_TRUE(exact && clustered);
    // The normal distribution is off by a value at most; up to 100 clusters nothing is.
    const double off = n <= 100 ? 0 : 1;
    EXPECT_NEAR(exact->low, clustered->low, off);
    EXPECT_NEAR(exact->high, clustered->high, off);
  }
}

}  // namespace
}  // namespace hullbench::testing
