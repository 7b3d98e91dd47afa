// The convex hull by Boost.Geometry, against the core without a limit.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"
#include "tests/simple_hull.hpp"

namespace hullbench::testing {
namespace {

TEST(ConvexHull, HasTheCornersOnly) {
  const auto adapter = make_convex_hull();
  const std::vector<Point> points = {{2, 0}, {4, 3}, {1, 1}, {0, 0}, {4, 0}, {0, 3}, {2, 3}};
  EXPECT_EQ(canonical(hull_of(*adapter, points, {})), (MultiPolygon{{{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, {}}}));
}

TEST(ConvexHull, IsTheCoreWithoutALimit) {
  const auto adapter = make_convex_hull();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::uniform_points(5 + 40 * seed, seed);
    const MultiPolygon hull = hull_of(*adapter, points, {});
    ASSERT_EQ(hull.size(), 1U);
    EXPECT_EQ(canonical(hull)[0].shell, polylidar::testing::convex_corners(points));
    const MultiPolygon core = core_hull(points, polylidar::testing::kConvexHull);
    // The core keeps points on the hull's edges as vertices; the area is a sum of fewer than 2^11 terms.
    EXPECT_NEAR(polylidar::area(hull), polylidar::area(core), 0x1p-41);
  }
}

TEST(ConvexHull, OfTiesAndRepeatsIsOnePolygonRoundAll) {
  const auto adapter = make_convex_hull();
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::integer_points(100, seed, 12);
    expect_one_simple_polygon_round(points, hull_of(*adapter, points, {}));
  }
}

}  // namespace
}  // namespace hullbench::testing
