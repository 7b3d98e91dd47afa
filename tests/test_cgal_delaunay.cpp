// The filter on CGAL's triangulation: its contract, and the same polygons as Polylidar's.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/metrics/validity.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/infinity.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

using polylidar::Options;
using polylidar::testing::describe;
using polylidar::testing::PointSet;
using polylidar::testing::uniform_points;

MultiPolygon run(const std::vector<Point>& points, const Options& options) {
  return hull_of(*make_cgal_delaunay(), points, parameters_of(options));
}

// The polygons of both.
MultiPolygon expect_the_same(const std::vector<Point>& points, const Options& options) {
  SCOPED_TRACE(describe(options));
  MultiPolygon theirs = run(points, options);
  EXPECT_TRUE(canonical(theirs) == canonical(core_hull(points, options)));
  return theirs;
}

// How many comparisons were made of shapes that are neither empty nor one ring.
int expect_the_same(const std::vector<Point>& points) {
  int telling = 0;
  for (const Options& options : polylidar::testing::clear_options(points, polylidar::delaunay(points))) {
    const MultiPolygon shape = expect_the_same(points, options);
    EXPECT_EQ(metrics::invalid_reason(shape), "") << describe(options);
    telling += shape.size() + hole_count(shape) > 1 ? 1 : 0;
  }
  return telling;
}

TEST(CgalDelaunay, OfNothingIsEmpty) {
  for (const PointSet& set : polylidar::testing::flat_point_sets()) {
    SCOPED_TRACE(set.name);
    for (const Options& options : {Options{}, Options{.alpha = 1}, Options{.max_perimeter = 1}}) {
      EXPECT_TRUE(run(set.points, options).empty()) << describe(options);
    }
  }
}

// Of a right triangle with sides 3, 4 and 5 all three are exact.
TEST(CgalDelaunay, LimitsAreInclusiveAndAllMustHold) {
  const std::vector<Point> points = {{0, 0}, {4, 0}, {0, 3}};
  const MultiPolygon triangle = {{{{0, 0}, {4, 0}, {0, 3}}, {}}};
  const auto below = [](double value) { return std::nextafter(value, 0); };
  EXPECT_EQ(canonical(run(points, {.alpha = 2.5, .max_edge_length = 5, .max_perimeter = 12})), triangle);
  EXPECT_TRUE(run(points, {.alpha = below(2.5), .max_edge_length = 5, .max_perimeter = 12}).empty());
  EXPECT_TRUE(run(points, {.alpha = 2.5, .max_edge_length = below(5), .max_perimeter = 12}).empty());
  EXPECT_TRUE(run(points, {.alpha = 2.5, .max_edge_length = 5, .max_perimeter = below(12)}).empty());
  EXPECT_TRUE(run(points, {.alpha = 0}).empty());
}

TEST(CgalDelaunay, WithoutALimitIsTheConvexHull) {
  const std::vector<Point> points = uniform_points(500, 3);
  const MultiPolygon hull = hull_of(*make_cgal_delaunay(), points, {});
  EXPECT_EQ(canonical(hull), canonical(core_hull(points, {.alpha = kInfinity})));
  ASSERT_EQ(hull.size(), 1U);
  EXPECT_TRUE(hull[0].holes.empty());
}

TEST(CgalDelaunay, SamePolygonsAsPolylidarsOnRandomPoints) {
  int telling = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    telling += expect_the_same(uniform_points(10 + 15 * seed, seed, 100));
  }
  EXPECT_GT(telling, 100);
}

// The paper's rule for alpha and the limits that the core chooses, on samples like those measured.
TEST(CgalDelaunay, SamePolygonsAsPolylidarsOnASampleWithAHole) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Point> points = uniform_points(20000, seed, 200);
    std::erase_if(points,
                  [](const Point& p) { return std::hypot(p.x - 80, p.y - 90) < 30 || p.x + p.y < 70; });
    const double spacing = std::sqrt(40000.0 / 20000);
    for (const Options& options :
         {Options{.alpha = 2 * spacing}, Options{.max_edge_length = 3 * spacing},
          Options{.max_perimeter = 9 * spacing}, Options{.alpha = spacing, .max_edge_length = 3 * spacing}}) {
      EXPECT_GT(hole_count(expect_the_same(points, options)), 0U) << describe(options);
    }
  }
}

// Where points are cocircular the triangulations differ; triangles on one circle are kept or dropped together
// when the circle's radius is what is limited.
TEST(CgalDelaunay, SamePolygonsAsPolylidarsOnLatticesWithGaps) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::lattice_with_gaps(seed);
    for (const double radius : {0.75, 1.05}) expect_the_same(points, {.alpha = radius});
  }
}

// Circles of many points are triangulated in more than one way, so that edges and perimeters may differ: the
// circumradius alone decides alike.
TEST(CgalDelaunay, SamePolygonsAsPolylidarsOnNastyPointSets) {
  int compared = 0;
  for (const PointSet& set : polylidar::testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const std::vector<Point> points = polylidar::testing::near_one(set.points);
    for (const Options& options : polylidar::testing::clear_options(points, polylidar::delaunay(points))) {
      if (!options.alpha || options.max_edge_length || options.max_perimeter) continue;
      expect_the_same(points, options);
      ++compared;
    }
  }
  EXPECT_GT(compared, 20);
}

}  // namespace
}  // namespace hullbench::testing
