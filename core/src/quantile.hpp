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
  const auto bits = std::bit_cast<std::int64_t>(value);
  return static_cast<std::uint64_t>(bits) ^ (static_cast<std::uint64_t>(bits >> 63) | kSign);
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
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::uint64_t order = order_of(values[i]);
      orders[i] = order;
      least = std::min(least, order);
      most = std::max(most, order);
    }
    orders_ = {orders, values.size()};
    least_ = least;
    const auto width = static_cast<unsigned>(std::bit_width(most - least));
    shift_ = width > kCellBits ? width - kCellBits : 0;
    for (const std::uint64_t order : orders_) ++counts_[cell_of(order)];
  }
  Ranking(const Ranking&) = delete;
  Ranking& operator=(const Ranking&) = delete;
  ~Ranking() = default;

  /// The values at these places in ascending order; none of them if the cell of one holds too many values.
  template <std::size_t kPlaces>
  std::array<std::optional<double>, kPlaces> at(const std::array<std::size_t, kPlaces>& places) const {
    constexpr std::size_t kMostInACell = 64;
    struct Place {
      std::size_t cell = 0;
      std::size_t below = 0;  ///< in the cells before
      std::uint64_t* next = nullptr;
      std::array<std::uint64_t, kMostInACell + 1> found;  ///< one more, which is written in vain
    };
    std::array<Place, kPlaces> asked;
    for (std::size_t p = 0; p < kPlaces; ++p) {
      Place& one = asked[p];
      while (one.below + counts_[one.cell] <= places[p]) one.below += counts_[one.cell++];
      one.next = one.found.data();
      if (counts_[one.cell] > kMostInACell) return {};
    }
    for (const std::uint64_t order : orders_) {
      const std::size_t cell = cell_of(order);
      for (Place& one : asked) {
        *one.next = order;
        one.next += cell == one.cell ? 1 : 0;
      }
    }
    std::array<std::optional<double>, kPlaces> values;
    for (std::size_t p = 0; p < kPlaces; ++p) {
      std::uint64_t* const middle = &asked[p].found[places[p] - asked[p].below];
      std::nth_element(asked[p].found.data(), middle, asked[p].next);
      values[p] = value_of(*middle);
    }
    return values;
  }

 private:
  static constexpr unsigned kCellBits = 7;
  static constexpr std::size_t kFew = 512;

  std::size_t cell_of(std::uint64_t order) const { return (order - least_) >> shift_; }

  std::array<std::uint64_t, kFew> of_few_;
  std::vector<std::uint64_t> of_many_;
  std::span<const std::uint64_t> orders_;  ///< of the values, in one of these
  std::uint64_t least_ = 0;
  unsigned shift_ = 0;
  std::array<std::uint32_t, std::size_t{1} << kCellBits> counts_{};
};

/// The value at `place` of `values` in ascending order; it may reorder them.
inline double value_at(std::span<double> values, std::size_t place) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The place of a quantile of so many values, at least one, in ascending order.
inline std::size_t place_of(double quantile, std::size_t values) {
  return std::min(values - 1, static_cast<std::size_t>(quantile * static_cast<double>(values)));
}

/// The value at `quantile` of `values`, which it may reorder. Needs at least one value, none of them NaN.
inline double quantile_of(std::span<double> values, double quantile) {
  const std::size_t place = place_of(quantile, values.size());
  constexpr std::size_t kFew = 24;  // below, cells cost more than they save
  if (values.size() >= kFew) {
    const auto [value] = Ranking(values).at(std::array{place});
    if (value) return *value;
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
