// Statistics against values worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/statistics/weighted.hpp"
#include "tests/infinity.hpp"

namespace hullbench::testing {
namespace {

using Times = std::vector<std::int64_t>;

TEST(Median, OfInfiniteValuesIsInfiniteAndNeverNaN) {
  const auto median_of = [](const std::vector<double>& values) {
    return statistics::median(std::span<const double>(values));
  };
  EXPECT_EQ(median_of({kInfinity}), kInfinity);
  EXPECT_EQ(median_of({1, 2, kInfinity}), 2);
  EXPECT_EQ(median_of({1, kInfinity}), kInfinity);
  EXPECT_EQ(median_of({1, kInfinity, kInfinity, kInfinity}), kInfinity);
}

TEST(Weighted, OfEqualWeightsTheMedianIsTheUsualOne) {
  const auto median_of = [](const std::vector<double>& values) {
    std::vector<statistics::WeightedValue> weighted;
    weighted.reserve(values.size());
    for (const double value : values) weighted.push_back({value, 1.0 / 3});
    return statistics::weighted_median(weighted);
  };
  for (const std::vector<double>& values : {std::vector<double>{3},
                                            {3, 1},
                                            {5, 1, 2},
                                            {4, 1, 3, 2},
                                            {1, 2, kInfinity},
                                            {1, kInfinity},
                                            {1, 2, 3, 4, 5, 6},
                                            {kInfinity, kInfinity}})
    EXPECT_EQ(median_of(values), statistics::median(std::span<const double>(values)));
}

TEST(Weighted, WhatHasMoreThanHalfOfTheWeightIsTheMedian) {
  EXPECT_EQ(statistics::weighted_median({{1, 1}, {2, 1}, {9, 3}}), 9);
  EXPECT_EQ(statistics::weighted_median({{9, 3}, {1, 1}, {2, 2}}), 5.5) << "exactly half lies up to 2";
  EXPECT_DOUBLE_EQ(statistics::weighted_mean({{1, 1}, {3, 3}}), 2.5);
}

TEST(Weighted, IntervalsResampleWholeClusters) {
  // Ten clusters of one value each: the exact bootstrap ends at the second, or between it and the third.
  std::vector<std::vector<statistics::WeightedValue>> clusters;
  for (int i = 1; i <= 10; ++i) clusters.push_back({{static_cast<double>(i), 0.1}});
  const auto interval = statistics::weighted_median_interval(clusters);
  ASSERT_TRUE(interval);
  EXPECT_NEAR(interval->low, 2.5, 0.5);
  EXPECT_NEAR(interval->high, 8.5, 0.5);
  // More values of the same clusters say no more.
  for (auto& cluster : clusters) cluster = {{cluster[0].value, 0.05}, {cluster[0].value, 0.05}};
  EXPECT_EQ(statistics::weighted_median_interval(clusters)->low, interval->low);
  // The standard error of 0.4, 0.6 and 0.5 is 0.1 / sqrt(3).
  const auto mean = statistics::weighted_mean_interval({{{0.4, 2}}, {{0.6, 2}}, {{0.5, 2}}});
  EXPECT_NEAR(mean->high - mean->low, 2 * 4.302653 * 0.1 / std::sqrt(3.0), 1e-4);
  EXPECT_FALSE(statistics::weighted_median_interval({{{1, 1}, {2, 1}}, {}}));
  EXPECT_FALSE(statistics::weighted_mean_interval({}));
}

TEST(Statistics, MedianOfDoubles) {
  const std::vector<double> values = {0.5, 0.25, 4};
  EXPECT_EQ(statistics::median(std::span<const double>(values)), 0.5);
}

TEST(Statistics, OneOutlierMovesTheMeanOnly) {
  const Times values = {10, 11, 12, 13, 1000000};
  EXPECT_EQ(statistics::median(values), 12);
  EXPECT_EQ(statistics::median_absolute_deviation(values), 1);  // deviations 2 1 0 1 999988
  EXPECT_EQ(statistics::describe(values).mean, 200009.2);
}

TEST(Statistics, QuantilesInterpolateBetweenOrderStatistics) {
  const std::vector<double> values = {40, 10, 30, 20};
  EXPECT_EQ(statistics::quantile(values, 0), 10);
  EXPECT_EQ(statistics::quantile(values, 1), 40);
  EXPECT_EQ(statistics::quantile(values, 0.5), 25);
  EXPECT_EQ(statistics::quantile(values, 0.25), 17.5);  // position 0.75
  EXPECT_EQ(statistics::quantile(values, 0.75), 32.5);  // position 2.25
}

TEST(Statistics, QuantileOutsideZeroToOneIsRefused) {
  const std::vector<double> values = {1, 2};
  EXPECT_THROW(statistics::quantile(values, -0.1), std::invalid_argument);
  EXPECT_THROW(statistics::quantile(values, 1.1), std::invalid_argument);
  EXPECT_THROW(statistics::quantile(values, std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

TEST(Statistics, MeanAndStandardDeviationOfDoubles) {
  const std::vector<double> values = {0.5, 1.5, 4};
  EXPECT_DOUBLE_EQ(statistics::mean(std::span<const double>(values)), 2);
  EXPECT_DOUBLE_EQ(statistics::standard_deviation(std::span<const double>(values)).value(), std::sqrt(3.25));
}

TEST(Statistics, OneValueHasNoStandardDeviation) {
  const statistics::Statistics one = statistics::describe(Times{7});
  EXPECT_EQ(one.count, 1U);
  EXPECT_EQ(one.median, 7);
  EXPECT_EQ(one.mad, 0);
  EXPECT_EQ(one.minimum, 7);
  EXPECT_EQ(one.maximum, 7);
  EXPECT_EQ(one.mean, 7);
  EXPECT_FALSE(one.standard_deviation.has_value());
}

TEST(Statistics, DescribeHasAllOfThem) {
  const statistics::Statistics all = statistics::describe(Times{3, 1, 2, 10});
  EXPECT_EQ(all.count, 4U);
  EXPECT_EQ(all.median, 2.5);
  EXPECT_EQ(all.mad, 1);  // deviations 0.5 1.5 0.5 7.5
  EXPECT_EQ(all.minimum, 1);
  EXPECT_EQ(all.maximum, 10);
  EXPECT_EQ(all.mean, 4);
  EXPECT_DOUBLE_EQ(all.standard_deviation.value(), std::sqrt(50.0 / 3.0));  // 1 9 4 36
}

TEST(Statistics, LargeTimesKeepEveryNanosecond) {
  const std::int64_t day = 86'400'000'000'000;
  EXPECT_EQ(statistics::median(Times{day, day + 1, day + 2}), static_cast<double>(day + 1));
  EXPECT_EQ(*statistics::describe(Times{day, day + 2}).standard_deviation, std::sqrt(2.0));
}

TEST(Statistics, NothingHasNoStatistic) {
  const Times no_times;
  EXPECT_THROW(statistics::median(no_times), std::invalid_argument);
  EXPECT_THROW(statistics::median_absolute_deviation(no_times), std::invalid_argument);
  EXPECT_THROW(statistics::describe(no_times), std::invalid_argument);
  const std::vector<double> none;
  EXPECT_THROW(statistics::quantile(none, 0.5), std::invalid_argument);
  EXPECT_THROW(statistics::mean(none), std::invalid_argument);
  EXPECT_THROW(statistics::standard_deviation(none), std::invalid_argument);
}

TEST(Holm, ByHand) {
  const std::vector<double> p = {0.01, 0.04, 0.03, 0.005};
  // 4 * 0.005, 3 * 0.01, 2 * 0.03, and 0.04 is held up to the one before.
  const std::vector<double> expected = {0.03, 0.06, 0.06, 0.02};
  const std::vector<double> adjusted = statistics::holm_adjusted(p);
  ASSERT_EQ(adjusted.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_DOUBLE_EQ(adjusted[i], expected[i]);
  EXPECT_TRUE(statistics::holm_adjusted({}).empty());
  EXPECT_EQ(statistics::holm_adjusted(std::vector<double>{0.7, 0.8}), (std::vector<double>{1, 1}));
}

}  // namespace
}  // namespace hullbench::testing
