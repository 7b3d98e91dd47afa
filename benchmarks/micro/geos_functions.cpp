// GEOS's Delaunay triangulation and its concave hulls, through its C interface.
#include <geos_c.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "benchmarks/metrics/geos_session.hpp"
#include "benchmarks/micro/measure.hpp"
#include "benchmarks/micro/measured_functions.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench::micro {
namespace {

using metrics::GeosSession;

// The caller's points as GEOS takes them: neither timed nor counted.
GeosSession::Geometry multi_point(const GeosSession& geos, const SpeedPointSet& set) {
  std::vector<GEOSGeometry*> points;
  points.reserve(set.points.size());
  for (const Point& p : set.points) {
    points.push_back(GEOSGeom_createPointFromXY_r(geos.context(), p.x, p.y));
  }
  return geos.own(GEOSGeom_createCollection_r(geos.context(), GEOS_MULTIPOINT, points.data(),
                                              static_cast<unsigned>(points.size())),
                  "making points");
}

void geos_delaunay(benchmark::State& state, const SpeedPointSet& set) {
  const GeosSession geos;
  const GeosSession::Geometry points = multi_point(geos, set);
  GeosSession::Geometry triangles;
  const auto triangulate = [&] {
    triangles =
        geos.own(GEOSDelaunayTriangulation_r(geos.context(), points.get(), 0, 0), "Delaunay triangulation");
    return static_cast<std::size_t>(std::max(0, GEOSGetNumGeometries_r(geos.context(), triangles.get())));
  };
  measure(state, set, 0, Memory::kCounted, triangulate, [&] { triangles.reset(); });
}

// The ratio by which GEOS 3.11 stops at edges of length 2 * alpha, the longest that a triangle of
// circumradius alpha can have: its limit is shortest + ratio * (longest - shortest), over all edges of the
// Delaunay triangulation.
double length_ratio(const SpeedPointSet& set) {
  const polylidar::Triangulation delaunay = polylidar::delaunay(set.points);
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  for (std::size_t e = 0; e < delaunay.triangles.size(); ++e) {
    const Point& start = set.points[delaunay.triangles[e]];
    const Point& end = set.points[delaunay.triangles[3 * (e / 3) + (e + 1) % 3]];
    const double length = std::hypot(end.x - start.x, end.y - start.y);
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  if (!(shortest < longest)) return 1;
  return std::clamp((2 * set.alpha - shortest) / (longest - shortest), 0.0, 1.0);
}

template <bool holes>
void geos_concave_hull(benchmark::State& state, const SpeedPointSet& set) {
  const GeosSession geos;
  const GeosSession::Geometry points = multi_point(geos, set);
  const double ratio = length_ratio(set);
  GeosSession::Geometry hull;
  const auto make_hull = [&] {
    hull = geos.own(GEOSConcaveHull_r(geos.context(), points.get(), ratio, holes ? 1 : 0), "concave hull");
    return static_cast<std::size_t>(GEOSisEmpty_r(geos.context(), hull.get()) == 0 ? 1 : 0);
  };
  measure(state, set, 0, Memory::kCounted, make_hull, [&] { hull.reset(); });
}

constexpr std::size_t kMostPoints = 64'000;
constexpr MeasuredFunction kFunctions[] = {
    {"geos_delaunay", &geos_delaunay, kMostPoints},
    {"geos_concave_hull", &geos_concave_hull<false>, kMostPoints},
    {"geos_concave_hull_with_holes", &geos_concave_hull<true>, kMostPoints}};

}  // namespace

std::span<const MeasuredFunction> geos_functions() {
  return kFunctions;
}

}  // namespace hullbench::micro
