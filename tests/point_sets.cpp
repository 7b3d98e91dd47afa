#include "tests/point_sets.hpp"

#include <cmath>
#include <utility>

namespace polylidar::testing {

std::vector<Point> uniform_points(std::size_t count, std::uint64_t seed, double side) {
  Random random(seed);
  std::vector<Point> points(count);
  for (Point& point : points) {
    point.x = side * random.unit();
    point.y = side * random.unit();
  }
  return points;
}

std::vector<Point> integer_points(std::size_t count, std::uint64_t seed, std::int64_t side) {
  Random random(seed);
  std::vector<Point> points(count);
  for (Point& point : points) {
    point.x = static_cast<double>(random.below(static_cast<std::size_t>(side)));
    point.y = static_cast<double>(random.below(static_cast<std::size_t>(side)));
  }
  return points;
}

std::vector<Point> lattice(std::size_t columns, std::size_t rows, double step, Point origin) {
  std::vector<Point> points;
  points.reserve(columns * rows);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      points.push_back(
          {origin.x + step * static_cast<double>(column), origin.y + step * static_cast<double>(row)});
    }
  }
  return points;
}

std::vector<Point> lattice_with_gaps(std::uint64_t seed) {
  Random random(seed);
  const double density = random.between(0.3, 0.97);
  std::vector<Point> points = lattice(14, 14);
  std::erase_if(points, [&](const Point&) { return random.unit() >= density; });
  return points;
}

std::vector<Point> rotated(std::vector<Point> points, double radians) {
  const double cosine = std::cos(radians);
  const double sine = std::sin(radians);
  for (Point& point : points) point = {cosine * point.x - sine * point.y, sine * point.x + cosine * point.y};
  return points;
}

std::vector<Point> near_one(std::vector<Point> points) {
  const Box box = bounding_box(points);
  const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  if (!(extent > 0)) return points;
  const int exponent = -std::ilogb(extent);
  for (Point& point : points) point = {std::ldexp(point.x, exponent), std::ldexp(point.y, exponent)};
  return points;
}

std::vector<Point> scaled(std::vector<Point> points, int exponent_x, int exponent_y) {
  for (Point& point : points) point = {std::ldexp(point.x, exponent_x), std::ldexp(point.y, exponent_y)};
  return points;
}

std::optional<Exponents> exponents(std::span<const Point> points) {
  std::optional<Exponents> range;
  for (const Point& point : points) {
    for (const double coordinate : {point.x, point.y}) {
      if (coordinate == 0) continue;
      const int exponent = std::ilogb(coordinate);
      if (!range) range = {exponent, exponent};
      range = {std::min(range->least, exponent), std::max(range->greatest, exponent)};
    }
  }
  return range;
}

std::vector<Point> circle(std::size_t count, double radius, Point centre) {
  std::vector<Point> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(count);
    points[i] = {centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  }
  return points;
}

std::vector<Point> integer_circle(std::int64_t squared_radius) {
  std::vector<Point> points;
  for (std::int64_t x = 0; x * x <= squared_radius; ++x) {
    const std::int64_t rest = squared_radius - x * x;
    const auto y = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(rest))));
    if (y * y != rest) continue;
    for (const double u : {-1.0, 1.0}) {
      for (const double v : {-1.0, 1.0}) {
        if ((x == 0 && u < 0) || (y == 0 && v < 0)) continue;
        points.push_back({u * static_cast<double>(x), v * static_cast<double>(y)});
      }
    }
  }
  return points;
}

std::vector<Point> shuffled(std::vector<Point> points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
  return points;
}

std::vector<Point> transformed(std::vector<Point> points, double scale, Point offset) {
  for (Point& point : points) point = {scale * point.x + offset.x, scale * point.y + offset.y};
  return points;
}

std::vector<Point> joined(std::vector<Point> points, const std::vector<Point>& more) {
  points.insert(points.end(), more.begin(), more.end());
  return points;
}

std::vector<Point> repeated(const std::vector<Point>& points, std::size_t times) {
  std::vector<Point> copies;
  for (std::size_t i = 0; i < times; ++i) copies.insert(copies.end(), points.begin(), points.end());
  return copies;
}

namespace {

std::vector<Point> clusters(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points;
  for (std::size_t cluster = 0; cluster < 8; ++cluster) {
    const Point centre{random.between(-100, 100), random.between(-100, 100)};
    const double radius = std::ldexp(1.0, -static_cast<int>(4 * cluster));
    for (std::size_t i = 0; i < count / 8; ++i) {
      points.push_back({centre.x + radius * random.unit(), centre.y + radius * random.unit()});
    }
  }
  return points;
}

std::vector<Point> parabola(std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = static_cast<double>(i) - static_cast<double>(count) / 2;
    points.push_back({x, x * x});
  }
  return points;
}

