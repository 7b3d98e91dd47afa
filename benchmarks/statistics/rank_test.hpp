// Whether one list of times is faster than another, and by how much, without assuming how times are
// distributed.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::statistics {

/// Times of b over times of a.
struct RatioOfTimes {
  double ratio = 0;  ///< median of all ratios of a time of b to a time of a (Hodges and Lehmann 1963)
  /// The ratios that the test below does not reject at 5 % (Moses 1965). None when there are too few values
  /// to reject any: four on both sides are enough, three on both are not.
  std::optional<Interval> interval;
  /// Two-sided, of the rank test of Mann and Whitney (1947), in (0, 1]: how often lists that do not differ
  /// would lie as far apart. Exact for up to 20 values a side, by the normal approximation above. Equal
  /// values count for no difference. Below 0.05 exactly when the interval does not hold 1.
  double p_value = 1;
};

/// Both lists need at least one value (else std::invalid_argument). None when a time is not positive.
std::optional<RatioOfTimes> ratio_of_times(std::span<const std::int64_t> a, std::span<const std::int64_t> b);

}  // namespace hullbench::statistics
