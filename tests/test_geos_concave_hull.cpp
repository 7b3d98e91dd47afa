// The GEOS adapter: its two parameters, its extremes, and the chi shape, which GEOS's erosion by length is.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "tests/adapter_contract.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/infinity.hpp"
#include "tests/point_sets.hpp"
#include "tests/simple_hull.hpp"

namespace hullbench::testing {
namespace {

MultiPolygon geos_hull(const std::vector<Point>& points, const Parameters& parameters) {
  return hull_of(*make_geos_concave_hull(), points, parameters);
}

TEST(GeosConcaveHull, TakesOneOfItsTwoLimits) {
  EXPECT_FALSE(has_defaults(make_geos_concave_hull()->info()));
  const std::vector<Point> points = square_points(100, 1, false);
  const auto refusal = [&](const Parameters& parameters) {
    return complaint_of<std::invalid_argument>([&] { geos_hull(points, parameters); });
  };
  EXPECT_EQ(refusal({{"length_ratio", 0.5}, {"max_edge_length", 0.5}}),
            "geos_concave_hull takes one of 'length_ratio' and 'max_edge_length': give only one of them");
  EXPECT_EQ(refusal({}),
            "geos_concave_hull takes one of 'length_ratio' and 'max_edge_length': give one, as GEOS has no "
            "default");
  const MultiPolygon by_ratio = geos_hull(points, {{"length_ratio", 0.5}, {"max_edge_length", kInfinity}});
  EXPECT_EQ(by_ratio, geos_hull(points, {{"length_ratio", 0.5}}));
  const MultiPolygon by_length = geos_hull(points, {{"length_ratio", kInfinity}, {"max_edge_length", 0.2}});
  EXPECT_EQ(by_length, geos_hull(points, {{"max_edge_length", 0.2}}));
}

// GEOS triangulates within a frame of finite size, so that slivers along the convex hull may be missing: in
// this set one, 1.4e-6 of the whole.
TEST(GeosConcaveHull, AtItsLargestLimitsIsTheConvexHull) {
  const std::vector<Point> points = square_points(kPoints, 7, true);
  const double convex = polylidar::area(core_hull(points, polylidar::testing::kConvexHull));
  for (const Parameters& parameters : {Parameters{{"length_ratio", 1}}, Parameters{{"max_edge_length", 2}}}) {
    EXPECT_NEAR(polylidar::area(geos_hull(points, parameters)), convex, 2e-6);
  }
}

// By hand, as in the test of the chi shape.
TEST(GeosConcaveHull, OfATrapezoidWithOneInnerPoint) {
  const std::vector<Point> points = {{0, 0}, {6, 0}, {5, 4}, {1, 4}, {3, 1}};
  const MultiPolygon convex = {{{{0, 0}, {6, 0}, {5, 4}, {1, 4}}, {}}};
  const MultiPolygon notched = {{{{0, 0}, {3, 1}, {6, 0}, {5, 4}, {1, 4}}, {}}};
  EXPECT_EQ(canonical(geos_hull(points, {{"max_edge_length", 6.1}})), convex);
  EXPECT_EQ(canonical(geos_hull(points, {{"max_edge_length", 5.9}})), notched);
  EXPECT_EQ(canonical(geos_hull(points, {{"length_ratio", 0}})), notched);
  EXPECT_EQ(canonical(geos_hull(points, {{"length_ratio", 1}})), convex);
}

TEST(GeosConcaveHull, KeepsOrFillsTheHole) {
  expect_hole_to_be_filled_or_kept(*make_geos_concave_hull(), {{"max_edge_length", 0.12}},
                                   {{"max_edge_length", 0.12}, {"allow_holes", 1}});
}

TEST(GeosConcaveHull, ByLengthIsTheChiShape) {
  const auto chi_shape = make_chi_shape();
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<Point> points = polylidar::testing::uniform_points(5 + 20 * seed, seed);
    for (const double spacings : {0.0, 1.0, 2.0, 4.0}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", spacings " + std::to_string(spacings));
      const Parameters limit = {
          {"max_edge_length", spacings / std::sqrt(static_cast<double>(points.size()))}};
      const MultiPolygon hull = geos_hull(points, limit);
      EXPECT_EQ(canonical(hull), canonical(hull_of(*chi_shape, points, limit)));
    }
  }
}

TEST(GeosConcaveHull, OfRandomPointsIsOneSimplePolygonRoundAll) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::uniform_points(5 + 5 * seed, seed);
    expect_one_simple_polygon_round(points, geos_hull(points, {{"length_ratio", 0.2}}));
  }
}

}  // namespace
}  // namespace hullbench::testing
