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

/// Maps a number to a whole number, keeping the order. It must not be NaN.
inline std::uint64_t order_of(double value) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits ^ ((bits & kSign) != 0 ? ~std::uint64_t{0} : kSign);
}

/// The number whose order_of() is `order`.
inline double value_of(std::uint64_t order) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  return std::bit_cast<double>(order ^ ((order & kSign) == 0 ? ~std::uint64_t{0} : kSign));
}

/// Sorts values into cells to find single ones by rank. Unlike in a sort, no branch depends on a value.
class Ranking {
 public:
  /// Needs at least one value, none of them NaN.
  explicit Ranking(std::span<const double> values) : of_many_(values.size() <= kFew ? 0 : values.size()) {
    std::uint64_t* const orders = of_many_.empty() ? of_few_.data() : of_many_.data();
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      orders[i] = order_of(values[i]);
      least_ = std::min(least_, orders[i]);
      most = std::max(most, orders[i]);
    }
    orders_ = {orders, values.size()};
    const auto width = static_cast<unsigned>(std::bit_width(most - least_));
    shift_ = width > kCellBits ? width - kCellBits : 0;
    for (const std::uint64_t order : orders_) ++counts_[cell_of(order)];
  }
  Ranking(const Ranking&) = delete;
  Ranking& operator=(const Ranking&) = delete;
  ~Ranking() = default;

  /// The value at `place` in ascending order; none if its cell holds too many values.
  std::optional<double> at(std::size_t place) const {
    constexpr std::size_t kMostInACell = 64;
    std::size_t cell = 0;
    std::size_t below = 0;  // in the cells before
    while (below + counts_[cell] <= place) below += counts_[cell++];
    if (counts_[cell] > kMostInACell) return std::nullopt;
    std::array<std::uint64_t, kMostInACell + 1> found{};  // one more, which is written in vain
    std::size_t count = 0;
    for (const std::uint64_t order : orders_) {
      found[count] = order;
      count += cell_of(order) == cell ? 1U : 0U;
    }
    const auto middle = found.begin() + static_cast<std::ptrdiff_t>(place - below);
    std::nth_element(found.begin(), middle, found.begin() + static_cast<std::ptrdiff_t>(count));
    return value_of(*middle);
  }

 private:
  static constexpr unsigned kCellBits = 7;
  static constexpr std::size_t kFew = 512;

  std::size_t cell_of(std::uint64_t order) const { return (order - least_) >> shift_; }

  std::array<std::uint64_t, kFew> of_few_;
  std::vector<std::uint64_t> of_many_;
  std::span<const std::uint64_t> orders_;  ///< of the values, in one of these
  std::uint64_t least_ = std::numeric_limits<std::uint64_t>::max();
  unsigned shift_ = 0;
  std::array<std::uint32_t, std::size_t{1} << kCellBits> counts_{};
};

/// The value at `place` of `values` in ascending order; it may reorder them.
inline double value_at(std::vector<double>& values, std::size_t place) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The place of a quantile of so many values, at least one, in ascending order.
inline std::size_t place_of(double quantile, std::size_t values) {
  return std::min(values - 1, static_cast<std::size_t>(quantile * static_cast<double>(values)));
}

/// The value at `quantile` of `values`, which it may reorder. Needs at least one value, none of them NaN.
inline double quantile_of(std::vector<double>& values, double quantile) {
  const std::size_t place = place_of(quantile, values.size());
  constexpr std::size_t kFew = 24;  // below, cells cost more than they save
  if (values.size() >= kFew) {
    if (const std::optional<double> value = Ranking(values).at(place)) return *value;
  }
  return value_at(values, place);
}

/// An estimate of a standard deviation from the 0.9 quantile of the distances to the middle, as if the values
/// were normal.
struct RobustDeviation {
  static constexpr double kQuantile = 0.9;
  static constexpr double kOfNormal = 1.645;  ///< that quantile of |x|
};

/// The robust deviation of `values` from `middle`. Changes `values`. Needs at least one.
inline double robust_deviation(std::vector<double>& values, double middle) {
  for (double& value : values) value = std::abs(value - middle);
  return quantile_of(values, RobustDeviation::kQuantile) / RobustDeviation::kOfNormal;
}

}  // namespace polylidar::detail
