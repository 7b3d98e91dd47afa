// Rings and shapes with sides along the axes.
#pragma once

#include "polylidar/geometry.hpp"

namespace hullbench::testing {

/// Counter-clockwise.
inline polylidar::Ring box(double left, double bottom, double right, double top) {
  return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
}

inline polylidar::Ring reversed(const polylidar::Ring& ring) {
  return {ring.rbegin(), ring.rend()};
}

inline const polylidar::MultiPolygon kUnitSquare = {{box(0, 0, 1, 1), {}}};

}  // namespace hullbench::testing
