// What is claimed of certified cells and points (core/src/certificate.hpp), against the definition.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/src/certificate.hpp"
#include "core/src/occupancy.hpp"
#include "tests/each_kernel.hpp"
#include "tests/point_sets.hpp"

namespace polylidar::detail {
namespace {

using testing::Random;

constexpr double kTurn = 6.283185307179586;

// Cells of side 1; `rows` says which are occupied.
struct Cells {
  explicit Cells(std::size_t size)
      : grid({{0, 0}, {static_cast<double>(size) - 0.5, static_cast<double>(size) - 0.5}}, 1),
        rows(size, std::vector<bool>(size)) {
    occupied.clear(grid.word_count());
    uncertain.clear(grid.word_count());
  }

  // Each occupied by chance.
  Cells(std::size_t size, std::uint64_t seed, double density) : Cells(size) {
    Random random(seed);
    for (std::size_t row = 0; row < size; ++row) {
      for (std::size_t column = 0; column < size; ++column) {
        if (random.unit() < density) occupy(column, row);
      }
    }
  }

  void occupy(std::size_t column, std::size_t row) {
    rows[row][column] = true;
    occupied.set(cell(column, row));
  }
  void clear(std::size_t column, std::size_t row) {
    rows[row][column] = false;
    occupied.clear_run(cell(column, row), 1);
  }
  Grid::Cell cell(std::size_t column, std::size_t row) const {
    return grid.cell({static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
  }

  Grid grid;
  std::vector<std::vector<bool>> rows;
  Bitmap occupied;
  Bitmap uncertain;
};

// The part of a cell in which a point is known to lie, by its least corner.
struct Part {
  double x;
  double y;
  double side;
};

template <class Found>
bool any_occupied(const Cells& cells, const Part& part, const Found& found) {
  for (std::size_t row = 0; row < cells.rows.size(); ++row) {
    for (std::size_t column = 0; column < cells.rows.size(); ++column) {
      const auto x = static_cast<double>(column);
      const auto y = static_cast<double>(row);
      if (std::hypot(x - part.x, y - part.y) > 2 * kRadius + 2 || !cells.rows[row][column]) continue;
      if (found(Point{x, y})) return true;
    }
  }
  return false;
}

// Whether all of the cell at `q` lies inside the disk that touches p in direction `angle`, for every p of the
// part: as far as their corners, moved outwards by `slack`, tell.
bool is_inside(const Point& q, const Part& part, double angle, double slack, double radius = kRadius) {
  const double u = std::cos(angle);
  const double v = std::sin(angle);
  for (const double px : {part.x - slack, part.x + part.side + slack}) {
    for (const double py : {part.y - slack, part.y + part.side + slack}) {
      for (const double qx : {q.x - slack, q.x + 1 + slack}) {
        for (const double qy : {q.y - slack, q.y + 1 + slack}) {
          if (std::hypot(qx - px - radius * u, qy - py - radius * v) >= radius) return false;
        }
      }
    }
  }
  return true;
}

// In this direction some occupied cell is inside the disk.
bool holds_at(const Cells& cells, const Part& part, double angle, double radius) {
  return any_occupied(cells, part,
                      [&](const Point& q) { return is_inside(q, part, angle, Grid::kSlack, radius); });
}

// In every one of so many directions: what certified means.
bool holds(const Cells& cells, const Part& part, int directions) {
  for (int i = 0; i < directions; ++i) {
    if (!holds_at(cells, part, kTurn * i / directions, kRadius)) return false;
  }
  return true;
}

// As the certificate decides: for the sector from `angle` on one cell, inside at both ends, and not just
// touching.
bool is_sector_covered(const Cells& cells, const Part& part, double angle, double width, double radius) {
  constexpr double kClear = 1e-7;
  return any_occupied(cells, part, [&](const Point& q) {
    return is_inside(q, part, angle, kClear, radius) && is_inside(q, part, angle + width, kClear, radius);
  });
}

bool is_covered(const Cells& cells, const Part& part, int sectors) {
  for (int s = 0; s < sectors; ++s) {
    if (!is_sector_covered(cells, part, kTurn * s / sectors, kTurn / sectors, kRadius)) return false;
  }
  return true;
}

class CertificateByKernel : public testing::KernelTest {};
class GridByKernel : public testing::KernelTest {};

INSTANTIATE_TEST_SUITE_P(Each, CertificateByKernel, testing::each_kernel(), testing::name_of_kernel_test);
INSTANTIATE_TEST_SUITE_P(Each, GridByKernel, testing::each_kernel(), testing::name_of_kernel_test);

TEST(Certificate, OfCellsIsThatOfItsDefinition) {
  std::size_t certified = 0;
  std::size_t uncertain = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Cells cells(75, seed, 0.12 + 0.02 * static_cast<double>(seed % 6));
    find_uncertain_cells(cells.grid, cells.occupied, 0, cells.grid.rows(), cells.uncertain);
    for (std::size_t row = 0; row < cells.rows.size(); row += 6) {
      for (std::size_t column = 0; column < cells.rows.size(); ++column) {
        const bool is_uncertain = cells.uncertain.test(cells.cell(column, row));
        if (!cells.rows[row][column]) {
          EXPECT_FALSE(is_uncertain);
          continue;
        }
        const Part part{static_cast<double>(column), static_cast<double>(row), 1};
        const bool is_told_by_sectors = is_covered(cells, part, 16);
        if (is_uncertain) {
          ASSERT_FALSE(is_told_by_sectors) << seed << ", " << column << ", " << row;
        }
        (is_uncertain ? uncertain : certified) += 1;
        if (!is_uncertain && (column % 8 == 0 || !is_told_by_sectors)) {
          EXPECT_TRUE(holds(cells, part, 16 * 9));
        }
      }
    }
  }
  EXPECT_GT(certified, 300U);
  EXPECT_GT(uncertain, 300U);
}

TEST_P(CertificateByKernel, IsTheSameAlsoInBands) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    const std::size_t size = 1 + 13 * seed;
    Cells cells(size, seed, 0.05 + 0.05 * static_cast<double>(seed % 9));
    find_uncertain_cells(cells.grid, cells.occupied, 0, cells.grid.rows(), cells.uncertain,
                         Kernel::kPortable);
    Bitmap uncertain;
    uncertain.clear(cells.grid.word_count());
    const auto middle = static_cast<Grid::Cell>(size / 3);
    find_uncertain_cells(cells.grid, cells.occupied, middle, cells.grid.rows(), uncertain, GetParam());
    find_uncertain_cells(cells.grid, cells.occupied, 0, middle, uncertain, GetParam());
    EXPECT_TRUE(
        std::equal(uncertain.words(), uncertain.words() + cells.grid.word_count(), cells.uncertain.words()));
  }
}

TEST_P(CertificateByKernel, OfPointsIsThatOfItsDefinition) {
  const PointCertificate& certificate = PointCertificate::instance();
  std::size_t certified = 0;
  std::size_t uncertain = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Cells cells(27, seed, 0.03 + 0.02 * static_cast<double>(seed % 5));
    Random random(seed + 1000);
    // In a quarter of the cell in the middle, now and then in its very corner.
    const double qx = 0.25 * static_cast<double>(random.below(4));
    const double qy = 0.25 * static_cast<double>(random.below(4));
    const Point p{13 + qx + 0.25 * random.unit() * static_cast<double>(random.below(2)),
                  13 + qy + 0.25 * random.unit() * static_cast<double>(random.below(2))};
    const bool is_certified =
        certificate.is_certified(p, cells.grid.cell(p), cells.grid, cells.occupied, GetParam());
    const Part part{13 + qx, 13 + qy, 0.25};
    ASSERT_EQ(is_certified, is_covered(cells, part, 64)) << seed;
    (is_certified ? certified : uncertain) += 1;
    if (is_certified) {
      EXPECT_TRUE(holds(cells, part, 64 * 7)) << seed;
    }
  }
  EXPECT_GT(certified, 50U);
  EXPECT_GT(uncertain, 50U);
}

