// Fewer vertices, none far from the new outline, the topology as it was.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "benchmarks/metrics/validity.hpp"
#include "polylidar/concave_hull.hpp"
#include "tool/shapes/simplify.hpp"

namespace polylidar::tool {
namespace {

std::size_t vertices_in(const IndexShape& shape) {
  std::size_t count = 0;
  for (const IndexPolygon& polygon : shape) {
    count += polygon.shell.size();
    for (const IndexRing& hole : polygon.holes) count += hole.size();
  }
  return count;
}

double distance(const Point& p, const Point& a, const Point& b) {
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const double t = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / (length * length);
  const double s = std::min(1.0, std::max(0.0, t));
  return std::hypot(p.x - a.x - s * (b.x - a.x), p.y - a.y - s * (b.y - a.y));
}

/// How far the vertices of `before` that `after` left out are from the segment that took their place.
double displacement(const IndexRing& before, const IndexRing& after, const std::vector<Point>& points) {
  // `after` is a subsequence of `before`.
  double largest = 0;
  std::size_t k = 0;
  for (const std::uint32_t v : before) {
    if (k < after.size() && v == after[k]) {
      ++k;
      continue;
    }
    const Point& a = points[after[(k + after.size() - 1) % after.size()]];
    const Point& b = points[after[k % after.size()]];
    largest = std::max(largest, distance(points[v], a, b));
  }
  EXPECT_EQ(k, after.size());
  return largest;
}

void expect_simple(const std::vector<Point>& points, const Options& options, double tolerance,
                   double most_share) {
  const IndexShape whole = polygons_of(concave_hull(points, options));
  const IndexShape simple = simplify(whole, points, tolerance);
  EXPECT_LE(static_cast<double>(vertices_in(simple)), most_share * static_cast<double>(vertices_in(whole)));
  EXPECT_EQ(hullbench::metrics::invalid_reason(to_coordinates(simple, points)), "");
  ASSERT_EQ(simple.size(), whole.size());
  for (std::size_t p = 0; p < whole.size(); ++p) {
    ASSERT_EQ(simple[p].holes.size(), whole[p].holes.size());
    EXPECT_LE(displacement(whole[p].shell, simple[p].shell, points), tolerance);
    EXPECT_GT(signed_area(simple[p].shell, points), 0);
    for (std::size_t h = 0; h < whole[p].holes.size(); ++h) {
      EXPECT_LE(displacement(whole[p].holes[h], simple[p].holes[h], points), tolerance);
      EXPECT_LT(signed_area(simple[p].holes[h], points), 0);
    }
  }
}

TEST(Simplify, ManyShapesStayValidAtEveryTolerance) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(0, 10);
    std::vector<Point> points(600 + 30 * seed);
    for (Point& p : points) p = {coordinate(random), coordinate(random)};
    for (const double alpha : {0.2, 0.3, 0.5}) {
      for (const double tolerance : {1e-9, 0.05, 0.3, 2.0, 100.0}) {
        expect_simple(points, {.alpha = alpha}, tolerance, 1);
      }
    }
  }
}

TEST(Simplify, LatticesWhereRingsTouchAndVerticesAreOnALine) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Point> points;
    for (int x = 0; x < 25; ++x) {
      for (int y = 0; y < 25; ++y) {
        if (random() % 100 < 70) points.push_back({static_cast<double>(x), static_cast<double>(y)});
      }
    }
    for (const double alpha : {0.75, 1.2}) {
      for (const double tolerance : {1e-9, 0.6, 1.1, 5.0})
        expect_simple(points, {.alpha = alpha}, tolerance, 1);
    }
  }
}

TEST(Simplify, LeavesOutWhatIsOnALineAndLittleElse) {
  std::vector<Point> points;
  for (int x = 0; x <= 100; ++x) {
    for (int y = 0; y <= 100; ++y) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  }
  const IndexShape square = polygons_of(concave_hull(points, {.alpha = 1}));
  ASSERT_EQ(vertices_in(square), 400U);
  EXPECT_EQ(simplify(square, points, 1e-12)[0].shell.size(), 4U);
  EXPECT_EQ(simplify(square, points, 1000)[0].shell.size(), 3U);
  EXPECT_TRUE(simplify({}, points, 1).empty());
}

TEST(Simplify, AWavyOutlineLosesMostVertices) {
  std::vector<Point> points;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  while (points.size() < 20000) {
    const Point p = {coordinate(random), coordinate(random)};
    if (std::hypot(p.x, p.y) < 1) points.push_back(p);
  }
  expect_simple(points, {.alpha = 0.06}, 0.03, 0.15);
}

}  // namespace
}  // namespace polylidar::tool
