// The SpatiaLite adapter on the real library.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/adapter_contract.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_input.hpp"
#include "tests/infinity.hpp"

namespace hullbench::testing {
namespace {

// Five standard deviations: no spurious holes at this density.
const Parameters kFilled = {{"c", 5}, {"allow_holes", 0}};

TEST(Spatialite, KeepsOrFillsTheHole) {
  expect_hole_to_be_filled_or_kept(*make_spatialite(), kFilled, {{"c", 5}, {"allow_holes", 1}});
}

TEST(Spatialite, GivesSeveralPolygons) {
  const auto adapter = make_spatialite();
  std::vector<Point> points = square_points(500, 1, false);
  for (const Point& point : square_points(500, 2, false)) points.push_back({point.x + 3, point.y});
  EXPECT_EQ(hull_of(*adapter, points, {{"c", 2.5}}).size(), 2U);
}

TEST(Spatialite, SaysWhenNoTriangleIsKept) {
  const auto adapter = make_spatialite();
  expect_complaint([&] { hull_of(*adapter, square_points(100, 6, false), {{"c", 0}}); }, "no triangle");
  // The failed run leaves the adapter usable.
  NoSteps steps;
  adapter->run(kFilled, steps);
  EXPECT_NEAR(polylidar::area(adapter->extract(steps)), 1, 0.2) << "100 points leave a wide rim";
}

// 3-4-5: of the two triangles of a rectangle the edges are 3, 4 and 5 twice, so their deviation is sqrt(2/3).
TEST(Spatialite, KeepsTrianglesWhoseEdgesAreShorterThanALength) {
  const auto adapter = make_spatialite();
  const std::vector<Point> corners = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, corners, {{"max_edge_length", 5.001}})), 12);
  expect_complaint([&] { hull_of(*adapter, corners, {{"max_edge_length", 4.999}}); }, "no triangle");
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, corners, {{"c", 5.001 * std::sqrt(1.5)}})), 12);
}

// The same triangles as Polylidar's by the longest edge.
TEST(Spatialite, KeepsTheTrianglesOfPolylidarWithThatLength) {
  const auto adapter = make_spatialite();
  const std::vector<Point> points = square_points(2000, 3, true);
  for (const double length : {0.04, 0.06, 0.1}) {
    const polylidar::MultiPolygon expected =
        polylidar::to_coordinates(polylidar::concave_hull(points, {.max_edge_length = length}), points);
    EXPECT_NEAR(polylidar::area(hull_of(*adapter, points, {{"max_edge_length", length}, {"allow_holes", 1}})),
                polylidar::area(expected), 1e-9);
  }
}

TEST(Spatialite, KeepsEveryTriangleWithoutALimit) {
  const auto adapter = make_spatialite();
  const std::vector<Point> corners = {{0, 0}, {4, 0}, {4, 3}, {0, 3}, {1, 1}};
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, corners, {{"c", kInfinity}})), 12);
}

}  // namespace
}  // namespace hullbench::testing
