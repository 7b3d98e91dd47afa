#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "benchmarks/base/names.hpp"
#include "datasets/datasets.hpp"
#include "datasets/holes.hpp"
#include "tests/boost_checks.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

// Coordinates up to 200 are rounded to 2.8e-14; a centre or a distance recovered from them is off by a few of
// these.
constexpr double kHoleRounding = 1e-12;

Point centre_of(const Ring& hole) {
  return {(hole.front().x + hole[kHoleCorners / 2].x) / 2, (hole.front().y + hole[kHoleCorners / 2].y) / 2};
}

/// The distance from `point` to the nearest ring of `shape` other than `own`, by Boost.Geometry.
double distance_to_rings(const MultiPolygon& shape, const Point& point, const Ring& own) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Ring& ring : rings_of(shape)) {
    if (ring != own) nearest = std::min(nearest, boost_distance(point, ring));
  }
  return nearest;
}

TEST(HoleDirections, AreTheCornersOfARegular64Gon) {
  const auto directions = hole_directions();
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / kHoleCorners;
    // The documented accuracy; the libm values are within half a unit in the last place, 1.1e-16.
    EXPECT_NEAR(directions[i].x, std::cos(angle), 1e-15) << i;
    EXPECT_NEAR(directions[i].y, std::sin(angle), 1e-15) << i;
  }
}

class HolesIn : public ::testing::TestWithParam<std::pair<const char*, double>> {};

INSTANTIATE_TEST_SUITE_P(States, HolesIn, ::testing::Values(std::pair{"ca", 5.0}, std::pair{"hi", 2.0}),
                         [](const auto& state) { return std::string(state.param.first); });

TEST_P(HolesIn, AreTenClockwiseCirclesOfTheRadius) {
  const auto& [name, radius] = GetParam();
  std::size_t count = 0;
  for (const Polygon& polygon : make_ground_truth(name, true)) {
    for (const Ring& hole : polygon.holes) {
      ++count;
      ASSERT_EQ(hole.size(), kHoleCorners);
      EXPECT_LT(polylidar::signed_area(hole), 0);
      const Point centre = centre_of(hole);
      for (const Point& corner : hole) {
        EXPECT_NEAR(std::hypot(corner.x - centre.x, corner.y - centre.y), radius, kHoleRounding);
      }
    }
  }
  EXPECT_EQ(count, 10U);
}

TEST_P(HolesIn, KeepTwiceTheRadiusFromEveryBoundary) {
  const auto& [name, radius] = GetParam();
  const MultiPolygon shape = make_ground_truth(name, true);
  for (const Polygon& polygon : shape) {
    for (const Ring& hole : polygon.holes) {
      EXPECT_GE(distance_to_rings(shape, centre_of(hole), hole), 2 * radius - kHoleRounding);
    }
  }
}

TEST_P(HolesIn, LeaveAValidShapeWithTheirAreaLess) {
  const auto& [name, radius] = GetParam();
  const MultiPolygon plain = make_ground_truth(name, false);
  const MultiPolygon with_holes = make_ground_truth(name, true);
  EXPECT_EQ(boost_fault(with_holes), "");
  const double hole_area =
      kHoleCorners / 2.0 * radius * radius * std::sin(2 * std::numbers::pi / kHoleCorners);
  // Sums of a few hundred products up to 4e4, each rounded to 7e-12.
  EXPECT_NEAR(polylidar::area(plain) - polylidar::area(with_holes), 10 * hole_area, 1e-8);
  ASSERT_EQ(plain.size(), with_holes.size());
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(plain[i].shell, with_holes[i].shell);
}

TEST(WithCircularHoles, KeepClearOfHolesThatAreThereAlready) {
  // A frame whose hole takes the middle: centres fit only in the band round it, 2 to 8 wide.
  const Ring middle{{8, 8}, {8, 32}, {32, 32}, {32, 8}};
  const MultiPolygon frame{{.shell = {{0, 0}, {40, 0}, {40, 40}, {0, 40}}, .holes = {middle}}};
  const MultiPolygon result = with_circular_holes(frame, 12, 1, 3);
  ASSERT_EQ(result.front().holes.size(), 13U);
  EXPECT_EQ(result.front().holes.front(), middle);
  for (std::size_t i = 1; i < 13; ++i) {
    const Ring& hole = result.front().holes[i];
    EXPECT_GE(distance_to_rings(result, centre_of(hole), hole), 2 - kHoleRounding);
  }
  EXPECT_EQ(boost_fault(result), "");
}

TEST(WithCircularHoles, SeedAndCountDecide) {
  const MultiPolygon square{{.shell = {{0, 0}, {40, 0}, {40, 40}, {0, 40}}, .holes = {}}};
  EXPECT_EQ(with_circular_holes(square, 0, 1, 1), square);
  EXPECT_EQ(with_circular_holes(square, 3, 1, 1), with_circular_holes(square, 3, 1, 1));
  EXPECT_NE(with_circular_holes(square, 3, 1, 1), with_circular_holes(square, 3, 1, 2));
}

TEST(WithCircularHoles, NoRoomIsAnError) {
  const MultiPolygon square{{.shell = {{0, 0}, {10, 0}, {10, 10}, {0, 10}}, .holes = {}}};
  EXPECT_NO_THROW(with_circular_holes(square, 1, 2.4, 1));
  EXPECT_EQ(complaint_of([&] { with_circular_holes(square, 1, 2.6, 1); }),
            "no room for another hole of radius 2.6 after 1000000 tries; ask for fewer or smaller holes, or "
            "another seed");
}

TEST(WithCircularHoles, RadiusMustBeALength) {
  for (const double radius :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(with_circular_holes({}, 1, radius, 1), std::invalid_argument) << radius;
  }
}

}  // namespace
}  // namespace hullbench::testing
