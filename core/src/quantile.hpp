// Quantiles of numbers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace polylidar::detail {

/// A whole number for each number, in the order of these; none is to be NaN.
inline std::uint64_t order_of(double value) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits ^ ((bits & kSign) != 0 ? ~std::uint64_t{0} : kSign);
}

/// The value that stands at `place` among `values` in ascending order, by counting them in cells: no branch
/// depends on a value, as those of a sort do. None where too many fall into one cell.
inline std::optional<double> value_at(std::span<const double> values, std::size_t place) {
  constexpr unsigned kCellBits = 7;
  constexpr std::size_t kMostInACell = 64;
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t most = 0;
  for (const double value : values) {
    least = std::min(least, order_of(value));
    most = std::max(most, order_of(value));
  }
  const auto width = static_cast<unsigned>(std::bit_width(most - least));
  const unsigned shift = width > kCellBits ? width - kCellBits : 0;
  const auto cell_of = [&](double value) { return (order_of(value) - least) >> shift; };
  std::array<std::uint32_t, std::size_t{1} << kCellBits> counts{};
  for (const double value : values) ++counts[cell_of(value)];
  std::size_t cell = 0;
  std::size_t below = 0;  // in the cells before
  while (below + counts[cell] <= place) below += counts[cell++];
  if (counts[cell] > kMostInACell) return std::nullopt;
  std::array<double, kMostInACell + 1> found{};  // one more, which is written in vain
  std::size_t count = 0;
  for (const double value : values) {
    found[count] = value;
    count += cell_of(value) == cell ? 1U : 0U;
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(place - below);
  std::nth_element(found.begin(), middle, found.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

/// The value at `quantile` of `values`, which it may reorder; there is one, and none is NaN.
inline double quantile_of(std::vector<double>& values, double quantile) {
  const auto place =
      std::min(values.size() - 1, static_cast<std::size_t>(quantile * static_cast<double>(values.size())));
  constexpr std::size_t kFew = 24;  // below, cells cost more than they save
  if (values.size() >= kFew) {
    if (const std::optional<double> value = value_at(values, place)) return *value;
  }
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
