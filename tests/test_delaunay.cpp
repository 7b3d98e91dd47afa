// The Delaunay triangulation by its invariants; its differential test is test_delaunay_against_cgal.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "polylidar/check.hpp"
#include "polylidar/delaunay.hpp"
#include "polylidar/predicates.hpp"
#include "tests/complaint.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::lattice;
using testing::PointSet;

std::string fault(const std::vector<Point>& points) {
  return check_triangulation(points, delaunay(points));
}

std::size_t next(std::size_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

bool all_on_a_line(const std::vector<Point>& points) {
  for (const Point& b : points) {
    if (b == points[0]) continue;
    return std::all_of(points.begin(), points.end(),
                       [&](const Point& c) { return orient2d(points[0], b, c) == 0; });
  }
  return true;
}

TEST(Delaunay, IsRightOnNastyPointSets) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    EXPECT_EQ(fault(set.points), "");
  }
}

TEST(Delaunay, HasNoTrianglesWithoutArea) {
  for (const PointSet& set : testing::flat_point_sets()) {
    SCOPED_TRACE(set.name);
    EXPECT_TRUE(delaunay(set.points).triangles.empty());
    EXPECT_TRUE(delaunay(set.points).halfedges.empty());
  }
}

TEST(Delaunay, IsRightOnRandomSmallSets) {
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Random random(seed);
    const std::size_t count = random.below(40);
    const auto side = static_cast<std::int64_t>(1 + random.below(12));
    ASSERT_EQ(fault(testing::integer_points(count, seed, side)), "");
    ASSERT_EQ(fault(testing::uniform_points(count, seed)), "");
  }
}

// Every sequence of up to 5 points of a 3 x 3 grid, with repetition: each order of insertion, each
// degeneracy.
TEST(Delaunay, IsRightOnEverySequenceFromASmallGrid) {
  const std::vector<Point> grid = lattice(3, 3);
  std::size_t sequences = 1;
  for (std::size_t size = 0; size <= 5; ++size, sequences *= grid.size()) {
    for (std::size_t code = 0; code < sequences; ++code) {
      std::vector<Point> points;
      for (std::size_t i = 0, rest = code; i < size; ++i, rest /= grid.size())
        points.push_back(grid[rest % grid.size()]);
      const Triangulation triangulation = delaunay(points);
      ASSERT_EQ(check_triangulation(points, triangulation), "") << "size " << size << ", code " << code;
      if (!points.empty()) {
        ASSERT_EQ(triangulation.triangles.empty(), all_on_a_line(points))
            << "size " << size << ", code " << code;
      }
    }
  }
}

// Every subset of a 4 x 4 grid: lattices with points left out.
TEST(Delaunay, IsRightOnEverySubsetOfAGrid) {
  const std::vector<Point> grid = lattice(4, 4);
  for (std::size_t subset = 0; subset < (std::size_t{1} << grid.size()); ++subset) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if ((subset >> i & 1U) != 0) points.push_back(grid[i]);
    }
    ASSERT_EQ(fault(points), "") << "subset " << subset;
  }
}

TEST(Delaunay, DoesNotDependOnTheRunOrOnWhatRanBefore) {
  const std::vector<Point> points = testing::uniform_points(500, 3);
  const Triangulation first = delaunay(points);
  delaunay(testing::circle(300, 1));
  const Triangulation second = delaunay(points);
  EXPECT_EQ(first.triangles, second.triangles);
  EXPECT_EQ(first.halfedges, second.halfedges);
}

bool is_less(const Point& a, const Point& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

// The triangles by their corners' positions, each from its least corner on, in order.
std::vector<std::array<Point, 3>> positions(const std::vector<Point>& points) {
  const Triangulation triangulation = delaunay(points);
  std::vector<std::array<Point, 3>> result(triangulation.triangles.size() / 3);
  for (std::size_t t = 0; t < result.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) result[t][k] = points[triangulation.triangles[3 * t + k]];
    std::rotate(result[t].begin(), std::min_element(result[t].begin(), result[t].end(), is_less),
                result[t].end());
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), is_less);
  });
  return result;
}

