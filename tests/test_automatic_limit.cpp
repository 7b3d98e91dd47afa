// The limit that is chosen when none is given: what it does not depend on, and what it must find.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/src/automatic_limit.hpp"
#include "core/src/delaunay_builder.hpp"
#include "core/src/outliers.hpp"
#include "core/src/region.hpp"
#include "core/src/spacings.hpp"
#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/checked_hull.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::checked_hull;
using testing::hole_count;
using testing::PointSet;

std::optional<ChosenSizes> chosen(const std::vector<Point>& points, const Options& options = {}) {
  Extractor extractor;
  extractor.extract(points, options);
  return extractor.chosen_sizes();
}

/// Of points that have a triangle.
double median_size(const std::vector<Point>& points) {
  return chosen(points).value().median;
}

template <class Map>
std::vector<Point> mapped(std::vector<Point> points, const Map& map) {
  std::transform(points.begin(), points.end(), points.begin(), map);
  return points;
}

/// Uniform points of the square [0, 10)^2 without a disc of radius 2 in its middle, and of a square of side 2
/// at a distance of 2 from it.
std::vector<Point> ring_and_island(std::size_t count, std::uint64_t seed) {
  return testing::points_where(count, seed, 14, 10, [](const Point& p, testing::Random&) {
    const bool in_square = p.x < 10 && std::hypot(p.x - 5, p.y - 5) > 2;
    return in_square || (p.x > 12 && p.y > 4 && p.y < 6);
  });
}

/// Points of the unit square, `ratio` times as far apart at its right side as at its left.
std::vector<Point> sparser_to_the_right(std::size_t count, double ratio, std::uint64_t seed) {
  return testing::points_where(count, seed, 1, 1, [&](const Point& p, testing::Random& random) {
    const double spacing = 1 + (ratio - 1) * p.x;
    return random.between(0, 1) < 1 / (spacing * spacing);
  });
}

/// `points`, and `count` uniform ones of the square with this side and lower left corner.
std::vector<Point> with_square(const std::vector<Point>& points, std::size_t count, std::uint64_t seed,
                               double side, Point corner) {
  return testing::joined(points, testing::transformed(testing::uniform_points(count, seed, side), 1, corner));
}

// when it is chosen, and when not

TEST(AutomaticLimit, IsForThoseWhoGiveNone) {
  const std::vector<Point> points = testing::uniform_points(500, 1);
  Extractor extractor;
  extractor.triangulate(points);
  const auto limits = [&](const Options& options) {
    extractor.extract_regions(options);
    return extractor.limits();
  };
  for (const Options& given : {Options{.alpha = 0.1}, Options{.max_edge_length = 0.1},
                               Options{.max_perimeter = 0.3}, Options{.alpha = kNoLimit}}) {
    EXPECT_EQ(limits(given).alpha, given.alpha.value_or(kNoLimit));
    EXPECT_EQ(limits(given).max_edge_length, given.max_edge_length.value_or(kNoLimit));
    EXPECT_EQ(limits(given).max_perimeter, given.max_perimeter.value_or(kNoLimit));
    EXPECT_EQ(extractor.chosen_sizes(), std::nullopt);
  }
  EXPECT_EQ(limits({}), Limits{});
  EXPECT_GT(extractor.chosen_sizes().value().least, 0);
  EXPECT_LT(extractor.chosen_sizes().value().most, 1);
}

TEST(AutomaticLimit, AlwaysKeepsATriangle) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    Extractor extractor;
    extractor.triangulate(set.points);
    EXPECT_EQ(extractor.has_triangles(), !delaunay(set.points).triangles.empty());
    EXPECT_EQ(extractor.extract(set.points).polygon_count() > 0, extractor.has_triangles());
    EXPECT_EQ(check_polygon(set.points, concave_hull(set.points)), "");
  }
}

TEST(AutomaticLimit, OfPointsWithoutATriangleIsNone) {
  for (const PointSet& set : testing::flat_point_sets()) {
    SCOPED_TRACE(set.name);
    EXPECT_EQ(chosen(set.points), std::nullopt);
    EXPECT_TRUE(checked_hull(set.points).empty());
  }
}

TEST(AutomaticLimit, OfThreePointsKeepsTheirTriangle) {
  EXPECT_EQ(checked_hull({{0, 0}, {4, 0}, {0, 3}}).size(), 1U);
  EXPECT_EQ(checked_hull({{0, 0}, {1e6, 0}, {5e5, 1e-3}}).size(), 1U) << "a flat one";
  const double ulp = 0x1p-52;
  EXPECT_EQ(checked_hull({{0, 0}, {1 + ulp, 1}, {2 + 4 * ulp, 2 + 2 * ulp}}).size(), 1U)
      << "one whose area is zero by rounding";
}

// Of so many records but a few are used, so that a sample of them finds one or none.
TEST(AutomaticLimit, OfThreePointsWithManyCopiesKeepsTheirTriangle) {
  const std::vector<Point> corners{{0, 0}, {0, 1}, {1, 0}};
  for (const auto& copies :
       {std::vector<std::size_t>{2000, 4000, 2000}, {1000, 3000, 3900}, {4000, 4000, 190}}) {
    std::vector<Point> points;
    for (std::size_t k = 0; k < corners.size(); ++k) points.insert(points.end(), copies[k], corners[k]);
    EXPECT_EQ(checked_hull(points).size(), 1U) << copies[0];
  }
}

TEST(AutomaticLimit, OfAnExtractorIsForItsPointsAlone) {
  const std::vector<Point> few = testing::uniform_points(300, 11);
  const std::vector<Point> many = testing::uniform_points(40000, 12);  // of which it looks at a part
  Extractor extractor;
  for (const auto* points : {&few, &many, &few}) {
    EXPECT_EQ(extractor.extract(*points), concave_hull(*points));
    EXPECT_EQ(extractor.extract(*points, {.alpha = 0.02}), concave_hull(*points, {.alpha = 0.02}));
  }
}

