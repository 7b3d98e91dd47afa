// Points that lie on outlines only: what these enclose is the shape. Points with an inside are not taken for
// that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/src/automatic_limit.hpp"
#include "core/src/delaunay_builder.hpp"
#include "core/src/thread_pool.hpp"
#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::hole_count;
using testing::Random;

/// Points along a circle, one at random in each of as many arcs of length 1 as fit, and moved off it by
/// chance.
void add_circle(std::vector<Point>& points, const Point& centre, double radius, Random& random) {
  const int count = static_cast<int>(2 * std::numbers::pi * radius);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.unit()) / count;
    const double distance = radius + random.between(-0.2, 0.2);
    points.push_back({centre.x + distance * std::cos(angle), centre.y + distance * std::sin(angle)});
  }
}

double disc(double radius) {
  return std::numbers::pi * radius * radius;
}

/// A disc with a round hole in which an island lies, and another disc beside it.
std::vector<Point> ring_island_and_disc(std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points;
  add_circle(points, {0, 0}, 200, random);
  add_circle(points, {20, 0}, 120, random);
  add_circle(points, {20, 10}, 50, random);
  add_circle(points, {350, 0}, 90, random);
  return points;
}

bool is_by_outlines(const std::vector<Point>& points, const Options& options = {}) {
  Extractor extractor;
  extractor.extract(points, options);
  return extractor.statistics().by_outlines;
}

TEST(OutlineFill, FillsWhatOutlinesEnclose) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Point> points = ring_island_and_disc(seed);
    Extractor extractor;
    const IndexedMultiPolygon& shape = extractor.extract(points);
    EXPECT_TRUE(extractor.statistics().by_outlines);
    ASSERT_EQ(check_polygon(points, shape), "");
    const MultiPolygon polygons = to_coordinates(shape, points);
    EXPECT_EQ(polygons.size(), 3U);
    EXPECT_EQ(hole_count(polygons), 1U);
    const double truth = disc(200) - disc(120) + disc(50) + disc(90);
    EXPECT_NEAR(area(polygons) / truth, 1, 0.02);
  }
}

// A sorted outline's gaps are known; one step bridges them all but no wall.
TEST(OutlineFill, TellsTheStepInTheUnitOfThePoints) {
  for (const double unit : {1.0, 1e-200, 1e200}) {
    SCOPED_TRACE(unit);
    std::vector<Point> points = ring_island_and_disc(1);
    for (Point& point : points) point = {point.x * unit, point.y * unit};
    Extractor extractor;
    extractor.extract(points);
    EXPECT_GT(extractor.statistics().outline_step, 1 * unit);
    EXPECT_LT(extractor.statistics().outline_step, 70 * unit);  // the walls of 120 and 50 are that far apart
    extractor.extract(points, {.alpha = unit});
    EXPECT_EQ(extractor.statistics().outline_step, 0);
  }
  Extractor extractor;
  extractor.extract(testing::circle(100, 10));
  EXPECT_EQ(extractor.statistics().outline_step, kNoLimit);
}

/// The border of the square [0, side]^2 in steps of 1.
std::vector<Point> border_of_square(int side) {
  std::vector<Point> points;
  for (int i = 0; i < side; ++i) {
    const double along = i;
    const double end = side;
    points.insert(points.end(), {{along, 0}, {end, along}, {end - along, end}, {0, end - along}});
  }
  return points;
}

// Points on one line or one circle to the last bit, and repeats.
TEST(OutlineFill, TakesDegenerateOutlines) {
  struct Outline {
    std::string name;
    std::vector<Point> points;
    double area;
  };
  std::vector<Outline> outlines = {{"circle", testing::circle(1000, 10), disc(10)},
                                   {"square", border_of_square(100), 100 * 100}};
  outlines.push_back({"turned square", testing::rotated(border_of_square(100), 0.3), 100 * 100});
  outlines.push_back(outlines[1]);
  outlines.back().name = "square with repeats";
  for (int i = 0; i < 3; ++i) {
    const std::vector<Point> square = border_of_square(100);
    outlines.back().points.insert(outlines.back().points.end(), square.begin(), square.end());
  }
  for (const auto& [name, points, area_of_shape] : outlines) {
    SCOPED_TRACE(name);
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const std::vector<Point> shuffled = testing::shuffled(points, seed);
      const IndexedMultiPolygon shape = concave_hull(shuffled);
      ASSERT_EQ(check_polygon(shuffled, shape), "");
      EXPECT_TRUE(is_by_outlines(shuffled));
      EXPECT_NEAR(area(to_coordinates(shape, shuffled)) / area_of_shape, 1, 0.01);
    }
  }
}

