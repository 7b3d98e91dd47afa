// Points on a shape's rings; stress.hpp says what the kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

std::vector<polylidar::Point> sample_boundary(const polylidar::MultiPolygon& shape, std::size_t n,
                                              double level, std::uint64_t seed);

std::vector<polylidar::Point> sample_outline(const polylidar::MultiPolygon& shape, std::size_t n,
                                             double level, std::uint64_t seed);

}  // namespace hullbench
