// Molecules of a cell, with some of its neighbours' among them; stress.hpp says what the kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// The part of the cell's own molecules that lies round its nucleus.
inline constexpr double kNucleusShare = 0.5;
/// The standard deviation of those over the root of the shape's area.
inline constexpr double kNucleusDeviation = 0.2;

std::vector<polylidar::Point> sample_transcripts(const polylidar::MultiPolygon& shape, std::size_t n,
                                                 double level, std::uint64_t seed);

}  // namespace hullbench
