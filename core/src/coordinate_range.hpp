// The coordinates of a point set: their range, their scaling, and whether they lie on a lattice.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

#include "kernels.hpp"
#include "polylidar/geometry.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

struct CoordinateRange {
  Box box;
  /// Coordinates are multiplied by 2 to this power, so that the predicates can handle them; 0 unless they are
  /// extremely large or small.
  int scale_exponent = 0;
  /// The largest power of two of which all coordinates are multiples; 0 if it is too small to matter or if
  /// coordinates are scaled.
  double unit = 0;
};

/// What to throw for the point of this number, from 0.
std::invalid_argument point_not_finite(std::uint64_t number);

/// Needs at least one point. Throws std::invalid_argument if a coordinate is not finite or coordinates span
/// more than the supported range (see Extractor).
CoordinateRange measure_coordinates(std::span<const Point> points, ThreadPool& pool,
                                    Kernel kernel = best_kernel());

/// Measures points that come block by block; `unit` is not set.
class RangeOfBlocks {
 public:
  void add(std::span<const Point> block);
  /// The points of `more` follow.
  void add(const RangeOfBlocks& more);
  std::uint64_t count() const { return count_; }
  /// As bounding_box(); of no meaning where not_finite() is set.
  const Box& box() const { return box_; }
  /// The number of the first point that is not finite, from 0.
  const std::optional<std::uint64_t>& not_finite() const { return not_finite_; }
  /// Needs at least one point, and only finite ones. Throws as measure_coordinates.
  CoordinateRange range() const;

 private:
  Box box_ = bounding_box({});
  double largest_ = 0;
  double smallest_ = std::numeric_limits<double>::infinity();
  std::uint64_t count_ = 0;
  std::optional<std::uint64_t> not_finite_;
};

/// Whether all points are finite and in the box, whose corners are finite.
bool are_within(std::span<const Point> points, const Box& box, Kernel kernel = best_kernel());

}  // namespace polylidar::detail
