// Ratios of times, their test and its correction, by hand and against every order there is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "benchmarks/statistics/rank_test.hpp"

namespace hullbench {
namespace {

using Times = std::vector<std::int64_t>;

TEST(RatioOfTimes, IsTheMedianOfAllRatios) {
  // 8/1 8/2 8/4 2/1 2/2 2/4 = 8 4 2 2 1 0.5
  EXPECT_EQ(statistics::ratio_of_times(Times{1, 2, 4}, Times{8, 2})->ratio, 2);
  EXPECT_EQ(statistics::ratio_of_times(Times{4}, Times{6})->ratio, 1.5);
  EXPECT_EQ(statistics::ratio_of_times(Times{1, 2}, Times{6, 9})->ratio, 5.25);  // 3 4.5 6 9
}

TEST(RatioOfTimes, OfListsThatAreApart) {
  const auto apart = statistics::ratio_of_times(Times{10, 11, 12, 13}, Times{20, 21, 22, 23});
  ASSERT_TRUE(apart && apart->interval);
  EXPECT_DOUBLE_EQ(apart->p_value, 2.0 / 70);  // one of 8! / (4! 4!) orders, on either side
  // Only the outermost ratio on each side is rejected at 5 %: with the next ones it is 4 / 70.
  EXPECT_EQ(apart->interval->low, 20.0 / 13);
  EXPECT_EQ(apart->interval->high, 23.0 / 10);
}

TEST(RatioOfTimes, ThreeValuesASideRejectNothing) {
  const auto few = statistics::ratio_of_times(Times{1, 2, 3}, Times{100, 200, 300});
  ASSERT_TRUE(few.has_value());
  EXPECT_FALSE(few->interval.has_value());
  EXPECT_DOUBLE_EQ(few->p_value, 0.1);
}

TEST(RatioOfTimes, TheSameListIsNotApart) {
  const Times times = {10, 12, 11, 14, 13, 10};
  const auto same = statistics::ratio_of_times(times, times);
  ASSERT_TRUE(same && same->interval);
  EXPECT_EQ(same->ratio, 1);
  EXPECT_EQ(same->p_value, 1);
  EXPECT_LT(same->interval->low, 1);
  EXPECT_GT(same->interval->high, 1);
}

TEST(RatioOfTimes, TurnedRoundTurnsTheRatioRound) {
  const Times a = {100, 130, 115, 120, 108};
  const Times b = {90, 95, 117, 80, 99};
  const auto there = statistics::ratio_of_times(a, b);
  const auto back = statistics::ratio_of_times(b, a);
  ASSERT_TRUE(there && back && there->interval && back->interval);
  EXPECT_EQ(there->p_value, back->p_value);
  EXPECT_DOUBLE_EQ(there->ratio, 1 / back->ratio);
  EXPECT_DOUBLE_EQ(there->interval->low, 1 / back->interval->high);
}

TEST(RatioOfTimes, ZeroHasNoRatioAndNothingIsRefused) {
  EXPECT_FALSE(statistics::ratio_of_times(Times{0, 1}, Times{1}).has_value());
  EXPECT_THROW(statistics::ratio_of_times(Times{}, Times{1}), std::invalid_argument);
  EXPECT_THROW(statistics::ratio_of_times(Times{1}, Times{}), std::invalid_argument);
}

/// Of every way to share out 1..n+m: how often it lies at least as far on one of the sides.
double brute_force_p_value(std::size_t n, std::size_t m, std::size_t u) {
  std::vector<int> owner(n + m, 0);
  std::fill(owner.begin() + static_cast<std::ptrdiff_t>(n), owner.end(), 1);
  double all = 0;
  double extreme = 0;
  do {
    std::size_t count = 0;  // pairs with the one of a above the one of b
    for (std::size_t i = 0; i < owner.size(); ++i) {
      if (owner[i] == 0)
        count += static_cast<std::size_t>(
            std::count(owner.begin(), owner.begin() + static_cast<std::ptrdiff_t>(i), 1));
    }
    all += 1;
    if (count <= u) extreme += 1;
  } while (std::next_permutation(owner.begin(), owner.end()));
  return std::min(1.0, 2 * extreme / all);
}

TEST(RatioOfTimes, PValueIsThatOfEveryOrder) {
  // In the k-th case the largest k values of b are smaller than all of a: U = k n.
  for (const auto& [n, m] : {std::pair(4, 5), std::pair(6, 3), std::pair(5, 5)}) {
    for (int k = 0; 2 * k <= m; ++k) {
      Times a;
      Times b;
      for (int i = 0; i < n; ++i) a.push_back(100 + i);
      for (int j = 0; j < m; ++j) b.push_back(j < k ? 10 + j : 1000 + j);
      const double expected = brute_force_p_value(static_cast<std::size_t>(n), static_cast<std::size_t>(m),
                                                  static_cast<std::size_t>(k) * static_cast<std::size_t>(n));
      // The recurrence adds and multiplies fewer than a hundred numbers below 1.
      EXPECT_NEAR(statistics::ratio_of_times(a, b)->p_value, expected, 1e-14) << n << " " << m << " " << k;
    }
  }
}

TEST(RatioOfTimes, IntervalHoldsOneExactlyWhenTheTestDoesNotReject) {
  int rejected = 0;
  for (int shift = 0; shift <= 12; ++shift) {
    Times a;
    Times b;
    for (int i = 0; i < 8; ++i) {
      a.push_back(100 + 3 * i);
      b.push_back(101 + 2 * i + shift);
    }
    const auto ratio = statistics::ratio_of_times(a, b);
    ASSERT_TRUE(ratio && ratio->interval);
    EXPECT_EQ(ratio->p_value<0.05, ratio->interval->low> 1 || ratio->interval->high < 1) << shift;
    if (ratio->p_value < 0.05) ++rejected;
  }
  EXPECT_GT(rejected, 0);
  EXPECT_LT(rejected, 13);
}

TEST(RatioOfTimes, BeyondTwentyValuesTheNormalDistributionTakesOver) {
  Times a(21);
  std::iota(a.begin(), a.end(), 1000);
  Times b = a;
  for (std::int64_t& time : b) time += 8;
  const auto ratio = statistics::ratio_of_times(a, b);
  ASSERT_TRUE(ratio && ratio->interval);
  // scipy.stats.mannwhitneyu(a, b, method="asymptotic") without ties: U = 91, (U + 0.5 - 220.5) / 39.74.
  // The 13 pairs of equal values count for no difference: U = 78 + 13.
  EXPECT_NEAR(ratio->p_value, 0.001174, 0.000001);
}

}  // namespace
}  // namespace hullbench
