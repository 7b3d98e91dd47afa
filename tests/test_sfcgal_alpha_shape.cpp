// The SFCGAL adapter, against what its manual promises and against the core's alpha shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "datasets/point_locator.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/adapter_contract.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"

namespace hullbench {

std::unique_ptr<Adapter> make_sfcgal_alpha_shape();

namespace {

using polylidar::testing::canonical;
using test::hull_of;
using test::kHoleArea;
using test::kPoints;
using test::square_points;

/// Less than the hole of square_points, more than any other gap.
constexpr double kRadius = 0.15;

MultiPolygon sfcgal_hull(const std::vector<Point>& points, const Parameters& parameters) {
  return hull_of(*make_sfcgal_alpha_shape(), points, parameters);
}

TEST(SfcgalAlphaShape, SaysWhoItIs) {
  const auto adapter = make_sfcgal_alpha_shape();
  const MethodInfo& info = adapter->info();
  EXPECT_EQ(info.name, "sfcgal_alpha_shape");
  EXPECT_EQ(info.version.find_first_not_of("0123456789."), std::string::npos) << info.version;
  EXPECT_TRUE(info.capabilities.holes);
  EXPECT_FALSE(info.capabilities.several_polygons);
}

TEST(SfcgalAlphaShape, KeepsTheContract) {
  test::expect_adapter_contract(&make_sfcgal_alpha_shape, {}, {{"alpha", 0.04}, {"allow_holes", 1}});
}

TEST(SfcgalAlphaShape, ExtractComesAfterRun) {
  const auto adapter = make_sfcgal_alpha_shape();
  test::NoSteps steps;
  adapter->load(square_points(100, 1, false));
  EXPECT_THROW(adapter->extract(steps), std::logic_error);
  adapter->run({}, steps);
  EXPECT_EQ(adapter->extract(steps), adapter->extract(steps)) << "extracted again";
  adapter->reset();
  EXPECT_THROW(adapter->extract(steps), std::logic_error);
}

// As the core's with the same circumradius, where the shape is one polygon that does not touch itself.
TEST(SfcgalAlphaShape, OfAnAlphaIsTheAlphaShape) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = square_points(kPoints, seed, true);
    const MultiPolygon hull = sfcgal_hull(points, {{"alpha", kRadius * kRadius}, {"allow_holes", 1}});
    const MultiPolygon core =
        polylidar::to_coordinates(polylidar::concave_hull(points, {.alpha = kRadius}), points);
    ASSERT_EQ(core.size(), 1U);
    ASSERT_EQ(core[0].holes.size(), 1U);
    EXPECT_TRUE(canonical(hull) == canonical(core));
  }
}

// The least alpha that leaves one polygon round all points.
TEST(SfcgalAlphaShape, ByDefaultIsOnePolygonRoundAllPoints) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = square_points(500, seed, false);
    const MultiPolygon hull = sfcgal_hull(points, {});
    ASSERT_EQ(hull.size(), 1U);
    const MultiPolygon convex =
        polylidar::to_coordinates(polylidar::concave_hull(points, {.alpha = polylidar::kNoLimit}), points);
    EXPECT_LT(polylidar::area(hull), polylidar::area(convex)) << "the convex hull";
    const PointLocator shape(hull);
    EXPECT_TRUE(std::all_of(points.begin(), points.end(), [&](const Point& p) { return shape.contains(p); }));
  }
}

TEST(SfcgalAlphaShape, AnInfiniteAlphaIsTheConvexHull) {
  const std::vector<Point> points = square_points(kPoints, 7, true);
  const MultiPolygon hull =
      sfcgal_hull(points, {{"alpha", std::numeric_limits<double>::infinity()}, {"allow_holes", 1}});
  EXPECT_TRUE(canonical(hull) ==
              canonical(polylidar::to_coordinates(
                  polylidar::concave_hull(points, {.alpha = polylidar::kNoLimit}), points)));
}

TEST(SfcgalAlphaShape, HasHolesWhereTheyAreAllowed) {
  const std::vector<Point> points = square_points(kPoints, 7, true);
  const MultiPolygon closed = sfcgal_hull(points, {{"alpha", kRadius * kRadius}});
  const MultiPolygon open = sfcgal_hull(points, {{"alpha", kRadius * kRadius}, {"allow_holes", 1}});
  EXPECT_EQ(test::hole_count(closed), 0U);
  EXPECT_EQ(test::hole_count(open), 1U);
  EXPECT_NEAR(polylidar::area(closed) - polylidar::area(open), kHoleArea, test::kAreaTolerance);
}

}  // namespace
}  // namespace hullbench
