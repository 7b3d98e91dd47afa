// The methods in other languages that filter Delaunay triangles as the core does: the same points and limits
// give the same polygons.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/validity.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/hull_samples.hpp"
#include "tests/manifest_method.hpp"
#include "tests/point_sets.hpp"

namespace hullbench {
namespace {

using polylidar::Options;
using polylidar::testing::canonical;
using testing::ManifestMethod;

MultiPolygon core_hull(const std::vector<Point>& points, const Options& options) {
  return polylidar::to_coordinates(polylidar::concave_hull(points, options), points);
}

Parameters parameters_of(const Options& options) {
  Parameters parameters;
  if (options.alpha) parameters["alpha"] = *options.alpha;
  if (options.max_edge_length) parameters["max_edge_length"] = *options.max_edge_length;
  if (options.max_perimeter) parameters["max_perimeter"] = *options.max_perimeter;
  return parameters;
}

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

class DelaunatorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!method_.missing().empty()) GTEST_SKIP() << method_.missing();
  }

  void expect_same_polygons(const std::vector<Point>& points, const Options& options) {
    SCOPED_TRACE(polylidar::testing::describe(options));
    const MultiPolygon shape = method_.hull(points, parameters_of(options));
    EXPECT_EQ(invalid_reason(shape), "");
    EXPECT_TRUE(canonical(shape) == canonical(core_hull(points, options)));
  }

  /// Under limits of all kinds, none so near a triangle that rounding could decide.
  void expect_same_polygons(const std::vector<Point>& points) {
    const polylidar::Triangulation triangulation = polylidar::delaunay(points);
    for (const Options& options : polylidar::testing::clear_options(points, triangulation)) {
      expect_same_polygons(points, options);
    }
  }

  ManifestMethod method_{"delaunator"};
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

TEST_F(DelaunatorTest, GivesTheCoresPolygonsOnRandomPoints) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_same_polygons(polylidar::testing::uniform_points(3 + 12 * seed, seed, 100));
  }
}

TEST_F(DelaunatorTest, GivesTheCoresPolygonsOnSamplesOfShapes) {
  for (const test::HullSample& sample : test::hull_samples()) {
    SCOPED_TRACE(sample.name);
    const double spacing = std::sqrt(sample.area / static_cast<double>(sample.points.size()));
    for (const double spacings : {0.9, 1.3, 2.1, 3.3}) {
      expect_same_polygons(sample.points, {.alpha = spacings * spacing});
    }
  }
}

// Cocircular points have several triangulations, whose triangles on one circle are kept or dropped together.
// The gaps touch one another and the outside at vertices.
TEST_F(DelaunatorTest, GivesTheCoresPolygonsOnLatticesWithGaps) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    polylidar::testing::Random random(seed);
    const double density = random.between(0.3, 0.97);
    std::vector<Point> points;
    for (const Point& point : polylidar::testing::lattice(14, 14)) {
      if (random.unit() < density) points.push_back(point);
    }
    expect_same_polygons(points, {.alpha = 0.75});
    expect_same_polygons(points, {.alpha = 1.05});
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
      EXPECT_EQ(invalid_reason(method_.hull(points, {{"alpha", 0.01}})), "");
    }
  }
  EXPECT_GT(compared, 20U);
}

}  // namespace
}  // namespace hullbench
