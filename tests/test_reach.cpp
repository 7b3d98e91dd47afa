// What is claimed of the cells near uncertain points and of triangles whose circle lies in them
// (core/src/reach.hpp), just inside and just outside each bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/src/reach.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::detail {
namespace {

using testing::Random;

constexpr double kFullTurn = 6.283185307179586;
constexpr std::size_t kColumns = 64;
constexpr std::size_t kMiddle = kColumns / 2;
constexpr double kMid = static_cast<double>(kMiddle);
constexpr double kInside = 1 - 0x1p-20;  // just so, of a radius

// Cells of side 1, so that a radius of kRadius is 6.
Grid square_grid() {
  constexpr double kSide = kColumns - 0.5;
  return Grid({{0, 0}, {kSide, kSide}}, 1);
}

Grid::Cell cell_at(const Grid& grid, std::size_t column, std::size_t row) {
  return grid.cell({static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
}

Point at(const Point& centre, double distance, double angle) {
  return {centre.x + distance * std::cos(angle), centre.y + distance * std::sin(angle)};
}

// All or none of the cells, also those of the margin.
void set_every(const Grid& grid, bool is_set, Bitmap& cells) {
  cells.clear(grid.word_count());
  if (is_set) std::fill_n(cells.words(), grid.word_count(), ~Bitmap::Word{0});
}

// A point of the cell in the middle, now and then in a corner of it.
Point in_middle(Random& random) {
  const auto coordinate = [&] { return kMid + std::array{0.0, 1 - 0x1p-40, random.unit()}[random.below(3)]; };
  return {coordinate(), coordinate()};
}

// How far apart points of the cell in the middle and of this one are at least.
double least_distance(std::size_t column, std::size_t row) {
  const auto gap = [](std::size_t place) {
    return std::max(std::abs(static_cast<double>(place) - kMid) - 1, 0.0);
  };
  return std::hypot(gap(column), gap(row));
}

// is_marked(cell) is true of all cells that come within `reach` of the cell in the middle, and of no others.
template <class IsMarked>
void expect_marked_within(double reach, const Grid& grid, const IsMarked& is_marked) {
  constexpr double kRounding = 0x1p-10;
  for (std::size_t row = 0; row < kColumns; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      ASSERT_EQ(is_marked(cell_at(grid, column, row)), least_distance(column, row) < reach + kRounding)
          << column << ", " << row;
    }
  }
}

TEST(Reach, OfAStreamIsTwoRadii) {
  const Grid grid = square_grid();
  Bitmap map;
  set_every(grid, true, map);
  ReachedCells reached;
  reached.begin(map, grid.word_count());
  mark_reach(grid, cell_at(grid, kMiddle, kMiddle), reached);
  expect_marked_within(2 * kRadius, grid, [&](Grid::Cell cell) { return reached.test(cell); });
  // A shard looks for uncertain points 13 rows beyond its band: there are such cells, and none farther away.
  for (const std::size_t row : {kMiddle - kReachedRows, kMiddle + kReachedRows}) {
    EXPECT_TRUE(reached.test(cell_at(grid, kMiddle, row)));
  }
  for (const std::size_t row : {kMiddle - kReachedRows - 1, kMiddle + kReachedRows + 1}) {
    EXPECT_FALSE(reached.test(cell_at(grid, kMiddle, row)));
  }
  Random random(1);
  for (int k = 0; k < 10'000; ++k) {
    const Point q = at(in_middle(random), 2 * kRadius * kInside, kFullTurn * random.unit());
    ASSERT_TRUE(reached.test(grid.cell(q))) << q.x << ", " << q.y;
  }
}

// Marks what points of the cell in the middle reach that have large triangles in the directions `open`.
void mark_from_middle(const Grid& grid, Directions open, Bitmap& reached) {
  set_every(grid, false, reached);
  const auto cell = static_cast<std::uint32_t>(cell_at(grid, kMiddle, kMiddle));
  mark_reach(grid, &cell, std::array{0U}, std::array{open}, reached);
}

TEST(Reach, IsTwoThirdsWhereNoDirectionIsOpen) {
  const Grid grid = square_grid();
  Bitmap reached;
  mark_from_middle(grid, 0, reached);
  expect_marked_within(2 * kNearRadius, grid, [&](Grid::Cell cell) { return reached.test(cell); });
}

// The corners of a triangle at p whose circumcentre lies in direction u, and whose circumradius is below r,
// lie in the disk of radius r with the centre p + r u.
TEST(Reach, InAnOpenDirectionHasTheDisksThere) {
  const Grid grid = square_grid();
  Random random(2);
  Bitmap reached;
  for (unsigned fraction = 0; fraction < kTurnFractions; ++fraction) {
    SCOPED_TRACE(fraction);
    mark_from_middle(grid, static_cast<Directions>(1U << fraction), reached);
    for (int k = 0; k < 10'000; ++k) {
      const Point p = in_middle(random);
      const double along = std::array{0.0, 1.0, random.unit()}[random.below(3)];
      const Point centre = at(p, kRadius, kFullTurn * (fraction + along) / kTurnFractions);
      const Point q = at(centre, kRadius * kInside, kFullTurn * random.unit());
      ASSERT_TRUE(reached.test(grid.cell(q))) << q.x << ", " << q.y;
      const Point near = at(p, 2 * kNearRadius * kInside, kFullTurn * random.unit());
      ASSERT_TRUE(reached.test(grid.cell(near))) << near.x << ", " << near.y;
    }
    std::size_t marked = 0;
    std::size_t within_two_radii = 0;
    for (std::size_t row = 0; row < kColumns; ++row) {
      for (std::size_t column = 0; column < kColumns; ++column) {
        marked += reached.test(cell_at(grid, column, row)) ? 1U : 0U;
        within_two_radii += least_distance(column, row) < 2 * kRadius ? 1U : 0U;
      }
    }
    EXPECT_LT(marked, 3 * within_two_radii / 4);
  }
}

// Three points on a circle, counter-clockwise; half of the time so near each other that the far side of the
// circle's box is as far away as can be.
std::array<Point, 3> on_circle(const Point& centre, double radius, Random& random) {
  const bool is_narrow = random.below(2) == 0;
  const double first =
      kFullTurn * (is_narrow ? 0.125 + 0.25 * static_cast<double>(random.below(4)) - 0.002 : random.unit());
  const double widest = is_narrow ? 0.002 : 0.3;  // of a turn
  const double second = first + kFullTurn * random.between(0.3 * widest, widest);
  const double third = second + kFullTurn * random.between(0.3 * widest, widest);
  return {at(centre, radius, first), at(centre, radius, second), at(centre, radius, third)};
}

// After that a triangle is surely whole, if it is one of the whole mesh: its circle's box is reached.
TEST(Reach, OfAnEnlargementHasTheBoxesOfCircles) {
  const Grid grid = square_grid();
  Random random(3);
  ThreadPool pool;
  DelaunayBuilder builder;
  Bitmap occupied;
  set_every(grid, true, occupied);
  Bitmap reached;
  for (int k = 0; k < 5'000; ++k) {
    const Point centre{kMid + random.unit(), kMid + random.unit()};
    const double radius = random.below(2) == 0 ? kRadius * (1 - 0x1p-10) : random.between(0.1, kRadius);
    const std::array<Point, 3> corners = on_circle(centre, radius, random);
    builder.build(corners, pool);
    Mesh::Index t = 0;
    while (builder.mesh().is_ghost(t)) ++t;
    const Triangle triangle(builder.mesh(), builder.vertices(), t);
    set_every(grid, false, reached);
    EXPECT_FALSE(is_surely_whole(triangle, grid, occupied, reached));
    mark_reach_round(std::array{t}, builder, grid, reached);
    ASSERT_TRUE(is_surely_whole(triangle, grid, occupied, reached)) << centre.x << ", " << centre.y;
    Bitmap map;
    set_every(grid, true, map);
    ReachedCells of_stream;
    of_stream.begin(map, grid.word_count());
    mark_reach_round(std::array{t}, builder, grid, of_stream);
    ASSERT_TRUE(is_surely_whole(triangle, grid, of_stream)) << centre.x << ", " << centre.y;
  }
}

TEST(SurelyWhole, IsNoTriangleWhoseCircleHasACellThatIsNotReached) {
  const Grid grid = square_grid();
  Random random(4);
  Bitmap occupied;
  set_every(grid, true, occupied);
  Bitmap reached;
  set_every(grid, true, reached);
  for (int k = 0; k < 5'000; ++k) {
    const Point centre{kMid + random.unit(), kMid + random.unit()};
    const double radius = random.between(0.1, kRadius * kInside);
    const auto [a, b, c] = on_circle(centre, radius, random);
    const Triangle triangle(0, a, b, c);
    const auto is_whole_without = [&](Grid::Cell cell) {
      reached.clear_run(cell, 1);
      const bool is_whole = is_surely_whole(triangle, grid, occupied, reached);
      reached.set(cell);
      return is_whole;
    };
    ASSERT_TRUE(is_surely_whole(triangle, grid, occupied, reached));
    for (const double turn : {0.0, 0.25, 0.5, 0.75, random.unit()}) {
      const Point inside = at(centre, radius * kInside, kFullTurn * turn);
      EXPECT_FALSE(is_whole_without(grid.cell(inside))) << turn;
    }
    // Beside the box, by more than rounding may move a point.
    const double beyond = radius + 1 + 0x1p-5;
    for (const double turn : {0.0, 0.25, 0.5, 0.75}) {
      EXPECT_TRUE(is_whole_without(grid.cell(at(centre, beyond, kFullTurn * turn)))) << turn;
    }
    const Grid::Cell empty = grid.cell(centre);
    occupied.clear_run(empty, 1);
    EXPECT_TRUE(is_whole_without(empty)) << "a cell without points";
    occupied.set(empty);
  }
}

TEST(SurelyWhole, IsNoTriangleWithAWideCircleOrAShortEdge) {
  const Grid grid = square_grid();
  Bitmap occupied;
  Bitmap reached;
  set_every(grid, true, occupied);
  set_every(grid, true, reached);
  const auto is_whole = [&](const Point& a, const Point& b, const Point& c) {
    return is_surely_whole(Triangle(0, a, b, c), grid, occupied, reached);
  };
  const Point middle{kMid, kMid};
  const auto of_radius = [&](double radius) {
    return is_whole(at(middle, radius, 0), at(middle, radius, 2), at(middle, radius, 4));
  };
  EXPECT_TRUE(of_radius(kRadius * (1 - 0x1p-20)));
  EXPECT_FALSE(of_radius(kRadius * (1 + 0x1p-20)));
  const auto of_width = [&](double width) {
    return is_whole(middle, {kMid + 4, kMid}, {kMid, kMid + width});
  };
  EXPECT_TRUE(of_width(4 * 0x1p-21 * (1 + 0x1p-10)));
  EXPECT_FALSE(of_width(4 * 0x1p-21 * (1 - 0x1p-10)));
}

}  // namespace
}  // namespace polylidar::detail