// With so few points a circle's steps are not much shorter than what they enclose.
TEST(OutlineFill, FewPointsOnTheirHullEncloseIt) {
  std::vector<std::pair<std::vector<Point>, double>> outlines = {{border_of_square(10), 100},
                                                                 {border_of_square(40), 1600}};
  for (const std::size_t count : {12U, 16U, 24U, 60U, 90U, 200U}) {
    const std::vector<Point> corners = testing::circle(count, 1);
    outlines.emplace_back(corners, signed_area(corners));
  }
  for (const auto& [outline, area_of_shape] : outlines) {
    SCOPED_TRACE(outline.size());
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const std::vector<Point> points = testing::shuffled(outline, seed);
      for (const double detail : {0.5, 1.0, 2.0}) {
        const IndexedMultiPolygon shape = concave_hull(points, {.detail = detail});
        ASSERT_EQ(check_polygon(points, shape), "");
        EXPECT_EQ(shape.polygon_count(), 1U);
        EXPECT_NEAR(area(to_coordinates(shape, points)) / area_of_shape, 1, 1e-9);
      }
    }
  }
}

// All of these are on their hull, too, but their triangles are not flat.
TEST(OutlineFill, RowsStayApart) {
  std::vector<Point> points;
  for (int i = 0; i < 5; ++i) {
    for (const int y : {0, 1}) points.insert(points.end(), {{1.0 * i, 1.0 * y}, {30.0 + i, 1.0 * y}});
  }
  const IndexedMultiPolygon shape = concave_hull(points);
  EXPECT_EQ(shape.polygon_count(), 2U);
  EXPECT_DOUBLE_EQ(area(to_coordinates(shape, points)), 8);
}

TEST(OutlineFill, KeepsAFilledPartInside) {
  Random random(1);
  std::vector<Point> points;
  add_circle(points, {0, 0}, 200, random);
  for (int i = 0; i < 400; ++i) points.push_back({random.between(-10, 10), random.between(-10, 10)});
  const MultiPolygon polygons = to_coordinates(concave_hull(points), points);
  EXPECT_TRUE(is_by_outlines(points));
  EXPECT_EQ(polygons.size(), 1U);
  EXPECT_EQ(hole_count(polygons), 0U);
  EXPECT_NEAR(area(polygons) / disc(200), 1, 0.02);
}

TEST(OutlineFill, LessDetailJoinsWhatIsApartAndMoreChangesNothing) {
  const std::vector<Point> points = ring_island_and_disc(1);
  double before = std::numeric_limits<double>::infinity();
  for (const double detail : {1e-200, 0.05, 0.2, 0.5, 0.8, 1.0, 1.1, 3.0, 1e200}) {
    SCOPED_TRACE(detail);
    Extractor extractor;
    const IndexedMultiPolygon& shape = extractor.extract(points, {.detail = detail});
    ASSERT_EQ(check_polygon(points, shape), "");
    EXPECT_TRUE(extractor.statistics().by_outlines);
    EXPECT_LE(area(to_coordinates(shape, points)), before * (1 + 1e-12));
    before = area(to_coordinates(shape, points));
    if (detail < 0.1) {
      EXPECT_EQ(shape.polygon_count(), 1U);
    } else if (detail > 1) {
      EXPECT_EQ(shape, concave_hull(points));
    }
  }
}

TEST(OutlineFill, DependsNeitherOnOrderNorUnitNorThreads) {
  const std::vector<Point> points = ring_island_and_disc(2);
  const IndexedMultiPolygon shape = concave_hull(points);
  for (const unsigned threads : {2U, 3U, 8U}) EXPECT_EQ(concave_hull(points, {.threads = threads}), shape);
  for (const int exponent : {-1000, 1000}) {
    EXPECT_EQ(concave_hull(testing::scaled(points, exponent, exponent)), shape) << exponent;
  }
  const std::vector<Point> shuffled = testing::shuffled(points, 1);
  EXPECT_DOUBLE_EQ(area(to_coordinates(concave_hull(shuffled), shuffled)),
                   area(to_coordinates(shape, points)));
}

TEST(OutlineFill, IsForTheLimitThatIsChosen) {
  const std::vector<Point> points = ring_island_and_disc(3);
  Extractor extractor;
  extractor.extract(points);
  ASSERT_TRUE(extractor.statistics().by_outlines);
  extractor.extract(points, {.alpha = 2});
  EXPECT_FALSE(extractor.statistics().by_outlines);
  // Step by step, as with all at once.
  extractor.triangulate(points);
  EXPECT_FALSE(extractor.statistics().by_outlines);
  extractor.extract_regions({});
  EXPECT_TRUE(extractor.statistics().by_outlines);
  EXPECT_EQ(extractor.extract_polygons(), concave_hull(points));
}

