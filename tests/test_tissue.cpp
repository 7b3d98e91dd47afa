// The cells of a tissue: valid shapes that touch each other.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/random.hpp"
#include "datasets/tissue.hpp"
#include "polylidar/point_locator.hpp"
#include "tests/boost_checks.hpp"

namespace hullbench::testing {

using polylidar::PointLocator;

namespace {

std::vector<MultiPolygon> all_cells() {
  std::vector<MultiPolygon> cells;
  for (std::size_t i = 0; i < kTissueCells; ++i) cells.push_back(tissue_cell(i));
  return cells;
}

/// Whether a counter-clockwise ring turns right somewhere.
bool is_concave(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % ring.size()];
    const Point& c = ring[(i + 2) % ring.size()];
    if ((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x) < 0) return true;
  }
  return false;
}

TEST(Tissue, CellsAreValidAndMostlyConcave) {
  std::size_t concave = 0;
  for (const MultiPolygon& cell : all_cells()) {
    ASSERT_EQ(cell.size(), 1U);
    EXPECT_TRUE(cell[0].holes.empty());
    EXPECT_EQ(boost_fault(cell), "");
    EXPECT_GT(polylidar::area(cell), 100);
    EXPECT_LT(polylidar::area(cell), 1000);
    concave += is_concave(cell[0].shell) ? 1U : 0U;
  }
  // Of a cell all of whose sides bend outwards, one in 64 or so, only a corner may be.
  EXPECT_GE(concave, kTissueCells - 3);
}

TEST(Tissue, CellsDoNotOverlap) {
  const std::vector<MultiPolygon> cells = all_cells();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_LT(boost_common_area(cells[i], cells[j]), 1e-6) << i << " and " << j;
  }
}

TEST(Tissue, CellsLeaveNoGap) {
  std::vector<PointLocator> locators;
  for (const MultiPolygon& cell : all_cells()) locators.emplace_back(cell);
  Random random(1);
  // Of a grid of 8 by 6 cells of 20 units, whose middles begin at 0.
  for (int k = 0; k < 20'000; ++k) {
    const double x = random.between(0, 140);
    const double y = random.between(0, 100);
    int cells = 0;
    for (const PointLocator& locator : locators) cells += locator.contains({x, y}) ? 1 : 0;
    // Beyond the middles of the outer cells begin those that are not of the tissue.
    const bool is_inside = x > 20 && x < 120 && y > 20 && y < 80;
    EXPECT_LE(cells, 1) << x << " " << y;
    EXPECT_TRUE(cells == 1 || !is_inside) << x << " " << y;
  }
}

TEST(Tissue, HasNoOtherCells) {
  EXPECT_THROW(tissue_cell(kTissueCells), std::invalid_argument);
}

}  // namespace
}  // namespace hullbench::testing