// what it is: the rule in its plainest words, where there is but one block

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// By how much the logarithm of one quantile over another is beyond what chance may add.
double plain_scatter(std::vector<double> lengths, std::size_t points, double small, double large,
                     double three_deviations) {
  if (lengths.empty()) return 0;
  std::sort(lengths.begin(), lengths.end());
  const auto quantile = [&](double share) {
    return lengths[static_cast<std::size_t>(share * static_cast<double>(lengths.size()))];
  };
  const double looked_at = static_cast<double>(std::min(points, lengths.size()));
  return std::log(quantile(large) / quantile(small)) - three_deviations / std::sqrt(looked_at);
}

/// By how much spacings scatter too much: of each triangle its first corner counts, and of the triangles
/// round this corner the third smallest. Its nearest neighbours must scatter, too.
double plain_excess(const std::vector<Point>& points, const Triangulation& mesh,
                    const std::vector<double>& sizes, const detail::AutomaticConstants& constants) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::map<std::uint32_t, std::vector<double>> sizes_at;
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e) sizes_at[mesh.triangles[e]].push_back(sizes[e / 3]);
  std::vector<double> spacings;
  std::vector<double> nearest;
  for (std::size_t t = 0; t < sizes.size(); ++t) {
    const std::uint32_t corner = mesh.triangles[3 * t];
    std::vector<double> round = sizes_at[corner];
    std::sort(round.begin(), round.end());
    if (round.size() > 2) spacings.push_back(round[2]);
    nearest.push_back(kInfinity);
    for (const Point& other : points) {
      const double apart = testing::distance(other, points[corner]);
      if (apart > 0) nearest.back() = std::min(nearest.back(), apart);
    }
  }
  if (plain_scatter(nearest, points.size(), 0.5, 0.85, 1.6) < 0.347) return 0;
  return std::max(plain_scatter(spacings, points.size(), 0.2, 0.6, 2.4) - constants.even, 0.0);
}

/// The size of the least cost for points that make one block.
double plain_size(const std::vector<Point>& points, const detail::AutomaticConstants& constants = {}) {
  const Triangulation mesh = delaunay(points);
  std::vector<double> sizes;
  std::vector<double> areas;
  std::size_t flat = 0;
  for (std::size_t e = 0; e < mesh.triangles.size(); e += 3) {
    const Ring triangle{points[mesh.triangles[e]], points[mesh.triangles[e + 1]],
                        points[mesh.triangles[e + 2]]};
    std::vector<double> edges;
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(testing::distance(triangle[k], triangle[(k + 1) % 3]));
    const double second_longest = median_of(edges);
    const double longest = *std::max_element(edges.begin(), edges.end());
    flat += 2 * std::abs(signed_area(triangle)) <= 0.17 * longest * longest ? 1U : 0U;
    areas.push_back(std::abs(signed_area(triangle)));
    sizes.push_back(
        std::max(std::pow(4 / std::sqrt(3) * second_longest * second_longest * areas.back(), 0.25),
                 second_longest / 2));
  }
  const double median = median_of(sizes);
  // 16 to the octave, 4 to one of their fourth powers; the median lies in a cell.
  const auto size = [&](int cell) {
    const double fourth_power = 0.125 * std::ldexp(1 + (cell & 3) / 4.0, cell >> 2) / 1.1;
    return std::pow(fourth_power, 0.25) * median;
  };
  const auto log_area = [&](double largest) {
    double sum = 0;
    for (std::size_t t = 0; t < areas.size(); ++t) sum += sizes[t] < largest ? areas[t] : 0;
    return std::log(sum);
  };
  double least_cost = std::numeric_limits<double>::infinity();
  const auto count = static_cast<double>(points.size());
  const double usual = constants.usual * std::sqrt(std::log(count)) * median;
  const double excess = 2 * flat >= sizes.size() ? 0 : plain_excess(points, mesh, sizes, constants);
  const double doubt = 1 + constants.doubt * excess;
  double best = usual;
  const int below = static_cast<int>(constants.below);
  const int above = static_cast<int>(constants.above);
  for (int cell = below; cell + above < 72; ++cell) {
    if (size(cell) < 1.2 * median || size(cell) > 8 * median) continue;
    const double low = size(cell - below);
    const double high = size(cell + above);
    const double growth = (log_area(high) - log_area(low)) / std::log(high / low);
    const double distance = std::log(size(cell) / usual);
    const double pull = constants.pull / std::pow(count, 0.2) / (distance > 0 ? doubt : 1);
    const double cost = std::log(growth + constants.still) + pull * distance * distance;
    if (cost < least_cost) {
      least_cost = cost;
      best = size(cell);
    }
  }
  return best;
}

TEST(AutomaticLimit, OfOneBlockIsWhatTheRuleSays) {
  std::vector<PointSet> sets{{"circle, half of its triangles ghosts", testing::circle(60, 1)},
                             {"lattice", testing::lattice(8, 8)},
                             {"three points", {{0, 0}, {4, 0}, {0, 3}}}};
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const std::string name = ", seed " + std::to_string(seed);
    sets.push_back({"60 points" + name, ring_and_island(60, seed)});
    const auto heavy_tailed = [](const Point& p) { return Point{std::tan(1.5 * p.x), std::tan(1.5 * p.y)}; };
    sets.push_back({"50 points" + name, mapped(testing::uniform_points(50, seed), heavy_tailed)});
    const auto on_two_lines = [](const Point& p) { return Point{p.x * p.x * p.x, p.y < 0.5 ? 0.0 : 1.0}; };
    sets.push_back({"60 points on lines" + name, mapped(testing::uniform_points(60, seed), on_two_lines)});
  }
  for (const PointSet& set : sets) {
    const ChosenSizes sizes = chosen(set.points).value();
    EXPECT_NEAR(sizes.median / plain_size(set.points), 1, 1e-12) << set.name;
    EXPECT_EQ(sizes.least, sizes.most) << set.name;
  }
}

