// The PCL adapter, against the core's alpha shape.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/validity.hpp"
#include "tests/adapter_contract.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

MultiPolygon pcl_hull(const std::vector<Point>& points, double alpha) {
  return hull_of(*make_pcl_concave_hull(), points, {{"alpha", alpha}});
}

TEST(PclConcaveHull, SaysWhoItIs) {
  const auto adapter = make_pcl_concave_hull();
  const MethodInfo& info = adapter->info();
  EXPECT_EQ(info.name, "pcl_concave_hull");
  EXPECT_EQ(info.version.find_first_not_of("0123456789."), std::string::npos) << info.version;
  EXPECT_TRUE(info.capabilities.holes);
  EXPECT_TRUE(info.capabilities.several_polygons);
}

// All of the contract but that repeated points are ignored: Qhull joggles its input and makes triangles
// between equal points.
TEST(PclConcaveHull, KeepsTheContract) {
  const Parameters parameters = {{"alpha", 0.1}};
  expect_the_same_bytes_again(&make_pcl_concave_hull, parameters, {{"alpha", 0.4}});
  expect_nothing_without_area(&make_pcl_concave_hull, parameters);
  expect_bad_arguments_to_be_refused(&make_pcl_concave_hull, parameters);
}

TEST(PclConcaveHull, HasHolesAndSeveralPolygons) {
  std::vector<Point> points = square_points(kPoints, 7, true);
  for (const Point& point : square_points(kPoints, 8, false)) points.push_back({point.x + 3, point.y});
  const MultiPolygon hull = pcl_hull(points, 0.1);
  EXPECT_EQ(hull.size(), 2U);
  EXPECT_EQ(hole_count(hull), 1U);
  EXPECT_EQ(metrics::invalid_reason(hull), "");
  EXPECT_NEAR(polylidar::area(hull), 2 - kHoleArea, 2 * kAreaTolerance);
}

TEST(PclConcaveHull, AlphaIsARadius) {
  const Ring points = {{0, 0}, {4, 0}, {4, 3}, {0, 3}};  // circumradius 2.5
  EXPECT_EQ(canonical(pcl_hull(points, 2.6)), (MultiPolygon{{points, {}}}));
  EXPECT_TRUE(pcl_hull(points, 2.4).empty());
  EXPECT_TRUE(pcl_hull(points, 0).empty());
}

TEST(PclConcaveHull, NeedsFourPoints) {
  EXPECT_THROW(pcl_hull({{0, 0}, {4, 0}, {0, 3}}, 5), Unsupported);
}

// Qhull joggles its input by some 1e-12 of the extent and PCL rounds it to 24 bits, so a triangle near the
// limit may fall on either side; few do.
TEST(PclConcaveHull, IsNearlyTheCoresAlphaShape) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::uniform_points(kPoints, seed);
    const double alpha = 2 / std::sqrt(static_cast<double>(kPoints));
    const MultiPolygon core = core_hull(points, {.alpha = alpha});
    const MultiPolygon hull = pcl_hull(points, alpha);
    ASSERT_EQ(metrics::invalid_reason(hull), "");
    EXPECT_LT(*metrics::area_scores(hull, core).l2, 1e-3);
  }
}

}  // namespace
}  // namespace hullbench::testing
