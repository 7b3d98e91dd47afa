// Descriptive statistics of repeated times, and the correction for many tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::statistics {

/// Of a list of times, all in the unit of the times (nanoseconds).
struct Statistics {
  std::size_t count = 0;
  double median = 0;
  std::optional<Interval> median_interval;  ///< of 95 %, see bootstrap.hpp; empty for a single value
  double mad = 0;                           ///< median absolute deviation from the median, not scaled
  std::int64_t minimum = 0;
  std::int64_t maximum = 0;
  double mean = 0;
  std::optional<double> standard_deviation;  ///< with n - 1; empty for a single value
};

// Every function below needs at least one value and throws std::invalid_argument without.

/// The `q`-quantile, 0 <= q <= 1 (else std::invalid_argument), by linear interpolation between the order
/// statistics at q * (n - 1) (type 7 of Hyndman and Fan 1996, the default of R and NumPy).
double quantile(std::span<const double> values, double q);

/// The middle value, or the mean of the two middle ones.
double median(std::span<const std::int64_t> values);
double median(std::span<const double> values);

/// Median of |value - median|, without the factor that makes it estimate a normal distribution's sigma.
double median_absolute_deviation(std::span<const std::int64_t> values);

double mean(std::span<const double> values);

/// With n - 1 in the denominator; empty for a single value.
std::optional<double> standard_deviation(std::span<const double> values);

/// All of the first ones.
Statistics describe(std::span<const std::int64_t> values);

/// Holm's adjusted p-values (Scandinavian Journal of Statistics 6, 1979), in the order of `p_values`: those
/// at most a are significant with a probability of at most a for any error among them all. For none: none.
std::vector<double> holm_adjusted(std::span<const double> p_values);

}  // namespace hullbench::statistics