// what it does not depend on

class AutomaticLimitRelations : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  // Integers, so that moving and scaling the points changes no rounding.
  const std::vector<Point> points_ = testing::integer_points(200 + 100 * GetParam(), GetParam(), 1 << 20);
  const IndexedMultiPolygon shape_ = concave_hull(points_);
};

TEST_P(AutomaticLimitRelations, PowersOfTwoScaleIt) {
  const double size = median_size(points_);
  for (const int exponent : {-1000, -30, 1, 30, 1000}) {
    const std::vector<Point> scaled = testing::scaled(points_, exponent, exponent);
    EXPECT_NEAR(std::ldexp(median_size(scaled), -exponent) / size, 1, 1e-12) << exponent;
    EXPECT_EQ(concave_hull(scaled), shape_) << exponent;
  }
}

TEST_P(AutomaticLimitRelations, PlaceAndOrderDoNotMatter) {
  const std::vector<Point> moved = mapped(points_, [](const Point& p) {
    return Point{p.x + 12345, p.y - 98765};
  });
  EXPECT_EQ(concave_hull(moved), shape_);
  const std::vector<Point> shuffled = testing::shuffled(points_, GetParam());
  EXPECT_DOUBLE_EQ(median_size(shuffled), median_size(points_));
  EXPECT_DOUBLE_EQ(area(checked_hull(shuffled)), area(to_coordinates(shape_, points_)));
}

// They move the borders of blocks.
TEST_P(AutomaticLimitRelations, RepeatsMatterNoMoreThanNoise) {
  const std::vector<Point> repeated = testing::shuffled(testing::repeated(points_, 60), GetParam());
  EXPECT_NEAR(median_size(repeated) / median_size(points_), 1, 0.2);
  EXPECT_NEAR(area(checked_hull(repeated)) / area(to_coordinates(shape_, points_)), 1, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AutomaticLimitRelations,
                         ::testing::Range(std::uint64_t{0}, std::uint64_t{12}));

TEST(AutomaticLimit, IsTheSameOnAnyNumberOfThreads) {
  for (const std::vector<Point>& points :
       {testing::repeated(testing::uniform_points(200, 2), 80), testing::uniform_points(40000, 2),
        sparser_to_the_right(30000, 5, 3)}) {
    for (const unsigned threads : {2U, 3U, 8U}) {
      EXPECT_EQ(chosen(points, {.threads = threads}), chosen(points)) << threads;
      EXPECT_EQ(concave_hull(points, {.threads = threads}), concave_hull(points)) << threads;
    }
  }
}

/// Points of a scanner whose lines zigzag across the unit square, six times as far from each other on average
/// as points along a line.
std::vector<Point> zigzag(int lines, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  const int shots = 6 * lines;
  std::vector<Point> points;
  for (int line = 0; line < lines; ++line) {
    const double phase = uniform(random);
    for (int shot = 0; shot < shots; ++shot) {
      const double across = (shot + phase) / shots;
      points.push_back({across, (line + (line % 2 == 0 ? across : 1 - across)) / lines});
    }
  }
  return points;
}

/// `count` points of the unit square in clusters of sixteen, each Gaussian and as wide as points would be
/// apart that are spread evenly.
std::vector<Point> clustered(std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Point> centres(count / 16);
  for (Point& centre : centres) centre = {uniform(random), uniform(random)};
  std::normal_distribution<double> off(0, 1 / std::sqrt(static_cast<double>(count)));
  std::vector<Point> points;
  while (points.size() < count) {
    const Point& centre = centres[random() % centres.size()];
    const Point p{centre.x + off(random), centre.y + off(random)};
    if (std::clamp(p.x, 0.0, 1.0) == p.x && std::clamp(p.y, 0.0, 1.0) == p.y) points.push_back(p);
  }
  return points;
}

// The points above are smooth, or make too few blocks to be smoothed.
class AutomaticLimitOfRoughPlaces : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Points, AutomaticLimitOfRoughPlaces, ::testing::Bool(),
                         [](const auto& instance) { return instance.param ? "Clusters" : "Zigzag"; });

TEST_P(AutomaticLimitOfRoughPlaces, DependsOnNothingElseEither) {
  const std::vector<Point> points = GetParam() ? clustered(5000, 1) : zigzag(40, 1);
  const IndexedMultiPolygon shape = concave_hull(points);
  for (const int exponent : {-1000, -30, 30, 1000}) {
    const std::vector<Point> scaled = testing::scaled(points, exponent, exponent);
    EXPECT_EQ(concave_hull(scaled), shape) << exponent;
  }
  const std::vector<Point> shuffled = testing::shuffled(points, 1);
  EXPECT_DOUBLE_EQ(median_size(shuffled), median_size(points));
  EXPECT_DOUBLE_EQ(area(checked_hull(shuffled)), area(to_coordinates(shape, points)));
  for (const unsigned threads : {2U, 3U, 8U}) {
    EXPECT_EQ(chosen(points, {.threads = threads}), chosen(points)) << threads;
    EXPECT_EQ(concave_hull(points, {.threads = threads}), shape) << threads;
  }
}

// the field

TEST(AutomaticLimit, IsOneLimitWherePointsAreUniform) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const ChosenSizes sizes = chosen(testing::uniform_points(4000, seed)).value();
    EXPECT_LT(sizes.most / sizes.least, 1.3) << seed;
  }
}

