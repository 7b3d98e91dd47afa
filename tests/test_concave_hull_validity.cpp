// Every concave hull is a valid multipolygon in the eyes of GEOS and of Boost.Geometry.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/metrics/validity.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/boost_checks.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::near_one;
using testing::PointSet;

void expect_valid(const std::vector<Point>& points, const Options& options) {
  SCOPED_TRACE(testing::describe(options));
  const MultiPolygon shape = to_coordinates(concave_hull(points, options), near_one(points));
  EXPECT_EQ(hullbench::metrics::invalid_reason(shape), "") << "by GEOS";
  EXPECT_EQ(hullbench::testing::boost_fault_in_detail(shape), "") << "by Boost.Geometry";
}

TEST(ConcaveHullValidity, OnNastyPointSets) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    for (const Options& options : testing::clear_options(set.points, delaunay(set.points))) {
      expect_valid(set.points, options);
    }
  }
}

TEST(ConcaveHullValidity, OnNamedCases) {
  for (const testing::NamedCase& named : testing::named_cases()) {
    SCOPED_TRACE(named.name);
    for (const Options& options : named.options) expect_valid(named.points, options);
  }
}

TEST(ConcaveHullValidity, OnRandomPoints) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = testing::uniform_points(20 + 10 * seed, seed, 100);
    for (const Options& options : testing::clear_options(points, delaunay(points)))
      expect_valid(points, options);
  }
}

// Rings that touch wherever they can.
TEST(ConcaveHullValidity, OnLatticesWithGaps) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = testing::lattice_with_gaps(seed);
    expect_valid(points, {.alpha = 0.75});
    expect_valid(points, {.alpha = 1.01});
  }
}

}  // namespace
}  // namespace polylidar
