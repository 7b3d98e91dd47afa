// What "faster", "slower", "met" and "undecided" mean, for all that compares: an interval is on one side of a
// limit, or nothing is said.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::statistics {

/// On which side of a limit a quantity lies.
enum class Side {
  kBelow,     ///< its whole interval, which may end at the limit
  kAbove,     ///< likewise
  kUndecided  ///< the interval holds the limit, or too many questions were asked at once
};

/// What is known of one quantity, such as a ratio of times.
struct Evidence {
  Interval interval;  ///< of the quantity
  /// Of the test that it is on the side where the interval is, in [0, 1]; 0 where the interval says it all.
  double p_value = 0;
};

/// One quantity, judged.
struct Judgement {
  Side side = Side::kUndecided;
  double p_value = 1;  ///< after Holm's correction over all that were judged together
};

/// The side of a single interval. An interval that is the limit alone is below it.
Side side_of(const Interval& interval, double limit);

/// With too few repetitions for an interval a time is called longer or shorter only if every repetition is so
/// many times as long or short. No repetition of a row of the reference run of 0.2.0 took ten times as long
/// as another one (at most 9.3 times, of 2062 rows).
inline constexpr double kBeyondNoise = 10;

/// Where the ratio of `times` to `others` lies beside 1, by the interval of ratio_of_times (rank_test.hpp),
/// or without one by kBeyondNoise. Both need a value. Undecided when the interval holds 1, be it as its end,
/// and when a time is not positive.
Side side_of_times(std::span<const std::int64_t> times, std::span<const std::int64_t> others);

/// Judges quantities together: each is on the side of its interval when its p-value, after Holm's correction
/// over all of them, is at most `level`. In the order of `evidence`.
std::vector<Judgement> judge(std::span<const Evidence> evidence, double limit, double level);

}  // namespace hullbench::statistics
