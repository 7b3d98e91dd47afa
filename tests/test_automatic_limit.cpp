// The limit that is chosen when none is given: what it does not depend on, and what it must find.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/src/delaunay_builder.hpp"
#include "core/src/filter_rules.hpp"
#include "core/src/region.hpp"
#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::hole_count;
using testing::PointSet;

Limits chosen(const std::vector<Point>& points, unsigned threads = 1) {
  Extractor extractor;
  extractor.extract(points, {.threads = threads});
  return extractor.limits();
}

double chosen_perimeter(const std::vector<Point>& points) {
  const Limits limits = chosen(points);
  EXPECT_EQ(limits, (Limits{.max_perimeter = limits.max_perimeter}));
  return limits.max_perimeter;
}

MultiPolygon hull(const std::vector<Point>& points) {
  const IndexedMultiPolygon shape = concave_hull(points);
  EXPECT_EQ(check_polygon(points, shape), "");
  return to_coordinates(shape, points);
}

template <class Map>
std::vector<Point> mapped(std::vector<Point> points, const Map& map) {
  std::transform(points.begin(), points.end(), points.begin(), map);
  return points;
}

/// Uniform points of the square [0, 10)^2 without a disc of radius 2 in its middle, and of a square of side 2
/// at a distance of 2 from it.
std::vector<Point> ring_and_island(std::size_t count, std::uint64_t seed) {
  testing::Random random(seed);
  std::vector<Point> points;
  while (points.size() < count) {
    const Point p{random.between(0, 14), random.between(0, 10)};
    const bool in_square = p.x < 10 && std::hypot(p.x - 5, p.y - 5) > 2;
    if (in_square || (p.x > 12 && p.y > 4 && p.y < 6)) points.push_back(p);
  }
  return points;
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
  EXPECT_EQ(limits({.alpha = 0.1}), (Limits{.alpha = 0.1}));
  EXPECT_EQ(limits({.max_edge_length = 0.1}), (Limits{.max_edge_length = 0.1}));
  EXPECT_EQ(limits({.alpha = 0.1, .max_edge_length = 0.2, .max_perimeter = 0.3}), (Limits{0.1, 0.2, 0.3}));
  EXPECT_EQ(limits({.alpha = kNoLimit}), Limits{});
  EXPECT_EQ(limits({.max_edge_length = kNoLimit}), Limits{});
  EXPECT_EQ(limits({.max_perimeter = 0.1}), (Limits{.max_perimeter = 0.1}));
  EXPECT_EQ(limits({.max_perimeter = kNoLimit}), Limits{});
  EXPECT_LT(limits({}).max_perimeter, 1);
  EXPECT_GT(limits({}).max_perimeter, 0);
}

TEST(AutomaticLimit, ExtractsWhatGivingItExtracts) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const IndexedMultiPolygon shape = concave_hull(set.points);
    EXPECT_EQ(check_polygon(set.points, shape), "");
    const Options given{.max_perimeter = chosen_perimeter(set.points), .fill_single_triangles = true};
    EXPECT_EQ(concave_hull(set.points, given), shape);
  }
  // About multiples of 64 triangles, which the filter takes together, and of all and of a part.
  for (const std::size_t count : {33U, 34U, 65U, 66U, 1000U, 1899U, 1900U, 1901U, 30000U}) {
    const std::vector<Point> points = testing::uniform_points(count, count);
    const Options given{.max_perimeter = chosen_perimeter(points), .fill_single_triangles = true};
    EXPECT_EQ(concave_hull(points, given), concave_hull(points)) << count;
  }
}

