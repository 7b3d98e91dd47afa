#include "benchmarks/metrics/anchors.hpp"

#include <algorithm>
#include <vector>

#include "benchmarks/metrics/triangle_outline.hpp"
#include "polylidar/delaunay.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench::metrics {
namespace {

using polylidar::PointLocator;
using polylidar::Triangulation;

std::vector<bool> triangles_within(const Triangulation& mesh, std::span<const Point> points,
                                   const MultiPolygon& truth) {
  const PointLocator locator(truth);
  std::vector<bool> within(mesh.triangles.size() / 3);
  for (std::size_t triangle = 0; triangle < within.size(); ++triangle) {
    const Point& a = points[mesh.triangles[3 * triangle]];
    const Point& b = points[mesh.triangles[3 * triangle + 1]];
    const Point& c = points[mesh.triangles[3 * triangle + 2]];
    within[triangle] = locator.contains({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
  }
  return within;
}

/// Of a valid `shape`.
double l2_of(const GeosSession& geos, const MultiPolygon& shape, const PreparedTruth& truth,
             const GeosSession::Geometry& truth_geometry) {
  const double common = geos.common_area(geos.make_multi_polygon(shape), truth_geometry);
  return std::max(0.0, polylidar::area(shape) + truth.area() - 2 * common) / truth.area();
}

}  // namespace

Anchors find_anchors(std::span<const Point> points, const MultiPolygon& truth,
                     const PreparedTruth& prepared) {
  const Triangulation mesh = polylidar::delaunay(points);
  const std::vector<bool> all(mesh.triangles.size() / 3, true);
  const std::vector<bool> within = triangles_within(mesh, points, truth);
  const GeosSession geos;
  const GeosSession::Geometry geometry = prepared.geometry(geos);
  return {l2_of(geos, triangle_outline(mesh, points, all), prepared, geometry),
          l2_of(geos, triangle_outline(mesh, points, within), prepared, geometry)};
}

std::optional<double> skill(const std::optional<double>& l2, const Anchors& anchors, std::size_t points) {
  const double range = anchors.l2_convex_hull - anchors.l2_best_triangles;
  if (!l2 || !(range * static_cast<double>(points) > 1)) return std::nullopt;
  return (anchors.l2_convex_hull - *l2) / range;
}

}  // namespace hullbench::metrics