// Where points are dense few strips of cells are looked at; one with an empty disk is among them, wherever it
// lies.
TEST_P(CertificateByKernel, AnEmptyDiskMakesItsCellUncertain) {
  constexpr std::size_t kSize = 330;
  constexpr std::size_t kDiameter = std::size_t{2} * kRadius;
  Random random(5);
  for (int k = 0; k < 600; ++k) {
    SCOPED_TRACE(k);
    Cells cells(kSize, static_cast<std::uint64_t>(k), k % 2 == 0 ? 0.6 : 1);
    const std::size_t column = kDiameter + random.below(kSize - 2 * kDiameter);
    const std::size_t row = kDiameter + random.below(kSize - 2 * kDiameter);
    const double angle = kTurn * random.unit();
    const Point p{static_cast<double>(column) + random.unit(), static_cast<double>(row) + random.unit()};
    const Point centre{p.x + kRadius * std::cos(angle), p.y + kRadius * std::sin(angle)};
    for (std::size_t r = row - kDiameter; r <= row + kDiameter; ++r) {
      for (std::size_t c = column - kDiameter; c <= column + kDiameter; ++c) {
        // A cell that has a part outside of the disk may have a point there.
        const double x = std::max(centre.x - static_cast<double>(c), static_cast<double>(c) + 1 - centre.x);
        const double y = std::max(centre.y - static_cast<double>(r), static_cast<double>(r) + 1 - centre.y);
        if (std::hypot(x, y) < kRadius) cells.clear(c, r);
      }
    }
    cells.occupy(column, row);
    find_uncertain_cells(cells.grid, cells.occupied, 0, cells.grid.rows(), cells.uncertain, GetParam());
    EXPECT_TRUE(cells.uncertain.test(cells.cell(column, row)));
    std::size_t uncertain = 0;
    for (std::size_t w = 0; w < cells.grid.word_count(); ++w) {
      uncertain += static_cast<std::size_t>(std::popcount(cells.uncertain.words()[w]));
    }
    EXPECT_LT(uncertain, kSize * kSize / 8);  // those at the side, and few others
  }
}

