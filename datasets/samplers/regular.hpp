// Points that keep their distance from each other; stress.hpp says what each kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

std::vector<polylidar::Point> sample_poisson(const polylidar::MultiPolygon& shape, std::size_t n,
                                             double level, std::uint64_t seed);
std::vector<polylidar::Point> sample_lattice(const polylidar::MultiPolygon& shape, std::size_t n,
                                             double level, std::uint64_t seed);

}  // namespace hullbench
