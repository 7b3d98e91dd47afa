// Shapes of groups: each as that of its points alone, widened no further than needed, on any number of
// threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/point_locator.hpp"
#include "tool/hull/degrees.hpp"
#include "tool/hull/group_hulls.hpp"

namespace polylidar::tool {
namespace {

/// Clusters of uniform points, and a few points between.
std::vector<Point> islands(std::uint64_t seed, std::size_t clusters, std::size_t each, std::size_t outliers) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Point> points;
  for (std::size_t c = 0; c < clusters; ++c) {
    const Point corner = {8 * coordinate(random), 8 * coordinate(random)};
    for (std::size_t i = 0; i < each; ++i) {
      points.push_back({corner.x + coordinate(random), corner.y + coordinate(random)});
    }
  }
  for (std::size_t i = 0; i < outliers; ++i)
    points.push_back({9 * coordinate(random), 9 * coordinate(random)});
  std::shuffle(points.begin(), points.end(), random);
  return points;
}

GroupHull hull_of(const std::vector<Point>& points, const HullOptions& options) {
  std::vector<GroupHull> hulls = group_hulls(points, {}, 0, options, 1);
  EXPECT_EQ(hulls.size(), 1U);
  EXPECT_EQ(hulls[0].points, points.size());
  return std::move(hulls[0]);
}

MultiPolygon shape_of(const std::vector<Point>& points, const HullOptions& options) {
  return to_coordinates(hull_of(points, options).shape, points);
}

/// The points that `shape` leaves outside, by ascending index.
std::vector<std::uint32_t> points_outside(const IndexShape& shape, const std::vector<Point>& points) {
  const PointLocator locator(to_coordinates(shape, points));
  std::vector<std::uint32_t> outside;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!locator.contains(points[i])) outside.push_back(i);
  }
  return outside;
}

/// By the angles that the rings turn round `p`, without anything of the locator's.
bool is_covered(const Point& p, const IndexShape& shape, const std::vector<Point>& points) {
  double turns = 0;
  bool on_boundary = false;
  const auto add = [&](const IndexRing& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& a = points[ring[i]];
      const Point& b = points[ring[(i + 1) % ring.size()]];
      if (a == p || b == p) on_boundary = true;
      turns += std::atan2((a.x - p.x) * (b.y - p.y) - (b.x - p.x) * (a.y - p.y),
                          (a.x - p.x) * (b.x - p.x) + (a.y - p.y) * (b.y - p.y));
    }
  };
  for (const IndexPolygon& polygon : shape) {
    add(polygon.shell);
    for (const IndexRing& hole : polygon.holes) add(hole);
  }
  return on_boundary || turns > 3;
}

TEST(GroupHulls, OneGroupIsTheCoresShape) {
  const std::vector<Point> points = islands(1, 5, 800, 30);
  for (const Options& core :
       {Options(), Options{.alpha = 0.1}, Options{.max_edge_length = 0.2, .detail = 2}}) {
    EXPECT_EQ(shape_of(points, {.core = core}), to_coordinates(concave_hull(points, core), points));
  }
  const GroupHull hull = hull_of(points, {.core = {.alpha = 0.1}});
  EXPECT_EQ(hull.limits.alpha, 0.1);
  EXPECT_FALSE(hull.sizes || hull.limits.max_perimeter);
  EXPECT_DOUBLE_EQ(hull.area, polylidar::area(to_coordinates(hull.shape, points)));
}

TEST(GroupHulls, EveryGroupIsThatOfItsPointsOnAnyThreads) {
  const std::vector<Point> points = islands(2, 12, 3000, 500);
  std::mt19937_64 random(5);
  std::vector<std::uint32_t> groups;
  // One large group, which has the threads to itself, and many small ones; 40 has one point, 41 none.
  for (std::size_t i = 0; i < points.size(); ++i) {
    groups.push_back(i == 17 ? 40U : random() % 2 == 0 ? 0U : static_cast<std::uint32_t>(random() % 40));
  }
  std::map<std::uint32_t, std::vector<Point>> members;
  for (std::size_t i = 0; i < points.size(); ++i) members[groups[i]].push_back(points[i]);
  for (const unsigned threads : {1U, 4U}) {
    std::vector<std::string> told;
    const std::vector<GroupHull> hulls = group_hulls(
        points, groups, 42, {}, threads, [&](const std::string& doing) { told.push_back(doing); });
    ASSERT_EQ(hulls.size(), 42U);
    ASSERT_EQ(told.size(), 42U);
    EXPECT_EQ(told.back(), "group 42 of 42");
    for (std::uint32_t g = 0; g < 42; ++g) {
      EXPECT_EQ(hulls[g].points, members[g].size());
      EXPECT_EQ(to_coordinates(hulls[g].shape, points), to_coordinates(concave_hull(members[g]), members[g]))
          << "group " << g << ", " << threads << " threads";
    }
  }
}

