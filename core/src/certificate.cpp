#include "certificate.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

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

/// Between a cell `column` and `row` cells away from p's and a part of p's cell: a square of side `side`
/// whose least corner is at (x, y) in the cell.
constexpr Differences differences(int column, int row, double x, double y, double side) {
  constexpr double kSlack = 2 * Grid::kSlack;
  return {column - (x + side) - kSlack, column + 1 - x + kSlack, row - (y + side) - kSlack,
          row + 1 - y + kSlack};
}

/// (1) of the header with room to spare, at one corner and one end.
constexpr bool is_inside(double dx, double dy, const Vector& u) {
  return dx * dx + dy * dy + kExtra < 2 * kRadius * (dx * u.x + dy * u.y);
}

/// Whether (1) holds for all `d` with the direction u.
constexpr bool is_inside(const Differences& d, const Vector& u) {
  return is_inside(d.min_x, d.min_y, u) && is_inside(d.min_x, d.max_y, u) && is_inside(d.max_x, d.min_y, u) &&
         is_inside(d.max_x, d.max_y, u);
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
        const Differences d = differences(column, row, 0, 0, 1);
        if (!is_inside(d, cell_direction(s)) || !is_inside(d, cell_direction(s + 1))) continue;
        if (run.first > run.last) run.first = column;
        run.last = column;
      }
      runs[static_cast<std::size_t>(s)][static_cast<std::size_t>(row + kReach)] = run;
    }
  }
  return runs;
}
constexpr auto kRuns = make_runs();

// A strip of 32 columns is looked at together with 16 columns on either side: one word a row. Bit b of
// windows[row][k] says whether one of the 2^k cells from b on is occupied.
constexpr int kStrip = 32;
constexpr int kSide = 16;
static_assert(kReach <= kSide);
using Windows = std::array<Word, 3>;

/// Which cells of the strip have an occupied cell where Run kRuns[kSector][kRow] says.
template <std::size_t kSector, std::size_t kRow>
[[gnu::always_inline]] inline Word any_in_run(const Windows* windows) {
  constexpr Run kRun = kRuns[kSector][kRow];
  if constexpr (kRun.first > kRun.last) {
    return 0;
  } else {
    constexpr unsigned kLength = kRun.last - kRun.first + 1;
    constexpr unsigned kLevel = std::bit_width(kLength) - 1;
    static_assert(kLevel < std::tuple_size_v<Windows>);
    const Word runs = windows[kRow][kLevel];
    const Word any = runs >> static_cast<unsigned>(kSide + kRun.first);
    if constexpr (std::has_single_bit(kLength)) return any;
    return any | runs >> static_cast<unsigned>(kSide + kRun.last + 1 - (1 << kLevel));
  }
}

template <std::size_t kSector, std::size_t... kRow>
[[gnu::always_inline]] inline Word any_in_sector(const Windows* windows,
                                                 std::index_sequence<kRow...> /*rows*/) {
  return (any_in_run<kSector, kRow>(windows) | ...);
}

/// Of `cells` of the strip in the middle of the kRows `windows` those that are not certified.
template <std::size_t... kSector>
[[gnu::always_inline]] inline Word uncertain(Word cells, const Windows* windows,
                                             std::index_sequence<kSector...> /*sectors*/) {
  Word certified = cells;
  const bool goes_on =
      (((certified &= any_in_sector<kSector>(windows, std::make_index_sequence<kRows>())) != 0) && ...);
  return goes_on ? cells & ~certified : cells;
}

Windows windows_of(const Word* row, Grid::Cell strip) {
  // Column 0 is bit 64 of the row.
  const Word* const word = row + 1 + strip / 2;
  const Word one = strip % 2 == 0 ? word[-1] >> 48U | word[0] << 16U : word[0] >> 16U | word[1] << 48U;
  const Word two = one | one >> 1U;
  return {one, two, two | two >> 2U};
}

}  // namespace

