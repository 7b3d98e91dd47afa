// The methods in other languages that filter Delaunay triangles as the core does: the same points and limits
// give the same polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/metrics/validity.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/hull_samples.hpp"
#include "tests/manifest_method.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

using polylidar::Options;
using polylidar::testing::canonical;
using polylidar::testing::core_hull;

/// Whether rounding decides nothing in Delaunator, whose tests of circles and distances are plain arithmetic;
/// on cocircular points any of several triangulations is right, too.
bool is_clear_to_delaunator(const std::vector<Point>& points, const polylidar::Triangulation& triangulation) {
  constexpr double kRounding = 1e-12;  // some thousand roundings of 2^-53
  constexpr double kThin = 1e-8;       // below its root the distances from a centre all round to the same
  const polylidar::Box box = polylidar::bounding_box(points);
  const double width = box.max.x - box.min.x;
  const double height = box.max.y - box.min.y;
  if (std::min(width, height) < kThin * std::max(width, height) && !triangulation.triangles.empty())
    return false;
  for (std::size_t e = 0; e < triangulation.triangles.size(); ++e) {
    const std::uint32_t twin = triangulation.halfedges[e];
    if (twin == polylidar::kNone) continue;
    const Point& beyond = points[triangulation.triangles[twin % 3 == 0 ? twin + 2 : twin - 1]];
    std::array<Point, 3> from{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& corner = points[triangulation.triangles[3 * (e / 3) + k]];
      from[k] = {corner.x - beyond.x, corner.y - beyond.y};
    }
    double sum = 0;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [x, y] = from[k];
      const Point& a = from[(k + 1) % 3];
      const Point& b = from[(k + 2) % 3];
      sum += (x * x + y * y) * (a.x * b.y - a.y * b.x);
      size += (x * x + y * y) * (std::abs(a.x * b.y) + std::abs(a.y * b.x));
    }
    if (!(std::abs(sum) > kRounding * size)) return false;
  }
  return true;
}

/// A method of adapters/manifests against the core.
class TriangleMethod : public ::testing::Test {
 protected:
  explicit TriangleMethod(const std::string& name) : method_(name) {}

  void SetUp() override {
    if (!method_.missing().empty()) GTEST_SKIP() << "skipped: " << method_.missing();
  }

  void expect_same_polygons(const std::vector<Point>& points, const Options& options) {
    SCOPED_TRACE(polylidar::testing::describe(options));
    const MultiPolygon shape = method_.hull(points, parameters_of(options));
    EXPECT_EQ(metrics::invalid_reason(shape), "");
    EXPECT_TRUE(canonical(shape) == canonical(core_hull(points, options)));
  }

  /// Under limits of all the method's kinds, none so near a triangle that rounding could decide.
  void expect_same_polygons(const std::vector<Point>& points) {
    const polylidar::Triangulation triangulation = polylidar::delaunay(points);
    for (const Options& options : polylidar::testing::clear_options(points, triangulation)) {
      const bool only_alpha = !options.max_edge_length && !options.max_perimeter;
      if (only_alpha || method_.info().parameters.size() > 1) expect_same_polygons(points, options);
    }
  }

  ManifestMethod method_;
};

/// A method that gives the core's polygons wherever rounding decides nothing.
class SameAsTheCore : public TriangleMethod, public ::testing::WithParamInterface<const char*> {
 protected:
  SameAsTheCore() : TriangleMethod(GetParam()) {}
};

INSTANTIATE_TEST_SUITE_P(Methods, SameAsTheCore, ::testing::Values("delaunator", "scipy_alpha_shape"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(SameAsTheCore, OnRandomPoints) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_polygons(polylidar::testing::uniform_points(3 + 12 * seed, seed, 100));
  }
}

TEST_P(SameAsTheCore, OnSamplesOfShapes) {
  for (const HullSample& sample : hull_samples()) {
    SCOPED_TRACE(sample.name);
    const double spacing = std::sqrt(sample.area / static_cast<double>(sample.points.size()));
    for (const double spacings : {0.9, 1.3, 2.1, 3.3}) {
      expect_same_polygons(sample.points, {.alpha = spacings * spacing});
    }
  }
}

