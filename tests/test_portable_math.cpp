#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "datasets/portable_math.hpp"
#include "datasets/random.hpp"

namespace hullbench {
namespace {

using polylidar::Point;

// The documented accuracy.
constexpr long double kUnitVectorError = 1e-15L;
constexpr long double kLogError = 2e-15L;

void expect_unit_vector(double turns) {
  // Whole turns are taken off exactly, so that the long double reference is good for many of them too.
  const long double angle = 2 * std::numbers::pi_v<long double> * std::fmod(turns, 1.0);
  const Point found = unit_vector(turns);
  EXPECT_LE(std::abs(static_cast<long double>(found.x) - std::cos(angle)), kUnitVectorError) << turns;
  EXPECT_LE(std::abs(static_cast<long double>(found.y) - std::sin(angle)), kUnitVectorError) << turns;
}

TEST(UnitVector, IsCosineAndSine) {
  for (int step = -4096; step <= 4096; ++step) expect_unit_vector(step / 1024.0);
  Random random(1);
  for (int i = 0; i < 100'000; ++i) expect_unit_vector(random.between(-3, 3));
}

TEST(UnitVector, ManyTurnsLoseNothing) {
  Random random(2);
  for (int i = 0; i < 10'000; ++i) expect_unit_vector(random.between(-1e12, 1e12));
  EXPECT_EQ(unit_vector(0x1p52 + 1), (Point{1, 0}));
  EXPECT_EQ(unit_vector(std::numeric_limits<double>::max()), (Point{1, 0}));
}

TEST(UnitVector, SmallAnglesKeepTheirRelativeAccuracy) {
  EXPECT_EQ(unit_vector(0x1p-60), (Point{1, 2 * std::numbers::pi * 0x1p-60}));
  EXPECT_EQ(unit_vector(-0x1p-60), (Point{1, -2 * std::numbers::pi * 0x1p-60}));
}

TEST(UnitVector, QuarterTurnsAreExact) {
  EXPECT_EQ(unit_vector(0), (Point{1, 0}));
  EXPECT_EQ(unit_vector(0.25), (Point{0, 1}));
  EXPECT_EQ(unit_vector(0.5), (Point{-1, 0}));
  EXPECT_EQ(unit_vector(-0.5), (Point{-1, 0}));
  EXPECT_EQ(unit_vector(0.75), (Point{0, -1}));
  EXPECT_EQ(unit_vector(-7.75), (Point{0, 1}));
}

TEST(UnitVector, AnAngleMustBeFinite) {
  EXPECT_THROW(unit_vector(std::numeric_limits<double>::infinity()), std::invalid_argument);
  EXPECT_THROW(unit_vector(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

void expect_log(double x) {
  const long double expected = std::log(static_cast<long double>(x));
  const long double error = std::abs(static_cast<long double>(natural_log(x)) - expected);
  EXPECT_LE(error, kLogError * std::max(1.0L, std::abs(expected))) << x;
}

TEST(NaturalLog, IsTheLogarithm) {
  Random random(3);
  for (int i = 0; i < 100'000; ++i) expect_log(random.uniform() + 0x1p-54);
  for (int i = 0; i < 100'000; ++i) expect_log(random.between(0.5, 2));
  for (int exponent = -1074; exponent < 1024; ++exponent) {
    expect_log(std::ldexp(1.0, exponent));
    expect_log(std::ldexp(1 + random.uniform(), exponent));
  }
  expect_log(std::numeric_limits<double>::max());
}

TEST(NaturalLog, NearOneKeepsItsRelativeAccuracy) {
  EXPECT_EQ(natural_log(1), 0);
  for (int exponent = -52; exponent <= -1; ++exponent) {
    for (const double x : {1 + std::ldexp(1.0, exponent), 1 - std::ldexp(1.0, exponent)}) {
      const long double expected = std::log(static_cast<long double>(x));
      EXPECT_LE(std::abs(static_cast<long double>(natural_log(x)) / expected - 1), kLogError) << x;
    }
  }
}

TEST(NaturalLog, NeedsAPositiveFiniteNumber) {
  for (const double x :
       {0.0, -0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(natural_log(x), std::invalid_argument) << x;
  }
}

}  // namespace
}  // namespace hullbench
