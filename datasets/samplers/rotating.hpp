// Points as the rings of a rotating lidar fall on the ground; stress.hpp says what the kind is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// The lidar's height over its range.
inline constexpr double kLidarHeight = 1.0 / 4;

/// Rings and the steps along them: angles, in full turns.
struct LidarRings {
  double range = 0;       ///< from the foot to the farthest corner of the shape, units of the coordinates
  double beam_step = 0;   ///< between neighbouring beams, from straight down to the horizon
  std::size_t shots = 0;  ///< in a ring
};

/// With `level` as in stress.hpp. At half the range a point has `pitch` squared for itself.
LidarRings lidar_rings(const polylidar::MultiPolygon& shape, const polylidar::Point& foot, double pitch,
                       double level);

/// One revolution over `foot`, ring by ring from the inside.
std::vector<polylidar::Point> rotate_lidar(const polylidar::MultiPolygon& shape, const polylidar::Point& foot,
                                           const LidarRings& rings, Random& random);

std::vector<polylidar::Point> sample_rotating(const polylidar::MultiPolygon& shape, std::size_t n,
                                              double level, std::uint64_t seed);

}  // namespace hullbench
