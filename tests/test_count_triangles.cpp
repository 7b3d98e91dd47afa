// How many triangles the polygons are made of.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using Points = std::vector<Point>;

/// Sizes of the edge-connected regions of kept triangles, by way of the public triangulation, in ascending
/// order.
std::vector<std::size_t> region_sizes(const Points& points, double max_edge) {
  const Triangulation t = delaunay(points);
  const std::size_t count = t.triangles.size() / 3;
  const auto kept = [&](std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& a = points[t.triangles[3 * triangle + k]];
      const Point& b = points[t.triangles[3 * triangle + (k + 1) % 3]];
      if ((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) > max_edge * max_edge) return false;
    }
    return true;
  };
  std::vector<std::size_t> label(count);
  std::iota(label.begin(), label.end(), 0U);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t e = 0; e < t.triangles.size(); ++e) {
      if (t.halfedges[e] == kNone || !kept(e / 3) || !kept(t.halfedges[e] / 3)) continue;
      const std::size_t other = label[t.halfedges[e] / 3];
      if (other < label[e / 3]) {
        label[e / 3] = other;
        changed = true;
      }
    }
  }
  std::map<std::size_t, std::size_t> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    if (kept(i)) ++sizes[label[i]];
  }
  std::vector<std::size_t> values;
  values.reserve(sizes.size());
  for (const auto& [first, size] : sizes) values.push_back(size);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(CountTriangles, AgreesWithASlowCountOfTheRegions) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Points points = testing::uniform_points(400, 100 + seed);
    for (const double max_edge : {0.04, 0.06, 0.07, 0.08, 0.1, 10.0}) {
      Extractor extractor;
      const std::size_t polygons = extractor.extract(points, {.max_edge_length = max_edge}).polygon_count();
      std::vector<std::size_t> counts = extractor.count_triangles();
      EXPECT_EQ(counts.size(), polygons);
      std::sort(counts.begin(), counts.end());
      EXPECT_EQ(counts, region_sizes(points, max_edge)) << seed << " " << max_edge;
    }
  }
}

TEST(CountTriangles, GoesByThePolygonsOrder) {
  Points points;
  for (std::size_t side = 2; side < 9; ++side) {
    const Points grid = testing::lattice(side, side, 1, {100 * static_cast<double>(side), 0});
    points.insert(points.end(), grid.begin(), grid.end());
  }
  Extractor extractor;
  const MultiPolygon shape = to_coordinates(extractor.extract(points, {.alpha = 1}), points);
  const std::vector<std::size_t> counts = extractor.count_triangles();
  ASSERT_EQ(shape.size(), 7U);
  ASSERT_EQ(counts.size(), 7U);
  // A square of the grid has the area 1 and two triangles.
  for (std::size_t p = 0; p < shape.size(); ++p)
    EXPECT_EQ(static_cast<double>(counts[p]), 2 * area({shape[p]}));
}

}  // namespace
}  // namespace polylidar
