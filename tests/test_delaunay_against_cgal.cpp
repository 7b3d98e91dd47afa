// Our Delaunay triangulation against CGAL's, and against CGAL's exact predicates.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "polylidar/delaunay.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::PointSet;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalPoint = Kernel::Point_2;
using CgalDelaunay = CGAL::Delaunay_triangulation_2<Kernel>;

// A triangle or an edge by the sorted lowest indices of its corners.
using TriangleKey = std::array<std::uint32_t, 3>;
using EdgeKey = std::pair<std::uint32_t, std::uint32_t>;

// What any two Delaunay triangulations of a point set have in common, and what they may differ in.
struct Summary {
  std::vector<TriangleKey> triangles;  // sorted
  std::set<EdgeKey> certain_edges;     // hull edges, and edges whose four points are not cocircular
  std::size_t hull_edges = 0;
  bool unique = true;
};

EdgeKey edge_key(std::uint32_t a, std::uint32_t b) {
  return std::minmax(a, b);
}

TriangleKey triangle_key(TriangleKey triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

CgalPoint cgal_point(const Point& point) {
  return {point.x, point.y};
}

Summary summary_of_cgal(const std::vector<Point>& points) {
  std::vector<CgalPoint> cgal_points;
  std::map<std::pair<double, double>, std::uint32_t> lowest_index;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    cgal_points.push_back(cgal_point(points[i]));
    lowest_index.emplace(std::pair(points[i].x, points[i].y), i);
  }
  const CgalDelaunay delaunay(cgal_points.begin(), cgal_points.end());
  Summary summary;
  if (delaunay.dimension() < 2) return summary;

  const auto index = [&](CgalDelaunay::Vertex_handle vertex) {
    return lowest_index.at({vertex->point().x(), vertex->point().y()});
  };
  for (const auto face : delaunay.finite_face_handles()) {
    summary.triangles.push_back(
        triangle_key({index(face->vertex(0)), index(face->vertex(1)), index(face->vertex(2))}));
  }
  std::sort(summary.triangles.begin(), summary.triangles.end());
  for (const auto& [face, i] : delaunay.finite_edges()) {
    const auto neighbour = face->neighbor(i);
    const bool hull = delaunay.is_infinite(face) || delaunay.is_infinite(neighbour);
    const bool cocircular =
        !hull && delaunay.side_of_oriented_circle(face, delaunay.mirror_vertex(face, i)->point()) ==
                     CGAL::ON_ORIENTED_BOUNDARY;
    if (hull) ++summary.hull_edges;
    if (cocircular) {
      summary.unique = false;
    } else {
      summary.certain_edges.insert(
          edge_key(index(face->vertex(CgalDelaunay::ccw(i))), index(face->vertex(CgalDelaunay::cw(i)))));
    }
  }
  return summary;
}

std::size_t next(std::size_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

// The same from our triangulation, decided by CGAL's predicates; reports triangles that are not
// counter-clockwise and edges that are not Delaunay.
Summary summary_of_ours(const std::vector<Point>& points, const Triangulation& triangulation) {
  const std::vector<std::uint32_t>& triangles = triangulation.triangles;
  const std::vector<std::uint32_t>& twins = triangulation.halfedges;
  const auto at = [&](std::size_t half_edge) { return cgal_point(points[triangles[half_edge]]); };
  Summary summary;
  std::size_t clockwise = 0;
  std::size_t not_delaunay = 0;
  for (std::size_t e = 0; e < triangles.size(); ++e) {
    const std::size_t f = next(e);
    const std::size_t g = next(f);
    if (e % 3 == 0) {
      summary.triangles.push_back(triangle_key({triangles[e], triangles[f], triangles[g]}));
      if (CGAL::orientation(at(e), at(f), at(g)) != CGAL::LEFT_TURN) ++clockwise;
    }
    bool cocircular = false;
    if (twins[e] == kNone) {
      ++summary.hull_edges;
    } else {
      const auto side = CGAL::side_of_oriented_circle(at(e), at(f), at(g), at(next(next(twins[e]))));
      if (side == CGAL::ON_POSITIVE_SIDE) ++not_delaunay;
      cocircular = side == CGAL::ON_ORIENTED_BOUNDARY;
    }
    if (cocircular) {
      summary.unique = false;
    } else {
      summary.certain_edges.insert(edge_key(triangles[e], triangles[f]));
    }
  }
  EXPECT_EQ(clockwise, 0U);
  EXPECT_EQ(not_delaunay, 0U);
  std::sort(summary.triangles.begin(), summary.triangles.end());
  return summary;
}

// Edges that are strictly Delaunay are in every Delaunay triangulation, so those sets agree always; the
// triangles agree where there is no other kind of edge.
void expect_same(const std::vector<Point>& points) {
  const Summary cgal = summary_of_cgal(points);
  const Summary ours = summary_of_ours(points, delaunay(points));
  ASSERT_EQ(ours.triangles.size(), cgal.triangles.size());
  EXPECT_EQ(ours.hull_edges, cgal.hull_edges);
  EXPECT_EQ(ours.unique, cgal.unique);
  EXPECT_TRUE(ours.certain_edges == cgal.certain_edges);
  if (cgal.unique) {
    EXPECT_TRUE(ours.triangles == cgal.triangles);
  }
}

TEST(DelaunayAgainstCgal, AgreesOnNastyPointSets) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    expect_same(set.points);
  }
}

TEST(DelaunayAgainstCgal, AgreesOnRandomPoints) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = testing::uniform_points(50 * (seed + 1), seed, 100);
    expect_same(points);
    EXPECT_TRUE(summary_of_cgal(points).unique);
  }
}

TEST(DelaunayAgainstCgal, AgreesOnSmallIntegerSets) {
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Random random(seed);
    const std::size_t count = random.below(60);
    expect_same(testing::integer_points(count, seed, static_cast<std::int64_t>(1 + random.below(16))));
  }
}

TEST(DelaunayAgainstCgal, AgreesOnManyRandomPoints) {
  expect_same(testing::uniform_points(100000, 77));
}

TEST(DelaunayAgainstCgal, AgreesOnNamedCases) {
  for (const testing::NamedCase& named : testing::named_cases()) {
    SCOPED_TRACE(named.name);
    expect_same(named.points);
  }
}

}  // namespace
}  // namespace polylidar