TEST(OutlineFill, IsNotForAnOpenLine) {
  std::vector<Point> points;
  Random random(1);
  add_circle(points, {0, 0}, 200, random);
  std::erase_if(points, [](const Point& p) { return p.x > 0; });
  EXPECT_FALSE(is_by_outlines(points));
}

/// Whether the points are asked for what outlines enclose, which then may say that they are none.
bool is_asked(const std::vector<Point>& points) {
  detail::ThreadPool pool;
  detail::DelaunayBuilder builder;
  builder.build(points, pool);
  detail::AutomaticLimit limit;
  limit.choose_by_blocks(builder, 1, pool);
  return limit.field().outlines.has_value();
}

/// Uniform in the strip of this width along the border of a rectangle of 10 x 1.
std::vector<Point> frame(std::size_t count, double width, std::uint64_t seed) {
  return testing::points_where(count, seed, 10, 1, [&](const Point& p, Random&) {
    return std::min({p.x, 10 - p.x, p.y, 1 - p.y}) < width;
  });
}

/// Lines at a distance of 1, along which points are a tenth of that apart.
std::vector<Point> lines(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points;
  const auto across = static_cast<int>(std::sqrt(static_cast<double>(count) / 10));
  for (int line = 0; line < across; ++line) {
    for (int k = 0; k < 10 * across; ++k) {
      points.push_back({(k + random.unit()) / 10.0, line + 0.01 * random.unit()});
    }
  }
  return points;
}

TEST(OutlineFill, IsAskedOfFlatTrianglesAcrossWideGaps) {
  EXPECT_TRUE(is_asked(ring_island_and_disc(1)));
  EXPECT_TRUE(is_asked(testing::circle(400, 1)));
  EXPECT_TRUE(is_asked(testing::circle(200, 1))) << "few, but on their hull";
  std::vector<Point> with_an_inside = testing::circle(24, 1);
  with_an_inside.push_back({0, 0});
  EXPECT_FALSE(is_asked(with_an_inside)) << "few";
  EXPECT_FALSE(is_asked(frame(3000, 0.03, 1))) << "across wide gaps, but not flat";
  EXPECT_FALSE(is_asked(lines(3000, 1))) << "flat, but not across wide gaps";
}

// A step over all records would find hardly a triangle.
TEST(OutlineFill, IsAskedWhereMostPointsAreCopies) {
  std::vector<Point> curve;
  for (int i = 0; i < 300; ++i) curve.push_back({static_cast<double>(i), 1e-6 * i * i});
  EXPECT_TRUE(is_asked(curve));
  for (const std::size_t copies : {635'292U, 737'983U}) {
    std::vector<Point> points(copies, Point{0, 0});
    points.insert(points.end(), curve.begin(), curve.end());
    EXPECT_TRUE(is_asked(points)) << copies;
  }
}

// A ring that is closed by its first point, as in many files, has as many points as without it.
TEST(OutlineFill, OfEightPointsOnAConvexOutlineIsTheHullAlsoIfTheRingIsClosed) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    testing::Random random(seed);
    for (const int count : {7, 8, 9}) {
      std::vector<Point> ring;
      for (int i = 0; i < count; ++i) {
        const double angle = random.between(0, 6.283);
        ring.push_back({3 * std::cos(angle), std::sin(angle)});
      }
      std::vector<Point> closed = ring;
      closed.push_back(ring[0]);
      EXPECT_EQ(area(to_coordinates(concave_hull(closed), closed)),
                area(to_coordinates(concave_hull(ring), ring)))
          << seed << ", " << count;
    }
  }
}

// Everything that has an inside, and scan lines, which are no outlines.
TEST(OutlineFill, IsNotForPointsWithAnInside) {
  std::vector<testing::PointSet> sets;
  for (const std::size_t count : {100U, 500U, 3000U}) {
    sets.push_back({"uniform", testing::uniform_points(count, count)});
    sets.push_back({"a frame", frame(count, 100.0 / static_cast<double>(count), count)});
    testing::PointSet far{"an island far away", testing::uniform_points(count, 1)};
    for (std::size_t i = 0; i < count / 2; ++i) far.points[i].x += 30;
    sets.push_back(std::move(far));
    sets.push_back({"lines", lines(count, count)});
  }
  for (const auto& [name, points] : sets) EXPECT_FALSE(is_by_outlines(points)) << name << points.size();
}

}  // namespace
}  // namespace polylidar
