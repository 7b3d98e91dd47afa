// The predicates' signs against exact integer arithmetic, on input chosen to be as nearly degenerate as
// doubles allow.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "polylidar/predicates.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using boost::multiprecision::cpp_int;
using testing::Random;

template <std::size_t N>
using Points = std::array<Point, N>;

int sign(double value) {
  return (value > 0) - (value < 0);
}

// Doubles are integers times powers of two, so over one common power the determinants are integers.
template <std::size_t N>
std::array<std::array<cpp_int, 2>, N> as_integers(const Points<N>& points) {
  constexpr int kDigits = std::numeric_limits<double>::digits;
  int lowest = std::numeric_limits<int>::max();
  for (const Point& point : points) {
    for (const double value : {point.x, point.y}) {
      if (value != 0) lowest = std::min(lowest, std::ilogb(value) - kDigits + 1);
    }
  }
  const auto integer = [&](double value) -> cpp_int {
    if (value == 0) return 0;
    const int exponent = std::ilogb(value) - kDigits + 1;
    return cpp_int(static_cast<std::int64_t>(std::ldexp(value, -exponent))) << (exponent - lowest);
  };
  std::array<std::array<cpp_int, 2>, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = {integer(points[i].x), integer(points[i].y)};
  return result;
}

int exact_orient2d(const Points<3>& p) {
  const auto q = as_integers(p);
  const cpp_int determinant =
      (q[1][0] - q[0][0]) * (q[2][1] - q[0][1]) - (q[1][1] - q[0][1]) * (q[2][0] - q[0][0]);
  return determinant.sign();
}

int exact_incircle(const Points<4>& p) {
  const auto q = as_integers(p);
  std::array<std::array<cpp_int, 3>, 3> row;
  for (std::size_t i = 0; i < 3; ++i) {
    const cpp_int x = q[i][0] - q[3][0];
    const cpp_int y = q[i][1] - q[3][1];
    row[i] = {x, y, x * x + y * y};
  }
  const auto minor = [&](std::size_t i, std::size_t j) -> cpp_int {
    return row[i][0] * row[j][1] - row[j][0] * row[i][1];
  };
  const cpp_int determinant = row[0][2] * minor(1, 2) + row[1][2] * minor(2, 0) + row[2][2] * minor(0, 1);
  return determinant.sign();
}

template <std::size_t N>
std::string text(const Points<N>& points) {
  std::ostringstream out;
  out << std::hexfloat;
  for (const Point& point : points) out << " {" << point.x << ", " << point.y << '}';
  return out.str();
}

// How often each sign came up: a family of inputs that never meets zero tests nothing nearly degenerate.
struct Tally {
  std::size_t wrong = 0;
  std::size_t zero = 0;
  std::size_t positive = 0;
  std::size_t negative = 0;
  std::string first_wrong;

  template <std::size_t N>
  void count(const Points<N>& points, int expected, int actual) {
    if (expected != actual && wrong++ == 0) {
      first_wrong =
          "expected " + std::to_string(expected) + ", got " + std::to_string(actual) + " on" + text(points);
    }
    (expected == 0 ? zero : expected > 0 ? positive : negative) += 1;
  }
};

void check(Tally& tally, const Points<3>& p) {
  tally.count(p, exact_orient2d(p), sign(orient2d(p[0], p[1], p[2])));
}

void check(Tally& tally, const Points<4>& p) {
  tally.count(p, exact_incircle(p), sign(incircle(p[0], p[1], p[2], p[3])));
}

// Zero moves by the last place of 1: its neighbours among doubles lie outside the predicates' range.
double moved_by_ulps(double value, int ulps) {
  if (value == 0) return ulps * 0x1p-52;
  const double infinity = std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::abs(ulps); ++i) value = std::nextafter(value, ulps < 0 ? -infinity : infinity);
  return value;
}

template <std::size_t N>
Points<N> jittered(Points<N> points, Random& random, int most_ulps) {
  for (Point& point : points) {
    point.x = moved_by_ulps(point.x, static_cast<int>(random.integer(most_ulps)));
    point.y = moved_by_ulps(point.y, static_cast<int>(random.integer(most_ulps)));
  }
  return points;
}

// Points near 1 at any magnitude of the range: coordinates from about 2^-110 to 2^149, or zero.
template <std::size_t N>
Points<N> at_any_magnitude(Points<N> points, Random& random) {
  const int exponent = static_cast<int>(random.below(246)) - 98;
  const auto moved = [&](double value) {
    return std::abs(value) < 0x1p-12 ? 0.0 : std::ldexp(value, exponent);
  };
  for (Point& point : points) point = {moved(point.x), moved(point.y)};
  return points;
}