TEST(AutomaticLimit, FollowsTheDensity) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::vector<Point> points = sparser_to_the_right(20000, 8, seed);
    const ChosenSizes sizes = chosen(points).value();
    EXPECT_GT(sizes.most / sizes.least, 4) << seed;
    EXPECT_LT(sizes.most / sizes.least, 16) << seed;
    // With one limit for all the right side falls to pieces or the left one's notches are closed.
    const MultiPolygon shape = checked_hull(points);
    EXPECT_EQ(shape.size(), 1U) << seed;
    EXPECT_EQ(hole_count(shape), 0U) << seed;
    EXPECT_GT(area(shape), 0.97) << seed;
  }
}

// Of many points whose density varies by a few times, the sizes are found place by place before anything is
// triangulated, so the interior need not be.
TEST(AutomaticLimit, FollowsTheDensityOfManyPointsWithoutTheirInterior) {
  const std::vector<Point> points = sparser_to_the_right(300'000, 1.8, 1);
  Extractor extractor;
  const IndexedMultiPolygon shape = extractor.extract(points);
  const ChosenSizes sizes = extractor.chosen_sizes().value();
  EXPECT_EQ(extractor.statistics().way, Way::kInteriorLeftOut);
  EXPECT_GT(sizes.most / sizes.least, 1.4);
  EXPECT_LT(sizes.most / sizes.least, 2.4);
  const MultiPolygon polygons = to_coordinates(shape, points);
  EXPECT_EQ(polygons.size(), 1U);
  EXPECT_EQ(hole_count(polygons), 0U);
  EXPECT_GT(area(polygons), 0.995);

  Extractor steps;
  steps.triangulate(points);
  steps.extract_regions({});
  EXPECT_EQ(steps.extract_polygons(), shape);
  EXPECT_EQ(steps.chosen_sizes(), sizes);
  for (const unsigned threads : {2U, 3U}) {
    EXPECT_EQ(extractor.extract(points, {.threads = threads}), shape) << threads;
    EXPECT_EQ(extractor.chosen_sizes(), sizes) << threads;
  }
  const std::vector<Point> shuffled = testing::shuffled(points, 1);
  EXPECT_DOUBLE_EQ(median_size(shuffled), sizes.median);
  EXPECT_EQ(testing::canonical(to_coordinates(concave_hull(shuffled), shuffled)),
            testing::canonical(polygons));
}

// A square has no notch that a wider limit would close, so the limit is above the usual one, which is about
// 1.04 in the unit of this test.
TEST(AutomaticLimit, OfManyPointsIsWiderWhereTheirAreaHardlyGrows) {
  constexpr double kCount = 400'000;
  std::vector<double> sizes;
  for (std::uint64_t seed = 0; seed < 7; ++seed) {
    const auto points = testing::uniform_points(static_cast<std::size_t>(kCount), seed);
    sizes.push_back(median_size(points) * std::sqrt(kCount / std::log(kCount)));
  }
  EXPECT_GT(median_of(sizes), 1.08);
}

TEST(AutomaticLimit, TakesOutliersOfManyPointsForNoSparsePart) {
  const std::vector<Point> points =
      with_square(sparser_to_the_right(300'000, 1.8, 2), 30'000, 3, 1.4, {-0.2, -0.2});
  const double whole = area(to_coordinates(concave_hull(points), points));
  EXPECT_GT(whole, 0.99);
  EXPECT_LT(whole, 1.02);
}

TEST(AutomaticLimit, TakesOutliersForNoSparsePart) {
  for (const std::size_t count : {2000U, 20000U}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const std::vector<Point> points =
          with_square(testing::uniform_points(count, seed), count / 50, seed + 100, 3, {-1, -1});
      EXPECT_LT(area(checked_hull(points)), 1.15) << count << " points, seed " << seed;
    }
  }
}

// Near the turns two lines meet, and the next two are twice as far apart as on average: blocks that lie in a
// narrow end must not cut comb teeth into the wide one beside it.
TEST(AutomaticLimit, TakesLinesThatMeetForNoDensity) {
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) sum += area(checked_hull(zigzag(36, seed)));
  EXPECT_GT(sum / 10, 0.96);
}

// The gaps between clusters are voids that are usual there, however large they are beside those in a cluster.
TEST(AutomaticLimit, JoinsClusters) {
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) sum += area(checked_hull(clustered(4000, seed)));
  EXPECT_GT(sum / 10, 0.8);  // 0.47 where gaps between clusters count as any others
}

TEST(AutomaticLimit, JoinsClustersOfRepeatedPoints) {
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    sum += area(checked_hull(testing::repeated(clustered(4000, seed), 20)));
  }
  EXPECT_GT(sum / 5, 0.7);
}

/// The mean area of the hull of `count` points in strokes, over the strokes' area: five rows and a column
/// that joins them, in a square of side 10. Every tenth point is an outlier if `has_outliers`.
double area_of_strokes(double width, std::size_t count, bool has_outliers) {
  const double true_area = 60 * width - 5 * width * width;
  double sum = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    testing::Random random(seed);
    std::vector<Point> points;
    while (points.size() < count) {
      const Point p{random.between(0, 10), random.between(0, 10)};
      const bool is_outlier = has_outliers && points.size() % 10 == 0;
      if (is_outlier || std::fmod(p.y, 2.0) < width || (p.x > 5 && p.x < 5 + width)) points.push_back(p);
    }
    sum += area(checked_hull(points)) / true_area;
  }
  return sum / 20;
}

TEST(AutomaticLimit, FewPointsOfThinStrokesAreEven) {
  const double mean = area_of_strokes(0.5, 600, false);
  EXPECT_LT(mean, 1.3);
  EXPECT_GT(mean, 0.7);
}

TEST(AutomaticLimit, ThinStrokesAmongOutliersAreEven) {
  EXPECT_LT(area_of_strokes(0.3, 1500, true), 1.0);
  EXPECT_GT(area_of_strokes(0.3, 1500, true), 0.7);
}

