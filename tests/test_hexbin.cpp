// The hexagons that footprints are compared with.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "benchmarks/footprint/hexbin.hpp"
#include "benchmarks/metrics/area.hpp"

namespace hullbench::footprint {
namespace {

double hexagon_area(double height) {
  return height * height * std::numbers::sqrt3 / 2;
}

TEST(Hexbin, OneHexagonRoundAPoint) {
  const std::vector<Point> points = {{3, 5}};
  const MultiPolygon shape = hexbin(points, 2, 1);
  ASSERT_EQ(shape.size(), 1U);
  ASSERT_EQ(shape[0].shell.size(), 6U);
  EXPECT_NEAR(polylidar::area(shape), hexagon_area(2), 1e-12);
  for (const Point& corner : shape[0].shell) {
    EXPECT_NEAR(std::hypot(corner.x - 3, corner.y - 5), 2 / std::numbers::sqrt3, 1e-12);
  }
  EXPECT_TRUE(hexbin(points, 2, 2).empty());
  EXPECT_TRUE(hexbin({}, 2, 1).empty());
  EXPECT_THROW(hexbin(std::vector<Point>{{0, 0}, {1e9, 1e9}}, 1, 1), std::invalid_argument);
}

/// Every point is in its hexagon, and the hexagons make a valid shape of their summed area.
TEST(Hexbin, IsValidAndCoversItsPoints) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-40, 60);
  std::vector<Point> points;
  while (points.size() < 9000) {
    const Point p = {coordinate(random), coordinate(random)};
    if (std::abs(std::hypot(p.x, p.y) - 20) > 4) points.push_back(p);
  }
  for (const double height : {0.9, 2.0, 7.0, 200.0}) {
    const MultiPolygon shape = hexbin(points, height, 1);
    const metrics::AreaScores scores = metrics::area_scores(shape, shape);
    EXPECT_TRUE(scores.valid) << scores.invalid_reason;
    const double hexagons = scores.area / hexagon_area(height);
    EXPECT_NEAR(hexagons, std::round(hexagons), 1e-6);
    if (height == 2.0) {
      EXPECT_EQ(shape.size(), 2U) << "inside and outside of the ring without points";
      EXPECT_NEAR(scores.area, 1e4 - std::numbers::pi * (24 * 24 - 16 * 16), 600);
    }
    // More points a hexagon: fewer of them, and none that was not there.
    const MultiPolygon denser = hexbin(points, height, 3);
    EXPECT_NEAR(*metrics::area_scores(denser, shape).commission, 0, 1e-9);
    EXPECT_LE(polylidar::area(denser), scores.area);
  }
}

TEST(Hexbin, TheHeightOfHexer) {
  EXPECT_EQ(hexer_height({}, 15), 0);
  EXPECT_DOUBLE_EQ(hexer_height(std::vector<Point>{{0, 0}, {3, 4}, {3, 4}, {0, 0}}, 15), 15 * 10.0 / 4);
}

}  // namespace
}  // namespace hullbench::footprint
