// The k-nearest-neighbours hull: what the paper promises of its result, on points of every kind.
#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/infinity.hpp"
#include "tests/point_sets.hpp"
#include "tests/simple_hull.hpp"

namespace hullbench::testing {
namespace {

MultiPolygon knn_hull(const std::vector<Point>& points, double k) {
  return hull_of(*make_knn_hull(), points, {{"k", k}});
}

TEST(KnnHull, TakesWholeNumbersOnly) {
  EXPECT_THROW(knn_hull(square_points(10, 1, false), 3.5), std::invalid_argument);
}

// By hand: a U on the grid, two points wide. In its slot the walk turns right as soon as a point of the floor
// is among the three nearest, and so cuts both corners.
TEST(KnnHull, OfTheLetterU) {
  std::vector<Point> points;
  for (int x = 0; x <= 6; ++x) {
    for (int y = 0; y <= 4; ++y) {
      if (y <= 1 || x <= 1 || x >= 5) points.push_back({static_cast<double>(x), static_cast<double>(y)});
    }
  }
  const Ring expected = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}, {6, 1},
                         {6, 2}, {6, 3}, {6, 4}, {5, 4}, {5, 3}, {4, 1}, {3, 1}, {2, 1},
                         {1, 2}, {1, 3}, {1, 4}, {0, 4}, {0, 3}, {0, 2}, {0, 1}};
  EXPECT_EQ(canonical(knn_hull(points, 3)), (MultiPolygon{{expected, {}}}));
}

TEST(KnnHull, OfThreeAndFourPoints) {
  const Ring triangle = {{0, 0}, {4, 0}, {0, 3}};
  EXPECT_EQ(canonical(knn_hull(triangle, 3)), (MultiPolygon{{triangle, {}}}));
  EXPECT_EQ(canonical(knn_hull({{0, 0}, {4, 0}, {1, 1}, {0, 3}}, 3)), (MultiPolygon{{triangle, {}}}));
}

// Neighbours of a point in one cluster are all of that cluster until k is as large as it.
TEST(KnnHull, TakesMoreNeighboursUntilAllPointsAreInside) {
  std::vector<Point> points = square_points(40, 1, false);
  for (const Point& point : square_points(40, 2, false)) points.push_back({point.x + 5, point.y});
  expect_one_simple_polygon_round(points, knn_hull(points, 3));
}

TEST(KnnHull, WithAllNeighboursIsTheConvexHull) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::integer_points(3 + 10 * seed, seed, 12);
    EXPECT_EQ(canonical(knn_hull(points, kInfinity)),
              canonical(core_hull(points, polylidar::testing::kConvexHull)));
  }
}

TEST(KnnHull, OfPointsInAnyOrderIsTheSame) {
  for (const std::vector<Point>& points :
       {polylidar::testing::uniform_points(1000, 1), polylidar::testing::lattice(20, 20)}) {
    EXPECT_EQ(knn_hull(polylidar::testing::shuffled(points, 2), 6), knn_hull(points, 6));
  }
}

TEST(KnnHull, IsOneSimplePolygonRoundAll) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const double k : {3.0, 8.0}) {
      const std::vector<Point> random = polylidar::testing::uniform_points(5 + 2 * seed, seed);
      expect_one_simple_polygon_round(random, knn_hull(random, k));
      // Many points on few lines, many of them more than once.
      const std::vector<Point> ties = polylidar::testing::integer_points(5 + seed, seed, 9);
      expect_one_simple_polygon_round(ties, knn_hull(ties, k));
    }
  }
}

TEST(KnnHull, OfNastyPointsIsOneSimplePolygonRoundAll) {
  for (const polylidar::testing::PointSet& set : polylidar::testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const std::vector<Point> points = polylidar::testing::near_one(set.points);  // the predicates' range
    const MultiPolygon hull = knn_hull(points, 10);
    if (polylidar::delaunay(points).triangles.empty()) {
      EXPECT_TRUE(hull.empty());
    } else {
      expect_one_simple_polygon_round(points, hull);
    }
  }
}

}  // namespace
}  // namespace hullbench::testing