// Cocircular points have several triangulations, whose triangles on one circle are kept or dropped together.
// The gaps touch one another and the outside at vertices.
TEST_P(SameAsTheCore, OnLatticesWithGaps) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::lattice_with_gaps(seed);
    expect_same_polygons(points, {.alpha = 0.75});
    expect_same_polygons(points, {.alpha = 1.05});
  }
}

class DelaunatorTest : public TriangleMethod {
 protected:
  DelaunatorTest() : TriangleMethod("delaunator") {}
};

TEST_F(DelaunatorTest, ItsLimitsAreInclusive) {
  const std::vector<Point> points = {{0, 0}, {4, 0}, {0, 3}};
  for (const auto& [name, limit] :
       {std::pair{"alpha", 2.5}, std::pair{"max_edge_length", 5.0}, std::pair{"max_perimeter", 12.0}}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(canonical(method_.hull(points, {{name, limit}})), (MultiPolygon{{points, {}}}));
    EXPECT_EQ(method_.hull(points, {{name, std::nextafter(limit, 0)}}), MultiPolygon());
    EXPECT_EQ(method_.hull(points, {{name, 0}}), MultiPolygon());
  }
}

TEST_F(DelaunatorTest, GivesTheCoresPolygonsOnNastyPointSets) {
  std::size_t compared = 0;
  for (const auto& set : polylidar::testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const std::vector<Point> points = polylidar::testing::near_one(set.points);
    if (is_clear_to_delaunator(points, polylidar::delaunay(points))) {
      expect_same_polygons(points);
      ++compared;
    } else {
      EXPECT_EQ(metrics::invalid_reason(method_.hull(points, {{"alpha", 0.01}})), "");
    }
  }
  EXPECT_GT(compared, 20U);
}

class SciPyAlphaShapeTest : public TriangleMethod {
 protected:
  SciPyAlphaShapeTest() : TriangleMethod("scipy_alpha_shape") {}
};

// Far from the origin a lattice's steps are uneven. Qhull's triangles there overlap or are flat, and what is
// round them is no polygon.
TEST_F(SciPyAlphaShapeTest, IsValidWhereTrianglesOverlap) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Point> points = polylidar::testing::integer_points(300, seed, 30);
    for (Point& point : points) point = {point.x * 0.1 + 1e6, point.y * 0.1 + 1e6};
    for (const double alpha : {0.3, 1.0}) {
      const MultiPolygon shape = method_.hull(points, {{"alpha", alpha}});
      EXPECT_EQ(metrics::invalid_reason(shape), "") << alpha;
      const double area = polylidar::area(core_hull(points, {.alpha = alpha}));
      EXPECT_NEAR(polylidar::area(shape), area, 0.05 * area) << alpha;
    }
  }
}

// Qhull's rounding decides what these triangles are.
TEST_F(SciPyAlphaShapeTest, IsValidOnNastyPointSets) {
  for (const auto& set : polylidar::testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const std::vector<Point> points = polylidar::testing::near_one(set.points);
    // An area is a sum of products of coordinates, which near_one() puts near 1.
    const double rounding = static_cast<double>(points.size()) * 0x1p-52;
    const double largest = polylidar::area(core_hull(points, polylidar::testing::kConvexHull)) + rounding;
    for (const double alpha : {0.0, 0.01, 0.05, 1.0, polylidar::kNoLimit}) {
      const MultiPolygon shape = method_.hull(points, {{"alpha", alpha}});
      EXPECT_EQ(metrics::invalid_reason(shape), "") << alpha;
      EXPECT_LE(polylidar::area(shape), largest * (1 + 1e-9)) << alpha;
    }
  }
}

