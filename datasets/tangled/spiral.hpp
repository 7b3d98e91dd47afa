// A spiral: a band that winds round itself.
#pragma once

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// A counter-clockwise ring: a band between two Archimedean spirals of one pitch, 1.5 to 3 turns long, of
/// either hand, ending on the circle of radius 100 round the origin. The band takes 40 to 60 percent of the
/// pitch, the gap the rest.
///
/// Simple because all its vertices lie on 64 rays from the origin: between two neighbouring rays, the pieces
/// of the outline are chords that end in the same order of distance on both.
polylidar::Ring draw_spiral(Random& random);

}  // namespace hullbench