// A limit is inclusive, and where perimeters are not known most triangles are told without a root, which
// rounds otherwise. Perimeters and their neighbours are the limits that would tell the two ways apart, most
// of all where all edges of a triangle are equal.
TEST(AutomaticLimit, KnownPerimetersKeepWhatOthersKeep) {
  std::vector<Point> equilateral;
  for (const Point& p : testing::lattice(12, 12)) {
    equilateral.push_back({0.37 * (p.x + p.y / 2), 0.37 * std::sqrt(0.75) * p.y});
  }
  for (const std::vector<Point>& points : {testing::uniform_points(300, 36), equilateral}) {
    detail::ThreadPool pool;
    detail::DelaunayBuilder builder;
    builder.build(points, pool);
    detail::Mesh& mesh = builder.mesh();
    const Point* const vertices = builder.vertices();
    std::set<double> limits;
    std::vector<double> perimeters(mesh.triangle_count(), std::numeric_limits<double>::infinity());
    for (detail::Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
      if (mesh.is_ghost(t)) continue;
      perimeters[t] = detail::Triangle(mesh, vertices, t).perimeter();
      limits.insert(
          {std::nextafter(perimeters[t], 0.0), perimeters[t], std::nextafter(perimeters[t], 100.0)});
    }
    detail::RegionFilter filter;
    for (const double limit : limits) {
      std::vector<detail::Mesh::Index> expected;
      filter.run(mesh, vertices, detail::filter_rules({.max_perimeter = limit}), false, pool, expected);
      std::vector<detail::Mesh::Index> boundary;
      filter.run(mesh, vertices, detail::filter_rules({.max_perimeter = limit}, perimeters), false, pool,
                 boundary);
      ASSERT_EQ(boundary, expected) << limit;
    }
  }
}

TEST(AutomaticLimit, AlwaysKeepsATriangle) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    Extractor extractor;
    extractor.triangulate(set.points);
    EXPECT_EQ(extractor.has_triangles(), !delaunay(set.points).triangles.empty());
    EXPECT_EQ(extractor.extract(set.points).polygon_count() > 0, extractor.has_triangles());
  }
}

TEST(AutomaticLimit, OfPointsWithoutATriangleIsNone) {
  for (const PointSet& set : testing::flat_point_sets()) {
    SCOPED_TRACE(set.name);
    EXPECT_EQ(chosen(set.points), Limits{});
    EXPECT_TRUE(hull(set.points).empty());
  }
}

TEST(AutomaticLimit, OfThreePointsKeepsTheirTriangle) {
  EXPECT_EQ(hull({{0, 0}, {4, 0}, {0, 3}}).size(), 1U);
  EXPECT_EQ(hull({{0, 0}, {1e6, 0}, {5e5, 1e-3}}).size(), 1U) << "a flat one";
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

// what it is: the rule in its plainest words

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The rule's limit of the least cost for all triangles of `points`, which have one.
double plain_limit(const std::vector<Point>& points) {
  const Triangulation mesh = delaunay(points);
  std::vector<double> perimeters;
  std::vector<double> areas;
  for (std::size_t e = 0; e < mesh.triangles.size(); e += 3) {
    const Ring triangle{points[mesh.triangles[e]], points[mesh.triangles[e + 1]],
                        points[mesh.triangles[e + 2]]};
    double perimeter = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& to = triangle[(k + 1) % 3];
      perimeter += std::hypot(to.x - triangle[k].x, to.y - triangle[k].y);
    }
    perimeters.push_back(perimeter);
    areas.push_back(std::abs(signed_area(triangle)));
  }
  const double median = median_of(perimeters);
  const auto limit = [&](int cell) {  // 16 to the octave
    return 0.93 * std::ldexp(1 + (cell & 15) / 16.0, cell >> 4) * median;
  };
  const auto log_area = [&](double largest) {
    double sum = 0;
    for (std::size_t t = 0; t < areas.size(); ++t) sum += perimeters[t] < largest ? areas[t] : 0;
    return std::log(sum);
  };
  double least_cost = std::numeric_limits<double>::infinity();
  double best = 1.6 * median;
  for (int cell = 0; limit(cell) <= 6 * median; ++cell) {
    if (limit(cell) < 1.1 * median) continue;
    const double low = limit(cell - 10);
    const double high = limit(cell + 2);
    const double growth = (log_area(high) - log_area(low)) / std::log(high / low);
    const double cost = std::log(growth + 0.003) + 2 * std::pow(std::log(limit(cell) / (1.6 * median)), 2);
    if (cost < least_cost) {
      least_cost = cost;
      best = limit(cell);
    }
  }
  return best;
}