// Pairs of columns of lattice points, 4 apart, on two rows that join them: a long outline with deep bays.
std::vector<Point> comb_shape(std::size_t teeth) {
  std::vector<Point> points = lattice(4 * teeth, 2);
  for (std::size_t tooth = 0; tooth < teeth; ++tooth) {
    points = joined(points, lattice(2, 40, 1, {4 * static_cast<double>(tooth), 2}));
  }
  return points;
}

// Triangles far from one another.
std::vector<Point> islands(std::size_t columns, std::size_t rows) {
  std::vector<Point> points;
  for (const Point& corner : lattice(columns, rows, 10)) {
    points.insert(points.end(), {corner, {corner.x + 1, corner.y}, {corner.x, corner.y + 1}});
  }
  return points;
}

// Two rows of points, one far denser: long thin triangles between them.
std::vector<Point> comb(std::size_t teeth) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < teeth; ++i) points.push_back({static_cast<double>(i), 0});
  for (std::size_t i = 0; i < teeth * 10; ++i) points.push_back({0.1 * static_cast<double>(i), 1000});
  return points;
}

// Rings of points round one centre: cocircular by symmetry, and the centre sees all of them.
std::vector<Point> spider_web() {
  std::vector<Point> points{{0, 0}};
  for (int ring = 1; ring <= 20; ++ring) points = joined(points, circle(24, ring));
  return points;
}

// Lattice points, each coordinate moved by at most one unit in its last place.
std::vector<Point> jittered_lattice(std::uint64_t seed) {
  Random random(seed);
  std::vector<Point> points = lattice(25, 25, 0.7, {3, 5});
  const auto moved = [&](double x) { return std::nextafter(x, random.below(2) == 0 ? -1e300 : 1e300); };
  for (Point& point : points) {
    if (random.below(2) == 0) point.x = moved(point.x);
    if (random.below(2) == 0) point.y = moved(point.y);
  }
  return points;
}

std::vector<PointSet> regular_sets() {
  return {{"integer lattice", lattice(30, 30)},
          {"shuffled integer lattice", shuffled(lattice(30, 30), 1)},
          {"two columns", lattice(2, 300)},
          {"lattice turned by 0.3 rad", rotated(lattice(40, 40), 0.3)},
          {"lattice turned by 45 degrees", rotated(lattice(30, 30), 0.7853981633974483)},
          {"lattice moved by ulps", jittered_lattice(7)},
          {"offset lattice like UTM", lattice(40, 40, 0.01, {5e5, 4e6})},
          {"hexagonal lattice", joined(lattice(20, 20, 1), lattice(20, 20, 1, {0.5, 0.5}))},
          {"anisotropic lattice", [] {
             std::vector<Point> points = lattice(30, 30);
             for (Point& point : points) point.y *= 0x1p-20;
             return points;
           }()}};
}

std::vector<PointSet> cocircular_sets() {
  return {{"circle", circle(1000, 1)},
          {"circle, shuffled", shuffled(circle(1000, 1), 3)},
          {"circle far from the origin", circle(500, 1, {1e6, -1e6})},
          {"circle with its centre", joined(circle(500, 10), {{0, 0}})},
          {"exactly cocircular integers", integer_circle(std::int64_t{5} * 5 * 13 * 13 * 17 * 17 * 29 * 29)},
          {"exactly cocircular integers, shuffled",
           shuffled(integer_circle(std::int64_t{5} * 5 * 13 * 13 * 17 * 17), 4)},
          {"exactly cocircular integers and the centre", joined(integer_circle(5525), {{0, 0}})},
          {"spider web", spider_web()}};
}

std::vector<PointSet> repeating_sets() {
  const std::vector<Point> base = uniform_points(200, 21);
  std::vector<Point> signed_zeros = lattice(9, 9, 1, {-4, -4});
  for (int i = -4; i <= 4; ++i) {
    signed_zeros.push_back({static_cast<double>(i), -0.0});
    signed_zeros.push_back({-0.0, static_cast<double>(i)});
  }
  return {{"a few duplicates", joined(uniform_points(300, 20), {base[0], base[0], base[1]})},
          {"every point three times", shuffled(repeated(base, 3), 5)},
          {"small integers with many repeats", integer_points(2000, 22, 12)},
          {"zeros of both signs", signed_zeros}};
}

