// The point sets on which the core's speed is measured.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::micro {

/// Points, and the alpha that the paper's rule 2 * sqrt(area / n) gives for the area they fill.
struct SpeedPointSet {
  std::vector<Point> points;
  double alpha = 0;
  /// How many polygons the concave hull has where that is known beforehand, else 0.
  std::size_t polygons = 0;
};

/// About `n` points of one of the sets "ca" (uniform in California), "gradient" (the same, 16 times as
/// dense at one side as at the other), "uniform" (in the unit square),
/// "lattice" (a square integer lattice), "airborne" (as an airborne scanner sees California, in strips that
/// overlap), "rgbd" (424 columns, jittered by a tenth of their spacing, as a
/// depth image of a floor gives), "islands" (uniform in 4000 squares so far apart that each is a polygon of
/// its own) and "sieve" (uniform in one region of the same area with 4000 square holes of the same size: as
/// long an outline in one polygon). The last two are for about 1,000,000 points, of which every square has
/// the 250 it needs to hold together, and have a wider alpha than the rule's. Where leaving the interior out
/// does not pay: "gradient64" (64 times as dense), "clusters" (50 normal ones in a square), "circle",
/// "parabola" (points on them), "repeats" and "repeats8" (uniform, each point four or eight times) and
/// "tight" (uniform, with three fifths of the rule's alpha). The same bytes at every call. Throws
/// std::invalid_argument for another name.
SpeedPointSet make_speed_point_set(const std::string& name, std::size_t n);

}  // namespace hullbench::micro
