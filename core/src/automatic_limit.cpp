#include "automatic_limit.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace polylidar::detail {

namespace {

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
/// the bits of a number. Limits lie between cells.
class Grid {
 public:
  /// Seven octaves, enough for all limits and the cells about them.
  static constexpr std::size_t kCells = 112;

  /// The cell of a length in medians; the outermost cells hold what lies outside.
  static std::size_t cell(double length) {
    const auto place = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(length / kShift) >> kDropped);
    return static_cast<std::size_t>(
        std::clamp(place - kFirst, std::int64_t{0}, static_cast<std::int64_t>(kCells - 1)));
  }
  /// Where cell `c` begins, in medians.
  static double begin(std::size_t c) {
    return std::bit_cast<double>((c + static_cast<std::uint64_t>(kFirst)) << kDropped) * kShift;
  }

 private:
  static constexpr int kDropped = 48;                              // of the 52 bits behind the point
  static constexpr std::int64_t kFirst = std::int64_t{1020} << 4;  // cell 0 begins at 2^-3 kShift
  /// Moves the cells so that the median itself, which is every triangle's perimeter in a lattice, and its
  /// simple multiples do not lie where one ends.
  static constexpr double kShift = 0.93;
};

using CellValues = std::array<double, Grid::kCells>;

/// The limit of the least cost, in medians, for triangles of these areas in the cells; kUsual where all areas
/// are zero, as those of triangles that are flat up to rounding.
double steadiest_limit(const CellValues& area) {
  CellValues log_area{};   // of all cells below
  CellValues log_limit{};  // where the cell begins
  double below = 0;
  for (std::size_t c = 0; c < Grid::kCells; ++c) {
    log_area[c] = std::log(below);
    log_limit[c] = std::log(Grid::begin(c));
    below += area[c];
  }
  double least_cost = std::numeric_limits<double>::infinity();
  double steadiest = kUsual;
  for (std::size_t c = kBelow; c + kAbove < Grid::kCells; ++c) {
    const double limit = Grid::begin(c);
    if (limit < kLeast || limit > kMost) continue;
    const double growth =
        (log_area[c + kAbove] - log_area[c - kBelow]) / (log_limit[c + kAbove] - log_limit[c - kBelow]);
    const double distance = log_limit[c] - std::log(kUsual);
    const double cost = std::log(growth + kStill) + kPull * distance * distance;
    if (cost < least_cost) {  // no: without an area below, where it is infinite or NaN
      least_cost = cost;
      steadiest = limit;
    }
  }
  return steadiest;
}

}  // namespace

void AutomaticLimit::sample(const Mesh& mesh, const Point* vertices, std::size_t step) {
  const auto length = [](const Point& a, const Point& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
  };
  sizes_.clear();
  for (std::size_t t = 0; t < mesh.triangle_count(); t += step) {
    if (mesh.is_ghost(static_cast<Mesh::Index>(t))) continue;
    const auto e = static_cast<Mesh::Index>(Mesh::kStride * t);
    const Point& a = vertices[mesh.origin(e)];
    const Point& b = vertices[mesh.origin(e + 1)];
    const Point& c = vertices[mesh.origin(e + 2)];
    sizes_.push_back({length(a, b) + length(b, c) + length(c, a),
                      std::max((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0.0)});
  }
}

double AutomaticLimit::choose(const Mesh& mesh, const Point* vertices) {
  // Records come in pairs, of which an even step would only see the first.
  const std::size_t step = mesh.triangle_count() <= kSample ? 1 : (mesh.triangle_count() / kSample) | 1U;
  sample(mesh, vertices, step);
  // Points that repeat others leave records unused.
  if (step > 1 && sizes_.size() < kSample / 4) sample(mesh, vertices, 1);
  if (sizes_.empty()) return std::numeric_limits<double>::infinity();

  const auto middle = sizes_.begin() + static_cast<std::ptrdiff_t>(sizes_.size() / 2);
  std::nth_element(sizes_.begin(), middle, sizes_.end(),
                   [](const Size& a, const Size& b) { return a.perimeter < b.perimeter; });
  const double median = middle->perimeter;

  CellValues area{};
  for (const Size& size : sizes_) area[Grid::cell(size.perimeter / median)] += size.twice_area;
  return steadiest_limit(area) * median;
}

}  // namespace polylidar::detail