TEST(Delaunay, OfPointsOnAnEmptyCircleTheLeastIsInEveryTriangle) {
  const std::vector<Point> points = testing::shuffled(testing::integer_circle(5525), 1);
  const Point least = *std::min_element(points.begin(), points.end(), is_less);
  const std::vector<std::array<Point, 3>> triangles = positions(points);
  ASSERT_EQ(triangles.size(), points.size() - 2);
  for (const std::array<Point, 3>& triangle : triangles) EXPECT_EQ(triangle[0], least);
}

TEST(Delaunay, OfTiesDependsOnThePointsAlone) {
  std::vector<PointSet> sets = testing::nasty_point_sets();
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    sets.push_back({"integers, seed " + std::to_string(seed), testing::integer_points(300, seed, 16)});
  }
  for (const PointSet& set : sets) {
    SCOPED_TRACE(set.name);
    EXPECT_EQ(positions(testing::shuffled(set.points, 17)), positions(set.points));
  }
}

// What is not where a point is taken away stays: a part of the points has the same triangles where all
// corners of a whole neighbourhood are left.
TEST(Delaunay, OfAPartHasTheTrianglesOfThePointsWhoseNeighboursAreLeft) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Point> points = testing::shuffled(lattice(24, 24), seed);
    std::vector<Point> part;
    for (const Point& p : points) {
      if (std::abs(p.x - 12) > 4 || std::abs(p.y - 12) > 4 || (p.x == 10 && p.y == 11)) part.push_back(p);
    }
    const auto far_out = [](std::vector<std::array<Point, 3>> triangles) {
      std::erase_if(triangles, [](const std::array<Point, 3>& t) {
        return std::any_of(t.begin(), t.end(),
                           [](const Point& p) { return std::abs(p.x - 12) <= 6 && std::abs(p.y - 12) <= 6; });
      });
      return triangles;
    };
    EXPECT_EQ(far_out(positions(part)), far_out(positions(points)));
  }
}

TEST(Delaunay, UsesTheLowestIndexOfEqualPoints) {
  const std::vector<Point> points = {{5, 5}, {0, 0}, {1, 0}, {0, 0}, {0, 1}, {1, 0}, {5, 5}, {-0.0, 1}};
  std::vector<std::uint32_t> used = delaunay(points).triangles;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  EXPECT_EQ(used, (std::vector<std::uint32_t>{0, 1, 2, 4}));
}

TEST(Delaunay, NamesTheFirstCoordinateThatIsNotFinite) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    for (const std::size_t index : {std::size_t{0}, std::size_t{7}, std::size_t{49}}) {
      std::vector<Point> points = testing::uniform_points(50, 4, 1e-3);
      (index % 2 == 0 ? points[index].x : points[index].y) = bad;
      points[49].y = bad;
      SCOPED_TRACE(bad);
      hullbench::testing::expect_complaint<std::invalid_argument>([&] { delaunay(points); },
                                                                  std::to_string(index));
    }
  }
}

TEST(Delaunay, RefusesASpanOfMagnitudesThatThePredicatesCannotHold) {
  const std::vector<Point> points = {{1e300, 0}, {0, 1e300}, {1e-300, 1e-300}, {1, 1}};
  EXPECT_THROW(delaunay(points), std::invalid_argument);
}

class CheckTriangulation : public ::testing::Test {
 protected:
  std::vector<Point> points_ = testing::uniform_points(60, 17);
  Triangulation triangulation_ = delaunay(points_);

  // The first half-edge that has a twin.
  std::size_t inner_edge() const {
    const auto& twins = triangulation_.halfedges;
    return static_cast<std::size_t>(
        std::find_if(twins.begin(), twins.end(), [](std::uint32_t twin) { return twin != kNone; }) -
        twins.begin());
  }

