// The triangles in a few windows are those of the whole triangulation, and where the density is uneven there
// are none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/src/filter_rules.hpp"
#include "core/src/number_counts.hpp"
#include "core/src/window_sample.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::detail {
namespace {

using Points = std::vector<Point>;
constexpr WindowSample::Wanted kWanted{.most_spread = 0.12, .margin = 2.8, .quantile = 0.6};

bool looks(WindowSample& sample, const Points& points, unsigned threads = 1) {
  ThreadPool pool;
  pool.use(threads);
  return sample.look(passes_over(points, pool), bounding_box(points), kWanted, pool);
}

// Doubled areas of all triangles of the whole triangulation, ascending.
std::vector<double> areas_of_all(const Points& points) {
  const Triangulation whole = delaunay(points);
  std::vector<double> areas;
  for (std::size_t t = 0; t < whole.triangles.size(); t += 3) {
    const auto corner = [&](std::size_t k) { return points[whole.triangles[t + k]]; };
    const Point a = corner(0);
    const Point b = corner(1);
    const Point c = corner(2);
    areas.push_back((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  }
  std::sort(areas.begin(), areas.end());
  return areas;
}

TEST(WindowSample, HasTrianglesOfTheWholeTriangulation) {
  WindowSample sample;
  const Points points = testing::uniform_points(50'000, 1);
  ASSERT_TRUE(looks(sample, points));
  ASSERT_EQ(sample.window_ends().size(), WindowSample::kMostWindows);
  EXPECT_EQ(sample.window_ends().back(), sample.triangles().size());
  EXPECT_GT(sample.triangles().size(), 3000U);
  EXPECT_LT(sample.triangles().size(), 8000U);
  EXPECT_EQ(sample.distinct_share(), 1);
  const std::vector<double> areas = areas_of_all(points);
  std::size_t narrow = 0;
  for (const WindowSample::Measured& one : sample.triangles()) {
    if (one.squared_radius > sample.margin() * sample.margin()) continue;
    ++narrow;
    const double rounding = 1e-15;
    const auto next = std::lower_bound(areas.begin(), areas.end(), one.twice_area - rounding);
    ASSERT_TRUE(next != areas.end() && *next <= one.twice_area + rounding) << one.twice_area;
  }
  EXPECT_GT(narrow, 0.99 * static_cast<double>(sample.triangles().size()));
}

TEST(WindowSample, HasFewWindowsOfFewPoints) {
  WindowSample sample;
  ASSERT_TRUE(looks(sample, testing::uniform_points(8'000, 1)));
  EXPECT_EQ(sample.window_ends().size(), 7U);
  ASSERT_TRUE(looks(sample, testing::uniform_points(20'000, 1)));
  EXPECT_EQ(sample.window_ends().size(), 17U);
  // Strips, of which little more than half lies well inside.
  Points points = testing::uniform_points(20'000, 2);
  std::erase_if(points, [](const Point& p) { return std::fmod(p.y, 0.3) > 0.15; });
  ASSERT_GT(points.size(), WindowSample::kLeastPoints);
  EXPECT_FALSE(looks(sample, points));
}

// Counted by their circumcentres, triangles have in the windows the sizes that they have in the whole.
TEST(WindowSample, HasTheAreasOfTheWhole) {
  WindowSample sample;
  double twice_area = 0;
  std::size_t count = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    ASSERT_TRUE(looks(sample, testing::uniform_points(40'000, seed)));
    for (const WindowSample::Measured& one : sample.triangles()) twice_area += one.twice_area;
    count += sample.triangles().size();
  }
  // Two triangles a point; and as windows are where points are, there is one point more in 64.
  EXPECT_NEAR(twice_area / static_cast<double>(count), 64.0 / 65 / 40'000, 0.015 / 40'000);
}

TEST(WindowSample, DependsNeitherOnTheOrderNorOnTheThreads) {
  WindowSample sample;
  const Points points = testing::uniform_points(40'000, 3);
  ASSERT_TRUE(looks(sample, points));
  for (const unsigned threads : {1U, 2U, 3U, 20U}) {
    SCOPED_TRACE(threads);
    WindowSample other;
    ASSERT_TRUE(looks(other, testing::shuffled(points, 7), threads));
    ASSERT_EQ(sample.window_ends(), other.window_ends());
    for (std::size_t i = 0; i < sample.triangles().size(); ++i) {
      EXPECT_EQ(sample.triangles()[i].size4, other.triangles()[i].size4);
      EXPECT_EQ(sample.triangles()[i].twice_area, other.triangles()[i].twice_area);
    }
  }
}

TEST(WindowSample, KnowsWhichPointsRepeatOthers) {
  WindowSample sample;
  Points points = testing::uniform_points(20'000, 4);
  points.insert(points.end(), points.begin(), points.end());
  ASSERT_TRUE(looks(sample, points));
  EXPECT_EQ(sample.distinct_share(), 0.5);
}

TEST(WindowSample, IsNotForFewNorForUnevenPoints) {
  WindowSample sample;
  EXPECT_TRUE(looks(sample, testing::lattice(200, 200)));
  EXPECT_FALSE(looks(sample, testing::uniform_points(WindowSample::kLeastPoints - 1, 1))) << "few";
  EXPECT_FALSE(looks(sample, testing::lattice(40'000, 1))) << "a line";
  EXPECT_FALSE(looks(sample, testing::lattice(20'000, 2))) << "a strip";
  EXPECT_FALSE(looks(sample, Points(40'000, Point{1, 2}))) << "one point";
  EXPECT_FALSE(looks(sample, testing::circle(40'000, 1))) << "no inside";
  Points points = testing::uniform_points(60'000, 5);
  for (Point& p : points) p.x = std::exp2(4 * p.x);  // 16 : 1
  EXPECT_FALSE(looks(sample, points)) << "a gradient";
  points = testing::uniform_points(60'000, 6);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i] = {points[i].x / 10, points[i].y / 10};
  EXPECT_FALSE(looks(sample, points)) << "a dense corner";
  points = testing::uniform_points(60'000, 7);
  for (std::size_t i = 0; i < points.size(); i += 2) points[i] = {0.5, 0.5};
  EXPECT_FALSE(looks(sample, points)) << "half of the points at one place";
}

// Counts of cells have 32 bits: what is counted then lacks as many points.
TEST(WindowSample, IsNotForMorePointsInACellThanCanBeCounted) {
  WindowSample sample;
  ThreadPool pool;
  const Points points = testing::uniform_points(40'000, 8);
  PointPasses passes = passes_over(points, pool);
  passes.points += std::uint64_t{1} << 32U;
  EXPECT_FALSE(sample.look(passes, bounding_box(points), kWanted, pool));
}

constexpr WindowSample::WantedPlaces kWantedPlaces{.margin = 2.8, .quantile = 0.6, .points_in_circle = 21};

bool looks_by_places(WindowSample& sample, const Points& points, unsigned threads = 1) {
  ThreadPool pool;
  pool.use(threads);
  constexpr WindowSample::Wanted kEven{.most_spread = 0.03, .margin = 2.8, .quantile = 0.6};
  const PointPasses passes = passes_over(points, pool);
  return !sample.look(passes, bounding_box(points), kEven, pool) &&
         sample.look_by_places(passes, kWantedPlaces, pool);
}

/// Points of the unit square, three times as dense at its right side as at its left.
Points denser_to_the_right(std::size_t count, std::uint64_t seed) {
  return testing::points_where(count, seed, 1, 1, [](const Point& p, testing::Random& random) {
    return random.between(0, 1) < (1 + 2 * p.x) / 3;
  });
}

TEST(WindowSample, HasAPlaceForEveryPoint) {
  WindowSample sample;
  const Points points = denser_to_the_right(300'000, 1);
  ASSERT_TRUE(looks_by_places(sample, points, 2));
  std::vector<std::uint32_t> place_of(points.size());
  EXPECT_TRUE(sample.places_of(points, place_of.data()));
  std::vector<double> count(sample.places().size());
  for (const std::uint32_t place : place_of) {
    ASSERT_LT(place, count.size());
    ++count[place];
  }
  ASSERT_EQ(sample.window_ends().size(), count.size());
  for (std::size_t p = 0; p < count.size(); ++p) {
    EXPECT_EQ(sample.places()[p].points, count[p]);
    EXPECT_LE(count[p], 4096);
  }
  // Of points at random a usual size is 1.17 spacings, wherever they are denser.
  double squares = 0;
  double known = 0;
  for (const WindowSample::Place& place : sample.places()) {
    if (!std::isfinite(place.usual4)) continue;
    squares += place.points * std::sqrt(place.usual4);
    known += place.points;
  }
  EXPECT_GT(known, 0.95 * 300'000);
  EXPECT_NEAR(squares, 1.36, 0.08);
  for (const auto& [place, neighbour] : sample.borders()) {
    EXPECT_LT(place, neighbour);
    EXPECT_LT(neighbour, count.size());
  }
  EXPECT_GT(sample.borders().size(), 2 * count.size());
}

TEST(WindowSample, HasNoPlaceForAPointThatLiesWhereNoneDid) {
  WindowSample sample;
  Points points = denser_to_the_right(300'000, 1);
  std::erase_if(points, [](const Point& p) { return std::hypot(p.x - 0.5, p.y - 0.5) < 0.1; });
  ASSERT_TRUE(looks_by_places(sample, points));
  std::vector<std::uint32_t> place_of(2);
  EXPECT_FALSE(sample.places_of(Points{points[0], {0.5, 0.5}}, place_of.data()));
  EXPECT_LT(place_of[0], sample.places().size());
  EXPECT_EQ(place_of[1], kNone);
}

TEST(WindowSample, OfPlacesDependsNeitherOnTheOrderNorOnTheThreads) {
  WindowSample sample;
  const Points points = denser_to_the_right(300'000, 2);
  ASSERT_TRUE(looks_by_places(sample, points));
  for (const unsigned threads : {2U, 3U, 20U}) {
    SCOPED_TRACE(threads);
    WindowSample other;
    ASSERT_TRUE(looks_by_places(other, testing::shuffled(points, 7), threads));
    ASSERT_EQ(sample.window_ends(), other.window_ends());
    for (std::size_t p = 0; p < sample.places().size(); ++p) {
      EXPECT_EQ(sample.places()[p].usual4, other.places()[p].usual4);
    }
    EXPECT_EQ(sample.borders(), other.borders());
  }
}

TEST(WindowSample, OfPlacesIsNotForFewNorForVeryUnevenPoints) {
  WindowSample sample;
  EXPECT_FALSE(looks_by_places(sample, denser_to_the_right(200'000, 3))) << "few";
  Points points = testing::uniform_points(300'000, 4);
  for (Point& p : points) p.x = std::exp2(6 * p.x);  // 64 : 1
  EXPECT_FALSE(looks_by_places(sample, points)) << "a gradient";
  const Points centres = testing::uniform_points(60'000, 5);
  testing::Random random(6);
  points.clear();
  for (std::size_t i = 0; i < 1'000'000; ++i) {  // about as far from their centre as points are apart
    const Point& centre = centres[random.below(centres.size())];
    const double angle = random.between(0, 6.3);
    const double away = random.between(0, 0.003);
    points.push_back({centre.x + away * std::cos(angle), centre.y + away * std::sin(angle)});
  }
  EXPECT_FALSE(looks_by_places(sample, points)) << "clusters";
  EXPECT_FALSE(looks_by_places(sample, testing::circle(300'000, 1))) << "no inside";
}

TEST(NumberCounts, HasTheMedianAndTheDeviationOfAllNumbers) {
  testing::Random random(3);
  for (std::size_t count = 1; count < 200; ++count) {
    // Some below 256, each of which counts as itself, and some far above.
    const std::size_t most = count % 3 == 0 ? 200'000 : 255;
    NumberCounts counts;
    counts.clear();
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = static_cast<std::uint32_t>(1 + random.below(most));
      counts.add(number);
      numbers.push_back(number);
    }
    ASSERT_EQ(counts.total(), count);
    std::sort(numbers.begin(), numbers.end());
    const double median = numbers[count / 2];
    const double accuracy = most < 256 ? 0 : 0.004;
    EXPECT_NEAR(counts.median(), median, accuracy * median);
    std::vector<double> distances(numbers.size());
    std::transform(numbers.begin(), numbers.end(), distances.begin(),
                   [&](double number) { return std::abs(std::log(number / median)); });
    std::sort(distances.begin(), distances.end());
    const double expected = distances[std::min(count - 1, count * 9 / 10)] / 1.645;
    EXPECT_NEAR(counts.robust_deviation_of_logarithms(median), expected, accuracy + 1e-12);
  }
}

}  // namespace
}  // namespace polylidar::detail