// The directions in which a disk of kNearRadius may be empty are those that have an uncovered sector.
TEST_P(CertificateByKernel, FindsTheDirectionsOfLargeTriangles) {
  constexpr int kSectorsOfFraction = static_cast<int>(SectorCover<kNearRadius>::kSectors / kTurnFractions);
  const PointCertificate& certificate = PointCertificate::instance();
  std::size_t open = 0;
  std::size_t closed = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Cells cells(27, seed, 0.06 + 0.05 * static_cast<double>(seed % 5));
    Random random(seed + 2000);
    const double qx = 0.25 * static_cast<double>(random.below(4));
    const double qy = 0.25 * static_cast<double>(random.below(4));
    const Point p{13 + qx + 0.2 * random.unit(), 13 + qy + 0.2 * random.unit()};
    const Part part{13 + qx, 13 + qy, 0.25};
    const Directions found =
        certificate.open_directions(p, cells.grid.cell(p), cells.grid, cells.occupied, GetParam());
    for (unsigned k = 0; k < kTurnFractions; ++k) {
      bool is_open = false;
      for (int s = 0; s < kSectorsOfFraction; ++s) {
        const double width = kTurn / kTurnFractions / kSectorsOfFraction;
        const double angle = kTurn * k / kTurnFractions + width * s;
        is_open |= !is_sector_covered(cells, part, angle, width, kNearRadius);
      }
      ASSERT_EQ((found >> k & 1U) != 0, is_open) << k;
      (is_open ? open : closed) += 1;
      for (int i = 0; i <= 8 && !is_open; ++i) {
        EXPECT_TRUE(holds_at(cells, part, kTurn * (k + i / 8.0) / kTurnFractions, kNearRadius));
      }
    }
  }
  EXPECT_GT(open, 200U);
  EXPECT_GT(closed, 1000U);
}