void find_uncertain_cells(const Grid& grid, const Bitmap& occupied, Grid::Cell begin, Grid::Cell end,
                          Bitmap& uncertain_cells) {
  constexpr Grid::Cell kTileRows = 128;
  std::array<Windows, kTileRows + 2 * kReach> windows;
  const Grid::Cell strips = (grid.columns() + kStrip - 1) / kStrip;
  for (Grid::Cell first = begin; first < end; first += kTileRows) {
    const Grid::Cell rows = std::min(kTileRows, end - first);
    for (Grid::Cell strip = 0; strip < strips; ++strip) {
      const Word* row = occupied.words() + grid.first_word(first) - std::size_t{grid.row_words()} * kReach;
      for (Grid::Cell r = 0; r < rows + 2 * kReach; ++r, row += grid.row_words()) {
        windows[r] = windows_of(row, strip);
      }
      Word* target = uncertain_cells.words() + grid.first_word(first) + 1 + strip / 2;
      for (Grid::Cell r = 0; r < rows; ++r, target += grid.row_words()) {
        const Word cells = windows[r + kReach][0] >> static_cast<unsigned>(kSide) & 0xFFFFFFFFU;
        if (cells == 0) continue;
        *target |= uncertain(cells, &windows[r], std::make_index_sequence<kCellSectors>())
                   << (strip % 2 * kStrip);
      }
    }
  }
}

PointCertificate::PointCertificate() {
  constexpr int kSectors = 64;
  constexpr int kQuarters = 4;
  std::array<Vector, kSectors> direction;
  for (int s = 0; s < kSectors; ++s) {
    const double angle = s * (6.283185307179586 / kSectors);
    direction[static_cast<std::size_t>(s)] = {std::cos(angle), std::sin(angle)};
  }
  for (int quarter = 0; quarter < kQuarters * kQuarters; ++quarter) {
    const double x = 1.0 / kQuarters * (quarter % kQuarters);
    const double y = 1.0 / kQuarters * (quarter / kQuarters);
    for (int row = -kReach; row <= kReach; ++row) {
      for (int column = -kReach; column <= kReach; ++column) {
        const Differences d = differences(column, row, x, y, 1.0 / kQuarters);
        Sectors inside = 0;  // bit s: with direction s
        for (unsigned s = 0; s < kSectors; ++s) inside |= Sectors{is_inside(d, direction[s])} << s;
        covered_[static_cast<std::size_t>(quarter)][static_cast<std::size_t>(row + kReach)]
                [static_cast<std::size_t>(column + kReach)] = inside & std::rotr(inside, 1);
      }
    }
  }
}

const PointCertificate& PointCertificate::instance() {
  static const PointCertificate certificate;
  return certificate;
}

bool PointCertificate::is_certified(const Point& p, Grid::Cell cell, const Grid& grid,
                                    const Bitmap& occupied) const {
  const auto quarter_x = static_cast<std::size_t>(grid.column(p) * 4) % 4;
  const auto quarter_y = static_cast<std::size_t>(grid.row(p) * 4) % 4;
  const auto& covered = covered_[quarter_y * 4 + quarter_x];
  const Grid::Cell row_bits = grid.row_words() * Grid::kWordBits;
  constexpr Word kRowCells = (Word{1} << static_cast<unsigned>(kSide)) - 1;
  Sectors all = 0;
  const auto add_row = [&](int row) {
    const Grid::Cell first = cell - kReach + static_cast<Grid::Cell>(row) * row_bits;
    const auto& sectors = covered[static_cast<std::size_t>(row + kReach)];
    for (Word cells = occupied.window(first) & kRowCells; cells != 0; cells &= cells - 1) {
      all |= sectors[static_cast<std::size_t>(std::countr_zero(cells))];
    }
  };
  add_row(0);
  for (int row = 1; row <= kReach; ++row) {
    add_row(row);
    add_row(-row);
    if (all == ~Sectors{0}) return true;
  }
  return false;
}

}  // namespace polylidar::detail
