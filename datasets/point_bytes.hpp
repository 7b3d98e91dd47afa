// Points as bytes: what is hashed, and what is written for workers.
#pragma once

#include <span>
#include <string>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// x0 y0 x1 y1 ... as little-endian IEEE 754 doubles, 16 bytes a point, on machines of either byte order.
std::string point_bytes(std::span<const polylidar::Point> points);

}  // namespace hullbench
