// The statistics of the gate against values worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "benchmarks/statistics/sign_test.hpp"

namespace hullbench {
namespace {

using Values = std::vector<double>;

/// 1, 2, ..., n.
Values first(int n) {
  Values values;
  for (int i = n; i >= 1; --i) values.push_back(i);
  return values;
}

TEST(GateStatistics, TooFewValuesHaveNoInterval) {
  // Of 5 values the widest pair covers 1 - 2/32 = 0.9375 only.
  for (const int n : {0, 1, 5}) {
    const statistics::Interval interval = statistics::sign_interval(first(n), 0.95);
    EXPECT_EQ(interval.low, -std::numeric_limits<double>::infinity()) << n;
    EXPECT_EQ(interval.high, std::numeric_limits<double>::infinity()) << n;
  }
}

TEST(GateStatistics, SixValuesHaveTheirRange) {
  // Covers 1 - 2/64 = 0.96875; the next pair 1 - 2 * 7/64 = 0.78125.
  const statistics::Interval interval = statistics::sign_interval(first(6), 0.95);
  EXPECT_EQ(interval.low, 1);
  EXPECT_EQ(interval.high, 6);
  EXPECT_EQ(statistics::sign_interval(first(6), 0.78).low, 2);
  EXPECT_EQ(statistics::sign_interval(first(6), 0.79).low, 1);
}

TEST(GateStatistics, TwentyValuesHaveTheSixthFromEitherEnd) {
  // At most 5 of 20 coins: (1 + 20 + 190 + 1140 + 4845 + 15504) / 2^20 = 0.0207; at most 6: 0.0577.
  const statistics::Interval interval = statistics::sign_interval(first(20), 0.95);
  EXPECT_EQ(interval.low, 6);
  EXPECT_EQ(interval.high, 15);
}

TEST(GateStatistics, AnOutlierMovesNoInterval) {
  Values values = first(20);
  values.front() = 1e9;
  EXPECT_EQ(statistics::sign_interval(values, 0.95).high, 15);
}

TEST(GateStatistics, AConfidenceLiesBetweenZeroAndOne) {
  for (const double confidence : {0.0, 1.0, -1.0, std::nan("")}) {
    EXPECT_THROW(statistics::sign_interval(first(6), confidence), std::invalid_argument) << confidence;
  }
}

TEST(GateStatistics, SignTestCountsWhatIsAbove) {
  EXPECT_EQ(statistics::sign_test_above(Values{1, 2, 3, 4}, 0), 1.0 / 16);
  EXPECT_EQ(statistics::sign_test_above(Values{-1, 2, 3, 4}, 0), 5.0 / 16);
  EXPECT_EQ(statistics::sign_test_above(Values{-1, -2, 3, 4}, 0), 11.0 / 16);
  EXPECT_EQ(statistics::sign_test_above(Values{-1, -2, -3, -4}, 0), 1);
}

TEST(GateStatistics, SignTestIsAgainstTheThreshold) {
  EXPECT_EQ(statistics::sign_test_above(Values{1, 2, 3, 4}, 1.5), 5.0 / 16);
}

TEST(GateStatistics, SignTestLeavesOutTies) {
  EXPECT_EQ(statistics::sign_test_above(Values{0, 0, 1, 2}, 0), 1.0 / 4);
  EXPECT_EQ(statistics::sign_test_above(Values{0, 0}, 0), 1);
  EXPECT_EQ(statistics::sign_test_above(Values{}, 0), 1);
}

TEST(GateStatistics, ThousandsOfValuesDoNotUnderflow) {
  // 2^-2000 is no double. Half of 2000 below or more: by symmetry (1 + P(exactly half)) / 2, and P(exactly
  // half) is 1 / sqrt(pi * 1000) * (1 - 1/8000 + ...) by Stirling, whose next term is below 1e-8.
  Values values(2000, 1.0);
  std::fill_n(values.begin(), 1000, -1.0);
  const double half = (1 - 1.0 / 8000) / std::sqrt(std::acos(-1.0) * 1000);
  EXPECT_NEAR(statistics::sign_test_above(values, 0), (1 + half) / 2, 1e-8);
  // The normal approximation has its 2.5 % at 1000 - 1.96 * sqrt(500) = 956.2 of 2000, good to one here.
  EXPECT_NEAR(statistics::sign_interval(first(2000), 0.95).low, 956.2, 1);
}

}  // namespace
}  // namespace hullbench
