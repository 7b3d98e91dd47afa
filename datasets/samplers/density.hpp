// Points of uneven density; stress.hpp says what each kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// A point of `shape`, uniform and independent of the sample that has the same `seed`: where a hot spot has
/// its middle and a rotating lidar its foot. Throws as sample_uniform.
polylidar::Point drawn_place(const polylidar::MultiPolygon& shape, std::uint64_t seed);

/// The standard deviation of a hot spot over the root of the shape's area.
inline constexpr double kHotSpotDeviation = 0.1;

std::vector<polylidar::Point> sample_gradient(const polylidar::MultiPolygon& shape, std::size_t n,
                                              double level, std::uint64_t seed);
std::vector<polylidar::Point> sample_hotspot(const polylidar::MultiPolygon& shape, std::size_t n,
                                             double level, std::uint64_t seed);
std::vector<polylidar::Point> sample_clusters(const polylidar::MultiPolygon& shape, std::size_t n,
                                              double level, std::uint64_t seed);

}  // namespace hullbench