/// Whether the scatter of the spacings has any effect on the limit of these points.
bool are_uneven(const std::vector<Point>& points) {
  detail::DelaunayBuilder builder;
  detail::ThreadPool pool;
  builder.build(points, pool);
  detail::AutomaticLimit limit;
  limit.choose_by_blocks(builder, 1, pool);
  const ChosenSizes sizes = limit.range().value();
  limit.choose_by_blocks(builder, 1, pool, {.doubt = 0});
  return sizes != limit.range().value();
}

TEST(AutomaticLimit, TakesPointsAtRandomForEven) {
  int uneven = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const std::size_t count : {300U, 3000U}) {
      uneven += are_uneven(testing::uniform_points(count, seed)) ? 1 : 0;
      uneven += are_uneven(sparser_to_the_right(count, 4, seed)) ? 1 : 0;
    }
    EXPECT_TRUE(are_uneven(clustered(3000, seed))) << seed;
  }
  EXPECT_LE(uneven, 4);  // of 80
}

// Outliers lie far apart, and the points of the shape do not. That is no reason to join them.
TEST(AutomaticLimit, LeavesAFifthOfOutliersOut) {
  int joined = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<Point> points =
        with_square(testing::uniform_points(1600, seed), 400, seed + 100, 1.6, {-0.3, -0.3});
    joined += area(checked_hull(points)) > 1.5 ? 1 : 0;  // of 2.56
  }
  EXPECT_LE(joined, 2);  // of 20
}

/// Points of the unit square, and uniform outliers in the square of thrice its area round it.
std::vector<Point> square_in_outliers(std::size_t count, std::size_t outliers, std::uint64_t seed) {
  return with_square(testing::uniform_points(count, seed), outliers, seed + 100, 1.73, {-0.365, -0.365});
}

/// Whether the spacings of the points show outliers.
bool shows_outliers(const std::vector<Point>& points) {
  detail::ThreadPool pool;
  detail::DelaunayBuilder builder;
  builder.build(points, pool);
  const detail::SizedMesh sized = {builder.mesh(), builder.vertices(), nullptr};
  return detail::spacing4_of_outliers(sized, detail::look_around_some(sized),
                                      detail::AutomaticConstants{}.valley)
      .has_value();
}

// So many outliers fill blocks of their own, whose sizes a bound on growth from block to block does not stop.
TEST(AutomaticLimit, LeavesManyOutliersOut) {
  for (const std::size_t count : {4000U, 8000U, 30000U}) {
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const double found = area(checked_hull(square_in_outliers(count, count / 6, seed)));
      EXPECT_GT(found, 0.95) << count << " points, seed " << seed;
      EXPECT_LT(found, 1.1) << count << " points, seed " << seed;
    }
  }
}

// With so many, A(s) is stable again where nearly all triangles between outliers are kept. A limit so large
// is not taken.
TEST(AutomaticLimit, LeavesManyOutliersOutThatLieClose) {
  for (const std::size_t outliers : {2400U, 3000U, 3600U}) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      std::vector<Point> points =
          with_square(testing::uniform_points(12000, seed), outliers, seed + 100, 1.7, {-0.35, -0.35});
      points.push_back(points[seed]);  // the sample of the triangles is another one by that
      EXPECT_LT(area(checked_hull(points)), 1.15) << outliers << " outliers, seed " << seed;
    }
  }
}

// A step over records would keep step with the copies: it would look at all triangles, or at few.
TEST(AutomaticLimit, LeavesManyOutliersOutHoweverOftenPointsAreRepeated) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const std::vector<Point> points = square_in_outliers(12000, 3000, seed);
    const double once = area(checked_hull(points));
    std::vector<Point> repeated = points;
    for (int copies = 2; copies <= 8; ++copies) {
      repeated.insert(repeated.end(), points.begin(), points.end());
      EXPECT_NEAR(area(checked_hull(repeated)) / once, 1, 0.02) << seed << ", " << copies << " copies";
    }
  }
}

TEST(AutomaticLimit, LooksAtAThousandSpacingsHoweverOftenPointsAreRepeated) {
  detail::ThreadPool pool;
  const std::vector<Point> points = testing::uniform_points(20000, 1);
  std::vector<Point> repeated;
  for (int copies = 1; copies <= 16; ++copies) {
    repeated.insert(repeated.end(), points.begin(), points.end());
    detail::DelaunayBuilder builder;
    builder.build(repeated, pool);
    const std::size_t seen =
        detail::look_around_some({builder.mesh(), builder.vertices(), nullptr}).around.size();
    EXPECT_NEAR(static_cast<double>(seen), 1024, 80) << copies << " copies";
  }
}

TEST(AutomaticLimit, SeesOutliersByTheirDensity) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    std::vector<Point> points = square_in_outliers(12000, 2000, seed);
    EXPECT_TRUE(shows_outliers(points)) << seed;
    const std::vector<Point> half(points.begin(), points.begin() + 7000);
    points.insert(points.end(), half.begin(), half.end());
    EXPECT_TRUE(shows_outliers(points)) << seed << ", half of the points twice";
    EXPECT_FALSE(shows_outliers(testing::uniform_points(3000, seed))) << seed;
    EXPECT_FALSE(shows_outliers(sparser_to_the_right(3000, 6, seed))) << seed;
    EXPECT_FALSE(shows_outliers(zigzag(36, seed))) << seed;
  }
  EXPECT_FALSE(shows_outliers(testing::lattice(50, 50)));
}

