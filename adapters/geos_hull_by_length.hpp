// GEOS's concave hull by edge length, which the C API of GEOS 3.11 has no function for.
#pragma once

#include <geos_c.h>

namespace hullbench {

/// GEOS's concave hull of the vertices of `points` by longest edge `max_edge_length` (finite, 0 or more, in
/// the unit of the points); the caller owns the result. Null when the C API fails, whose context then has the
/// message; before GEOS 3.12 an exception of GEOS, which is a std::runtime_error.
GEOSGeometry* geos_hull_by_length(GEOSContextHandle_t context, const GEOSGeometry* points,
                                  double max_edge_length, bool allow_holes);

}  // namespace hullbench
