// Hulls that leave no point outside, or are one polygon. What they are, on many point sets, is tested with
// the groups of the program (test_group_hulls.cpp).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/point_locator.hpp"
#include "polylidar/widened_hull.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

/// Two squares of uniform points, and a point far from both.
std::vector<Point> two_squares() {
  std::vector<Point> points = testing::uniform_points(300, 1);
  for (const Point& p : testing::uniform_points(300, 2)) points.push_back({p.x + 1.5, p.y});
  points.push_back({0.5, 3});
  return points;
}

bool covers_all(const MultiPolygon& shape, const std::vector<Point>& points) {
  const PointLocator locator(shape);
  for (const Point& p : points) {
    if (!locator.contains(p)) return false;
  }
  return true;
}

TEST(WidenedHull, CoversAllPointsOrIsOneOrBoth) {
  const std::vector<Point> points = two_squares();
  for (const Options& options : {Options(), Options{.alpha = 0.1}, Options{.max_edge_length = 0.3}}) {
    const MultiPolygon plain = to_coordinates(concave_hull(points, options), points);
    ASSERT_EQ(plain.size(), 2U);
    EXPECT_FALSE(covers_all(plain, points));
    const MultiPolygon covering = to_coordinates(concave_hull(points, options, {.cover = true}), points);
    EXPECT_TRUE(covers_all(covering, points));
    const IndexedMultiPolygon one = concave_hull(points, options, {.one = true});
    EXPECT_EQ(one.polygon_count(), 1U);
    EXPECT_LT(area(to_coordinates(one, points)), area(covering));
    const IndexedMultiPolygon both = concave_hull(points, options, {.cover = true, .one = true});
    EXPECT_EQ(both.polygon_count(), 1U);
    EXPECT_TRUE(covers_all(to_coordinates(both, points), points));
  }
}

// Few points in clumps: all parts are small, and are kept as long as none is large. A wider limit joins two
// of them, and the core would drop the third.
TEST(WidenedHull, LosesNoSmallPartBesideALargerOne) {
  std::vector<Point> points;
  for (const Point& centre : {Point{0, 0}, {4, 0}, {0, 9}}) {
    points.push_back(centre);
    for (int k = 0; k < 5; ++k) {
      const double angle = 2 * 3.141592653589793 * k / 5;
      points.push_back({centre.x + std::cos(angle), centre.y + std::sin(angle)});
    }
  }
  ASSERT_EQ(concave_hull(points).polygon_count(), 3U);
  ASSERT_EQ(concave_hull(points, {.detail = 0.6}).polygon_count(), 1U);
  const IndexedMultiPolygon one = concave_hull(points, {}, {.one = true});
  EXPECT_EQ(one.polygon_count(), 1U);
  EXPECT_TRUE(covers_all(to_coordinates(one, points), points));
  points.push_back({2, 2.5});
  for (const bool is_one : {false, true}) {
    const IndexedMultiPolygon shape = concave_hull(points, {}, {.cover = true, .one = is_one});
    EXPECT_TRUE(covers_all(to_coordinates(shape, points), points)) << is_one;
  }
}

// The predicates that say which points are covered need coordinates of a usual magnitude.
TEST(WidenedHull, IsTheSameForCoordinatesOfAnyMagnitude) {
  const std::vector<Point> points = two_squares();
  for (const Wanted& wanted : {Wanted{.cover = true}, Wanted{.one = true}, Wanted{true, true}}) {
    const IndexedMultiPolygon expected = concave_hull(points, {}, wanted);
    for (const int exponent : {-900, -600, 600, 1000}) {
      std::vector<Point> scaled;
      for (const Point& p : points) scaled.push_back({std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)});
      EXPECT_EQ(concave_hull(scaled, {}, wanted), expected) << exponent;
    }
  }
}

// With the edges that join the squares a sparse triangle far from both is kept, too.
TEST(WidenedHull, OneDropsWhatAWiderLimitAddsApart) {
  std::vector<Point> points = two_squares();
  for (const Point& corner : {Point{0, 9}, {0.4, 9}, {0.2, 9.3}}) points.push_back(corner);
  Extractor extractor;
  const WidenedHull one = widened_hull(extractor, points, {.max_edge_length = 0.2}, {.one = true});
  EXPECT_EQ(one.shape.polygon_count(), 1U);
  EXPECT_GE(concave_hull(points, one.options).polygon_count(), 2U);
  const MultiPolygon plain = to_coordinates(concave_hull(points, {.max_edge_length = 0.2}), points);
  EXPECT_EQ(plain.size(), 2U);
  EXPECT_GT(area(to_coordinates(one.shape, points)), area(plain));
}

