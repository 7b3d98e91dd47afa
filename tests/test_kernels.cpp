// The loops over all points give the same whatever registers they are compiled for, and what simple code
// gives.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "core/src/cell_numbers.hpp"
#include "core/src/coordinate_range.hpp"
#include "core/src/near_points.hpp"
#include "tests/each_kernel.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::detail {
namespace {

using testing::Random;

class Kernels : public testing::KernelTest {};

INSTANTIATE_TEST_SUITE_P(Each, Kernels, testing::each_kernel(), testing::name_of_kernel_test);

TEST(AllKernels, ThePortableOneIsSupportedAndTheBestIs) {
  EXPECT_TRUE(is_supported(Kernel::kPortable));
  EXPECT_TRUE(is_supported(best_kernel()));
}

TEST_P(Kernels, NumberCells) {
  Random random(1);
  for (std::size_t count = 0; count < 300; ++count) {
    SCOPED_TRACE(count);
    const double side = random.between(1, 1000);
    const CellNumbering numbering{{-3, 7}, random.between(0.1, 50) / side, 51, 9};
    std::vector<Point> points(count);
    for (Point& p : points) p = {-3 + side * random.unit(), 7 + side * random.unit()};
    std::vector<std::uint32_t> expected;
    for (const Point& p : points) {
      const double row = std::floor((p.y - 7) * numbering.cells_per_length);
      const double column = std::floor((p.x + 3) * numbering.cells_per_length);
      expected.push_back(static_cast<std::uint32_t>(9 + 51 * row + column));
    }
    std::vector<std::uint32_t> numbers(count + 1, 77);
    number_cells(points, numbering, numbers.data(), GetParam());
    EXPECT_EQ(numbers.back(), 77U) << "written beyond the end";
    numbers.pop_back();
    EXPECT_EQ(numbers, expected);
    // With more cells than 32 bits number, and a beginning that wraps round.
    const WideNumbering wide{{-3, 7}, numbering.cells_per_length, 4'000'000'000U, ~std::uint64_t{0} - 7};
    std::vector<std::uint64_t> wide_expected;
    for (const Point& p : points) {
      const auto row = static_cast<std::uint64_t>((p.y - 7) * wide.cells_per_length);
      const auto column = static_cast<std::uint64_t>((p.x + 3) * wide.cells_per_length);
      wide_expected.push_back(row * 4'000'000'000U + column - 8);
    }
    std::vector<std::uint64_t> wide_numbers(count);
    number_cells(points, wide, wide_numbers.data(), GetParam());
    EXPECT_EQ(wide_numbers, wide_expected);
  }
}

TEST(AllKernels, NumberCellsInBlocks) {
  Random random(1);
  for (std::size_t count = 0; count < 300; ++count) {
    const CellNumbering numbering{{-3, 7}, 0.4, 51, 9};
    std::vector<Point> points(count);
    for (Point& p : points) p = {-3 + 100 * random.unit(), 7 + 100 * random.unit()};
    std::vector<std::uint32_t> expected(count);
    number_cells(points, numbering, expected.data(), Kernel::kPortable);
    std::vector<std::uint32_t> own(count);
    std::size_t visited = 0;
    number_in_blocks(points, numbering, own.data(), [&](std::size_t begin, std::size_t end) {
      EXPECT_EQ(begin, visited);
      visited = end;
    });
    EXPECT_EQ(visited, count);
    EXPECT_EQ(own, expected);
    std::vector<std::uint32_t> in_blocks;
    visit_numbered(points, numbering,
                   [&](std::size_t begin, std::span<const Point> block, const std::uint32_t* numbers) {
                     EXPECT_EQ(begin, in_blocks.size());
                     EXPECT_EQ(block.data(), points.data() + begin);
                     in_blocks.insert(in_blocks.end(), numbers, numbers + block.size());
                   });
    EXPECT_EQ(in_blocks, expected);
  }
}

TEST(AllKernels, KnowWhatIsNearABorder) {
  EXPECT_FALSE(is_near_border(0));
  EXPECT_FALSE(is_near_border(0x1p-40));
  EXPECT_FALSE(is_near_border(0.5));
  for (const double border : {1.0, 2.0, 777.0, 1048575.0}) {
    for (const double distance : {0.0, -0x1p-29, 0x1p-29, -0x1p-28, 0x1p-28 - 0x1p-31}) {
      EXPECT_TRUE(is_near_border(border + distance)) << border << " + " << distance;
    }
    for (const double distance : {-0x1p-27, 0x1p-27, -0x1p-28 - 0x1p-31, 0x1p-28, -0.25, 0.25}) {
      EXPECT_FALSE(is_near_border(border + distance)) << border << " + " << distance;
    }
  }
}

TEST_P(Kernels, FindCoordinatesNearBorders) {
  Random random(4);
  const CellNumbering numbering{{-2, 5}, 8, 10, 0};
  for (std::size_t count = 0; count < 60; ++count) {
    std::vector<Point> points(count);
    for (Point& p : points)
      p = {-2 + (static_cast<double>(random.below(9)) + 0.25) / 8,
           5 + (static_cast<double>(random.below(9)) + 0.75) / 8};
    EXPECT_FALSE(any_near_border(points, numbering, GetParam()));
    if (count == 0) continue;
    Point& p = points[random.below(count)];
    (count % 2 == 0 ? p.x : p.y) += count % 2 == 0 ? 0.75 / 8 : 0.25 / 8;
    EXPECT_TRUE(any_near_border(points, numbering, GetParam())) << count;
  }
}

TEST_P(Kernels, FindNearPoints) {
  Random random(5);
  for (std::size_t count = 0; count < 400; ++count) {
    std::vector<Point> points(count);
    for (Point& p : points) p = {random.between(-30, 30), random.between(-30, 30)};
    const Point centre = {random.between(-9, 9), random.between(-9, 9)};
    const double squared_radius = count % 2 == 0 ? 0.5 : 200;  // in few blocks, and in nearly all
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = points[i].x - centre.x;
      const double y = points[i].y - centre.y;
      if (x * x + y * y < squared_radius) expected.push_back(i);
    }
    std::vector<std::size_t> found;
    const auto visit = [&](std::size_t i, double squared_distance) {
      found.push_back(i);
      EXPECT_LT(squared_distance, squared_radius);
    };
    for_each_near(points, centre, squared_radius, visit, GetParam());
    EXPECT_EQ(found, expected) << count << " points";
  }
}

// What counts is in one point alone, once in each place of a vector and behind the last whole one: calls
// visit(points, place) with that place among 1 to 39 points.
template <class Visit>
void for_each_place(const Visit& visit) {
  Random random(2);
  for (std::size_t count = 1; count < 40; ++count) {
    SCOPED_TRACE(::testing::Message() << count << " points");
    std::vector<Point> points(count);
    for (Point& p : points) p = {random.between(-5, 3), random.between(100, 900)};
    visit(points, random.below(count));
    visit(points, count - 1);
  }
}

TEST_P(Kernels, MeasureCoordinates) {
  ThreadPool pool;
  const auto measure = [&](const std::vector<Point>& points) {
    return measure_coordinates(points, pool, GetParam());
  };
  for_each_place([&](const std::vector<Point>& points, std::size_t special) {
    std::vector<Point> extreme = points;
    extreme[special] = {-0x1p40, 0x1p41};
    std::vector<Point> tiny = points;
    tiny[special].x = 0x1p-130;
    std::vector<Point> bad = points;
    bad[special].y = std::numeric_limits<double>::quiet_NaN();
    std::vector<Point> infinite = points;
    infinite[special].x = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(measure(points).box, bounding_box(points));
    EXPECT_EQ(measure(extreme).box, bounding_box(extreme));
    EXPECT_EQ(measure(points).scale_exponent, 0);
    EXPECT_NE(measure(tiny).scale_exponent, 0);
    EXPECT_THROW(measure(bad), std::invalid_argument);
    EXPECT_THROW(measure(infinite), std::invalid_argument);
  });
}

TEST_P(Kernels, TellPointsBeyondABox) {
  const Box box{{-5, 100}, {3, 900}};
  EXPECT_TRUE(are_within({}, box, GetParam()));
  for_each_place([&](const std::vector<Point>& points, std::size_t special) {
    const auto with = [&](const Point& p) {
      std::vector<Point> all = points;
      all[special] = p;
      return are_within(all, box, GetParam());
    };
    EXPECT_TRUE(with(box.min));
    EXPECT_TRUE(with(box.max));
    EXPECT_FALSE(with({std::nextafter(-5, -6), 500}));
    EXPECT_FALSE(with({std::nextafter(3, 4), 500}));
    EXPECT_FALSE(with({0, std::nextafter(100, 99)}));
    EXPECT_FALSE(with({0, std::nextafter(900, 901)}));
    EXPECT_FALSE(with({std::numeric_limits<double>::quiet_NaN(), 500}));
    EXPECT_FALSE(with({0, std::numeric_limits<double>::quiet_NaN()}));
    EXPECT_FALSE(with({0, std::numeric_limits<double>::infinity()}));
  });
}

}  // namespace
}  // namespace polylidar::detail