// Each coordinate with a magnitude of its own.
template <std::size_t N>
Points<N> of_different_magnitudes(Random& random) {
  const auto value = [&] {
    const double mantissa = random.below(2) == 0 ? -1 - random.unit() : 1 + random.unit();
    return std::ldexp(mantissa, static_cast<int>(random.below(259)) - 110);
  };
  Points<N> points;
  for (Point& point : points) point = {value(), value()};
  return points;
}

template <std::size_t N, typename Make>
Tally tally_of(std::size_t cases, std::uint64_t seed, Make make) {
  Random random(seed);
  Tally tally;
  for (std::size_t i = 0; i < cases; ++i) {
    const Points<N> points = make(random);
    check(tally, points);
  }
  return tally;
}

void expect_exact(const Tally& tally) {
  EXPECT_EQ(tally.wrong, 0U) << tally.first_wrong;
}

void expect_exact_and_degenerate(const Tally& tally) {
  expect_exact(tally);
  EXPECT_GT(tally.zero, 0U);
  EXPECT_GT(tally.positive, 0U);
  EXPECT_GT(tally.negative, 0U);
}

// Three points on a line: exactly so on a fine grid, moved off it by an ulp, or rounded from anywhere.
Points<3> nearly_collinear(Random& random) {
  const std::size_t kind = random.below(3);
  const auto coordinate = [&] {
    return kind == 2 ? random.between(-1, 1) : random.integer(1 << 20) * 0x1p-20;
  };
  const Point a{coordinate(), coordinate()};
  const Point b{coordinate(), coordinate()};
  const double t = kind == 2 ? random.between(-2, 2) : random.integer(8) / 4;
  const Points<3> points{a, b, Point{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}};
  return kind == 1 ? jittered(points, random, 1) : points;
}