TEST(WidenedHull, SaysTheLimitAndTheSizes) {
  const std::vector<Point> points = two_squares();
  Extractor extractor;
  int steps = 0;
  const WidenedHull by_length =
      widened_hull(extractor, points, {.max_edge_length = 0.3}, {.cover = true}, [&] { ++steps; });
  EXPECT_GT(steps, 5);
  ASSERT_TRUE(by_length.options.max_edge_length);
  EXPECT_GT(*by_length.options.max_edge_length, 1.5);
  EXPECT_EQ(by_length.shape, concave_hull(points, by_length.options));
  EXPECT_FALSE(extractor.chosen_sizes());
  extractor.extract(points);
  const double usual = extractor.chosen_sizes()->median;
  const WidenedHull chosen = widened_hull(extractor, points, {}, {.cover = true});
  EXPECT_LT(chosen.options.detail, 1);
  EXPECT_EQ(chosen.shape, concave_hull(points, chosen.options));
  ASSERT_TRUE(extractor.chosen_sizes());
  EXPECT_GT(extractor.chosen_sizes()->median, usual);
  // Bad options are refused before anything is done.
  extractor.extract(points);
  const std::vector<Point> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_THROW(widened_hull(extractor, square, {.alpha = -1}, {.cover = true}), std::invalid_argument);
  EXPECT_EQ(extractor.statistics().points, points.size());
  // Where no limit is left, each that was given says so.
  for (const auto& [given, left] :
       {std::pair{Options{.max_edge_length = 1e-20, .max_perimeter = 1e-20},
                  Options{.max_edge_length = kNoLimit, .max_perimeter = kNoLimit}},
        {Options{.alpha = 0}, Options{.alpha = kNoLimit}}})
    EXPECT_EQ(widened_hull(extractor, square, given, {.cover = true}).options, left);
  // What holds already is not widened, so the options stay.
  EXPECT_EQ(widened_hull(extractor, square, {.alpha = 1}, {true, true}).options, Options{.alpha = 1});
}

// No multiple of 0 covers a point.
TEST(WidenedHull, OfTheConvexHullKeepsTheNamesOfTheLimits) {
  const std::vector<Point> points = two_squares();
  Extractor extractor;
  for (const Wanted& wanted : {Wanted{.cover = true}, Wanted{.one = true}}) {
    const WidenedHull by_length = widened_hull(extractor, points, {.max_edge_length = 0}, wanted);
    EXPECT_EQ(by_length.options, Options{.max_edge_length = kNoLimit});
    EXPECT_EQ(by_length.shape, concave_hull(points, {.alpha = kNoLimit}));
    const WidenedHull by_both = widened_hull(extractor, points, {.alpha = 0, .max_perimeter = 0}, wanted);
    EXPECT_EQ(by_both.options, (Options{.alpha = kNoLimit, .max_perimeter = kNoLimit}));
    EXPECT_EQ(by_both.shape, by_length.shape);
  }
}

TEST(WidenedHull, OfEveryLabel) {
  std::vector<Point> points = two_squares();
  std::vector<std::int64_t> labels(points.size(), 5);
  const std::size_t before = points.size();
  for (const Point& p : two_squares()) points.push_back({p.x + 9, p.y});
  labels.resize(points.size(), 7);
  for (const unsigned threads : {1U, 3U}) {
    const auto hulls = concave_hulls(points, labels, {.threads = threads}, {.cover = true, .one = true});
    ASSERT_EQ(hulls.size(), 2U);
    for (const LabelledHull& hull : hulls) {
      ASSERT_EQ(hull.shape.polygon_count(), 1U);
      const std::vector<Point> own(
          points.begin() + (hull.label == 5 ? 0 : static_cast<long>(before)),
          hull.label == 5 ? points.begin() + static_cast<long>(before) : points.end());
      EXPECT_TRUE(covers_all(to_coordinates(hull.shape, points), own));
    }
  }
}

TEST(WidenedHull, OfNothingWithAnAreaIsEmptyAndBadInputIsRefused) {
  for (const std::vector<Point>& flat : {std::vector<Point>{}, {{1, 2}}, {{0, 0}, {1, 1}, {2, 2}}}) {
    EXPECT_EQ(concave_hull(flat, {}, {.cover = true, .one = true}).polygon_count(), 0U);
  }
  const std::vector<Point> points = two_squares();
  EXPECT_THROW(concave_hull(points, {.alpha = -1}, {.cover = true}), std::invalid_argument);
  EXPECT_THROW(concave_hull(points, {.detail = 0}, {.one = true}), std::invalid_argument);
  // No multiple of 0 is a limit, so that there is none in the end.
  EXPECT_TRUE(
      covers_all(to_coordinates(concave_hull(points, {.alpha = 0}, {.cover = true}), points), points));
  Extractor extractor;
  EXPECT_THROW(
      widened_hull(extractor, points, {}, {.cover = true}, [] { throw std::runtime_error("enough"); }),
      std::runtime_error);
}

}  // namespace
}  // namespace polylidar
