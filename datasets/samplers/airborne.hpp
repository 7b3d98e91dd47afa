// Points as a laser scanner in an aeroplane gets them; stress.hpp says what the kinds are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// How the mirror moves: it rotates, and lines are parallel, or it swings, and they are a zigzag.
enum class Mirror { kRotates, kSwings };

/// Strips a flight has, and the part of its shape's width that a strip covers: neighbours share a quarter.
inline constexpr int kStrips = 3;
inline constexpr double kStripWidth = 0.4;

/// Every coordinate is off by up to so much of the distance of points along a line.
inline constexpr double kLaserJitter = 0.1;

/// A flight over `shape` in a direction `turns` full turns counter-clockwise from x, strip by strip and line
/// by line. Where one strip lies alone a point has `pitch` squared for itself. `level` as in stress.hpp.
std::vector<polylidar::Point> fly_over(const polylidar::MultiPolygon& shape, double turns, double pitch,
                                       double level, Mirror mirror, Random& random);

std::vector<polylidar::Point> sample_airborne(const polylidar::MultiPolygon& shape, std::size_t n,
                                              double level, std::uint64_t seed);
std::vector<polylidar::Point> sample_zigzag(const polylidar::MultiPolygon& shape, std::size_t n, double level,
                                            std::uint64_t seed);

}  // namespace hullbench
