// The cells of a logarithmic scale for sizes.
#pragma once

#include <bit>
#include <cstdint>

namespace polylidar::detail {

// An octave of lengths has 16 cells, so one of their fourth powers has four: by the first two bits of these
// numbers' fractions. No logarithm is taken.
constexpr unsigned kBitsBelowCells = 50;

/// The number of the cell of a fourth power, which is not negative; the next larger cell has the next number.
constexpr std::int64_t log_cell(double length4) {
  return std::bit_cast<std::int64_t>(length4) >> kBitsBelowCells;
}

/// The fourth power at which the cell begins.
constexpr double log_cell_begin(std::int64_t cell) {
  return std::bit_cast<double>(cell << kBitsBelowCells);
}

// The median of what is counted is so many units, as fourth powers: if all have one size, as in a lattice, it
// lies within a cell and not where one ends.
constexpr double kInCell = 1.1;

}  // namespace polylidar::detail
