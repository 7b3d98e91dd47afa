#include "benchmarks/metrics/triangle_areas.hpp"

#include <algorithm>
#include <memory>

#include "benchmarks/metrics/geos_session.hpp"

namespace hullbench::metrics {
namespace {

struct DestroyPrepared {
  GEOSContextHandle_t context = nullptr;
  void operator()(const GEOSPreparedGeometry* prepared) const {
    GEOSPreparedGeom_destroy_r(context, prepared);
  }
};

/// A predicate's answer: GEOS gives 2 for an exception.
bool answer(const GeosSession& geos, char given) {
  if (given == 2) geos.fail("comparing a triangle with a shape");
  return given == 1;
}

}  // namespace

std::vector<double> areas_within(std::span<const std::array<Point, 3>> triangles, const MultiPolygon& shape) {
  const GeosSession geos;
  const GeosSession::Geometry geometry = geos.make_multi_polygon(shape);
  const std::unique_ptr<const GEOSPreparedGeometry, DestroyPrepared> prepared(
      GEOSPrepare_r(geos.context(), geometry.get()), {geos.context()});
  if (!prepared) geos.fail("preparing a shape");
  std::vector<double> areas;
  areas.reserve(triangles.size());
  for (const std::array<Point, 3>& corners : triangles) {
    const GeosSession::Geometry triangle =
        geos.make_polygon({.shell = {corners.begin(), corners.end()}, .holes = {}});
    if (answer(geos, GEOSPreparedContains_r(geos.context(), prepared.get(), triangle.get()))) {
      areas.push_back(std::max(0.0, polylidar::signed_area(corners)));  // flat ones may round below zero
    } else if (answer(geos, GEOSPreparedIntersects_r(geos.context(), prepared.get(), triangle.get()))) {
      areas.push_back(geos.common_area(triangle, geometry));
    } else {
      areas.push_back(0);
    }
  }
  return areas;
}

}  // namespace hullbench::metrics