/// Of each triangle its circumradius.
std::vector<double> circumradii(const std::vector<Point>& points,
                                const polylidar::Triangulation& triangulation) {
  std::vector<double> radii;
  for (std::size_t t = 0; t < triangulation.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t k) { return points[triangulation.triangles[t + k]]; };
    radii.push_back(polylidar::testing::circumradius(corner(0), corner(1), corner(2)));
  }
  return radii;
}

/// By trying them one by one: the shapes, from the tightest to the convex hull, that have all points and are
/// one polygon.
std::vector<MultiPolygon> one_polygon_shapes(const std::vector<Point>& points) {
  const polylidar::Triangulation triangulation = polylidar::delaunay(points);
  const std::vector<double> radii = circumradii(points, triangulation);
  std::vector<double> ordered = radii;
  std::ranges::sort(ordered);
  std::vector<MultiPolygon> shapes;
  for (const double radius : ordered) {
    std::set<std::uint32_t> corners;
    for (std::size_t e = 0; e < triangulation.triangles.size(); ++e) {
      if (radii[e / 3] <= radius) corners.insert(triangulation.triangles[e]);
    }
    // A little more, as the core's rounding is another.
    MultiPolygon shape = core_hull(points, {.alpha = radius * (1 + 1e-12)});
    if (corners.size() == points.size() && shape.size() == 1) shapes.push_back(std::move(shape));
  }
  return shapes;
}

TEST_F(SciPyAlphaShapeTest, WithoutAlphaItIsTheTightestPolygonThatHasAllPoints) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::uniform_points(3 + 2 * seed, seed, 100);
    const std::vector<MultiPolygon> shapes = one_polygon_shapes(points);
    ASSERT_FALSE(shapes.empty());
    EXPECT_TRUE(canonical(method_.hull(points, {})) == canonical(shapes.front()));
  }
}

TEST_F(SciPyAlphaShapeTest, WithoutAlphaTwoClustersAreJoined) {
  std::vector<Point> points = polylidar::testing::uniform_points(200, 1);
  for (const Point& point : polylidar::testing::uniform_points(200, 2))
    points.push_back({point.x + 5, point.y});
  EXPECT_EQ(method_.hull(points, {{"alpha", 0.4}}).size(), 2U);
  EXPECT_EQ(method_.hull(points, {}).size(), 1U);
}

class ShrinkBoundaryTest : public TriangleMethod {
 protected:
  ShrinkBoundaryTest() : TriangleMethod("shrink_boundary") {}
};

TEST_F(ShrinkBoundaryTest, TheFactorCountsThroughTheShapesThatAreOnePolygonWithAllPoints) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::uniform_points(3 + 4 * seed, seed, 100);
    std::vector<MultiPolygon> shapes = one_polygon_shapes(points);
    for (MultiPolygon& shape : shapes) shape.front().holes.clear();
    const std::size_t last = shapes.size() - 1;
    for (const auto& [factor, index] :
         {std::pair{0.0, last}, {1.0, std::size_t{0}}, {0.5, last / 2}, {0.25, 3 * last / 4}}) {
      EXPECT_TRUE(canonical(method_.hull(points, {{"shrink_factor", factor}})) == canonical(shapes[index]))
          << factor;
    }
    EXPECT_TRUE(canonical(method_.hull(points, {})) == canonical(shapes[last / 2])) << "default";
    EXPECT_TRUE(canonical(shapes[last]) == canonical(core_hull(points, polylidar::testing::kConvexHull)));
  }
}

TEST_F(ShrinkBoundaryTest, IsOneValidPolygonOrNoneOfNastyPointSets) {
  for (const auto& set : polylidar::testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const std::vector<Point> points = polylidar::testing::near_one(set.points);
    for (const double factor : {0.0, 0.5, 1.0}) {
      const MultiPolygon shape = method_.hull(points, {{"shrink_factor", factor}});
      EXPECT_LE(shape.size(), polylidar::delaunay(points).triangles.empty() ? 0U : 1U);
      EXPECT_EQ(metrics::invalid_reason(shape), "");
    }
  }
}

}  // namespace
}  // namespace hullbench::testing
