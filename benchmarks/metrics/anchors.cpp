#include "benchmarks/metrics/anchors.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "benchmarks/metrics/triangle_areas.hpp"
#include "polylidar/delaunay.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench::metrics {
namespace {

using TriangleCorners = std::array<Point, 3>;

std::vector<TriangleCorners> delaunay_triangles(std::span<const Point> points) {
  const polylidar::Triangulation mesh = polylidar::delaunay(points);
  std::vector<TriangleCorners> triangles;
  triangles.reserve(mesh.triangles.size() / 3);
  for (std::size_t corner = 0; corner < mesh.triangles.size(); corner += 3) {
    triangles.push_back({points[mesh.triangles[corner]], points[mesh.triangles[corner + 1]],
                         points[mesh.triangles[corner + 2]]});
  }
  return triangles;
}

/// The area of a union of triangles, and how much of it lies in the truth.
struct UnionOfTriangles {
  double area = 0;
  double in_truth = 0;

  void add(const TriangleCorners& triangle, double within) {
    area += polylidar::signed_area(triangle);
    in_truth += within;
  }
  double l2(double truth_area) const { return std::max(0.0, area + truth_area - 2 * in_truth) / truth_area; }
};

}  // namespace

Anchors find_anchors(std::span<const Point> points, const MultiPolygon& truth,
                     const PreparedTruth& prepared) {
  const std::vector<TriangleCorners> triangles = delaunay_triangles(points);
  const std::vector<double> within = areas_within(triangles, truth);
  const polylidar::PointLocator locator(truth);
  UnionOfTriangles convex_hull;
  UnionOfTriangles best;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    convex_hull.add(triangles[t], within[t]);
    if (locator.contains({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3})) best.add(triangles[t], within[t]);
  }
  return {convex_hull.l2(prepared.area()), best.l2(prepared.area())};
}

std::optional<double> skill(const std::optional<double>& l2, const Anchors& anchors, std::size_t points) {
  const double range = anchors.l2_convex_hull - anchors.l2_best_triangles;
  if (!l2 || !(range * static_cast<double>(points) > 1)) return std::nullopt;
  return (anchors.l2_convex_hull - *l2) / range;
}

}  // namespace hullbench::metrics
