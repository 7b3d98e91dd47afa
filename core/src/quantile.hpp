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
#include <utility>
#include <vector>

namespace polylidar::detail {

/// Sorts values into cells to find single ones by rank. Unlike in a sort, no branch depends on a value.
class Ranking {
 public:
  /// Needs at least one value, none of them NaN. They must outlive this object.
  explicit Ranking(std::span<const double> values)
      : values_(values), of_many_(values.size() <= kFew ? 0 : values.size()) {
    std::uint32_t* const keys = of_many_.empty() ? of_few_.data() : of_many_.data();
    std::int32_t least = std::numeric_limits<std::int32_t>::max();
    std::int32_t most = std::numeric_limits<std::int32_t>::min();
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::int32_t key = key_of(values[i]);
      keys[i] = static_cast<std::uint32_t>(key);
      least = std::min(least, key);
      most = std::max(most, key);
    }
    const auto first = static_cast<std::uint32_t>(least);
    const auto width = static_cast<unsigned>(std::bit_width(static_cast<std::uint32_t>(most) - first));
    const unsigned shift = width > kCellBits ? width - kCellBits : 0;
    const auto count = static_cast<std::uint32_t>(values.size());  // in a register, whatever is written
    for (std::uint32_t i = 0; i < count; ++i) {
      Cell& cell = cells_[(keys[i] - first) >> shift];
      ++cell.count;
      keys[i] = std::exchange(cell.last, i);
    }
    before_ = keys;
  }
  Ranking(const Ranking&) = delete;
  Ranking& operator=(const Ranking&) = delete;
  ~Ranking() = default;

  /// The value of this rank, from 0 and below their number, in ascending order; none if its cell holds too
  /// many values.
  std::optional<double> at(std::size_t rank) const {
    constexpr std::size_t kMostInACell = 64;
    const Cell* cell = cells_.data();
    for (; rank >= cell->count; ++cell) rank -= cell->count;  // down to that within its cell
    if (cell->count > kMostInACell) return {};
    std::array<double, kMostInACell> found;
    std::uint32_t i = cell->last;
    for (std::size_t k = 0; k < cell->count; ++k, i = before_[i]) found[k] = values_[i];
    std::nth_element(found.data(), &found[rank], found.data() + cell->count);
    return found[rank];
  }

 private:
  static constexpr unsigned kCellBits = 7;
  static constexpr std::size_t kFew = 512;

  struct Cell {
    std::uint32_t count = 0;
    std::uint32_t last = 0;  ///< which value
  };

  /// The first half of a number's bits, in the order of the numbers.
  static std::int32_t key_of(double value) {
    const auto bits = static_cast<std::int32_t>(std::bit_cast<std::int64_t>(value) >> 32);
    return bits ^ ((bits >> 31) & std::numeric_limits<std::int32_t>::max());
  }

  std::span<const double> values_;
  std::array<std::uint32_t, kFew> of_few_;
  std::vector<std::uint32_t> of_many_;
  const std::uint32_t* before_;  ///< value -> the one before it in its cell; in one of these
  std::array<Cell, std::size_t{1} << kCellBits> cells_{};
};

/// The value of this rank among `values` in ascending order, from 0; it may reorder them.
inline double value_of_rank(std::span<double> values, std::size_t rank) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The rank of a quantile among so many values, at least one, in ascending order, from 0.
inline std::size_t rank_of(double quantile, std::size_t values) {
  return std::min(values - 1, static_cast<std::size_t>(quantile * static_cast<double>(values)));
}

/// The value at `quantile` of `values`, which it may reorder. Needs at least one value, none of them NaN.
inline double quantile_of(std::span<double> values, double quantile) {
  const std::size_t rank = rank_of(quantile, values.size());
  constexpr std::size_t kFew = 24;  // below, cells cost more than they save
  if (values.size() >= kFew) {
    if (const std::optional<double> value = Ranking(values).at(rank)) return *value;
  }
  return value_of_rank(values, rank);
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
