// The paper's random polygons (PAPER: random polygon tests).
#pragma once

#include <cstddef>
#include <span>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// Seven irregularities times seven spikinesses.
inline constexpr std::size_t kStarPairs = 49;
/// 200 polygons for each pair.
inline constexpr std::size_t kStarPolygons = 200 * kStarPairs;
inline constexpr std::size_t kStarVertices = 100;
/// In the unit of the coordinates.
inline constexpr double kStarMeanRadius = 100;

/// What a star polygon is drawn with; both are 0.1, 0.2 ... 0.7.
struct StarParameters {
  double irregularity = 0;  ///< an angular step is uniform in a mean step times 1 - this to 1 + this
  double spikiness = 0;     ///< a radius has this standard deviation, in mean radii
};

/// Of polygon `index`: index % 49 counts through the pairs, spikiness fastest. Any first so many indices
/// cover all pairs evenly. std::invalid_argument when `index` is not below kStarPolygons.
StarParameters star_parameters(std::size_t index);

/// Whether `ring`, seen from the origin, turns strictly counter-clockwise at every edge and goes round once:
/// it is then simple, and star-shaped with the origin strictly inside. Exact, in the range of
/// polylidar::orient2d. False for fewer than 3 vertices.
bool circles_origin_once(std::span<const polylidar::Point> ring);

/// Star polygon `index`: one shell of kStarVertices vertices round the origin, no holes. The angular steps
/// are scaled to a full turn together and begin at a random direction; the radii are Gaussian round the mean
/// and clipped to [mean / 2, 2 * mean]. A draw that does not circle the origin once is thrown away and the
/// next is drawn from the same stream. std::invalid_argument when `index` is not below kStarPolygons.
polylidar::MultiPolygon star_polygon(std::size_t index);

}  // namespace hullbench
