// The chi shape against a slow, plain version of the paper's algorithm.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/infinity.hpp"
#include "tests/point_sets.hpp"
#include "tests/simple_hull.hpp"

namespace hullbench::testing {
namespace {

MultiPolygon chi_shape(const std::vector<Point>& points, double max_edge_length) {
  return hull_of(*make_chi_shape(), points, {{"max_edge_length", max_edge_length}});
}

using Index = std::uint32_t;
using Corners = std::array<Index, 3>;
using Edge = std::pair<Index, Index>;  // directed, the triangle to its left

/// The triangles that are left, with everything else worked out anew whenever it is asked for.
class PlainChiShape {
 public:
  explicit PlainChiShape(const std::vector<Point>& points) : points_(points) {
    const polylidar::Triangulation triangulation = polylidar::delaunay(points);
    for (std::size_t i = 0; i < triangulation.triangles.size(); i += 3) {
      const Index* corners = &triangulation.triangles[i];
      triangles_.insert({corners[0], corners[1], corners[2]});
    }
  }

  /// The boundary's edges by where they start.
  std::map<Index, Index> shape(double limit) {
    std::set<Edge> tried;
    while (true) {
      Edge longest{0, 0};
      for (const auto& [edge, triangle] : boundary(triangles_)) {
        if (length(edge) > limit && length(edge) > length(longest) && !tried.contains(edge)) longest = edge;
      }
      if (longest.first == longest.second) break;
      tried.insert(longest);
      std::set<Corners> smaller = triangles_;
      smaller.erase(boundary(triangles_).at(longest));
      if (is_simple_polygon(smaller) && vertices(smaller) == vertices(triangles_)) triangles_ = smaller;
    }
    std::map<Index, Index> next;
    for (const auto& [edge, triangle] : boundary(triangles_)) next.insert(edge);
    return next;
  }

 private:
  double length(const Edge& edge) const {
    return polylidar::testing::distance(points_[edge.first], points_[edge.second]);
  }

  /// Edges of one triangle only, each with that triangle.
  static std::map<Edge, Corners> boundary(const std::set<Corners>& triangles) {
    std::map<Edge, Corners> edges;
    for (const Corners& corners : triangles) {
      for (std::size_t i = 0; i < 3; ++i) edges[{corners[i], corners[(i + 1) % 3]}] = corners;
    }
    std::map<Edge, Corners> outer;
    for (const auto& [edge, triangle] : edges) {
      if (!edges.contains({edge.second, edge.first})) outer[edge] = triangle;
    }
    return outer;
  }

  static std::set<Index> vertices(const std::set<Corners>& triangles) {
    std::set<Index> all;
    for (const Corners& corners : triangles) all.insert(corners.begin(), corners.end());
    return all;
  }

  /// Whether the boundary is one cycle that passes no vertex twice.
  static bool is_simple_polygon(const std::set<Corners>& triangles) {
    std::map<Index, Index> next;
    for (const auto& [edge, triangle] : boundary(triangles)) {
      if (!next.insert(edge).second) return false;
    }
    if (next.empty()) return false;
    const Index start = next.begin()->first;
    std::size_t count = 1;
    for (Index vertex = next.at(start); vertex != start; vertex = next.at(vertex)) ++count;
    return count == next.size();
  }

  const std::vector<Point>& points_;
  std::set<Corners> triangles_;
};

MultiPolygon plain_chi_shape(const std::vector<Point>& points, double limit) {
  const std::map<Index, Index> next = PlainChiShape(points).shape(limit);
  Ring ring;
  Index vertex = next.begin()->first;
  do {
    ring.push_back(points[vertex]);
    vertex = next.at(vertex);
  } while (vertex != next.begin()->first);
  return {{ring, {}}};
}

// By hand: the bottom edge, 6 long, goes first and brings the inner point onto the boundary; then every point
// is on it, and no triangle can go any more.
TEST(ChiShape, OfATrapezoidWithOneInnerPoint) {
  const std::vector<Point> points = {{0, 0}, {6, 0}, {5, 4}, {1, 4}, {3, 1}};
  const MultiPolygon convex = {{{{0, 0}, {6, 0}, {5, 4}, {1, 4}}, {}}};
  const MultiPolygon notched = {{{{0, 0}, {3, 1}, {6, 0}, {5, 4}, {1, 4}}, {}}};
  EXPECT_EQ(canonical(chi_shape(points, kInfinity)), convex);
  EXPECT_EQ(canonical(chi_shape(points, 6)), convex) << "an edge of the limit's length stays";
  EXPECT_EQ(canonical(chi_shape(points, 5.9)), notched);
  EXPECT_EQ(canonical(chi_shape(points, 0)), notched);
}

TEST(ChiShape, OfATriangleIsTheTriangle) {
  const std::vector<Point> points = {{0, 0}, {4, 0}, {0, 3}};
  EXPECT_EQ(canonical(chi_shape(points, 0)), (MultiPolygon{{points, {}}}));
}

TEST(ChiShape, IsThePapersOnRandomPoints) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const std::vector<Point> points = polylidar::testing::uniform_points(5 + 3 * seed, seed);
    for (const double spacings : {0.0, 0.7, 1.5, 3.0}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", spacings " + std::to_string(spacings));
      const double limit = spacings / std::sqrt(static_cast<double>(points.size()));
      EXPECT_EQ(canonical(chi_shape(points, limit)), canonical(plain_chi_shape(points, limit)));
    }
  }
}

TEST(ChiShape, WithoutALimitIsTheConvexHull) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<Point> points = polylidar::testing::integer_points(200, seed, 15);
    EXPECT_EQ(canonical(chi_shape(points, kInfinity)),
              canonical(core_hull(points, polylidar::testing::kConvexHull)));
  }
}

TEST(ChiShape, OfPointsInAnyOrderIsTheSame) {
  const std::vector<Point> points = polylidar::testing::uniform_points(2000, 1);
  const MultiPolygon shape = canonical(chi_shape(points, 0.04));
  EXPECT_EQ(canonical(chi_shape(polylidar::testing::shuffled(points, 2), 0.04)), shape);
}

TEST(ChiShape, OfNastyPointsIsOneSimplePolygonRoundAll) {
  for (const polylidar::testing::PointSet& set : polylidar::testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const std::vector<Point> points = polylidar::testing::near_one(set.points);  // the judge's range
    if (chi_shape(points, kInfinity).empty()) continue;
    for (const double limit : {0.0, 0.05, 0.3}) {
      SCOPED_TRACE("limit " + std::to_string(limit));
      expect_one_simple_polygon_round(points, chi_shape(points, limit));
    }
  }
}

}  // namespace
}  // namespace hullbench::testing
