// The SFCGAL adapter, against what its manual promises and against the core's alpha shape.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/point_locator.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"

namespace hullbench::testing {

using polylidar::PointLocator;

namespace {

/// Less than the hole of square_points, more than any other gap.
constexpr double kRadius = 0.15;

MultiPolygon sfcgal_hull(const std::vector<Point>& points, const Parameters& parameters) {
  return hull_of(*make_sfcgal_alpha_shape(), points, parameters);
}

// As the core's with the same circumradius, where the shape is one polygon that does not touch itself.
TEST(SfcgalAlphaShape, OfAnAlphaIsTheAlphaShape) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = square_points(kPoints, seed, true);
    const MultiPolygon hull = sfcgal_hull(points, {{"alpha", kRadius * kRadius}, {"allow_holes", 1}});
    const MultiPolygon core = core_hull(points, {.alpha = kRadius});
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
    const MultiPolygon convex = core_hull(points, polylidar::testing::kConvexHull);
    EXPECT_LT(polylidar::area(hull), polylidar::area(convex)) << "the convex hull";
    const PointLocator shape(hull);
    EXPECT_TRUE(std::ranges::all_of(points, [&](const Point& p) { return shape.contains(p); }));
  }
}

TEST(SfcgalAlphaShape, AnInfiniteAlphaIsTheConvexHull) {
  const std::vector<Point> points = square_points(kPoints, 7, true);
  const MultiPolygon hull =
      sfcgal_hull(points, {{"alpha", std::numeric_limits<double>::infinity()}, {"allow_holes", 1}});
  EXPECT_TRUE(canonical(hull) == canonical(core_hull(points, polylidar::testing::kConvexHull)));
}

TEST(SfcgalAlphaShape, HasHolesWhereTheyAreAllowed) {
  const std::vector<Point> points = square_points(kPoints, 7, true);
  const MultiPolygon closed = sfcgal_hull(points, {{"alpha", kRadius * kRadius}});
  const MultiPolygon open = sfcgal_hull(points, {{"alpha", kRadius * kRadius}, {"allow_holes", 1}});
  EXPECT_EQ(hole_count(closed), 0U);
  EXPECT_EQ(hole_count(open), 1U);
  EXPECT_NEAR(polylidar::area(closed) - polylidar::area(open), kHoleArea, kAreaTolerance);
}

}  // namespace
}  // namespace hullbench::testing