TEST(AutomaticLimit, IsWhatTheRuleSays) {
  std::vector<PointSet> sets{{"circle, half of its triangles ghosts", testing::circle(1500, 1)},
                             {"lattice", testing::lattice(40, 45)},
                             {"three points", {{0, 0}, {4, 0}, {0, 3}}}};
  for (const std::size_t count : {40U, 500U, 520U, 1500U, 1800U}) {
    const std::string name = std::to_string(count);
    sets.push_back({name + " uniform", testing::uniform_points(count, count)});
    sets.push_back({name + " of a ring and an island", ring_and_island(count, count)});
    const auto denser = [](const Point& p) { return Point{p.x * p.x * p.x * p.x, p.y}; };
    sets.push_back({name + " denser on the left", mapped(testing::uniform_points(count, count + 1), denser)});
  }
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const std::string name = ", seed " + std::to_string(seed);
    sets.push_back({"300 points" + name, ring_and_island(300, seed)});
    const auto heavy_tailed = [](const Point& p) { return Point{std::tan(1.5 * p.x), std::tan(1.5 * p.y)}; };
    sets.push_back({"50 points" + name, mapped(testing::uniform_points(50, seed), heavy_tailed)});
    const std::vector<Point> split = mapped(testing::lattice(12, 12), [&](const Point& p) {
      return Point{p.x + (p.x > 5 ? 0.02 * static_cast<double>(seed) : 0), p.y};
    });
    sets.push_back({"split lattice" + name, split});
  }
  for (const PointSet& set : sets) {
    EXPECT_DOUBLE_EQ(chosen_perimeter(set.points), plain_limit(set.points)) << set.name;
  }
}

// what it does not depend on

class AutomaticLimitRelations : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  // Integers, so that moving, mirroring and doubling the points changes no rounding.
  const std::vector<Point> points_ = testing::integer_points(200 + 100 * GetParam(), GetParam(), 1 << 20);
  const double perimeter_ = chosen_perimeter(points_);
};

TEST_P(AutomaticLimitRelations, PowersOfTwoScaleIt) {
  for (const int exponent : {-1000, -30, 1, 30, 1000}) {
    const auto scaled = [&](const Point& p) {
      return Point{std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)};
    };
    EXPECT_EQ(chosen_perimeter(mapped(points_, scaled)), std::ldexp(perimeter_, exponent)) << exponent;
  }
}

TEST_P(AutomaticLimitRelations, OtherFactorsScaleItButForRounding) {
  for (const double factor : {3.0, 0.1, 1e-12}) {
    const auto scaled = [&](const Point& p) { return Point{p.x * factor, p.y * factor}; };
    // Coordinates are rounded, to 2^-53 of themselves, which may be a thousand times as long as an edge.
    EXPECT_NEAR(chosen_perimeter(mapped(points_, scaled)) / (perimeter_ * factor), 1, 1e-12) << factor;
  }
}

// A perimeter's three terms may be added in another order, hence DOUBLE_EQ here and below.
TEST_P(AutomaticLimitRelations, MovingAndMirroringDoNotMatter) {
  const auto expect_the_same = [&](const auto& motion) {
    EXPECT_DOUBLE_EQ(chosen_perimeter(mapped(points_, motion)), perimeter_);
  };
  expect_the_same([](const Point& p) { return Point{p.x + 12345, p.y - 98765}; });
  expect_the_same([](const Point& p) { return Point{-p.y, p.x}; });
  expect_the_same([](const Point& p) { return Point{p.y, p.x}; });
}

