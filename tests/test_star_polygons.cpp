#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "benchmarks/base/names.hpp"
#include "datasets/star_polygons.hpp"
#include "tests/boost_checks.hpp"
#include "tests/hull_oracle.hpp"

namespace hullbench::testing {
namespace {

/// Every fifth polygon: 5 has no factor in common with the number of pairs, so each pair has 40 of them.
constexpr std::size_t kStride = 5;

// A coordinate is the product of two doubles that are off by 1e-15 of themselves at most; what is worked out
// from two of them is off by a few of these, for radii up to 200.
constexpr double kStarRounding = 2e-12;

Ring ring_of(std::size_t index) {
  return star_polygon(index).front().shell;
}

/// In turns, counter-clockwise from `a` to `b` as seen from the origin, -0.5 to 0.5.
double turns_between(const Point& a, const Point& b) {
  return std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y) / (2 * std::numbers::pi);
}

TEST(StarParameters, CoverEveryPairInTurn) {
  EXPECT_EQ(kStarPolygons, 9800U);
  std::array<std::array<int, 8>, 8> seen{};
  for (std::size_t index = 0; index < kStarPairs; ++index) {
    const auto [irregularity, spikiness] = star_parameters(index);
    const auto row = static_cast<std::size_t>(std::lround(10 * irregularity));
    const auto column = static_cast<std::size_t>(std::lround(10 * spikiness));
    ++seen.at(row).at(column);
    EXPECT_EQ(irregularity, static_cast<double>(row) / 10);
    EXPECT_EQ(spikiness, static_cast<double>(column) / 10);
    const auto later = star_parameters(index + 199 * kStarPairs);
    EXPECT_EQ(later.irregularity, irregularity);
    EXPECT_EQ(later.spikiness, spikiness);
  }
  for (std::size_t row = 1; row <= 7; ++row) {
    for (std::size_t column = 1; column <= 7; ++column) EXPECT_EQ(seen.at(row).at(column), 1);
  }
}

TEST(StarParameters, TheLastIndexIs9799) {
  EXPECT_NO_THROW(star_parameters(9799));
  EXPECT_THROW(star_parameters(9800), std::invalid_argument);
  EXPECT_THROW(star_polygon(9800), std::invalid_argument);
}

TEST(CirclesOriginOnce, NeedsEveryEdgeToTurnTheSameWay) {
  EXPECT_TRUE(circles_origin_once(Ring{{1, 0}, {0, 1}, {-1, -1}}));
  EXPECT_FALSE(circles_origin_once(Ring{}));
  EXPECT_FALSE(circles_origin_once(Ring{{1, 0}, {0, 1}}));
  // Clockwise; the origin outside; on an edge; two vertices that coincide or lie on one ray.
  EXPECT_FALSE(circles_origin_once(Ring{{-1, -1}, {0, 1}, {1, 0}}));
  EXPECT_FALSE(circles_origin_once(Ring{{2, 1}, {3, 1}, {2, 2}}));
  EXPECT_FALSE(circles_origin_once(Ring{{1, 0}, {0, 1}, {-1, 0}}));
  EXPECT_FALSE(circles_origin_once(Ring{{1, 0}, {1, 0}, {0, 1}, {-1, -1}}));
  EXPECT_FALSE(circles_origin_once(Ring{{1, 0}, {2, 0}, {0, 1}, {-1, -1}}));
}

TEST(CirclesOriginOnce, TwoRoundsAreTooMany) {
  const Ring once{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  Ring twice = once;
  for (const Point& vertex : once) twice.push_back({2 * vertex.x, 2 * vertex.y});
  EXPECT_TRUE(circles_origin_once(once));
  EXPECT_FALSE(circles_origin_once(twice));
}

TEST(StarPolygon, IsValidAndStarShaped) {
  for (std::size_t index = 0; index < kStarPolygons; ++index) {
    const MultiPolygon shape = star_polygon(index);
    ASSERT_EQ(shape.size(), 1U);
    EXPECT_EQ(shape.front().shell.size(), kStarVertices);
    EXPECT_TRUE(shape.front().holes.empty());
    EXPECT_TRUE(circles_origin_once(shape.front().shell)) << index;
    EXPECT_EQ(boost_fault(shape), "") << index;
  }
}

TEST(StarPolygon, RadiiAreClippedAndStepsMakeAFullTurn) {
  double least = 200;
  double most = 50;
  for (std::size_t index = 0; index < kStarPolygons; index += kStride) {
    const Ring ring = ring_of(index);
    const double irregularity = star_parameters(index).irregularity;
    double turns = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double radius = std::hypot(ring[i].x, ring[i].y);
      least = std::min(least, radius);
      most = std::max(most, radius);
      const double step = turns_between(ring[i], ring[(i + 1) % ring.size()]);
      turns += step;
      // Before they are scaled to a full turn, steps differ by no more than this factor.
      EXPECT_GE(step * kStarVertices, (1 - irregularity) / (1 + irregularity) - kStarRounding) << index;
      EXPECT_LE(step * kStarVertices, (1 + irregularity) / (1 - irregularity) + kStarRounding) << index;
    }
    EXPECT_NEAR(turns, 1, kStarRounding) << index;
  }
  // Some of so many are clipped at either end.
  EXPECT_NEAR(least, 50, kStarRounding);
  EXPECT_NEAR(most, 200, kStarRounding);
}

TEST(StarPolygon, IrregularityIsTheSpreadOfTheSteps) {
  std::array<double, 8> sums{};
  for (std::size_t index = 0; index < kStarPolygons; index += kStride) {
    const Ring ring = ring_of(index);
    double squares = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const double step = turns_between(ring[i], ring[(i + 1) % ring.size()]) * kStarVertices - 1;
      squares += step * step;
    }
    const auto tenths = static_cast<std::size_t>(std::lround(10 * star_parameters(index).irregularity));
    sums.at(tenths) += squares / static_cast<double>(ring.size());
  }
  constexpr std::size_t kPolygons = kStarPolygons / kStride / 7;
  for (std::size_t tenths = 1; tenths <= 7; ++tenths) {
    // A uniform step's standard deviation; scaling takes a 200th off it, and four standard errors for 28,000
    // steps are a 70th.
    const double expected = static_cast<double>(tenths) / 10 / std::numbers::sqrt3;
    EXPECT_NEAR(std::sqrt(sums.at(tenths) / kPolygons), expected, 0.02 * expected) << tenths;
  }
}

