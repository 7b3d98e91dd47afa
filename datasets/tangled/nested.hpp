// Rings with islands in their holes.
#pragma once

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// Polygons two or three deep: a ring of about radius 100 round the origin whose hole has one to three
/// islands, or one ring more with islands in its own hole. Polygons with a hole come before what lies in it;
/// shells counter-clockwise, holes clockwise.
///
/// Valid because every outline lies between two circles round its centre, the outer one inside the inner one
/// of the outline around it with kLeastFeature or more between them.
polylidar::MultiPolygon draw_nested(Random& random);

}  // namespace hullbench