// Every single cell counts: a certified cell with only just enough about it is uncertain without any of them.
TEST(Certificate, FailsWithoutTheLastCellOfASector) {
  const Part part{13, 13, 1};
  for (int s = 0; s < 16; ++s) {
    Cells cells(27);
    for (std::size_t row = 0; row < 27; ++row) {
      for (std::size_t column = 0; column < 27; ++column) {
        const Point q{static_cast<double>(column), static_cast<double>(row)};
        if (!is_inside(q, part, kTurn * s / 16, 1e-7) || !is_inside(q, part, kTurn * (s + 1) / 16, 1e-7)) {
          cells.occupy(column, row);
        }
      }
    }
    find_uncertain_cells(cells.grid, cells.occupied, 0, cells.grid.rows(), cells.uncertain);
    EXPECT_TRUE(cells.uncertain.test(cells.cell(13, 13))) << s;
  }
  Cells cells(27, 1, 1);
  find_uncertain_cells(cells.grid, cells.occupied, 0, cells.grid.rows(), cells.uncertain);
  EXPECT_FALSE(cells.uncertain.test(cells.cell(13, 13)));
  // As wide as a disk reaches, nothing is certain at the side.
  EXPECT_TRUE(cells.uncertain.test(cells.cell(0, 13)));
}

// A shard looks at so many rows beyond its uncertain points: a cell of the last of them may decide, and none
// beyond it does.
TEST(Certificate, LooksAsFarAsItsReachAndNoFarther) {
  const PointCertificate& certificate = PointCertificate::instance();
  constexpr int kSectors = static_cast<int>(SectorCover<kRadius>::kSectors);
  const Point p{13.1, 13.1};
  const Part part{13, 13, 0.25};
  constexpr std::size_t kLast = 13 - kReach;
  std::size_t decided = 0;
  for (int s = 0; s < kSectors; ++s) {
    Cells cells(27);
    Cells without(27);
    for (std::size_t row = 0; row < 27; ++row) {
      for (std::size_t column = 0; column < 27; ++column) {
        const Point q{static_cast<double>(column), static_cast<double>(row)};
        const bool covers = is_inside(q, part, kTurn * s / kSectors, 1e-7) &&
                            is_inside(q, part, kTurn * (s + 1) / kSectors, 1e-7);
        EXPECT_FALSE(covers && std::abs(static_cast<int>(row) - 13) > kReach) << s;
        if (!covers) without.occupy(column, row);
        if (!covers || row == kLast) cells.occupy(column, row);
      }
    }
    EXPECT_FALSE(certificate.is_certified(p, without.grid.cell(p), without.grid, without.occupied)) << s;
    decided += certificate.is_certified(p, cells.grid.cell(p), cells.grid, cells.occupied) ? 1U : 0U;
  }
  EXPECT_GT(decided, 0U);
}

// How `cell`, with a margin round it, is to lie round the point.
void expect_in_cell(const Point& p, const Grid& grid, const Point& origin, Grid::Cell cell) {
  const Grid::Cell row_bits = grid.row_words() * Grid::kWordBits;
  const double column = static_cast<double>(cell % row_bits) - 64.0;
  const Grid::Cell row_number = cell / row_bits;
  const double row = static_cast<double>(row_number) - static_cast<double>(Grid::kMargin);
  const long double u = (static_cast<long double>(p.x) - origin.x) * grid.cells_per_length();
  const long double v = (static_cast<long double>(p.y) - origin.y) * grid.cells_per_length();
  EXPECT_GE(u, column - Grid::kSlack);
  EXPECT_LE(u, column + 1 + Grid::kSlack);
  EXPECT_GE(v, row - Grid::kSlack);
  EXPECT_LE(v, row + 1 + Grid::kSlack);
  EXPECT_LT(column, grid.columns());
  EXPECT_LT(row, grid.rows());
}