TEST(StarPolygon, SpikinessIsTheSpreadOfTheRadiiWhereNothingIsClipped) {
  double sum = 0;
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t index = 0; index < kStarPolygons; index += 7) {  // spikiness 0.1: clipped beyond 5 sigma
    ASSERT_EQ(star_parameters(index).spikiness, 0.1);
    for (const Point& vertex : ring_of(index)) {
      const double radius = std::hypot(vertex.x, vertex.y);
      sum += radius;
      squares += (radius - 100) * (radius - 100);
      ++count;
    }
  }
  // Four standard errors of 140,000 Gaussian radii: 10 / sqrt(n), and of their standard deviation 10 /
  // sqrt(2 n).
  ASSERT_EQ(count, 140'000U);
  EXPECT_NEAR(sum / static_cast<double>(count), 100, 0.11);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), 10, 0.08);
}

TEST(StarPolygon, ConvexityFallsWithSpikiness) {
  std::array<double, 8> sums{};
  for (std::size_t index = 0; index < kStarPolygons; index += kStride) {
    const Ring ring = ring_of(index);
    const double hull = polylidar::signed_area(polylidar::testing::convex_corners(ring));
    const auto tenths = static_cast<std::size_t>(std::lround(10 * star_parameters(index).spikiness));
    sums.at(tenths) += polylidar::signed_area(ring) / hull;
  }
  for (std::size_t tenths = 2; tenths <= 7; ++tenths) EXPECT_LT(sums.at(tenths), sums.at(tenths - 1));
}

TEST(StarPolygon, IndicesGiveDifferentPolygons) {
  EXPECT_EQ(ring_of(0), ring_of(0));
  EXPECT_NE(ring_of(0), ring_of(kStarPairs));
}

}  // namespace
}  // namespace hullbench::testing