/// An L whose arms are 0.3 wide, sparse but for a dense disc in its corner.
std::vector<Point> town_in_the_corner(std::size_t dense, std::size_t sparse, std::uint64_t seed) {
  std::vector<Point> points;
  for (const Point& p : testing::uniform_points(3 * sparse, seed)) {
    if (points.size() < sparse && std::min(p.x, p.y) < 0.3) points.push_back(p);
  }
  for (const Point& p : testing::uniform_points(dense, seed + 100)) {
    const double radius = 0.1 * std::sqrt(p.x);
    const double angle = 6.283185307179586 * p.y;
    points.push_back({0.15 + radius * std::cos(angle), 0.15 + radius * std::sin(angle)});
  }
  return points;
}

// The sparse part surrounds the dense one, as outliers do, but it leaves empty what is outside the shape.
TEST(AutomaticLimit, TakesNoSparsePartForOutliers) {
  for (const std::size_t count : {250U, 1000U, 4000U}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const std::vector<Point> points = town_in_the_corner(3 * count, count, seed);
      EXPECT_FALSE(shows_outliers(points)) << count << ", " << seed;
      EXPECT_GT(area(checked_hull(points)), 0.2) << count << ", " << seed;  // of 0.51; the disc has 0.03
    }
  }
}

// Nearly half of the points are no outliers, and of few outliers the bound on growth takes care.
TEST(AutomaticLimit, OutliersAreNeitherTooManyNorTooFew) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    EXPECT_FALSE(
        shows_outliers(with_square(testing::uniform_points(5500, seed), 5500, seed + 100, 4, {-1.5, -1.5})))
        << seed << ": a sparse rim";
    EXPECT_FALSE(shows_outliers(square_in_outliers(12000, 200, seed))) << seed << ": few outliers";
  }
}

// Rings of a lidar: forty that are close together, and then four far apart, along which points are close.
TEST(AutomaticLimit, TakesRingsForNoOutliers) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    testing::Random random(seed);
    std::vector<Point> points;
    double radius = 10;
    for (int ring = 0; ring < 44; ++ring) {
      radius += ring < 40 ? 1 : 14;
      for (int k = 0; k < 200; ++k) {
        const double angle = (k + random.between(0, 0.5)) * 2 * 3.14159265 / 200;
        const double at = radius + random.between(-0.1, 0.1);
        points.push_back({at * std::cos(angle), at * std::sin(angle)});
      }
    }
    EXPECT_FALSE(shows_outliers(points)) << seed;
  }
}

// Nine tenths of the points, and four times as close together: but the others do not lie round them.
TEST(AutomaticLimit, KeepsASparsePartThatAdjoins) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    std::vector<Point> points = testing::uniform_points(9000, seed);
    for (const Point& p : testing::uniform_points(1000, seed + 100)) points.push_back({1 + 1.8 * p.x, p.y});
    EXPECT_FALSE(shows_outliers(points)) << seed;
    EXPECT_GT(area(checked_hull(points)), 2.5) << seed << ": of 2.8";
  }
}

// Roads are far apart, but the points along them are even, as receivers write them down at a fixed interval.
TEST(AutomaticLimit, TakesRoadsForEven) {
  constexpr int kRoads = 12;
  struct Fixes {
    int number;     // on a road
    double jitter;  // of their mean distance
  };
  for (const auto& [fixes, jitter] : {Fixes{160, 0.5}, Fixes{100, 1}}) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<Point> points;
    for (int road = 0; road < kRoads; ++road) {
      for (int fix = 0; fix < fixes; ++fix) {
        const double across = (road + 0.5 + 0.02 * uniform(random)) / kRoads;
        const double along = (fix + jitter * uniform(random)) / fixes;
        points.push_back({along, across});
        points.push_back({across, along});
      }
    }
    EXPECT_FALSE(are_uneven(points)) << fixes;
  }
}

// The triangles between the points of an outline are flat, and their sizes scatter, but no voids are
// ordinary.
TEST(AutomaticLimit, TakesOutlinesForEven) {
  constexpr double kPi = 3.141592653589793;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    testing::Random random(seed);
    std::vector<Point> points;
    for (int i = 0; i < 600; ++i) {
      const double angle = 2 * kPi * random.unit();
      const double radius = (i % 3 == 0 ? 0.5 : 1) + random.between(-0.001, 0.001);
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    EXPECT_FALSE(are_uneven(points)) << seed;
  }
}

// Of a field that varies anyway: without a bound the outliers' own blocks would make them a part of the
// shape.
TEST(AutomaticLimit, BoundsWhatOutliersMakeOfAField) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<Point> points = sparser_to_the_right(20000, 5, seed);
    EXPECT_LT(area(checked_hull(with_square(points, 600, seed + 100, 5, {-2, -2}))),
              1.1 * area(checked_hull(points)))
        << seed;
  }
}

/// How many triangles of a ladder, with a point above the middle of its upper end, are kept, where sizes up
/// to 2 are and spikes begin at `spike`.
std::size_t kept_with_tip(double height, double spike) {
  std::vector<Point> points = testing::lattice(2, 6);
  points.push_back({0.5, 5 + height});
  detail::ThreadPool pool;
  detail::DelaunayBuilder builder;
  builder.build(points, pool);
  const detail::SizeField field{.limit4 = {16},
                                .spike_share = std::pow(spike / 2, 4),
                                .block_of_vertex = std::vector<std::uint32_t>(points.size())};
  std::vector<detail::Mesh::Index> boundary;
  detail::RegionFilter().run(builder.mesh(), builder.vertices(), field, false, pool, boundary);
  std::size_t kept = 0;
  for (detail::Mesh::Index t = 0; t < builder.mesh().triangle_count(); ++t) kept += builder.mesh().is_kept(t);
  return kept;
}