// Four points on a circle, rounded, in no particular order: the first three may run either way.
Points<4> nearly_cocircular(Random& random, double radius, Point centre) {
  Points<4> points;
  for (Point& point : points) {
    const double angle = random.between(0, 6.283185307179586);
    point = {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  }
  return points;
}

template <std::size_t N>
Points<N> on_integer_lattice(Random& random, std::int64_t limit) {
  Points<N> points;
  for (Point& point : points) point = {random.integer(limit), random.integer(limit)};
  return points;
}

TEST(Orient2d, KnowsLeftFromRight) {
  EXPECT_GT(orient2d({0, 0}, {1, 0}, {0, 1}), 0);
  EXPECT_LT(orient2d({0, 0}, {0, 1}, {1, 0}), 0);
  EXPECT_EQ(orient2d({0, 0}, {1, 1}, {3, 3}), 0);
  EXPECT_EQ(orient2d({2, 3}, {2, 3}, {7, 8}), 0);
}

TEST(Orient2d, SeesOneUlpBesideALine) {
  const Point a{0.5, 0.5};
  const Point b{12, 12};
  for (int i = -40; i <= 40; ++i) {
    for (int j = -40; j <= 40; ++j) {
      const Point c{moved_by_ulps(24, i), moved_by_ulps(24, j)};
      ASSERT_EQ(sign(orient2d(a, b, c)), sign(static_cast<double>(j - i))) << i << ' ' << j;
    }
  }
}

TEST(Orient2d, IsExactOnNearlyCollinearPoints) {
  expect_exact_and_degenerate(tally_of<3>(60000, 101, nearly_collinear));
}

TEST(Orient2d, IsExactOnLattices) {
  expect_exact_and_degenerate(
      tally_of<3>(30000, 102, [](Random& random) { return on_integer_lattice<3>(random, 8); }));
  expect_exact_and_degenerate(tally_of<3>(
      30000, 103, [](Random& random) { return jittered(on_integer_lattice<3>(random, 3), random, 1); }));
}

TEST(Orient2d, IsExactFarFromTheOrigin) {
  expect_exact_and_degenerate(tally_of<3>(30000, 104, [](Random& random) {
    Points<3> points = nearly_collinear(random);
    for (Point& point : points) point = {point.x + 0x1p28, point.y - 0x1p30};
    return points;
  }));
}

TEST(Orient2d, IsExactAtEveryMagnitudeOfItsRange) {
  expect_exact_and_degenerate(tally_of<3>(
      60000, 105, [](Random& random) { return at_any_magnitude(nearly_collinear(random), random); }));
}

TEST(Orient2d, IsExactWhenMagnitudesDiffer) {
  expect_exact(tally_of<3>(30000, 106, of_different_magnitudes<3>));
}

TEST(Orient2d, IsAntisymmetric) {
  Random random(107);
  for (int i = 0; i < 20000; ++i) {
    const Points<3> p = i % 2 == 0 ? nearly_collinear(random) : on_integer_lattice<3>(random, 5);
    const int value = sign(orient2d(p[0], p[1], p[2]));
    ASSERT_EQ(sign(orient2d(p[1], p[2], p[0])), value) << text(p);
    ASSERT_EQ(sign(orient2d(p[2], p[0], p[1])), value) << text(p);
    ASSERT_EQ(sign(orient2d(p[1], p[0], p[2])), -value) << text(p);
    ASSERT_EQ(sign(orient2d(p[0], p[2], p[1])), -value) << text(p);
    ASSERT_EQ(sign(orient2d(p[2], p[1], p[0])), -value) << text(p);
  }
}

TEST(Incircle, KnowsInsideFromOutside) {
  EXPECT_GT(incircle({0, 0}, {2, 0}, {0, 2}, {1, 1}), 0);
  EXPECT_LT(incircle({0, 0}, {2, 0}, {0, 2}, {3, 3}), 0);
  EXPECT_EQ(incircle({0, 0}, {2, 0}, {0, 2}, {2, 2}), 0);
  EXPECT_LT(incircle({0, 0}, {0, 2}, {2, 0}, {1, 1}), 0) << "a clockwise triangle reverses the sign";
  EXPECT_EQ(incircle({0, 0}, {2, 0}, {0, 2}, {2, 0}), 0) << "a corner lies on the circle";
}

TEST(Incircle, IsExactOnNearlyCocircularPoints) {
  expect_exact(tally_of<4>(60000, 201, [](Random& random) {
    return nearly_cocircular(random, random.between(0.1, 10), {random.between(-1, 1), random.between(-1, 1)});
  }));
}

TEST(Incircle, IsExactOnIntegerCircles) {
  const std::vector<Point> ring = testing::integer_circle(std::int64_t{5} * 5 * 13 * 13 * 17 * 17 * 29 * 29);
  ASSERT_GT(ring.size(), 200U);
  const auto on_circle = [&](Random& random) {
    Points<4> points;
    for (Point& point : points) point = ring[random.below(ring.size())];
    return points;
  };
  const Tally on = tally_of<4>(20000, 202, on_circle);
  expect_exact(on);
  EXPECT_EQ(on.zero, 20000U);
  expect_exact_and_degenerate(
      tally_of<4>(40000, 203, [&](Random& random) { return jittered(on_circle(random), random, 1); }));
}

TEST(Incircle, IsExactOnLattices) {
  expect_exact_and_degenerate(
      tally_of<4>(30000, 204, [](Random& random) { return on_integer_lattice<4>(random, 4); }));
  expect_exact_and_degenerate(tally_of<4>(
      30000, 205, [](Random& random) { return jittered(on_integer_lattice<4>(random, 2), random, 1); }));
}

// The unit cell of a lattice in metres at a place as in UTM: the step 0.01 is not a double.
TEST(Incircle, IsExactOnOffsetLattices) {
  expect_exact_and_degenerate(tally_of<4>(30000, 206, [](Random& random) {
    Points<4> points = on_integer_lattice<4>(random, 2);
    for (Point& point : points) point = {5e5 + 0.01 * point.x, 4e6 + 0.01 * point.y};
    return points;
  }));
}

TEST(Incircle, IsExactFarFromTheOrigin) {
  expect_exact(tally_of<4>(30000, 207, [](Random& random) {
    return nearly_cocircular(random, random.between(1, 100), {0x1p40, -0x1p44});
  }));
}

TEST(Incircle, IsExactAtEveryMagnitudeOfItsRange) {
  expect_exact_and_degenerate(tally_of<4>(60000, 208, [](Random& random) {
    return at_any_magnitude(
        random.below(2) == 0 ? on_integer_lattice<4>(random, 2) : nearly_cocircular(random, 1, {0.5, 0.25}),
        random);
  }));
}

TEST(Incircle, IsExactWhenMagnitudesDiffer) {
  expect_exact(tally_of<4>(30000, 209, of_different_magnitudes<4>));
}

TEST(Incircle, IsExactOnNearlyCollinearTriangles) {
  expect_exact(tally_of<4>(30000, 210, [](Random& random) {
    const Points<3> line = nearly_collinear(random);
    const Points<3> other = nearly_collinear(random);
    return Points<4>{line[0], line[1], line[2], random.below(2) == 0 ? other[2] : line[random.below(3)]};
  }));
}

// Swapping any two of the four rows of the determinant negates it.
TEST(Incircle, IsAntisymmetric) {
  const std::vector<Point> ring = testing::integer_circle(5525);
  Random random(211);
  for (int i = 0; i < 20000; ++i) {
    Points<4> p = on_integer_lattice<4>(random, 3);
    if (i % 2 == 0) {
      for (Point& point : p) point = ring[random.below(ring.size())];
      p = jittered(p, random, 1);
    }
    const int value = sign(incircle(p[0], p[1], p[2], p[3]));
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = j + 1; k < 4; ++k) {
        Points<4> q = p;
        std::swap(q[j], q[k]);
        ASSERT_EQ(sign(incircle(q[0], q[1], q[2], q[3])), -value)
            << text(p) << " swapping " << j << " and " << k;
      }
    }
  }
}

}  // namespace
}  // namespace polylidar
