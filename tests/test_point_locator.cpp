#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "polylidar/point_locator.hpp"
#include "tests/complaint.hpp"

namespace polylidar {
namespace {

/// A square of side 10 with a square hole in its middle, and a triangle beside it.
MultiPolygon square_and_triangle() {
  return {{.shell = {{0, 0}, {10, 0}, {10, 10}, {0, 10}}, .holes = {{{4, 4}, {4, 6}, {6, 6}, {6, 4}}}},
          {.shell = {{12, 0}, {16, 4}, {12, 8}}, .holes = {}}};
}

TEST(PointLocator, InsideAndOutside) {
  const PointLocator locator(square_and_triangle());
  for (const Point point : {Point{1, 1}, {9, 5}, {5, 2}, {5, 8}, {13, 4}, {15.5, 4}}) {
    EXPECT_TRUE(locator.contains(point)) << point.x << ' ' << point.y;
  }
  for (const Point point : {Point{-1, 5}, {5, 5}, {11, 4}, {11, 5}, {15, 7}, {15, 1}, {5, 11}, {17, 4}}) {
    EXPECT_FALSE(locator.contains(point)) << point.x << ' ' << point.y;
  }
}

TEST(PointLocator, BoundaryBelongsToTheShape) {
  const PointLocator locator(square_and_triangle());
  for (const Point point : {Point{0, 0},
                            {10, 10},
                            {0, 10},
                            {5, 0},
                            {5, 10},
                            {0, 4},
                            {10, 6},
                            {4, 4},
                            {6, 6},
                            {4, 5},
                            {5, 4},
                            {5, 6},
                            {16, 4},
                            {12, 0},
                            {12, 8},
                            {14, 2},
                            {14, 6},
                            {12, 3}}) {
    EXPECT_TRUE(locator.contains(point)) << point.x << ' ' << point.y;
  }
}

TEST(PointLocator, KnowsThePolygon) {
  const PointLocator locator(square_and_triangle());
  for (const Point point : {Point{1, 1}, {4, 5}, {10, 6}}) EXPECT_EQ(locator.polygon_of(point), 0U);
  for (const Point point : {Point{13, 4}, {12, 3}, {16, 4}}) EXPECT_EQ(locator.polygon_of(point), 1U);
  for (const Point point : {Point{5, 5}, {11, 4}, {17, 4}})
    EXPECT_EQ(locator.polygon_of(point), std::nullopt);
  const Ring square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const PointLocator twice({{.shell = square, .holes = {}}, {.shell = square, .holes = {}}});
  EXPECT_EQ(twice.polygon_of({1, 2}), 0U);
  EXPECT_FALSE(twice.contains({1, 2})) << "even";
}

TEST(PointLocator, NeighbouringDoublesOfAnEdgeAreToldApart) {
  // The edge from (0, 0) to (3, 1) at y = 0.1 passes between two doubles: the exact sign decides.
  const PointLocator locator({{.shell = {{0, 0}, {3, 1}, {0, 1}}, .holes = {}}});
  const double y = 0.1;  // the double 0.1 is a little more than 1/10, and 3 * 0.1 rounds up
  const double beyond = 3 * y;
  const double before = std::nextafter(beyond, 0.0);
  EXPECT_FALSE(locator.contains({beyond, y}));
  EXPECT_TRUE(locator.contains({before, y}));
}

TEST(PointLocator, RaysThroughVerticesAndAlongEdges) {
  // At y = 5 the ray meets a spike's tip from above, one from below, and runs along an edge.
  const PointLocator locator({{.shell = {{0, 0},
                                         {2, 0},
                                         {3, 5},
                                         {4, 0},
                                         {10, 0},
                                         {10, 5},
                                         {12, 5},
                                         {12, 10},
                                         {7, 10},
                                         {6, 5},
                                         {5, 10},
                                         {0, 10}},
                               .holes = {}}});
  EXPECT_TRUE(locator.contains({1, 5}));
  EXPECT_TRUE(locator.contains({4.5, 5}));
  EXPECT_TRUE(locator.contains({9, 5}));
  EXPECT_TRUE(locator.contains({11, 5}));
  EXPECT_FALSE(locator.contains({-1, 5}));
  EXPECT_FALSE(locator.contains({13, 5}));
  EXPECT_FALSE(locator.contains({11, 4.5}));
}

TEST(PointLocator, EmptyAndFlatShapesAndOddPoints) {
  EXPECT_FALSE(PointLocator(MultiPolygon{}).contains({0, 0}));
  const PointLocator flat({{.shell = {{0, 1}, {4, 1}, {2, 1}}, .holes = {}}});
  EXPECT_TRUE(flat.contains({3, 1}));
  EXPECT_FALSE(flat.contains({5, 1}));
  const PointLocator locator(square_and_triangle());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(locator.contains({nan, 1}));
  EXPECT_FALSE(locator.contains({1, nan}));
  EXPECT_FALSE(locator.contains({1, infinity}));
  for (const double odd : {nan, infinity, -1e308, 1e46}) {
    const MultiPolygon shape = {{.shell = {{0, 0}, {1, 0}, {1, odd}}, .holes = {}}};
    EXPECT_EQ(
        hullbench::testing::complaint_of<std::invalid_argument>([&] { const PointLocator none(shape); }),
        "a shape's coordinates must be finite and at most 2^150; scale them")
        << odd;
  }
}

}  // namespace
}  // namespace polylidar
