#include "certificate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "vector.hpp"

namespace polylidar::detail {

namespace {

using Word = Bitmap::Word;

constexpr double kExtra = 0x1p-20;

/// All differences q - p between the points of two boxes.
struct Differences {
  double min_x;
  double max_x;
  double min_y;
  double max_y;
};

/// Between a cell and p's, from which it is `column` and `row` cells away.
constexpr Differences differences(int column, int row) {
  constexpr double kSlack = 2 * Grid::kSlack;
  return {column - 1 - kSlack, column + 1 + kSlack, row - 1 - kSlack, row + 1 + kSlack};
}

/// (1) of the header for disks of radius `kDisk` with room to spare, at one corner and one end.
template <int kDisk>
constexpr bool is_inside(double dx, double dy, const Vector& u) {
  return dx * dx + dy * dy + kExtra < 2 * kDisk * (dx * u.x + dy * u.y);
}

/// Whether (1) holds for all `d` with the direction u.
constexpr bool is_inside(const Differences& d, const Vector& u) {
  return is_inside<kRadius>(d.min_x, d.min_y, u) && is_inside<kRadius>(d.min_x, d.max_y, u) &&
         is_inside<kRadius>(d.max_x, d.min_y, u) && is_inside<kRadius>(d.max_x, d.max_y, u);
}

constexpr int kCellSectors = 16;

/// Where sector `k` of 16 begins.
constexpr Vector cell_direction(int k) {
  constexpr std::array kCosine{1.0, 0.92387953251128674, 0.70710678118654752, 0.38268343236508977, 0.0};
  const auto step = static_cast<std::size_t>(k % 4);
  const double c = kCosine[step];
  const double s = kCosine[4 - step];
  switch (k / 4 % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// The cells of one row that cover a sector, by columns from p's cell; empty when first > last.
struct Run {
  int first = 1;
  int last = 0;
};
constexpr int kRows = 2 * kReach + 1;

/// Sector -> row, from kReach below p's cell on -> the cells that cover it. They are those in a convex set,
/// so in each row they follow one another.
constexpr auto make_runs() {
  std::array<std::array<Run, kRows>, kCellSectors> runs{};
  for (int s = 0; s < kCellSectors; ++s) {
    for (int row = -kReach; row <= kReach; ++row) {
      Run run;
      for (int column = -kReach; column <= kReach; ++column) {
        const Differences d = differences(column, row);
        if (!is_inside(d, cell_direction(s)) || !is_inside(d, cell_direction(s + 1))) continue;
        if (run.first > run.last) run.first = column;
        run.last = column;
      }
      const int from_lowest = row + kReach;
      runs[static_cast<std::size_t>(s)][static_cast<std::size_t>(from_lowest)] = run;
    }
  }
  return runs;
}
constexpr auto kRuns = make_runs();

// A row of cells is cut into strips of 32 columns, each looked at together with 16 columns on either side:
// one word a strip, its window. Bit b of a window of level k says whether one of the 2^k cells from b on is
// occupied.
constexpr unsigned kStrip = 32;
constexpr int kSide = 16;
static_assert(kReach <= kSide);
constexpr std::size_t kLevels = 4;
/// So many strips are checked together if one of them may have uncertain cells. A word of a bitmap has the
/// cells of two.
constexpr std::size_t kStripsAtOnce = 4;
static_assert(kStripsAtOnce % 2 == 0);

/// Of one row: strip by strip the windows of level 0, then those of level 1, and so on.
using WindowRow = const Word*;

/// How many columns and rows the cell of a disk's centre can be away from p's: below (2) of the header.
constexpr int kCentre = kRadius + 1;

/// The core of a cell, (2) of the header: rows away from the cell, up or down -> how many columns the core
/// has on either side of the cell's own; -1 where it has no cells.
constexpr auto make_core() {
  std::array<int, kRadius> half_widths{};
  for (int row = 0; row < kRadius; ++row) {
    int& half_width = half_widths[static_cast<std::size_t>(row)];
    half_width = -1;
    for (int column = 0; column < kRadius; ++column) {
      const double x = column + 1 + Grid::kSlack;
      const double y = row + 1 + Grid::kSlack;
      if (x * x + y * y + kExtra < kRadius * kRadius) half_width = column;
    }
  }
  return half_widths;
}
constexpr auto kCore = make_core();
constexpr int kCoreRows = [] {
  int rows = 0;
  for (const int half_width : kCore) rows += half_width >= 0 ? 1 : 0;
  return rows - 1;  // to either side
}();
static_assert(kCentre + kCoreRows <= kReach);
static_assert(kCentre + kCore[0] < kSide);

/// The columns of a strip and kCentre more on either side.
constexpr Word kStripAndSides = (Word{1} << (kStrip + 2 * kCentre)) - 1;

/// Of one row: sector by sector which cells cover it.
using SectorRow = SectorCover<kRadius>::Row;

/// Which cells of a strip have an occupied one where kRuns[kSector][kRow] says.
template <std::size_t kSector, std::size_t kRow>
[[gnu::always_inline]] inline Word any_in_run(WindowRow row, std::size_t strips, std::size_t strip) {
  constexpr Run kRun = kRuns[kSector][kRow];
  if constexpr (kRun.first > kRun.last) {
    return 0;
  } else {
    constexpr unsigned kLength = kRun.last - kRun.first + 1;
    constexpr unsigned kLevel = std::bit_width(kLength) - 1;
    static_assert(kLevel < kLevels);
    const Word window = row[kLevel * strips + strip];
    const Word any = window >> static_cast<unsigned>(kSide + kRun.first);
    if constexpr (std::has_single_bit(kLength)) return any;
    return any | window >> static_cast<unsigned>(kSide + kRun.last + 1 - (1 << kLevel));
  }
}

/// Takes from `certified` the cells of strips [begin, end) for which the sector is not covered.
template <std::size_t kSector, std::size_t... kRow>
[[gnu::always_inline]] inline void check_sector(const WindowRow* rows, std::size_t strips, std::size_t begin,
                                                std::size_t end, Word* __restrict__ certified,
                                                std::index_sequence<kRow...> /*rows*/) {
  for (std::size_t strip = begin; strip < end; ++strip) {
    certified[strip] &= (any_in_run<kSector, kRow>(rows[kRow], strips, strip) | ...);
  }
}

/// Which cells of a strip and of kCentre columns on either side have an occupied cell in row kRow of their
/// cores, counted from the lowest. Bit 0 is the cell farthest to the left.
template <std::size_t kRow>
[[gnu::always_inline]] inline Word any_in_core(WindowRow row, std::size_t strips, std::size_t strip) {
  constexpr int kFromMiddle = static_cast<int>(kRow) - kCoreRows;
  constexpr int kHalfWidth = kCore[static_cast<std::size_t>(kFromMiddle < 0 ? -kFromMiddle : kFromMiddle)];
  constexpr unsigned kLength = 2 * kHalfWidth + 1;
  constexpr unsigned kLevel = std::bit_width(kLength) - 1;
  static_assert(kLevel < kLevels);
  const Word window = row[kLevel * strips + strip];
  const Word any = window >> static_cast<unsigned>(kSide - kCentre - kHalfWidth);
  return any | window >> static_cast<unsigned>(kSide - kCentre + kHalfWidth + 1 - (1 << kLevel));
}

/// Writes for each strip which cells, of its own and of kCentre columns on either side, have an empty core.
template <std::size_t... kRow>
[[gnu::always_inline]] inline void find_empty_cores(const WindowRow* rows, std::size_t strips, Word* empty,
                                                    std::index_sequence<kRow...> /*rows*/) {
  for (std::size_t strip = 0; strip < strips; ++strip) {
    empty[strip] = ~(any_in_core<kRow>(rows[kRow], strips, strip) | ...) & kStripAndSides;
  }
}

template <std::size_t... kSector>
[[gnu::always_inline]] inline void check_sectors(const WindowRow* rows, std::size_t strips, std::size_t begin,
                                                 std::size_t end, Word* certified,
                                                 std::index_sequence<kSector...> /*sectors*/) {
  (check_sector<kSector>(rows, strips, begin, end, certified, std::make_index_sequence<kRows>()), ...);
}

/// Of those in `cells`, row by row, the cells that cover sector `s`, columns of all rows together.
template <std::size_t... kRow>
[[gnu::always_inline]] inline std::uint32_t covering(const SectorRow* rows, const std::uint32_t* cells,
                                                     std::size_t s, std::index_sequence<kRow...> /*rows*/) {
  return ((cells[kRow] & rows[kRow][s]) | ...);
}

[[gnu::always_inline]] inline bool check_point(const SectorRow* rows, const std::uint32_t* cells) {
  using Cover = SectorCover<kRadius>;
  unsigned uncovered = 0;
  for (std::size_t s = 0; s < Cover::kSectors; ++s) {
    uncovered += covering(rows, cells, s, std::make_index_sequence<Cover::kRows>()) == 0 ? 1U : 0U;
  }
  return uncovered == 0;
}

[[gnu::always_inline]] inline Directions find_open(const SectorRow* rows, const std::uint32_t* cells) {
  using Cover = SectorCover<kNearRadius>;
  std::array<std::uint32_t, Cover::kSectors> covered;
  for (std::size_t s = 0; s < Cover::kSectors; ++s) {
    covered[s] = covering(rows, cells, s, std::make_index_sequence<Cover::kRows>());
  }
  constexpr std::size_t kSectorsOfFraction = Cover::kSectors / kTurnFractions;
  unsigned open = 0;
  for (std::size_t s = 0; s < Cover::kSectors; ++s) {
    open |= (covered[s] == 0 ? 1U : 0U) << (s / kSectorsOfFraction);
  }
  return static_cast<Directions>(open);
}

/// The same; `rows` begin with the lowest row of the cores.
[[gnu::always_inline]] inline void find_empty_cores(const WindowRow* rows, std::size_t strips, Word* empty) {
  find_empty_cores(rows, strips, empty, std::make_index_sequence<2 * kCoreRows + 1>());
}

/// The loops that the time goes into.
struct Loops {
  void (*find_empty_cores)(const WindowRow* rows, std::size_t strips, Word* empty);
  void (*check_cells)(const WindowRow* rows, std::size_t strips, std::size_t begin, std::size_t end,
                      Word* certified);
  bool (*check_point)(const SectorRow* rows, const std::uint32_t* cells);
  Directions (*find_open)(const SectorRow* rows, const std::uint32_t* cells);
};

// The same code three times, for what the compiler makes of it with wider registers.
void find_empty_cores_portably(const WindowRow* rows, std::size_t strips, Word* empty) {
  find_empty_cores(rows, strips, empty);
}
void check_cells_portably(const WindowRow* rows, std::size_t strips, std::size_t begin, std::size_t end,
                          Word* certified) {
  check_sectors(rows, strips, begin, end, certified, std::make_index_sequence<kCellSectors>());
}
bool check_point_portably(const SectorRow* rows, const std::uint32_t* cells) {
  return check_point(rows, cells);
}
Directions find_open_portably(const SectorRow* rows, const std::uint32_t* cells) {
  return find_open(rows, cells);
}
#ifdef POLYLIDAR_X86_KERNELS
POLYLIDAR_AVX2 void find_empty_cores_with_avx2(const WindowRow* rows, std::size_t strips, Word* empty) {
  find_empty_cores(rows, strips, empty);
}
POLYLIDAR_AVX2 void check_cells_with_avx2(const WindowRow* rows, std::size_t strips, std::size_t begin,
                                          std::size_t end, Word* certified) {
  check_sectors(rows, strips, begin, end, certified, std::make_index_sequence<kCellSectors>());
}
POLYLIDAR_AVX2 bool check_point_with_avx2(const SectorRow* rows, const std::uint32_t* cells) {
  return check_point(rows, cells);
}
POLYLIDAR_AVX2 Directions find_open_with_avx2(const SectorRow* rows, const std::uint32_t* cells) {
  return find_open(rows, cells);
}
POLYLIDAR_AVX512 void find_empty_cores_with_avx512(const WindowRow* rows, std::size_t strips, Word* empty) {
  find_empty_cores(rows, strips, empty);
}
POLYLIDAR_AVX512 void check_cells_with_avx512(const WindowRow* rows, std::size_t strips, std::size_t begin,
                                              std::size_t end, Word* certified) {
  check_sectors(rows, strips, begin, end, certified, std::make_index_sequence<kCellSectors>());
}
POLYLIDAR_AVX512 bool check_point_with_avx512(const SectorRow* rows, const std::uint32_t* cells) {
  return check_point(rows, cells);
}
POLYLIDAR_AVX512 Directions find_open_with_avx512(const SectorRow* rows, const std::uint32_t* cells) {
  return find_open(rows, cells);
}
#endif

Loops loops_of(Kernel kernel) {
#ifdef POLYLIDAR_X86_KERNELS
  if (kernel == Kernel::kAvx512)
    return {&find_empty_cores_with_avx512, &check_cells_with_avx512, &check_point_with_avx512,
            &find_open_with_avx512};
  if (kernel == Kernel::kAvx2)
    return {&find_empty_cores_with_avx2, &check_cells_with_avx2, &check_point_with_avx2,
            &find_open_with_avx2};
#endif
  static_cast<void>(kernel);
  return {&find_empty_cores_portably, &check_cells_portably, &check_point_portably, &find_open_portably};
}

/// Fills a WindowRow from a row of the bitmap. Column 0 is bit 64 of that.
void fill_windows(const Word* row, std::size_t strips, Word* windows) {
  for (std::size_t strip = 0; strip < strips; ++strip) {
    const Word* const word = row + 1 + strip / 2;
    windows[strip] = strip % 2 == 0 ? word[-1] >> 48U | word[0] << 16U : word[0] >> 16U | word[1] << 48U;
  }
  for (std::size_t i = 0; i < strips; ++i) {
    windows[strips + i] = windows[i] | windows[i] >> 1U;
    windows[2 * strips + i] = windows[strips + i] | windows[strips + i] >> 2U;
    windows[3 * strips + i] = windows[2 * strips + i] | windows[2 * strips + i] >> 4U;
  }
}

/// Of a point: in which quarter (in x and in y) of its cell it lies, row by row.
std::size_t quarter_of(const Point& p, const Grid& grid) {
  constexpr std::size_t kQuarters = SectorCover<kRadius>::kQuarters;
  const auto x = static_cast<std::size_t>(grid.column(p) * kQuarters) % kQuarters;
  const auto y = static_cast<std::size_t>(grid.row(p) * kQuarters) % kQuarters;
  return y * kQuarters + x;
}

/// The occupied cells round `cell`, row by row, as SectorCover<kDisk>::Row names columns; behind them, bits
/// that it does not name.
template <int kDisk>
std::array<std::uint32_t, SectorCover<kDisk>::kRows> cells_round(Grid::Cell cell, const Grid& grid,
                                                                 const Bitmap& occupied) {
  constexpr Grid::Cell kFarthest = SectorCover<kDisk>::kFarthest;
  const Grid::Cell first = cell - kFarthest;
  const Word* word = occupied.words() + first / Grid::kWordBits - kFarthest * grid.row_words();
  const unsigned shift = first % Grid::kWordBits;
  std::array<std::uint32_t, SectorCover<kDisk>::kRows> cells;
  for (std::uint32_t& row : cells) {
    row = static_cast<std::uint32_t>(word[0] >> shift | word[1] << 1U << (Grid::kWordBits - 1 - shift));
    word += grid.row_words();
  }
  return cells;
}

}  // namespace

void find_uncertain_cells(const Grid& grid, const Bitmap& occupied, Grid::Cell begin, Grid::Cell end,
                          Bitmap& uncertain, Kernel kernel) {
  const Loops loops = loops_of(kernel);
  const std::size_t strips = (grid.columns() + kStrip - 1) / kStrip;
  // The windows of the last kRows rows; of the row in the middle the certified cells; of one row the cells
  // with an empty core.
  std::vector<Word> memory((kLevels * kRows + 2) * strips);
  Word* const certified = &memory[kLevels * kRows * strips];
  Word* const empty = certified + strips;
  std::array<Word*, kRows> rows;
  for (std::size_t r = 0; r < kRows; ++r) rows[r] = &memory[r * kLevels * strips];
  // Strip -> one past the last row that has a cell with an empty core in the strip or at most kCentre columns
  // beside it. Rows count from kCentre below `begin` on; 0 if there is none.
  std::vector<Grid::Cell> empty_until(strips);

  const Word* next = occupied.words() + grid.first_word(begin) - std::size_t{grid.row_words()} * kReach;
  for (std::size_t r = 0; r + 1 < kRows; ++r, next += grid.row_words())
    fill_windows(next, strips, rows[r + 1]);
  for (Grid::Cell row = begin; row < end; ++row, next += grid.row_words()) {
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
    fill_windows(next, strips, rows.back());

    constexpr std::size_t kLast = std::size_t{2} * kCentre;
    // The rows at most kCentre away from this one: all but the highest were looked at for the row before.
    for (std::size_t r = row == begin ? 0 : kLast; r <= kLast; ++r) {
      loops.find_empty_cores(&rows[kReach - kCentre - kCoreRows + r], strips, empty);
      for (std::size_t strip = 0; strip < strips; ++strip) {
        if (empty[strip] != 0) empty_until[strip] = row - begin + r + 1;
      }
    }
    for (std::size_t strip = 0; strip < strips; ++strip) {
      certified[strip] = rows[kReach][strip] >> static_cast<unsigned>(kSide) & 0xFFFFFFFFU;
    }
    const auto is_open = [&](std::size_t strip) {
      return certified[strip] != 0 && empty_until[strip] > row - begin;
    };
    const std::size_t word = grid.first_word(row) + 1;
    for (std::size_t first = 0; first < strips; first += kStripsAtOnce) {
      const std::size_t last = std::min(first + kStripsAtOnce, strips);
      bool is_any_open = false;
      for (std::size_t strip = first; strip < last; ++strip) is_any_open |= is_open(strip);
      if (!is_any_open) continue;
      loops.check_cells(rows.data(), strips, first, last, certified);
      for (std::size_t strip = first; strip < last; ++strip) {
        uncertain.words()[word + strip / 2] |= certified[strip] << (strip % 2 * kStrip);
      }
      // What is marked so far is certified; what is occupied and not certified is uncertain.
      for (std::size_t w = word + first / 2; w <= word + (last - 1) / 2; ++w) {
        uncertain.words()[w] = occupied.words()[w] & ~uncertain.words()[w];
      }
    }
  }
}

template <int kDisk>
SectorCover<kDisk>::SectorCover() {
  using Sectors = std::uint64_t;  // bit s: sector s, or direction s, where it begins
  std::array<Vector, kSectors> direction;
  for (std::size_t s = 0; s < kSectors; ++s) {
    const double angle = static_cast<double>(s) * (2 * std::numbers::pi / kSectors);
    direction[s] = {std::cos(angle), std::sin(angle)};
  }
  // Corners of the boxes of all d lie on a lattice of quarters. (kSlack, which moves them, changes (1) by
  // less than 2^-22, so that kExtra covers it.) Turning a corner by 90 degrees turns its directions.
  constexpr int kSteps = static_cast<int>(kQuarters);  // of a column
  constexpr int kFarthestCorner = 2 * kDisk * kSteps;
  constexpr std::size_t kCorners = 2 * kFarthestCorner + 1;
  std::vector<Sectors> inside(kCorners * kCorners);  // (1) holds with these directions
  const auto inside_at = [&](int x, int y) -> Sectors& {
    return inside[static_cast<std::size_t>(y + kFarthestCorner) * kCorners +
                  static_cast<std::size_t>(x + kFarthestCorner)];
  };
  for (int y = 0; y < kFarthestCorner; ++y) {
    for (int x = 1; x * x + y * y < kFarthestCorner * kFarthestCorner; ++x) {
      Sectors sectors = 0;
      for (std::size_t s = 0; s < kSectors; ++s) {
        sectors |= Sectors{is_inside<kDisk>(1.0 / kSteps * x, 1.0 / kSteps * y, direction[s])} << s;
      }
      inside_at(x, y) = sectors;
      inside_at(-y, x) = std::rotl(sectors, kSectors / 4);
      inside_at(-x, -y) = std::rotl(sectors, kSectors / 2);
      inside_at(y, -x) = std::rotr(sectors, kSectors / 4);
    }
  }
  for (int quarter = 0; quarter < kSteps * kSteps; ++quarter) {
    for (int row = -kFarthest; row <= kFarthest; ++row) {
      for (int column = -kFarthest; column <= kFarthest; ++column) {
        const int x = kSteps * column - quarter % kSteps;
        const int y = kSteps * row - quarter / kSteps;
        // From p at the far side of its quarter to q at the near side of its cell, and the other way round.
        const Sectors both = inside_at(x - 1, y - 1) & inside_at(x - 1, y + kSteps) &
                             inside_at(x + kSteps, y - 1) & inside_at(x + kSteps, y + kSteps);
        const int from_lowest = row + kFarthest;
        auto& sectors = covering_[static_cast<std::size_t>(quarter)][static_cast<std::size_t>(from_lowest)];
        for (Sectors covered = both & std::rotr(both, 1); covered != 0; covered &= covered - 1) {
          sectors[static_cast<std::size_t>(std::countr_zero(covered))] |=
              std::uint32_t{1} << static_cast<unsigned>(column + kFarthest);
        }
      }
    }
  }
}

template class SectorCover<kRadius>;
template class SectorCover<kNearRadius>;

const PointCertificate& PointCertificate::instance() {
  static const PointCertificate certificate;
  return certificate;
}

bool PointCertificate::is_certified(const Point& p, Grid::Cell cell, const Grid& grid, const Bitmap& occupied,
                                    Kernel kernel) const {
  const auto cells = cells_round<kRadius>(cell, grid, occupied);
  return loops_of(kernel).check_point(cover_.rows(quarter_of(p, grid)), cells.data());
}

bool PointCertificate::is_middle_certified(Grid::Cell cell, const Grid& grid, const Bitmap& occupied) const {
  constexpr std::size_t kQuarters = SectorCover<kRadius>::kQuarters;
  const auto cells = cells_round<kRadius>(cell, grid, occupied);
  return loops_of(best_kernel())
      .check_point(cover_.rows(kQuarters * (kQuarters / 2) + kQuarters / 2), cells.data());
}

Directions PointCertificate::open_directions(const Point& p, Grid::Cell cell, const Grid& grid,
                                             const Bitmap& occupied, Kernel kernel) const {
  const auto cells = cells_round<kNearRadius>(cell, grid, occupied);
  return loops_of(kernel).find_open(near_cover_.rows(quarter_of(p, grid)), cells.data());
}

}  // namespace polylidar::detail