TEST_P(AutomaticLimitRelations, OrderAndRepeatsDoNotMatter) {
  EXPECT_DOUBLE_EQ(chosen_perimeter(testing::shuffled(points_, GetParam())), perimeter_);
  std::vector<Point> repeated;
  // So many that of the triangles that there might be only a few are there.
  for (int i = 0; i < 60; ++i) repeated.insert(repeated.end(), points_.begin(), points_.end());
  EXPECT_DOUBLE_EQ(chosen_perimeter(testing::shuffled(repeated, GetParam())), perimeter_);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AutomaticLimitRelations,
                         ::testing::Range(std::uint64_t{0}, std::uint64_t{12}));

TEST(AutomaticLimit, IsTheSameOnAnyNumberOfThreads) {
  // Of the first it looks at all triangles, as repeats leave most records unused, and spares the filter their
  // perimeters; of the second at a part.
  std::vector<Point> repeated;
  for (int i = 0; i < 80; ++i) {
    for (const Point& p : testing::uniform_points(200, 2)) repeated.push_back(p);
  }
  for (const std::vector<Point>& points : {repeated, testing::uniform_points(40000, 2)}) {
    for (const unsigned threads : {2U, 3U, 8U}) {
      EXPECT_EQ(chosen(points, threads), chosen(points)) << threads;
      EXPECT_EQ(concave_hull(points, {.threads = threads}), concave_hull(points)) << threads;
    }
  }
}

// what it must find

TEST(AutomaticLimit, FindsHolesAndPartsAtAnyDensity) {
  const double area_of_shape = 100 - 4 * std::acos(-1.0) + 4;
  for (const std::size_t count : {600U, 2000U, 8000U, 20000U}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      SCOPED_TRACE(std::to_string(count) + " points, seed " + std::to_string(seed));
      const MultiPolygon shape = hull(ring_and_island(count, seed));
      EXPECT_EQ(shape.size(), 2U);
      EXPECT_GE(hole_count(shape), 1U);
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
  const MultiPolygon shape = hull(points);
  ASSERT_EQ(shape.size(), 1U);
  EXPECT_EQ(shape[0].holes.size(), 1U);
  // Half a cell, or a little more, in each of the hole's corners.
  EXPECT_GE(area(shape), 39 * 39 - 12 * 12 + 2);
  EXPECT_LE(area(shape), 39 * 39 - 12 * 12 + 12);
}

TEST(AutomaticLimit, IsSmallBesideALongGap) {
  std::vector<Point> points = testing::uniform_points(2000, 33);
  for (const Point& p : testing::uniform_points(2000, 34)) points.push_back({p.x + 1e9, p.y + 1e9});
  EXPECT_EQ(hull(points).size(), 2U);
  EXPECT_LT(chosen_perimeter(points), 0.3);
}

TEST(AutomaticLimit, IsFoundForPointsThatAreTinyBesideADistance) {
  const std::vector<Point> points = testing::uniform_points(1000, 35);
  const double perimeter = chosen_perimeter(points);
  for (const int exponent : {-30, -40, -50, -60, -100, -150, -200, -240}) {
    std::vector<Point> tiny = mapped(points, [&](const Point& p) {
      return Point{std::ldexp(p.x, exponent), std::ldexp(p.y, exponent)};
    });
    tiny.push_back({1, 1});
    EXPECT_NEAR(std::ldexp(chosen_perimeter(tiny), -exponent) / perimeter, 1, 0.1) << exponent;
    const Options given{.max_perimeter = chosen_perimeter(tiny), .fill_single_triangles = true};
    EXPECT_EQ(concave_hull(tiny, given), concave_hull(tiny)) << exponent;
    EXPECT_EQ(concave_hull(tiny).polygon_count(), 1U) << exponent;
  }
}

// Only a part of the triangles is looked at.
TEST(AutomaticLimit, OfManyPointsIsAsOfFew) {
  const double few = chosen_perimeter(testing::uniform_points(4000, 3)) * std::sqrt(4000.0);
  const double many = chosen_perimeter(testing::uniform_points(400000, 4)) * std::sqrt(400000.0);
  // Chance moves it by a cell or two of the rule's grid, each less than 7 %.
  EXPECT_NEAR(many / few, 1, 0.25);
}

}  // namespace
}  // namespace polylidar