  // Turns the diagonal of the first convex quadrilateral.
  void flip_an_edge() {
    std::vector<std::uint32_t>& triangles = triangulation_.triangles;
    std::vector<std::uint32_t>& twins = triangulation_.halfedges;
    for (std::size_t e = 0; e < triangles.size(); ++e) {
      if (twins[e] == kNone) continue;
      const std::size_t t = twins[e];
      const std::uint32_t a = triangles[e];
      const std::uint32_t b = triangles[t];
      const std::uint32_t c = triangles[next(next(e))];
      const std::uint32_t d = triangles[next(next(t))];
      if (!(orient2d(points_[c], points_[a], points_[d]) > 0 &&
            orient2d(points_[d], points_[b], points_[c]) > 0))
        continue;
      const std::uint32_t bc = twins[next(e)];
      const std::uint32_t ca = twins[next(next(e))];
      const std::uint32_t ad = twins[next(t)];
      const std::uint32_t db = twins[next(next(t))];
      const auto place = [&](std::size_t half_edge, std::uint32_t start, std::uint32_t twin) {
        triangles[half_edge] = start;
        twins[half_edge] = twin;
        if (twin != kNone) twins[twin] = static_cast<std::uint32_t>(half_edge);
      };
      place(e, c, static_cast<std::uint32_t>(t));  // now c -> d, d -> b, b -> c and d -> c, c -> a, a -> d
      place(next(e), d, db);
      place(next(next(e)), b, bc);
      place(t, d, static_cast<std::uint32_t>(e));
      place(next(t), c, ca);
      place(next(next(t)), a, ad);
      break;
    }
  }

  void expect_fault() const { EXPECT_NE(check_triangulation(points_, triangulation_), ""); }
};

TEST_F(CheckTriangulation, AcceptsWhatItShould) {
  EXPECT_EQ(check_triangulation(points_, triangulation_), "");
}

TEST_F(CheckTriangulation, SeesAMissingTriangle) {
  triangulation_.triangles.resize(triangulation_.triangles.size() - 3);
  triangulation_.halfedges.resize(triangulation_.halfedges.size() - 3);
  for (std::uint32_t& twin : triangulation_.halfedges) {
    if (twin != kNone && twin >= triangulation_.halfedges.size()) twin = kNone;
  }
  expect_fault();
}

TEST_F(CheckTriangulation, SeesABrokenTwin) {
  triangulation_.halfedges[inner_edge()] = kNone;
  expect_fault();
}

TEST_F(CheckTriangulation, SeesAClockwiseTriangle) {
  std::swap(triangulation_.triangles[0], triangulation_.triangles[1]);
  expect_fault();
}

TEST_F(CheckTriangulation, SeesAVertexOutOfRange) {
  triangulation_.triangles[5] = 60;
  expect_fault();
}

TEST_F(CheckTriangulation, SeesAPointThatIsNotUsed) {
  std::vector<Point> more = points_;
  more.push_back({0.5, 0.5});
  EXPECT_NE(check_triangulation(more, triangulation_), "");
}

TEST_F(CheckTriangulation, SeesAnEmptyResultForPointsWithArea) {
  EXPECT_NE(check_triangulation(points_, Triangulation{}), "");
}

// A flip leaves a triangulation that is no longer Delaunay.
TEST_F(CheckTriangulation, SeesAFlippedEdge) {
  flip_an_edge();
  EXPECT_NE(check_triangulation(points_, triangulation_).find("Delaunay"), std::string::npos)
      << check_triangulation(points_, triangulation_);
}

// Where products of differences would underflow next to a coordinate of 1.
TEST_F(CheckTriangulation, SeesAFlippedEdgeBetweenTinyCoordinates) {
  const double u = 0x1p-262;
  const double d = 0x1p-300;
  points_ = {{u, u}, {u + 8 * d, u}, {u + 6 * d, u + 3 * d}, {u + d, u + 6 * d}, {1, 1}};
  triangulation_ = delaunay(points_);
  ASSERT_EQ(check_triangulation(points_, triangulation_), "");
  flip_an_edge();
  EXPECT_NE(check_triangulation(points_, triangulation_).find("Delaunay"), std::string::npos)
      << check_triangulation(points_, triangulation_);
}

}  // namespace
}  // namespace polylidar
