// Point sets that triangulations and hulls tend to get wrong, and random numbers that are the same
// everywhere.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/geometry.hpp"

namespace polylidar::testing {

/// Numbers from the raw output of std::mt19937_64, which the standard fixes; its distributions it does not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, 1), a multiple of 2^-53.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  /// Uniform in [low, high), up to rounding.
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// 0 ... count - 1; the bias of the remainder is below 2^-32 for the counts used here.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  /// An integer in [-limit, limit] as a double.
  double integer(std::int64_t limit) {
    return static_cast<double>(static_cast<std::int64_t>(below(static_cast<std::size_t>(2 * limit + 1))) -
                               limit);
  }

 private:
  std::mt19937_64 engine_;
};

/// A point set and what to call it when a test fails on it.
struct PointSet {
  std::string name;
  std::vector<Point> points;
};

inline double distance(const Point& a, const Point& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// Of a triangle that is counter-clockwise.
inline double circumradius(const Point& a, const Point& b, const Point& c) {
  const double cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return distance(a, b) * distance(b, c) * distance(c, a) / (2 * cross);
}

/// `count` points, uniform in the square [0, side)^2.
std::vector<Point> uniform_points(std::size_t count, std::uint64_t seed, double side = 1);

/// The first `count` of uniform points of a rectangle with a corner at the origin that `is_kept` takes, which
/// is asked with the random numbers too.
template <class IsKept>
std::vector<Point> points_where(std::size_t count, std::uint64_t seed, double width, double height,
                                const IsKept& is_kept) {
  Random random(seed);
  std::vector<Point> points;
  while (points.size() < count) {
    const Point p{random.between(0, width), random.between(0, height)};
    if (is_kept(p, random)) points.push_back(p);
  }
  return points;
}

/// `count` points with integer coordinates in [0, side): exact under translation, mirroring and doubling.
std::vector<Point> integer_points(std::size_t count, std::uint64_t seed, std::int64_t side);

/// `columns` x `rows` points `step` apart, row by row from `origin`.
std::vector<Point> lattice(std::size_t columns, std::size_t rows, double step = 1, Point origin = {});

/// A lattice of 14 x 14 points of which some are missing, between a few and most: its gaps touch one another
/// and the outside at vertices, and its triangulations are many.
std::vector<Point> lattice_with_gaps(std::uint64_t seed);

/// `points` turned by `radians` round the origin; rounding turns exact degeneracies into near ones.
std::vector<Point> rotated(std::vector<Point> points, double radians);

/// `points` with an extent near 1, for libraries that are not made for coordinates whose squares overflow: a
/// power of two changes no shape.
std::vector<Point> near_one(std::vector<Point> points);

/// `points` with coordinates that are 2^exponent_x and 2^exponent_y times as large.
std::vector<Point> scaled(std::vector<Point> points, int exponent_x, int exponent_y);

/// The least and the greatest exponent of a coordinate that is not zero.
struct Exponents {
  int least = 0;
  int greatest = 0;
};

/// None when all coordinates are zero; they are finite.
std::optional<Exponents> exponents(std::span<const Point> points);

/// Binary orders of magnitude that the core takes at a time: from 2^-116 to below 2^150.
inline constexpr int kLargestSpan = 265;

/// `count` points on a circle, as near to it as doubles come.
std::vector<Point> circle(std::size_t count, double radius, Point centre = {});

/// All integer points at distance exactly sqrt(squared_radius) from the origin.
std::vector<Point> integer_circle(std::int64_t squared_radius);

/// `points` that are `scale` times as large and then moved by `offset`.
std::vector<Point> transformed(std::vector<Point> points, double scale, Point offset);

/// `points` and then `more`.
std::vector<Point> joined(std::vector<Point> points, const std::vector<Point>& more);

/// `points` so many times, one copy after another.
std::vector<Point> repeated(const std::vector<Point>& points, std::size_t times);

/// `points` in an order drawn from `seed`.
std::vector<Point> shuffled(std::vector<Point> points, std::uint64_t seed);

/// Sets of every kind: general, regular, cocircular, collinear, repeating, lopsided, huge, tiny; some hundred
/// to some thousand points each.
std::vector<PointSet> nasty_point_sets();

/// A point set with limits that suit it: none of its triangles is so near a limit that rounding could decide.
struct NamedCase {
  std::string name;
  std::vector<Point> points;
  std::vector<Options> options;
};

/// The inputs that hull and triangulation libraries are known to get wrong, or slow, at a size of thousands
/// of points; those of nasty_point_sets() are small enough for quadratic checks under many options.
std::vector<NamedCase> named_cases();

/// The sets of nasty_point_sets() that hold no triangle: too few points, or all on a line.
std::vector<PointSet> flat_point_sets();

}  // namespace polylidar::testing
