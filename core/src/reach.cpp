#include "reach.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "vector.hpp"

namespace polylidar::detail {

namespace {

static_assert(rows_below(kReachedHalfWidths) == kReachedRows);
/// Where 2 r turn out to be too little: the box of a circle of radius r reaches no farther from a point on
/// it.
constexpr auto kFartherHalfWidths = make_half_widths<2 * kRadius + 4>();
static_assert(kFartherHalfWidths[2 * kRadius + 5] <= Grid::kMargin);

/// Cells round one: row, from the lowest on -> bit c: the cell c - kFarthest columns away.
struct Neighbourhood {
  static constexpr int kFarthest = 2 * kRadius + 1;
  std::array<std::uint32_t, 2 * kFarthest + 1> rows{};
};

/// How far the interval from `low` to `high` is from `at`.
double gap(double low, double high, double at) {
  return std::max({low - at, at - high, 0.0});
}

/// The cells that may hold a corner of a triangle at a point of the cell in the middle.
struct Reach {
  Reach();

  /// Where all circumradii are below kNearRadius.
  Neighbourhood near;
  /// Fraction k of a turn -> where they are below kRadius and the circumcentres lie in these directions.
  std::array<Neighbourhood, kTurnFractions> in_fraction;
};

/// Of a triangle at p with a circumradius below R and the circumcentre in direction u the corners lie in the
/// disk of radius R with the centre p + R u. Over all u of a fraction of a turn, these disks are: those of
/// the first and the last u, and, in the directions between, all that is within 2 R of p.
Reach::Reach() {
  // For all rounding: a point is within Grid::kSlack of its cell, and no number below exceeds 2^9, so each is
  // off by less than 2^-40.
  constexpr double kWithin = 0x1p-10;
  constexpr int kFarthest = Neighbourhood::kFarthest;
  std::array<Vector, kTurnFractions + 1> directions;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const double angle = static_cast<double>(k) * (2 * std::numbers::pi / kTurnFractions);
    directions[k] = {std::cos(angle), std::sin(angle)};
  }
  for (int row = -kFarthest; row <= kFarthest; ++row) {
    for (int column = -kFarthest; column <= kFarthest; ++column) {
      // From anywhere in the cell in the middle to anywhere in this one.
      const Box d{{column - 1.0, row - 1.0}, {column + 1.0, row + 1.0}};
      const auto is_within = [&](double radius, const Vector& of) {
        const Vector nearest{gap(d.min.x, d.max.x, of.x), gap(d.min.y, d.max.y, of.y)};
        return squared_length(nearest) < (radius + kWithin) * (radius + kWithin);
      };
      const int from_lowest = row + kFarthest;
      const auto row_index = static_cast<std::size_t>(from_lowest);
      const std::uint32_t bit = std::uint32_t{1} << static_cast<unsigned>(column + kFarthest);
      if (is_within(2 * kNearRadius, {0, 0})) near.rows[row_index] |= bit;
      if (!is_within(2 * kRadius, {0, 0})) continue;
      std::array<bool, kTurnFractions + 1> in_disk{};
      // How far some of it lies to the left of a direction, and to the right.
      std::array<double, kTurnFractions + 1> most_left{};
      std::array<double, kTurnFractions + 1> most_right{};
      for (std::size_t k = 0; k < directions.size(); ++k) {
        const Vector& u = directions[k];
        in_disk[k] = is_within(kRadius, {kRadius * u.x, kRadius * u.y});
        most_left[k] = u.x * row - u.y * column + std::abs(u.x) + std::abs(u.y);
        most_right[k] = u.y * column - u.x * row + std::abs(u.x) + std::abs(u.y);
      }
      for (std::size_t k = 0; k < kTurnFractions; ++k) {
        const bool is_between = most_left[k] > -kWithin && most_right[k + 1] > -kWithin;
        if (in_disk[k] || in_disk[k + 1] || is_between) in_fraction[k].rows[row_index] |= bit;
      }
    }
  }
}

const Reach& reach_table() {
  static const Reach reach;
  return reach;
}

template <class Cells>
void mark(const Grid& grid, Grid::Cell cell, std::span<const unsigned> half_widths, Cells& reached) {
  const Grid::Cell row_bits = grid.row_words() * Grid::kWordBits;
  Grid::Cell centre = cell - rows_below(half_widths) * row_bits;
  for (const unsigned half_width : half_widths) {
    reached.set_run(centre - half_width, 2 * half_width + 1);
    centre += row_bits;
  }
}

/// Of a point in `cell` with large triangles in the directions `open`.
void mark(const Grid& grid, Grid::Cell cell, Directions open, const Reach& reach, Bitmap& reached) {
  Neighbourhood cells = reach.near;
  for (unsigned fractions = open; fractions != 0; fractions &= fractions - 1) {
    const Neighbourhood& more = reach.in_fraction[static_cast<std::size_t>(std::countr_zero(fractions))];
    for (std::size_t r = 0; r < cells.rows.size(); ++r) cells.rows[r] |= more.rows[r];
  }
  const Grid::Cell first = cell - Neighbourhood::kFarthest;
  const unsigned shift = first % Grid::kWordBits;
  Bitmap::Word* word =
      reached.words() + first / Grid::kWordBits - Neighbourhood::kFarthest * grid.row_words();
  for (const Bitmap::Word row : cells.rows) {
    word[0] |= row << shift;
    word[1] |= row >> 1U >> (Grid::kWordBits - 1 - shift);
    word += grid.row_words();
  }
}

template <class Cells>
void mark_round(std::span<const Mesh::Index> triangles, const DelaunayBuilder& builder, const Grid& grid,
                Cells& reached) {
  for (const Mesh::Index t : triangles) {
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Point& corner = builder.vertices()[builder.mesh().corners(t)[k]];
      mark(grid, grid.cell(corner), kFartherHalfWidths, reached);
    }
  }
}

