#include "datasets/degenerate.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "datasets/random.hpp"
#include "datasets/sampling.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;

namespace {

constexpr std::size_t kPoints = 1000;

MultiPolygon square(double left, double bottom, double side) {
  return {{{{left, bottom}, {left + side, bottom}, {left + side, bottom + side}, {left, bottom + side}}, {}}};
}

std::vector<Point> sample(const MultiPolygon& shape, std::size_t n, const char* label) {
  return sample_uniform(shape, n, derive_seed(1, label));
}

DegenerateInput few(std::size_t count, const char* name, const char* title) {
  const std::vector<Point> corners = {{0, 0}, {4, 1}, {1, 3}};
  DegenerateInput input = {name, title, {corners.begin(), corners.begin() + static_cast<long>(count)}, {}};
  if (count == corners.size()) input.ground_truth = {{corners, {}}};
  return input;
}

/// Places on y = 2 x in random order, some of them several times.
std::vector<Point> on_a_line() {
  std::vector<Point> points;
  Random random(derive_seed(1, "collinear"));
  for (std::size_t i = 0; i < kPoints; ++i) {
    const auto x = static_cast<double>(random.below(kPoints));
    points.push_back({x, 2 * x});
  }
  return points;
}

DegenerateInput collinear_plus_one() {
  std::vector<Point> points = on_a_line();
  points.front() = {0, 0};
  points[1] = {1000, 2000};
  points.push_back({300, 700});
  return {"degenerate_collinear_plus_one",
          "All on a line but one",
          points,
          {{{{0, 0}, {1000, 2000}, {300, 700}}, {}}}};
}

DegenerateInput duplicates() {
  const MultiPolygon shape = square(0, 0, 1);
  const std::vector<Point> once = sample(shape, kPoints / 10, "duplicates");
  std::vector<Point> points;
  for (int i = 0; i < 10; ++i) points.insert(points.end(), once.begin(), once.end());
  return {"degenerate_duplicates", "Every point ten times", points, shape};
}

/// All 324 points with whole coordinates at a distance of 5 * 13 * 17 * 29 from the origin,
/// counter-clockwise.
DegenerateInput cocircular() {
  constexpr std::int64_t kRadius = 5 * 13 * 17 * 29;
  std::vector<Point> upper;  // y > 0, or y = 0 on the right; by falling x
  for (std::int64_t x = kRadius; x > -kRadius; --x) {
    const std::int64_t square = kRadius * kRadius - x * x;
    const auto y = static_cast<std::int64_t>(std::llround(std::sqrt(static_cast<double>(square))));
    if (y * y == square) upper.push_back({static_cast<double>(x), static_cast<double>(y)});
  }
  std::vector<Point> points = upper;
  for (const Point& point : upper) points.push_back({0 - point.x, 0 - point.y});
  return {"degenerate_cocircular", "All on a circle", points, {{points, {}}}};
}

DegenerateInput lattice() {
  constexpr int kSide = 32;
  std::vector<Point> points;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  }
  return {"degenerate_lattice", "A square lattice", points, square(-0.5, -0.5, kSide)};
}

DegenerateInput square_sample(const char* name, const char* title, const MultiPolygon& shape) {
  return {name, title, sample(shape, kPoints, name), shape};
}

DegenerateInput two_clusters() {
  MultiPolygon shape = square(0, 0, 1);
  shape.push_back(square(1e6, 0, 1).front());
  std::vector<Point> points = sample({shape[0]}, kPoints / 2, "first cluster");
  const std::vector<Point> second = sample({shape[1]}, kPoints / 2, "second cluster");
  points.insert(points.end(), second.begin(), second.end());
  return {"degenerate_two_clusters", "Two squares, a million sides apart", points, shape};
}

}  // namespace

const std::vector<DegenerateInput>& degenerate_inputs() {
  static const std::vector<DegenerateInput> inputs = {
      few(0, "degenerate_empty", "No points"),
      few(1, "degenerate_one", "One point"),
      few(2, "degenerate_two", "Two points"),
      few(3, "degenerate_three", "Three points"),
      {"degenerate_equal", "All at one place", std::vector<Point>(kPoints, Point{3, 4}), {}},
      {"degenerate_collinear", "All on a line", on_a_line(), {}},
      collinear_plus_one(),
      duplicates(),
      cocircular(),
      lattice(),
      square_sample("degenerate_far_away", "A square of side 1 at (1e8, 1e8)", square(1e8, 1e8, 1)),
      square_sample("degenerate_tiny", "A square of side 1e-8", square(0, 0, 1e-8)),
      two_clusters(),
  };
  return inputs;
}

}  // namespace hullbench