TEST(GroupHulls, WhatATellerThrowsEndsTheWork) {
  const std::vector<Point> points = islands(3, 4, 100, 0);
  std::vector<std::uint32_t> groups(points.size());
  for (std::size_t i = 0; i < groups.size(); ++i) groups[i] = static_cast<std::uint32_t>(i % 20);
  EXPECT_THROW(
      group_hulls(points, groups, 20, {}, 3, [](const std::string&) { throw std::runtime_error("enough"); }),
      std::runtime_error);
}

TEST(GroupHulls, WithoutGroupsTheStepsAreTold) {
  const std::vector<Point> points = islands(3, 2, 100, 4);
  const auto steps = [&](const HullOptions& options) {
    std::vector<std::string> told;
    group_hulls(points, {}, 0, options, 1, [&](const std::string& doing) { told.push_back(doing); });
    return told;
  };
  EXPECT_EQ(steps({}), std::vector<std::string>{"triangulating 204 points"});
  EXPECT_EQ(steps({.simplify = 0.1}).back(), "simplifying the outline");
  const std::vector<std::string> widened = steps({.core = {.max_perimeter = 0.5}, .wanted = {.cover = true}});
  ASSERT_GT(widened.size(), 4U);
  EXPECT_EQ(widened[0], "triangulating 204 points");
  EXPECT_EQ(widened[3], "widening the limit: step 3");
}

TEST(GroupHulls, CoverLeavesNoPointOutsideAndIsTheLeastThatDoes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::vector<Point> points = islands(seed, 3, 150, 12);
    for (const bool chosen : {true, false}) {
      HullOptions options;
      if (!chosen) options.core.max_perimeter = 0.5;
      EXPECT_FALSE(points_outside(hull_of(points, options).shape, points).empty());
      options.wanted.cover = true;
      const GroupHull covering = hull_of(points, options);
      for (const Point& p : points) EXPECT_TRUE(is_covered(p, covering.shape, points));
      // A little less leaves somebody out.
      HullOptions less;
      if (chosen) {
        const double usual = hull_of(points, {}).sizes->median;
        less.core.detail = usual / covering.sizes->median * 1.01;
      } else {
        less.core.max_perimeter = *covering.limits.max_perimeter / 1.01;
      }
      const GroupHull smaller = hull_of(points, less);
      EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                              [&](const Point& p) { return !is_covered(p, smaller.shape, points); }));
    }
  }
}

TEST(GroupHulls, OneJoinsAllPartsAndIsTheLeastThatDoes) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::vector<Point> points = islands(seed, 4, 300, 3);
    const IndexShape parts = hull_of(points, {.core = {.alpha = 0.15}}).shape;
    ASSERT_GE(parts.size(), 2U);
    const GroupHull one = hull_of(points, {.core = {.alpha = 0.15}, .wanted = {.one = true}});
    ASSERT_EQ(one.shape.size(), 1U);
    // All parts are inside it, each by the middle of its first edge.
    for (const IndexPolygon& part : parts) {
      for (const std::uint32_t v : part.shell) EXPECT_TRUE(is_covered(points[v], one.shape, points));
    }
    const IndexShape less = hull_of(points, {.core = {.alpha = *one.limits.alpha / 1.01}}).shape;
    std::vector<std::size_t> polygons;
    const PointLocator locator(to_coordinates(less, points));
    for (const IndexPolygon& part : parts) {
      std::map<std::size_t, int> votes;
      for (const std::uint32_t v : part.shell) ++votes[locator.polygon_of(points[v]).value()];
      polygons.push_back(std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
                           return a.second < b.second;
                         })->first);
    }
    EXPECT_TRUE(
        std::any_of(polygons.begin(), polygons.end(), [&](std::size_t p) { return p != polygons[0]; }));
    EXPECT_EQ(hull_of(points, {.wanted = {.one = true}}).shape.size(), 1U);
    const GroupHull both = hull_of(points, {.wanted = {.cover = true, .one = true}});
    EXPECT_EQ(both.shape.size(), 1U);
    EXPECT_TRUE(points_outside(both.shape, points).empty());
  }
}

