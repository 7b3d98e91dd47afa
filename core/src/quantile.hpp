// Quantiles of numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace polylidar::detail {

/// The value at `quantile` of `values`, which it reorders; there is one.
inline double quantile_of(std::vector<double>& values, double quantile) {
  const auto place =
      std::min(values.size() - 1, static_cast<std::size_t>(quantile * static_cast<double>(values.size())));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What would be the standard deviation of normal `values`, from the 0.9 quantile of their distances to
/// `middle`; it changes them. There is one.
inline double robust_deviation(std::vector<double>& values, double middle) {
  constexpr double kQuantile = 0.9;
  constexpr double kOfNormal = 1.645;  // that quantile of |x|
  for (double& value : values) value = std::abs(value - middle);
  return quantile_of(values, kQuantile) / kOfNormal;
}

}  // namespace polylidar::detail
