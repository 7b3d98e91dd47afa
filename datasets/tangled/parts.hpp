// Separate components.
#pragma once

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// 3 to 7 polygons without holes in the square from (-110, -110) to (110, 110): blobs with lobes, boxes and
/// combs by turns, each turned at random in a disc of its own. Valid because the discs are at least
/// kLeastFeature apart.
polylidar::MultiPolygon draw_parts(Random& random);

}  // namespace hullbench
