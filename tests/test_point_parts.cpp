// Random parts of points: their sizes, that halves are all of them, and that a draw is the same again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "benchmarks/run/point_parts.hpp"

namespace hullbench {
namespace {

/// (0, 0), (1, 0), ...
std::vector<Point> row_of(std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({static_cast<double>(i), 0});
  return points;
}

bool is_in_order(const std::vector<Point>& points) {
  return std::is_sorted(points.begin(), points.end(),
                        [](const Point& a, const Point& b) { return a.x < b.x; });
}

TEST(PointParts, AreHalvesAndNineTenths) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 9U, 10U, 19U, 1001U}) {
    const std::vector<Point> points = row_of(count);
    const run::PointParts parts = run::draw_parts(points, "set", 1, 0);
    EXPECT_EQ(parts.half.size(), count / 2);
    EXPECT_EQ(parts.other_half.size(), count - count / 2);
    EXPECT_EQ(parts.most.size(), count - count / 10);
    std::set<double> places;
    for (const auto* part : {&parts.half, &parts.other_half}) {
      EXPECT_TRUE(is_in_order(*part));
      for (const Point& point : *part) places.insert(point.x);
    }
    EXPECT_EQ(places.size(), count);
    EXPECT_TRUE(is_in_order(parts.most));
  }
}

TEST(PointParts, AreTheSameAgainAndOthersForAnotherDraw) {
  const std::vector<Point> points = row_of(200);
  const run::PointParts parts = run::draw_parts(points, "set", 1, 0);
  EXPECT_EQ(run::draw_parts(points, "set", 1, 0).half, parts.half);
  EXPECT_EQ(run::draw_parts(points, "set", 1, 0).most, parts.most);
  EXPECT_NE(run::draw_parts(points, "set", 1, 1).half, parts.half);
  EXPECT_NE(run::draw_parts(points, "set", 2, 0).half, parts.half);
  EXPECT_NE(run::draw_parts(points, "other", 1, 0).most, parts.most);
}

TEST(PointParts, ASampleHasItsSizeAndOrderAndIsTheSameAgain) {
  const std::vector<Point> points = row_of(200);
  const std::vector<Point> sample = run::draw_sample(points, 50, 1);
  EXPECT_EQ(sample.size(), 50U);
  EXPECT_TRUE(is_in_order(sample));
  EXPECT_EQ(run::draw_sample(points, 50, 1), sample);
  EXPECT_NE(run::draw_sample(points, 50, 2), sample);
  EXPECT_EQ(run::draw_sample(points, 200, 1), points);
  EXPECT_EQ(run::draw_sample(points, 201, 1), points);
}

TEST(PointParts, EveryPointIsAsLikelyAsAnother) {
  constexpr int kDraws = 2000;
  std::vector<int> drawn(20);
  for (int draw = 0; draw < kDraws; ++draw) {
    for (const Point& point : run::draw_parts(row_of(20), "set", 1, draw).half)
      ++drawn[static_cast<std::size_t>(point.x)];
  }
  // A binomial count has a standard deviation of 22 here; beyond five of them is one in a million.
  for (const int count : drawn) EXPECT_NEAR(count, 0.5 * kDraws, 5 * 22.4);
}

}  // namespace
}  // namespace hullbench