std::vector<PointSet> lopsided_sets() {
  const std::vector<Point> line = lattice(300, 1, 0.25);
  return {{"parabola", parabola(500)},
          {"comb", comb(60)},
          {"two clusters 1e9 apart",
           joined(uniform_points(150, 30), transformed(uniform_points(150, 31), 1, {1e9, 1e9}))},
          {"clusters within clusters", clusters(800, 32)},
          {"line and a point beside it", joined(line, {{10, 1}})},
          {"line and a point far beside it", joined(line, {{10, 1e12}})},
          {"line between two points", joined(line, {{10, 1}, {20, -1e-9}})},
          {"nearly collinear", rotated(line, 0.3)},
          {"nearly collinear, far away", transformed(rotated(line, 1.1), 1, {1e7, 3e7})},
          {"convex position", [] {
             std::vector<Point> points;
             for (int i = -40; i <= 40; ++i) {
               const double x = i;
               points.push_back({x, x * x * x * x});
             }
             return points;
           }()}};
}

std::vector<PointSet> scaled_sets() {
  const std::vector<Point> centred = transformed(uniform_points(200, 40), 2, {-1, -1});
  return {{"coordinates near 1e100", transformed(centred, 1e100, {})},
          {"coordinates near 1e-100", transformed(centred, 1e-100, {})},
          {"lattice of step 1e-100", lattice(15, 15, 1e-100)},
          {"lattice of step 1e100", lattice(15, 15, 1e100)},
          {"coordinates near 1e300", transformed(centred, 1e300, {})},
          {"coordinates near 1e-290", transformed(centred, 1e-290, {})},
          {"uniform, far from the origin", transformed(uniform_points(500, 41), 1, {1e8, -1e8})}};
}

}  // namespace

std::vector<PointSet> nasty_point_sets() {
  std::vector<PointSet> sets = {{"uniform, 10 points", uniform_points(10, 11)},
                                {"uniform, 100 points", uniform_points(100, 12)},
                                {"uniform, 3000 points", uniform_points(3000, 13)},
                                {"integers, 1000 points", integer_points(1000, 14, 1 << 20)}};
  for (auto& part : {regular_sets(), cocircular_sets(), repeating_sets(), lopsided_sets(), scaled_sets(),
                     flat_point_sets()}) {
    sets.insert(sets.end(), part.begin(), part.end());
  }
  return sets;
}

std::vector<NamedCase> named_cases() {
  // Keeps the triangles of a unit lattice's cells (circumradius 0.707) and no others (the next is 1).
  constexpr Options kUnitCells{.alpha = 0.75};
  constexpr Options kAll{.alpha = kNoLimit};
  return {{"lattice turned by 0.3 rad", rotated(lattice(300, 300), 0.3), {kAll, kUnitCells}},
          {"lattice of UTM size",
           shuffled(lattice(200, 200, 0.01, {5e5, 4e6}), 1),
           {kAll, {.alpha = 0.0075}, {.max_edge_length = 0.0145}}},
          {"circle", circle(5000, 1000), {kAll, {.max_edge_length = 501}}},
          {"circle, shuffled", shuffled(circle(5000, 1000, {1, 2}), 2), {kAll, {.max_edge_length = 501}}},
          {"one point many times", std::vector<Point>(5000, Point{0.1, 0.2}), {kAll, kUnitCells}},
          {"two clusters 1e9 apart",
           joined(uniform_points(2000, 33), transformed(uniform_points(2000, 34), 1, {1e9, 1e9})),
           {kAll, {.alpha = 0.05}, {.max_edge_length = 10}}},
          {"parabola", parabola(3000), {kAll, {.max_edge_length = 100.5}}},
          {"comb", shuffled(comb_shape(100), 3), {kAll, kUnitCells}},
          {"islands", shuffled(islands(64, 64), 4), {kAll, kUnitCells, {.max_edge_length = 1.5}}}};
}

std::vector<PointSet> flat_point_sets() {
  std::vector<Point> diagonal;
  diagonal.reserve(200);
  for (int i = 0; i < 200; ++i) diagonal.push_back({static_cast<double>(i) * 3, static_cast<double>(i) * 7});
  return {{"no points", {}},
          {"one point", {{1, 2}}},
          {"two points", {{1, 2}, {3, 4}}},
          {"one point many times", std::vector<Point>(50, Point{0.1, 0.2})},
          {"two points many times",
           shuffled(joined(std::vector<Point>(20, {0, 1}), std::vector<Point>(20, {1, 0})), 6)},
          {"horizontal line", lattice(200, 1, 0.1, {0, 0.3})},
          {"vertical line", lattice(1, 200, 0.1, {0.3, 0})},
          {"diagonal line", shuffled(diagonal, 8)},
          {"line with repeats", shuffled(joined(diagonal, diagonal), 9)}};
}

}  // namespace polylidar::testing
