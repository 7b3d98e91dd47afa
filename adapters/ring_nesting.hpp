// From rings in no order to polygons, for libraries that do not say which ring is a hole of which.
#pragma once

#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// The polygons that `rings` bound: a ring inside an even number of others is a shell, one inside an odd
/// number a hole of the innermost of them. Shells come out counter-clockwise, holes clockwise, in the order
/// given. The rings are meant to be simple and to have no vertex in common; of others each still comes out
/// once, and whether the result is valid is for the caller to find out. O(r^2) boxes of r rings, and O(m) for
/// each ring of m vertices whose box holds another's first vertex.
polylidar::MultiPolygon nest_rings(std::vector<polylidar::Ring> rings);

}  // namespace hullbench