/// not_reached(first): of the 64 cells from `first` on those that are occupied and not in the part.
template <class NotReached>
bool is_whole(const Triangle& triangle, const Grid& grid, const NotReached& not_reached) {
  const Vector b = triangle.b - triangle.a;
  const Vector c = triangle.c - triangle.a;
  const double twice_cross = 2 * cross(b, c);
  // Of flat triangles the circle is not known well enough. Of the others, with a longest edge L and e =
  // 2^-53: twice_cross >= 2^-20 L^2 is off by at most 16 e L^2, which is 2^-29 of itself, and the numerators
  // of the circumcentre by 16 e L^3. A circle of radius below kRadius cells has L < 2 kRadius, so its centre
  // is off by less than 2^-24 of a cell.
  constexpr double kLeastCross = 0x1p-20;
  const double longest = std::max({squared_length(b), squared_length(c), triangle.squared_bc()});
  if (!(twice_cross >= kLeastCross * longest)) return false;
  const Vector centre = circumcentre(b, c, twice_cross);
  const double radius = std::sqrt(squared_length(centre)) * grid.cells_per_length();
  if (!(radius < kRadius)) return false;
  constexpr double kSlack = 0x1p-6;  // of a cell: far more than that and Grid::kSlack, and costs nothing
  constexpr double kMargin = Grid::kMargin;
  // From the margin's corner on, so that all is positive.
  const double x = grid.column(triangle.a) + centre.x * grid.cells_per_length() + kMargin;
  const double y = grid.row(triangle.a) + centre.y * grid.cells_per_length() + kMargin;
  const auto left = static_cast<Grid::Cell>(x - radius - kSlack);
  const auto width = static_cast<Grid::Cell>(x + radius + kSlack) - left + 1;
  const auto bottom = static_cast<Grid::Cell>(y - radius - kSlack);
  const auto top = static_cast<Grid::Cell>(y + radius + kSlack);
  const Bitmap::Word columns = (Bitmap::Word{1} << width) - 1;
  for (Grid::Cell row = bottom; row <= top; ++row) {
    const Grid::Cell first =
        row * grid.row_words() * Grid::kWordBits + Grid::kWordBits + left - Grid::kMargin;
    if ((not_reached(first) & columns) != 0) return false;
  }
  return true;
}

}  // namespace

void mark_reach(const Grid& grid, Grid::Cell cell, ReachedCells& reached) {
  mark(grid, cell, kReachedHalfWidths, reached);
}

void mark_reach(const Grid& grid, const std::uint32_t* cells, std::span<const std::uint32_t> uncertain,
                std::span<const Directions> open, Bitmap& reached) {
  const Reach& reach = reach_table();
  for (std::size_t i = 0; i < uncertain.size(); ++i) mark(grid, cells[uncertain[i]], open[i], reach, reached);
}

void mark_reach_round(std::span<const Mesh::Index> triangles, const DelaunayBuilder& builder,
                      const Grid& grid, Bitmap& reached) {
  mark_round(triangles, builder, grid, reached);
}
void mark_reach_round(std::span<const Mesh::Index> triangles, const DelaunayBuilder& builder,
                      const Grid& grid, ReachedCells& reached) {
  mark_round(triangles, builder, grid, reached);
}

bool is_surely_whole(const Triangle& triangle, const Grid& grid, const Bitmap& occupied,
                     const Bitmap& reached) {
  return is_whole(triangle, grid,
                  [&](Grid::Cell first) { return occupied.window(first) & ~reached.window(first); });
}
bool is_surely_whole(const Triangle& triangle, const Grid& grid, const ReachedCells& reached) {
  return is_whole(triangle, grid, [&](Grid::Cell first) { return reached.not_reached(first); });
}

}  // namespace polylidar::detail
