#include "adapters/geos_hull_by_length.hpp"

#if GEOS_VERSION_MAJOR > 3 || GEOS_VERSION_MINOR >= 12

namespace hullbench {

GEOSGeometry* geos_hull_by_length(GEOSContextHandle_t context, const GEOSGeometry* points,
                                  double max_edge_length, bool allow_holes) {
  return GEOSConcaveHullByLength_r(context, points, max_edge_length, allow_holes ? 1 : 0);
}

}  // namespace hullbench

#else

// GEOS 3.11 has this hull in its C++ class only, whose headers promise no stability; hence this file of its
// own. A GEOSGeometry is GEOS's geos::geom::Geometry under an opaque name: the C API's own source defines it
// so, and the C API's GEOSConcaveHull calls this class in the same way.
#include <geos/algorithm/hull/ConcaveHull.h>
#include <geos/geom/Geometry.h>

namespace hullbench {

GEOSGeometry* geos_hull_by_length(GEOSContextHandle_t /*context*/, const GEOSGeometry* points,
                                  double max_edge_length, bool allow_holes) {
  const auto* geometry = reinterpret_cast<const geos::geom::Geometry*>(points);
  return reinterpret_cast<GEOSGeometry*>(
      geos::algorithm::hull::ConcaveHull::concaveHullByLength(geometry, max_edge_length, allow_holes)
          .release());
}

}  // namespace hullbench

#endif
