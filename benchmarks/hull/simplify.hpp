// Fewer vertices for the same shape.
#pragma once

#include "polylidar/geometry.hpp"

namespace hullbench::hull {

/// `shape` with vertices left out, none of them further than `tolerance` > 0 (in the unit of the points) from
/// the new outline, by GEOS's topology-preserving Douglas-Peucker: as many polygons and holes as before, none
/// crossing another. Throws std::runtime_error when GEOS fails or its result is not valid.
polylidar::MultiPolygon simplify(const polylidar::MultiPolygon& shape, double tolerance);

}  // namespace hullbench::hull
