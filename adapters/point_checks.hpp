// What an adapter must know about its input before it can judge the library's answer.
#pragma once

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "polylidar/geometry.hpp"
#include "polylidar/predicates.hpp"

namespace hullbench {

/// Throws std::invalid_argument naming the first point that is NaN or infinite.
inline void require_finite(std::span<const polylidar::Point> points) {
  for (std::size_t index = 0; index < points.size(); ++index) {
    if (!std::isfinite(points[index].x) || !std::isfinite(points[index].y)) {
      throw std::invalid_argument("point " + std::to_string(index) + " is not finite");
    }
  }
}

/// Whether some three of the points are not on one line, so that a hull with an area exists. Exact; O(n) at
/// worst.
inline bool span_an_area(std::span<const polylidar::Point> points) {
  std::size_t second = 1;
  while (second < points.size() && points[second] == points[0]) ++second;
  for (std::size_t third = second + 1; third < points.size(); ++third) {
    if (polylidar::orient2d(points[0], points[second], points[third]) != 0) return true;
  }
  return false;
}

}  // namespace hullbench
