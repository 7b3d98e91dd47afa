// The named cases through the whole core: triangulation, polygons, and what little is known of each shape
// beforehand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/checked_hull.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::NamedCase;

NamedCase named_case(const std::string& name) {
  for (NamedCase& named : testing::named_cases()) {
    if (named.name == name) return std::move(named);
  }
  ADD_FAILURE() << "there is no case " << name;
  return {};
}

// The shape under the case's own limits; its first options are no limits.
MultiPolygon limited_hull(const NamedCase& named) {
  return to_coordinates(concave_hull(named.points, named.options.at(1)), named.points);
}

TEST(NamedCases, HaveADelaunayTriangulation) {
  for (const NamedCase& named : testing::named_cases()) {
    SCOPED_TRACE(named.name);
    EXPECT_EQ(check_triangulation(named.points, delaunay(named.points)), "");
  }
}

TEST(NamedCases, AreTheShapesOfTheirTriangles) {
  for (const NamedCase& named : testing::named_cases()) {
    SCOPED_TRACE(named.name);
    testing::expect_the_shapes_of_their_triangles(named.points, named.options);
  }
}

TEST(NamedCases, AllLatticesAreOnePolygon) {
  for (const auto& [name, corner_count, side] :
       {std::tuple{"lattice turned by 0.3 rad", 4 * 299, 299.0}, {"lattice of UTM size", 4 * 199, 1.99}}) {
    SCOPED_TRACE(name);
    const MultiPolygon shape = limited_hull(named_case(name));
    ASSERT_EQ(shape.size(), 1U);
    EXPECT_TRUE(shape[0].holes.empty());
    EXPECT_NEAR(area(shape), side * side, 1e-6 * side * side);
    EXPECT_EQ(shape[0].shell.size(), static_cast<std::size_t>(corner_count));
  }
}

TEST(NamedCases, EveryPointOfACircleOrParabolaIsACorner) {
  for (const std::string name : {"circle", "circle, shuffled", "parabola"}) {
    SCOPED_TRACE(name);
    const std::vector<Point> points = named_case(name).points;
    EXPECT_EQ(delaunay(points).triangles.size(), 3 * (points.size() - 2));
    EXPECT_EQ(concave_hull(points, testing::kConvexHull).vertices.size(), points.size());
  }
}

TEST(NamedCases, OnePointManyTimesHasNoShape) {
  EXPECT_TRUE(limited_hull(named_case("one point many times")).empty());
}

TEST(NamedCases, ClustersFarApartStayApart) {
  const NamedCase clusters = named_case("two clusters 1e9 apart");
  const MultiPolygon shape =
      to_coordinates(concave_hull(clusters.points, {.max_edge_length = 10}), clusters.points);
  ASSERT_EQ(shape.size(), 2U);
  EXPECT_NEAR(area(shape), 2, 0.1);
}

// 100 teeth of 1 x 40 on a back of 399 x 1, and half a cell in each of the 199 corners between them.
TEST(NamedCases, ACombKeepsItsTeeth) {
  const MultiPolygon shape = limited_hull(named_case("comb"));
  ASSERT_EQ(shape.size(), 1U);
  EXPECT_TRUE(shape[0].holes.empty());
  EXPECT_EQ(area(shape), 399 + 100 * 40 + 199 * 0.5);
}

TEST(NamedCases, ThousandsOfIslandsStayApart) {
  const MultiPolygon shape = limited_hull(named_case("islands"));
  EXPECT_EQ(shape.size(), 4096U);
  EXPECT_EQ(area(shape), 2048);
  EXPECT_TRUE(std::all_of(shape.begin(), shape.end(), [](const Polygon& polygon) {
    return polygon.shell.size() == 3 && polygon.holes.empty();
  }));
}

}  // namespace
}  // namespace polylidar
