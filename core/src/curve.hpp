// The space-filling curve along which points are sorted.
#pragma once

#include <cstdint>
#include <span>

#include "polylidar/geometry.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Morton keys of the cells of a square grid over a box: x in the odd bits, y in the even ones. Subtraction
/// and multiplication round monotonically, so if two points lie in different columns (or rows), the cells
/// have the order of the coordinates.
class Curve {
 public:
  /// A few cells for each of `points` points: enough to separate most of them, few enough to sort by few
  /// digits.
  Curve(const Box& box, std::size_t points);

  std::uint32_t key(const Point& p) const {
    const auto column = static_cast<std::uint32_t>((p.x - minimum_.x) * cells_per_length_);
    const auto row = static_cast<std::uint32_t>((p.y - minimum_.y) * cells_per_length_);
    return (spread_bits(column) << 1U) | spread_bits(row);
  }
  int key_bits() const { return key_bits_; }

 private:
  /// The bits of `value`, at most 16 of them, at the even places.
  static std::uint32_t spread_bits(std::uint32_t value) {
    value = (value | (value << 8U)) & 0x00FF00FFU;
    value = (value | (value << 4U)) & 0x0F0F0F0FU;
    value = (value | (value << 2U)) & 0x33333333U;
    value = (value | (value << 1U)) & 0x55555555U;
    return value;
  }

  Point minimum_;
  double cells_per_length_;
  int key_bits_;
};

/// A point's key in the upper 32 bits, its index in the lower ones.
using CurveEntry = std::uint64_t;

/// Writes the entries of `points` by ascending key, then by index, to `entries` or to `spare`, and returns a
/// pointer to them. Both have room for one entry for each point.
CurveEntry* sort_along(const Curve& curve, std::span<const Point> points, CurveEntry* entries,
                       CurveEntry* spare, ThreadPool& pool);

}  // namespace polylidar::detail