// A coordinate about the border before some column or row of a grid: the nearest double, and those beside it.
double about_border(Random& random, double minimum, double maximum, double cells_per_length) {
  const double cells = std::floor((maximum - minimum) * cells_per_length);
  const double border =
      minimum + static_cast<double>(random.below(static_cast<std::size_t>(cells) + 1)) / cells_per_length;
  const double beside = std::array{-HUGE_VAL, border, HUGE_VAL}[random.below(3)];
  return std::clamp(std::nextafter(border, beside), minimum, maximum);
}

TEST_P(GridByKernel, PutsPointsIntoTheirCells) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double size = std::ldexp(random.between(0.5, 1), static_cast<int>(random.integer(100)));
    const double away = size * (i % 2 == 0 ? 1e6 : 1);  // near zero there are more doubles
    const Point origin{away * random.between(-1, 1), away * random.between(-1, 1)};
    const Box box{origin, {origin.x + size, origin.y + size * random.unit()}};
    const double cells_per_length = random.between(1, 2000) / size;
    const Grid grid(box, cells_per_length);
    EXPECT_EQ(Grid::cell_count(box, cells_per_length), static_cast<double>(grid.columns() * grid.rows()));
    std::vector<Point> points{box.max, box.min};
    for (int k = 0; k < 100; ++k) {
      points.push_back({box.min.x + (box.max.x - box.min.x) * random.unit(),
                        box.min.y + (box.max.y - box.min.y) * random.unit()});
      points.push_back({about_border(random, box.min.x, box.max.x, cells_per_length),
                        about_border(random, box.min.y, box.max.y, cells_per_length)});
    }
    std::vector<std::uint32_t> numbers(points.size());
    number_cells(points, grid.numbering(), numbers.data(), GetParam());
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_EQ(numbers[k], grid.cell(points[k]));
      expect_in_cell(points[k], grid, box.min, numbers[k]);
    }
  }
}

TEST(Grid, HasNoCellsWhereItWouldNotFit) {
  EXPECT_EQ(Grid::cell_count({{0, 0}, {1, 1}}, HUGE_VAL), HUGE_VAL);
  EXPECT_EQ(Grid::cell_count({{0, 0}, {0, 1}}, HUGE_VAL), HUGE_VAL);
  EXPECT_EQ(Grid::cell_count({{0, 0}, {1, 1e-9}}, 2e6), HUGE_VAL);
  EXPECT_EQ(Grid::cell_count({{0, 0}, {1, 1}}, 2e5), HUGE_VAL);
  EXPECT_EQ(Grid::cell_count({{0, 0}, {1, 0.5}}, 1000), 1001.0 * 501);
}

bool pairs_may_exist(const std::vector<Point>& points, double distance, unsigned threads = 1) {
  const Grid grid({{0, 0}, {100, 100}}, 1);
  Bitmap occupied;
  Bitmap shared;
  occupied.clear(grid.word_count());
  shared.clear(grid.word_count());
  std::vector<std::uint32_t> cells;
  for (const Point& p : points) {
    cells.push_back(static_cast<std::uint32_t>(grid.cell(p)));
    if (occupied.test(cells.back())) shared.set(cells.back());
    occupied.set(cells.back());
  }
  ThreadPool pool;
  pool.use(threads);
  ClosePairs pairs;
  return pairs.may_exist(points, grid, cells.data(), shared, distance, pool);
}

TEST(ClosePairs, AreFoundWhereverTheyLie) {
  constexpr double kDistance = 0x1p-38;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto threads = static_cast<unsigned>(1 + seed / 3 % 3);  // each with each kind of place below
    std::vector<Point> points = testing::uniform_points(6000, seed, 100);  // of more threads, more chunks
    for (int copies = 0; copies < 50; ++copies) points.push_back(points[0]);
    EXPECT_FALSE(pairs_may_exist(points, kDistance, threads));
    // Inside a cell, or on both sides of a border, or of a corner.
    Point p{1 + 98 * random.unit(), 1 + 98 * random.unit()};
    if (seed % 3 >= 1) p.x = std::floor(p.x) - kDistance * random.unit();
    if (seed % 3 >= 2) p.y = std::floor(p.y) - kDistance * random.unit();
    const double angle = kTurn * random.unit();
    points.push_back(p);
    points.push_back({p.x + 0.9 * kDistance * std::cos(angle), p.y + 0.9 * kDistance * std::sin(angle)});
    if (points.back() == p) continue;
    EXPECT_TRUE(pairs_may_exist(testing::shuffled(points, seed), kDistance, threads));
    points.back() = {p.x + 4 * kDistance, p.y};
    EXPECT_FALSE(pairs_may_exist(testing::shuffled(points, seed), kDistance, threads));
  }
}

