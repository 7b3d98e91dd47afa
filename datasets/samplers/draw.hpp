// What several samplers do: single random points, and shares of a number.
#pragma once

#include <cmath>
#include <cstddef>

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// `percent` of `n`, rounded to a whole number.
inline std::size_t share(std::size_t n, double percent) {
  return static_cast<std::size_t>(std::round(static_cast<double>(n) * percent / 100));
}

/// `box` with `margin` more on every side.
inline polylidar::Box grown(const polylidar::Box& box, double margin) {
  return {{box.min.x - margin, box.min.y - margin}, {box.max.x + margin, box.max.y + margin}};
}

/// x is drawn before y, here and below.
inline polylidar::Point uniform_in(const polylidar::Box& box, Random& random) {
  const double x = random.between(box.min.x, box.max.x);
  const double y = random.between(box.min.y, box.max.y);
  return {x, y};
}

inline polylidar::Point moved_by_gaussian(const polylidar::Point& point, double deviation, Random& random) {
  const double x = point.x + deviation * random.normal();
  const double y = point.y + deviation * random.normal();
  return {x, y};
}

}  // namespace hullbench
