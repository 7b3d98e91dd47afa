// Intervals of medians: by hand, and against every resample there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "benchmarks/bootstrap.hpp"

namespace hullbench {
namespace {

using Times = std::vector<std::int64_t>;
using Clusters = std::vector<std::vector<double>>;

void expect_interval(const std::optional<Interval>& interval, double low, double high) {
  ASSERT_TRUE(interval.has_value());
  EXPECT_EQ(interval->low, low);
  EXPECT_EQ(interval->high, high);
}

/// The value that a share of 2.5 % of `sorted` does not exceed.
double smallest_but_tail(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t tail = (values.size() * 25 + 999) / 1000;  // rounded up, at least one
  return values[tail - 1];
}

/// The interval from all resamples of whole clusters, each written out.
Interval brute_force(const Clusters& clusters) {
  std::vector<double> lower;
  std::vector<double> negated_upper;
  std::vector<std::size_t> drawn(clusters.size(), 0);
  for (bool more = true; more;) {
    std::vector<double> values;
    for (const std::size_t which : drawn)
      values.insert(values.end(), clusters[which].begin(), clusters[which].end());
    std::sort(values.begin(), values.end());
    lower.push_back(values[(values.size() - 1) / 2]);
    negated_upper.push_back(-values[values.size() / 2]);
    more = false;
    for (std::size_t& which : drawn) {
      if (++which < clusters.size()) {
        more = true;
        break;
      }
      which = 0;
    }
  }
  return {smallest_but_tail(lower), -smallest_but_tail(negated_upper)};
}

TEST(MedianInterval, ByHand) {
  // P(a middle one of three is the smallest) = 7 / 27, of five 0.058: both above 0.025, so the whole range.
  expect_interval(median_interval(Times{30, 10, 20}), 10, 30);
  expect_interval(median_interval(Times{5, 4, 1, 3, 2}), 1, 5);
  // Of seven 35 / 7^4 (6/7)^3 + ... = 0.0102, and of the two smallest 0.11.
  expect_interval(median_interval(Times{1, 2, 3, 4, 5, 6, 7}), 2, 6);
  expect_interval(median_interval(Times{1, 2}), 1, 2);
}

TEST(MedianInterval, OfTwentyValuesIsFromTheSixthToTheFifteenth) {
  Times values(20);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int64_t>(i + 1);
  // P(Bin(20, 5/20) >= 10) = 0.0139, P(Bin(20, 6/20) >= 10) = 0.0480.
  expect_interval(median_interval(values), 6, 15);
}

TEST(MedianInterval, OneValueHasNone) {
  EXPECT_FALSE(median_interval(Times{7}).has_value());
  EXPECT_FALSE(median_interval(Times{}).has_value());
}

TEST(MedianInterval, EqualValuesHaveAnIntervalOfOnePoint) {
  expect_interval(median_interval(Times{4, 4, 4, 4}), 4, 4);
}

TEST(MedianInterval, AgreesWithEveryResample) {
  for (std::size_t n = 2; n <= 7; ++n) {
    Times values;
    Clusters single;
    for (std::size_t i = 0; i < n; ++i) {
      values.push_back(static_cast<std::int64_t>((i * 5) % 11 * 10 + 1));
      single.push_back({static_cast<double>(values.back())});
    }
    const Interval expected = brute_force(single);
    expect_interval(median_interval(values), expected.low, expected.high);
    expect_interval(clustered_median_interval(single), expected.low, expected.high);
  }
}

TEST(ClusteredMedianInterval, AgreesWithEveryResample) {
  const std::vector<Clusters> all = {{{1, 2, 3}, {10, 11, 12}},
                                     {{1}, {2, 3}, {4, 5, 6}, {7, 8, 9, 10}},
                                     {{1, 1, 5}, {2, 2}, {1, 9, 9, 9}, {3}, {4, 4}},
                                     {{5, 6}, {1, 2}, {3, 4}, {9, 9}, {7, 0.5}, {2, 8}}};
  for (const Clusters& clusters : all) {
    const Interval expected = brute_force(clusters);
    expect_interval(clustered_median_interval(clusters), expected.low, expected.high);
  }
}

// Two clusters, drawn twice: both the first with probability 1/4, and then the middle is 2; both the
// second, 11.
TEST(ClusteredMedianInterval, OfTwoClustersByHand) {
  expect_interval(clustered_median_interval({{1, 2, 3}, {10, 11, 12}}), 2, 11);
}

TEST(ClusteredMedianInterval, IsWiderThanThatOfIndependentValues) {
  const Times values = {10, 11, 12, 13, 20, 21, 22, 23, 30, 31, 32, 33};
  const auto independent = median_interval(values);
  const auto clustered = clustered_median_interval({{10, 11, 12, 13}, {20, 21, 22, 23}, {30, 31, 32, 33}});
  ASSERT_TRUE(independent && clustered);
  EXPECT_LT(clustered->low, independent->low);
  EXPECT_GT(clustered->high, independent->high);
}

TEST(ClusteredMedianInterval, OneClusterHasNone) {
  EXPECT_FALSE(clustered_median_interval({{1, 2, 3}}).has_value());
  EXPECT_FALSE(clustered_median_interval({{1, 2, 3}, {}}).has_value());
  EXPECT_FALSE(clustered_median_interval({}).has_value());
}

TEST(ClusteredMedianInterval, BesideTheLimitOfExactnessBothWaysAgree) {
  for (const std::size_t n : {100U, 101U, 1000U}) {
    Times values;
    Clusters single;
    for (std::size_t i = 0; i < n; ++i) {
      values.push_back(static_cast<std::int64_t>(i));
      single.push_back({static_cast<double>(i)});
    }
    const auto exact = median_interval(values);
    const auto clustered = clustered_median_interval(single);
    ASSERT_TRUE(exact && clustered);
    // The normal distribution is off by a value at most; up to 100 clusters nothing is.
    const double off = n <= 100 ? 0 : 1;
    EXPECT_NEAR(exact->low, clustered->low, off);
    EXPECT_NEAR(exact->high, clustered->high, off);
  }
}

}  // namespace
}  // namespace hullbench