// Few cells in rows of a larger grid, found band by band as a stream finds them.
TEST(FewCells, AreThoseOfABitmap) {
  for (const std::size_t size : {9U, 70U, 300U}) {
    for (const double density : {0.0, 0.3, 0.6}) {
      Cells cells(size, size, density);
      const Grid::Cell begin = size / 5;
      const Grid::Cell end = size - size / 7;
      find_uncertain_cells(cells.grid, cells.occupied, begin, end, cells.uncertain);
      for (const unsigned threads : {1U, 3U}) {
        ThreadPool pool;
        pool.use(threads);
        FewCells few;
        for (int again = 0; again < 2; ++again) {
          const auto find = [&](Grid::Cell first, Grid::Cell stop, Bitmap& found) {
            const Bitmap of_band = cells.occupied.from_word(first * cells.grid.row_words());
            find_uncertain_cells(cells.grid.band(first, stop), of_band, 0, stop - first, found);
          };
          few.fill(cells.grid, begin, end, find, pool);
        }
        std::vector<Grid::Cell> expected;
        for (std::size_t row = 0; row < size; ++row) {
          for (std::size_t column = 0; column < size; ++column) {
            const Grid::Cell cell = cells.cell(column, row);
            const bool is_there = few.may_have(cell) && few.test(cell);
            ASSERT_EQ(is_there, cells.uncertain.test(cell)) << column << ", " << row;
            if (is_there) expected.push_back(cell);
          }
        }
        EXPECT_EQ(few.count(), expected.size());
        std::vector<Grid::Cell> visited;
        const std::size_t words = cells.grid.word_count();
        for (const std::size_t from : {words / 3, 2 * words / 3, words}) {
          const std::size_t before = from == words / 3 ? 0 : from == words ? 2 * words / 3 : words / 3;
          few.for_each(before, from, [&](Grid::Cell cell) { visited.push_back(cell); });
        }
        EXPECT_EQ(visited, expected);
      }
    }
  }
}

TEST(ReachedCells, AreToldFromOtherOccupiedCells) {
  constexpr std::size_t kSize = 200;
  Cells cells(kSize, 3, 0.5);
  Bitmap map;
  map.clear(cells.grid.word_count());
  std::copy_n(cells.occupied.words(), cells.grid.word_count(), map.words());
  Bitmap expected;
  expected.clear(cells.grid.word_count());
  ReachedCells reached;
  reached.begin(map, cells.grid.word_count());
  Random random(4);
  for (int k = 0; k < 60; ++k) {
    const Grid::Cell first = cells.cell(random.below(kSize - 64), random.below(kSize));
    const auto count = static_cast<unsigned>(1 + random.below(63));
    reached.set_run(first, count);
    expected.set_run(first, count);
  }
  for (std::size_t row = 0; row < kSize; ++row) {
    for (std::size_t column = 0; column < kSize; ++column) {
      const Grid::Cell cell = cells.cell(column, row);
      if (!cells.rows[row][column]) continue;
      ASSERT_EQ(reached.may_have(cell) && reached.test(cell), expected.test(cell)) << column << ", " << row;
    }
    const Grid::Cell first = cells.cell(row % 100, row);
    EXPECT_EQ(reached.not_reached(first), cells.occupied.window(first) & ~expected.window(first));
  }
}

}  // namespace
}  // namespace polylidar::detail