// A tip of height 2.2 has a size of 1.9 and an acute angle, one of 0.4 a size of 0.8 and an obtuse angle.
TEST(AutomaticLimit, DropsASpike) {
  EXPECT_EQ(kept_with_tip(2.2, 1.57), 10U);
  EXPECT_EQ(kept_with_tip(2.2, 1.95), 11U) << "too small for a spike";
  EXPECT_EQ(kept_with_tip(0.4, 0.7), 11U) << "an obtuse angle";
}

TEST(AutomaticLimit, DropsPartsOfFewTriangles) {
  for (const auto& [side, parts] :
       {std::pair{std::size_t{3}, std::size_t{1}}, {7, 2}}) {  // 8 and 72 triangles
    const auto points = testing::joined(testing::lattice(45, 45), testing::lattice(side, side, 1, {60, 0}));
    EXPECT_EQ(checked_hull(points).size(), parts) << side;
  }
}

TEST(AutomaticLimit, KeepsASparsePartFarAway) {
  const MultiPolygon shape =
      checked_hull(with_square(testing::uniform_points(4000, 5), 1000, 6, 10, {10, 0}));
  ASSERT_EQ(shape.size(), 2U);
  EXPECT_NEAR(area(shape), 101, 10);
}

// what it must find

TEST(AutomaticLimit, FindsHolesAndPartsAtAnyDensity) {
  const double area_of_shape = 100 - 4 * std::acos(-1.0) + 4;
  for (const std::size_t count : {600U, 2000U, 8000U, 20000U}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(std::to_string(count) + " points, seed " + std::to_string(seed));
      const MultiPolygon shape = checked_hull(ring_and_island(count, seed));
      EXPECT_EQ(shape.size(), 2U);
      EXPECT_EQ(hole_count(shape), 1U);
      // The outline is 61 long, and the shape ends within a spacing of it.
      const double spacing = std::sqrt(area_of_shape / static_cast<double>(count));
      EXPECT_NEAR(area(shape), area_of_shape, 61 * spacing / 2);
    }
  }
}

TEST(AutomaticLimit, FindsTheHoleOfALattice) {
  std::vector<Point> points;
  for (const Point& p : testing::lattice(40, 40)) {
    if (std::max(std::abs(p.x - 20), std::abs(p.y - 20)) > 5) points.push_back(p);
  }
  const MultiPolygon shape = checked_hull(points);
  ASSERT_EQ(shape.size(), 1U);
  EXPECT_EQ(shape[0].holes.size(), 1U);
  // Half a cell, or a little more, in each of the hole's corners.
  EXPECT_GE(area(shape), 39 * 39 - 12 * 12 + 2);
  EXPECT_LE(area(shape), 39 * 39 - 12 * 12 + 12);
}

TEST(AutomaticLimit, LeavesNoHoleToChance) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const MultiPolygon shape = checked_hull(testing::uniform_points(100000, seed));
    EXPECT_EQ(shape.size(), 1U) << seed;
    EXPECT_EQ(hole_count(shape), 0U) << seed;
  }
}

// Where points get sparser without end, the triangles round a void tell the density better than its block
// does.
TEST(AutomaticLimit, LeavesFewHolesInTails) {
  std::size_t holes = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    testing::Random random(seed);
    std::vector<Point> points(100000);
    for (Point& p : points) {
      const double distance = std::sqrt(-2 * std::log(1 - random.unit()));
      const double angle = 6.283185307179586 * random.unit();
      p = {distance * std::cos(angle), distance * std::sin(angle)};
    }
    holes += hole_count(checked_hull(points));
  }
  EXPECT_LE(holes, 5U);
}

TEST(AutomaticLimit, IsSmallBesideALongGap) {
  const auto points = with_square(testing::uniform_points(2000, 33), 2000, 34, 1, {1e9, 1e9});
  EXPECT_EQ(checked_hull(points).size(), 2U);
  EXPECT_LT(median_size(points), 0.1);
}

TEST(AutomaticLimit, IsFoundForPointsThatAreTinyBesideADistance) {
  const std::vector<Point> points = testing::uniform_points(1000, 35);
  const double size = median_size(points);
  for (const int exponent : {-30, -40, -50, -60, -100, -150, -200, -240}) {
    std::vector<Point> tiny = testing::scaled(points, exponent, exponent);
    tiny.push_back({1, 1});
    EXPECT_NEAR(std::ldexp(median_size(tiny), -exponent) / size, 1, 0.2) << exponent;
    EXPECT_EQ(concave_hull(tiny).polygon_count(), 1U) << exponent;
  }
}

// Half of the triangles are so tiny beside the usual ones of their block that their sizes are zero in usual
// sizes.
TEST(AutomaticLimit, LeavesATriangleWhereHalfOfThePointsAreTinyBesideTheOthers) {
  for (const int exponent : {-60, -90, -100, -105, -110, -116}) {
    for (std::size_t tiny = 30; tiny <= 58; tiny += 2) {
      testing::Random random(tiny);
      std::vector<Point> points;
      for (std::size_t i = 0; i < 90; ++i) {
        const Point p{random.between(0, 1), random.between(0, 1)};
        const double base = std::ldexp(1, exponent);
        points.push_back(i < tiny ? Point{base * (1 + std::ldexp(std::floor(1e4 * p.x), -50)),
                                          base * (1 + std::ldexp(std::floor(1e4 * p.y), -50))}
                                  : Point{std::ldexp(p.x, 148), std::ldexp(p.y, 148)});
      }
      EXPECT_GT(concave_hull(points).polygon_count(), 0U) << exponent << ", " << tiny;
    }
  }
}

// Only a part of the triangles is looked at.
TEST(AutomaticLimit, OfManyPointsIsAsOfFew) {
  const double few = median_size(testing::uniform_points(4000, 3)) * std::sqrt(4000.0);
  const double many = median_size(testing::uniform_points(400000, 4)) * std::sqrt(400000.0);
  // Chance moves it by a few cells of the rule's grid, each less than 6 %.
  EXPECT_NEAR(many / few, 1, 0.25);
}

