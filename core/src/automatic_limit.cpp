#include "automatic_limit.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "value_of_rank.hpp"

namespace polylidar::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The rule's constants; lengths are in medians.
constexpr double kUsual = 1.6;
constexpr double kPull = 2;
constexpr double kStill = 0.003;
constexpr double kLeast = 1.1;
constexpr double kMost = 6;
/// Cells of the grid below and above a limit over which the growth is taken.
constexpr std::size_t kBelow = 8;
constexpr std::size_t kAbove = 1;

/// The grid that lengths are counted on: an octave has 16 cells of equal width, so that a cell is found in
/// the bits of a number. Limits lie between cells. The unit of lengths moves the cells so that the median
/// itself, which is every triangle's perimeter in a lattice, and its simple multiples do not lie where one
/// ends.
class Grid {
 public:
  /// Four octaves, enough for all limits and the cells about them.
  static constexpr std::size_t kCells = 64;
  /// In medians.
  static constexpr double kUnit = 0.93;

  /// Where cell `c`, of kCells too, begins, in units.
  static constexpr double begin(std::size_t c) { return std::bit_cast<double>((c + kFirst) << kDropped); }
  /// The cell of a positive length, in units; kCells or more for one that lies outside.
  static constexpr std::size_t cell(double length) {
    return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(length) >> kDropped) - kFirst;
  }

 private:
  static constexpr int kDropped = 48;                                 // of the 52 bits behind the point
  static constexpr std::uint64_t kFirst = std::uint64_t{1022} << 4U;  // cell 0 begins at 2^-1
};

using CellValues = std::array<double, Grid::kCells>;

/// What there is to know of the limits on the grid before any triangle is seen.
struct GridLimits {
  CellValues log_limit{};  ///< where the cell begins
  CellValues weight{};     ///< how far from the usual; infinite beyond kLeast and kMost

  GridLimits() {
    for (std::size_t c = 0; c < Grid::kCells; ++c) {
      const double limit = Grid::begin(c) * Grid::kUnit;
      const double distance = std::log(limit / kUsual);
      log_limit[c] = std::log(limit);
      weight[c] = limit < kLeast || limit > kMost ? kInfinity : std::exp(kPull * distance * distance);
    }
  }
};

/// The limit of the least cost, in medians, for triangles of these areas in the cells; kUsual where all areas
/// are zero, as those of triangles that are flat up to rounding.
double steadiest_limit(const CellValues& area) {
  static const GridLimits grid;
  CellValues log_area{};  // of all cells below
  double below = 0;
  for (std::size_t c = 0; c < Grid::kCells; ++c) {
    log_area[c] = std::log(below);
    below += std::max(area[c], 0.0);
  }
  double least_cost = kInfinity;
  double steadiest = kUsual;
  for (std::size_t c = kBelow; c + kAbove < Grid::kCells; ++c) {
    const double growth = (log_area[c + kAbove] - log_area[c - kBelow]) /
                          (grid.log_limit[c + kAbove] - grid.log_limit[c - kBelow]);
    const double cost = (growth + kStill) * grid.weight[c];  // its logarithm is the rule's
    if (cost < least_cost) {  // no: without an area below, where it is infinite or NaN
      least_cost = cost;
      steadiest = Grid::begin(c) * Grid::kUnit;
    }
  }
  return steadiest;
}

}  // namespace

void AutomaticLimit::sample(const Mesh& mesh, const Point* vertices, std::size_t step) {
  const std::size_t most = (mesh.triangle_count() + step - 1) / step;
  double* const perimeter = perimeters_.reserve(most);
  double* const twice_area = twice_areas_.reserve(most);
  const auto length = [](double x, double y) { return std::sqrt(x * x + y * y); };
  const Mesh::Index* const end = mesh.record(mesh.triangle_count());
  std::size_t count = 0;
  std::size_t ghosts = 0;
  for (const Mesh::Index* record = mesh.record(0); record < end; record += Mesh::kStride * step) {
    if (record[2] == kNone) {
      if (!is_complete_) continue;
      perimeter[count] = kInfinity;
      twice_area[count++] = 0;
      ++ghosts;
      continue;
    }
    const Point& a = vertices[record[0]];
    const Point& b = vertices[record[1]];
    const Point& c = vertices[record[2]];
    const Point ab{b.x - a.x, b.y - a.y};
    const Point bc{c.x - b.x, c.y - b.y};
    const Point ca{a.x - c.x, a.y - c.y};
    perimeter[count] = length(ab.x, ab.y) + length(bc.x, bc.y) + length(ca.x, ca.y);
    twice_area[count++] = ab.y * ca.x - ab.x * ca.y;
  }
  count_ = count;
  finite_count_ = count - ghosts;
}

double AutomaticLimit::choose(const Mesh& mesh, const Point* vertices) {
  // Odd, as records come in pairs, of which an even step would only see the first.
  const std::size_t step = (mesh.triangle_count() / kSample) | 1U;
  is_complete_ = step == 1;
  sample(mesh, vertices, step);
  // Points that repeat others leave records unused.
  if (step > 1 && count_ < kSample / 4) sample(mesh, vertices, 1);
  if (finite_count_ == 0) {
    is_complete_ = false;
    return kInfinity;
  }
  const std::span<const double> perimeters(perimeters_.data(), count_);
  const double median = value_of_rank(perimeters, finite_count_ / 2, room_.reserve(count_));
  const double* const twice_area = twice_areas_.data();
  const double scale = 1 / (median * Grid::kUnit);
  CellValues area{};
  for (std::size_t i = 0; i < count_; ++i) {
    const double length = perimeters[i] * scale;
    const std::size_t cell = Grid::cell(length);
    if (cell < Grid::kCells) {
      area[cell] += twice_area[i];
    } else if (length < 1) {
      area[0] += twice_area[i];
    }
  }
  return steadiest_limit(area) * median;
}

}  // namespace polylidar::detail
