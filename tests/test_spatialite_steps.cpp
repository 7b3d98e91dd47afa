// The step-by-step SpatiaLite adapter, against SpatiaLite's own ST_ConcaveHull.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_samples.hpp"
#include "tests/infinity.hpp"

namespace hullbench::testing {
namespace {

const Parameters kStepsFilled = {{"c", 5}, {"allow_holes", 0}};

TEST(SpatialiteSteps, SaysWhoItIs) {
  const auto adapter = make_spatialite_steps();
  const MethodInfo& info = adapter->info();
  const auto original = make_spatialite();
  EXPECT_EQ(info.name, "spatialite_steps");
  EXPECT_EQ(info.title, "SpatiaLite, step by step");
  EXPECT_EQ(info.version, original->info().version);
  Parameters parameters = complete_parameters(original->info(), {});
  parameters.erase("max_edge_length");  // is turned into c, off the clock
  EXPECT_EQ(complete_parameters(info, {}), parameters);
}

// Not nearly: ring for ring and bit for bit. Both unite the same triangles in the same order.
TEST(SpatialiteSteps, GivesTheShapeOfConcaveHull) {
  const auto steps = make_spatialite_steps();
  const auto original = make_spatialite();
  std::size_t holes = 0;
  std::size_t several = 0;
  for (const auto& [name, points, area] : hull_samples()) {
    for (const double c : {1.25, 2.0, kInfinity}) {
      for (const double allow_holes : {0.0, 1.0}) {
        const Parameters parameters = {{"c", c}, {"allow_holes", allow_holes}};
        SCOPED_TRACE(name + ", c " + std::to_string(c) + ", allow_holes " + std::to_string(allow_holes));
        MultiPolygon expected;
        try {
          expected = hull_of(*original, points, parameters);
        } catch (const std::runtime_error&) {
          EXPECT_THROW(hull_of(*steps, points, parameters), std::runtime_error);
          continue;
        }
        EXPECT_EQ(hull_of(*steps, points, parameters), expected);
        holes += hole_count(expected);
        if (expected.size() > 1) ++several;
      }
    }
  }
  EXPECT_GT(holes, 50U) << "too few holes to have tested them";
  EXPECT_GT(several, 5U) << "too few shapes of several polygons to have tested them";
}

TEST(SpatialiteSteps, WantsEdgesShorterThanTheLimit) {
  const std::vector<Point> triangle = {{0, 0}, {4, 0}, {0, 3}};
  // Of 3, 4 and 5, divided by the count; the sum of the squares is exact in whatever order.
  const double deviation = std::sqrt(2.0 / 3);
  const double c = 5 / deviation;
  ASSERT_EQ(c * deviation, 5) << "the longest edge is to be at the limit exactly";
  for (const auto& make : {&make_spatialite, &make_spatialite_steps}) {
    const auto adapter = make();
    EXPECT_THROW(hull_of(*adapter, triangle, {{"c", c}}), std::runtime_error);
    EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, triangle, {{"c", std::nextafter(c, 10)}})), 6);
  }
}

// All edges have one length, so their deviation is zero and the limit is infinity times zero.
TEST(SpatialiteSteps, KeepsEveryTriangleWhenTheLimitIsNotANumber) {
  const std::vector<Point> equilateral = {{0, 0}, {2, 0}, {1, 1.7320508075688774}};
  ASSERT_EQ(std::sqrt(1 + equilateral[2].y * equilateral[2].y), 2);
  const Parameters no_limit = {{"c", kInfinity}};
  const MultiPolygon expected = hull_of(*make_spatialite(), equilateral, no_limit);
  ASSERT_EQ(expected.size(), 1U);
  EXPECT_EQ(hull_of(*make_spatialite_steps(), equilateral, no_limit), expected);
}

TEST(SpatialiteSteps, SaysWhenNoTriangleIsKept) {
  const auto adapter = make_spatialite_steps();
  const std::vector<Point> points = square_points(100, 6, false);
  expect_complaint([&] { hull_of(*adapter, points, {{"c", 0}}); }, "no triangle");
  // The failed run leaves nothing behind.
  EXPECT_EQ(hull_of(*adapter, points, kStepsFilled), hull_of(*make_spatialite_steps(), points, kStepsFilled));
}

}  // namespace
}  // namespace hullbench::testing