// the caller's knob

TEST(AutomaticLimit, MoreDetailNeverAddsArea) {
  for (const std::vector<Point>& points : {ring_and_island(3000, 1), sparser_to_the_right(3000, 8, 2)}) {
    double before = std::numeric_limits<double>::infinity();
    for (const double detail : {0.25, 0.5, 0.8, 1.0, 1.1, 1.5, 2.0, 4.0}) {
      const MultiPolygon shape = checked_hull(points, {.detail = detail});
      EXPECT_LE(area(shape), before * (1 + 1e-12)) << detail;
      before = area(shape);
      EXPECT_DOUBLE_EQ(chosen(points, {.detail = detail}).value().median, median_size(points) / detail);
    }
  }
}

/// Which triangles are kept at a detail.
class KeptByDetail {
 public:
  explicit KeptByDetail(const std::vector<Point>& points) { builder_.build(points, pool_); }

  /// How many triangles are kept at `more` detail but not at `less`.
  std::size_t that_come_back(double less, double more) {
    const std::vector<bool> before = kept(less);
    const std::vector<bool> after = kept(more);
    std::size_t back = 0;
    for (std::size_t t = 0; t < before.size(); ++t) back += after[t] && !before[t] ? 1U : 0U;
    return back;
  }

 private:
  std::vector<bool> kept(double detail) {
    limit_.choose(builder_, detail, pool_);
    filter_.run(builder_.mesh(), builder_.vertices(), limit_.field(), true, pool_, boundary_);
    std::vector<bool> kept;
    for (detail::Mesh::Index t = 0; t < builder_.mesh().triangle_count(); ++t)
      kept.push_back(builder_.mesh().is_kept(t));
    return kept;
  }

  detail::ThreadPool pool_;
  detail::DelaunayBuilder builder_;
  detail::AutomaticLimit limit_;
  detail::RegionFilter filter_;
  std::vector<detail::Mesh::Index> boundary_;
};

TEST(AutomaticLimit, MoreDetailBringsNoTriangleBack) {
  std::vector<std::vector<Point>> sets = {testing::lattice_with_gaps(3)};
  for (const std::size_t count : {20U, 100U, 500U, 3000U}) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      sets.push_back(testing::uniform_points(count, seed));
      sets.push_back(testing::integer_points(count, seed, 60));
      sets.push_back(ring_and_island(count, seed));
      sets.push_back(sparser_to_the_right(count, 30, seed));
    }
  }
  for (const std::vector<Point>& points : sets) {
    KeptByDetail by_detail(points);
    double less = 0.25;
    for (const double more : {0.5, 0.8, 1.0, 1.1, 1.25, 1.5, 2.0, 3.0, 4.0}) {
      EXPECT_EQ(by_detail.that_come_back(less, more), 0U)
          << points.size() << " points, detail " << less << " and " << more;
      less = more;
    }
  }
}

// The sizes that were found for one detail are used for the next one.
TEST(AutomaticLimit, OfOneDetailAfterAnotherIsAsOfEachAlone) {
  std::vector<std::vector<Point>> sets = {sparser_to_the_right(20000, 8, 1), testing::uniform_points(500, 2),
                                          testing::uniform_points(20000, 3)};
  sets.push_back(with_square(sets.back(), 10000, 4, 0.001, {0.3, 0.4}));
  for (const std::vector<Point>& points : sets) {
    Extractor extractor;
    extractor.triangulate(points, 1);
    for (const double detail : {1.0, 4.0, 0.5, 1.0}) {
      const Options options{.detail = detail};
      extractor.extract_regions(options);
      EXPECT_EQ(extractor.extract_polygons(), concave_hull(points, options)) << points.size();
      EXPECT_EQ(extractor.chosen_sizes(), chosen(points, options));
    }
  }
}

// A small region does not come back where more detail leaves no large one, and stays where there never was
// one.
TEST(AutomaticLimit, MoreDetailDropsTheSmallPartsThatLessDetailDrops) {
  const auto points = testing::joined(testing::lattice(45, 45), testing::lattice(3, 3, 0.3, {60, 0}));
  EXPECT_EQ(checked_hull(points).size(), 1U);
  EXPECT_TRUE(checked_hull(points, {.detail = 3}).empty());
  const std::vector<Point> square = testing::lattice(2, 2);
  EXPECT_EQ(checked_hull(square, {.detail = 1.01}).size(), 1U);
}

TEST(AutomaticLimit, DetailMustBePositiveAndFinite) {
  for (const double detail : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(concave_hull({}, {.detail = detail}), std::invalid_argument) << detail;
  }
}

TEST(LabelledHulls, AreThoseOfEachLabelAlone) {
  const std::vector<Point> points = ring_and_island(3000, 7);
  std::vector<std::int64_t> labels;
  labels.reserve(points.size());
  for (const Point& p : points) labels.push_back(p.x > 11 ? -5 : p.y > 5 ? 3 : 1);
  for (const unsigned threads : {1U, 3U}) {
    const std::vector<LabelledHull> hulls = concave_hulls(points, labels, {.threads = threads});
    ASSERT_EQ(hulls.size(), 3U);
    for (std::size_t h = 0; h < hulls.size(); ++h) {
      EXPECT_EQ(hulls[h].label, (std::vector<std::int64_t>{-5, 1, 3})[h]);
      std::vector<Point> own;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (labels[i] == hulls[h].label) own.push_back(points[i]);
      }
      EXPECT_EQ(to_coordinates(hulls[h].shape, points), checked_hull(own));
    }
  }
  EXPECT_TRUE(concave_hulls({}, {}).empty());
  EXPECT_THROW(concave_hulls(points, std::span(labels).first(5)), std::invalid_argument);
}

}  // namespace
}  // namespace polylidar