TEST(GroupHulls, NothingIsWidenedWithoutNeedOrHope) {
  const std::vector<Point> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(hull_of(square, {.core = {.alpha = 1}, .wanted = {.cover = true, .one = true}}).limits.alpha, 1);
  // No multiple of 0 is a limit, so that there is none in the end.
  EXPECT_EQ(hull_of(square, {.core = {.alpha = 0}, .wanted = {.cover = true}}).shape.size(), 1U);
  for (const std::vector<Point>& flat : {std::vector<Point>{}, {{1, 2}}, {{0, 0}, {1, 1}, {2, 2}}}) {
    const GroupHull hull = hull_of(flat, {.wanted = {.cover = true, .one = true}});
    EXPECT_TRUE(hull.shape.empty());
    EXPECT_FALSE(hull.has_triangles);
    EXPECT_EQ(hull.area, 0);
  }
}

TEST(GroupHulls, AreasOfDegreesAreThoseOnTheSphere) {
  // Two squares of half a degree, of the same area on a plane that is true at latitude 60. On the sphere the
  // one at the equator has twice the area of the other.
  std::vector<Point> degrees;
  for (const double south : {0.0, 60.0}) {
    for (int row = 0; row < 6; ++row) {
      for (int column = 0; column < 6; ++column) degrees.push_back({0.1 * column, south + 0.1 * row});
    }
  }
  const std::vector<Point> metres = to_metres(degrees, 60);
  HullOptions options = {.core = {.max_edge_length = 20000}, .latitude = 60};
  const GroupHull both = hull_of(metres, options);
  ASSERT_EQ(both.shape.size(), 2U);
  const double equator = 55597.46 * 55597.46;
  EXPECT_NEAR(both.area, 1.5 * equator, 0.01 * equator);
  options.min_area = 0.6 * equator;
  const GroupHull large = hull_of(metres, options);
  ASSERT_EQ(large.shape.size(), 1U);
  EXPECT_LT(degrees[large.shape[0].shell[0]].y, 1);
  EXPECT_NEAR(large.area, equator, 0.001 * equator);
}

TEST(GroupHulls, TheLargestPartsStayInTheirOrder) {
  std::vector<Point> points;
  for (const double side : {1.0, 3.0, 2.0, 3.0}) {
    const double x = static_cast<double>(points.size()) * 10;
    for (const Point& p : {Point{x, 0}, Point{x + side, 0}, Point{x, side}}) points.push_back(p);
  }
  const HullOptions all = {.core = {.alpha = 3}};
  const IndexShape four = hull_of(points, all).shape;
  ASSERT_EQ(four.size(), 4U);
  HullOptions few = all;
  for (const auto& [count, starts] : std::map<std::size_t, std::vector<std::uint32_t>>{
           {1, {3}}, {2, {3, 9}}, {3, {3, 6, 9}}, {4, {0, 3, 6, 9}}, {9, {0, 3, 6, 9}}}) {
    few.max_parts = count;
    std::vector<std::uint32_t> got;
    for (const IndexPolygon& polygon : hull_of(points, few).shape) got.push_back(polygon.shell[0]);
    EXPECT_EQ(got, starts);
  }
}

TEST(PointLocator, AgreesWithAnglesAndKnowsItsBoundary) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Point> points = islands(seed, 4, 400, 50);
    const IndexShape shape = polygons_of(concave_hull(points, {.alpha = 0.06}));
    ASSERT_GT(shape.size(), 2U);
    const PointLocator locator(to_coordinates(shape, points));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-0.5, 9.5);
    for (int i = 0; i < 2000; ++i) {
      const Point p = {coordinate(random), coordinate(random)};
      EXPECT_EQ(locator.contains(p), is_covered(p, shape, points));
    }
    for (const Point& p : points) EXPECT_EQ(locator.contains(p), is_covered(p, shape, points));
    for (const IndexPolygon& polygon : shape) {
      for (const std::uint32_t v : polygon.shell) EXPECT_TRUE(locator.contains(points[v]));
    }
  }
  const std::vector<Point> square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const PointLocator locator(to_coordinates(concave_hull(square, {.alpha = 9}), square));
  for (const Point& p : {Point{0, 2}, Point{2, 0}, Point{4, 1}, Point{1, 4}, Point{2, 2}, Point{4, 4}}) {
    EXPECT_TRUE(locator.contains(p));
  }
  for (const Point& p :
       {Point{-1, 0}, Point{5, 0}, Point{-1, 4}, Point{5, 4}, Point{2, -0.1}, Point{2, 4.1}}) {
    EXPECT_FALSE(locator.contains(p));
  }
}

}  // namespace
}  // namespace polylidar::tool
