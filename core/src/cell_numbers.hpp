// The numbers of the cells in which points lie.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernels.hpp"
#include "polylidar/geometry.hpp"

namespace polylidar::detail {

/// Numbers the cells of a square grid row by row. Points must not lie below or to the left of its beginning,
/// and their columns and rows must be below 2^31; numbers are taken modulo what `Number` holds.
template <class Number>
struct Numbering {
  Point minimum;  ///< where the grid begins
  double cells_per_length;
  std::uint32_t cells_in_row;  ///< from a cell to the one above it
  Number first;                ///< the number of the cell at the beginning

  /// A point's coordinates in cells.
  double column(const Point& p) const { return (p.x - minimum.x) * cells_per_length; }
  double row(const Point& p) const { return (p.y - minimum.y) * cells_per_length; }
  Number of(const Point& p) const {
    const auto whole = [](double u) -> Number {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(u));
    };
    return whole(row(p)) * cells_in_row + first + whole(column(p));
  }
};
using CellNumbering = Numbering<std::uint32_t>;
/// Of grids with any number of cells.
using WideNumbering = Numbering<std::uint64_t>;

/// Puts the number of each point's cell into `numbers`, which has room for them.
void number_cells(std::span<const Point> points, const CellNumbering& numbering, std::uint32_t* numbers,
                  Kernel kernel = best_kernel());
void number_cells(std::span<const Point> points, const WideNumbering& numbering, std::uint64_t* numbers,
                  Kernel kernel = best_kernel());

/// Whether a coordinate in cells is so near the border between two columns or rows that rounding might put it
/// beyond. The side where the grid begins is no border.
inline bool is_near_border(double u) {
  constexpr double kNear = 0x1p-28;  // beyond Grid::kSlack
  const double part = u - static_cast<double>(static_cast<std::int32_t>(u));
  return ((u > 0.5) & ((part < kNear) | (part >= 1 - kNear))) != 0;  // without branches
}

/// Whether any of the points has such a coordinate.
bool any_near_border(std::span<const Point> points, const CellNumbering& numbering,
                     Kernel kernel = best_kernel());

/// Has the processor fetch the points while it does something else.
inline void prefetch(std::span<const Point> points) {
  constexpr std::size_t kInCacheLine = 64 / sizeof(Point);
  for (std::size_t i = 0; i < points.size(); i += kInCacheLine) __builtin_prefetch(&points[i]);
}

/// So many points get their numbers at once.
inline constexpr std::size_t kNumberedAtOnce = 128;

/// Puts the number of each point's cell into `numbers`, block by block, and calls visit(begin, end) for the
/// points of each block.
template <class Visit>
void number_in_blocks(std::span<const Point> points, const CellNumbering& numbering, std::uint32_t* numbers,
                      const Visit& visit) {
  constexpr std::size_t kBlock = kNumberedAtOnce;
  for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, points.size());
    number_cells(points.subspan(begin, end - begin), numbering, numbers + begin);
    prefetch(points.subspan(end, std::min(kBlock, points.size() - end)));
    visit(begin, end);
  }
}

/// Calls visit(begin, block, numbers) for blocks of consecutive points in their order: the first of them is
/// points[begin], and block[i] lies in the cell numbers[i].
template <class Number, class Visit>
void visit_numbered(std::span<const Point> points, const Numbering<Number>& numbering, const Visit& visit) {
  constexpr std::size_t kBlock = kNumberedAtOnce;
  std::array<Number, kBlock> numbers;
  for (std::size_t begin = 0; begin < points.size(); begin += kBlock) {
    const std::span<const Point> block = points.subspan(begin, std::min(kBlock, points.size() - begin));
    number_cells(block, numbering, numbers.data());
    prefetch(points.subspan(begin + block.size(), std::min(kBlock, points.size() - begin - block.size())));
    visit(begin, block, numbers.data());
  }
}

}  // namespace polylidar::detail
