// Points along lines, as positions of vehicles on roads; stress.hpp says what the kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// How far a road may be from its place in an even grid, in distances of roads.
inline constexpr double kRoadShift = 0.25;
/// How far a point may be from the middle of its road, in distances of points along the road.
inline constexpr double kRoadHalfWidth = 0.1;

/// Every road once: first those `turns` full turns counter-clockwise from x, then those across. A point has
/// `pitch` squared for itself on average. `level` as in stress.hpp.
std::vector<polylidar::Point> drive_roads(const polylidar::MultiPolygon& shape, double turns, double pitch,
                                          double level, Random& random);

std::vector<polylidar::Point> sample_tracks(const polylidar::MultiPolygon& shape, std::size_t n, double level,
                                            std::uint64_t seed);

}  // namespace hullbench
