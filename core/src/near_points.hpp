// Finds the few points near one place, among many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "kernels.hpp"
#include "polylidar/geometry.hpp"
#include "vector.hpp"

namespace polylidar::detail {

/// So many points are looked at together.
inline constexpr std::size_t kNearBlock = 32;

/// The first number from `begin` on, a whole number of blocks farther, of a block with a point nearer to
/// `centre` than the root of `squared_radius`; points.size() or more if there is none. A block that is not
/// whole counts.
std::size_t next_block_near(std::span<const Point> points, std::size_t begin, const Point& centre,
                            double squared_radius, Kernel kernel = best_kernel());

/// Calls visit(number, squared distance) for the points nearer to `centre` than the root of `squared_radius`,
/// in their order.
template <class Visit>
void for_each_near(std::span<const Point> points, const Point& centre, double squared_radius,
                   const Visit& visit, Kernel kernel = best_kernel()) {
  for (std::size_t begin = 0;; begin += kNearBlock) {
    begin = next_block_near(points, begin, centre, squared_radius, kernel);
    if (begin >= points.size()) return;
    const std::size_t end = std::min(begin + kNearBlock, points.size());
    for (std::size_t i = begin; i < end; ++i) {
      const double squared_distance = squared_length(points[i] - centre);
      if (squared_distance < squared_radius) visit(i, squared_distance);
    }
  }
}

}  // namespace polylidar::detail
