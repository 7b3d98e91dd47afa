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

/// A median perimeter outside of these is measured again in another unit: single precision has numbers from
/// 2^-149 to 2^128 for the squares of edges.
constexpr float kLeastMedian = 0x1p-40F;
constexpr float kMostMedian = 0x1p40F;
constexpr int kMostUnits = 10;

// The rule's constants; lengths are in medians.
constexpr double kUsual = 1.6;
constexpr double kPull = 2;
constexpr double kStill = 0.003;
constexpr double kLeast = 1.1;
constexpr double kMost = 6;
/// Cells of the grid below and above a limit over which the growth is taken.
constexpr std::size_t kBelow = 10;
constexpr std::size_t kAbove = 2;

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
  static constexpr double begin(std::size_t c) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(c + kFirst) << kDropped);
  }
  /// The cell of a positive length, in units; kCells or more for one that lies outside.
  static constexpr std::size_t cell(float length) {
    return (std::bit_cast<std::uint32_t>(length) >> kDropped) - kFirst;
  }

 private:
  static constexpr int kDropped = 19;                            // of the 23 bits behind the point
  static constexpr std::size_t kFirst = std::size_t{126} << 4U;  // cell 0 begins at 2^-1
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
  count_ = (mesh.triangle_count() + step - 1) / step;
  finite_count_ = count_;
  float* const perimeter = perimeters_.reserve(count_);
  double* const twice_area = twice_areas_.reserve(count_);
  const double scale = 1 / (unit_ * unit_);
  const auto square = [&](const Point& edge) {
    return static_cast<float>((edge.x * edge.x + edge.y * edge.y) * scale);
  };
  // The roots are taken by themselves, several in one instruction: they take most of the time.
  constexpr std::size_t kBlock = 128;
  std::array<float, kBlock> squared_ab{};
  std::array<float, kBlock> squared_bc{};
  std::array<float, kBlock> squared_ca{};
  const Mesh::Index* record = mesh.record(0);
  for (std::size_t begin = 0; begin < count_; begin += kBlock) {
    const std::size_t size = std::min(kBlock, count_ - begin);
    for (std::size_t k = 0; k < size; ++k, record += Mesh::kStride * step) {
      if (record[2] == kNone) {
        squared_ab[k] = std::numeric_limits<float>::infinity();
        twice_area[begin + k] = 0;
        --finite_count_;
        continue;
      }
      const Point& a = vertices[record[0]];
      const Point& b = vertices[record[1]];
      const Point& c = vertices[record[2]];
      const Point ab{b.x - a.x, b.y - a.y};
      const Point bc{c.x - b.x, c.y - b.y};
      const Point ca{a.x - c.x, a.y - c.y};
      squared_ab[k] = square(ab);
      squared_bc[k] = square(bc);
      squared_ca[k] = square(ca);
      twice_area[begin + k] = ab.y * ca.x - ab.x * ca.y;
    }
    for (std::size_t k = 0; k < size; ++k) {
      perimeter[begin + k] = std::sqrt(squared_ab[k]) + std::sqrt(squared_bc[k]) + std::sqrt(squared_ca[k]);
    }
  }
}

float AutomaticLimit::median() {
  return value_of_rank({perimeters_.data(), count_}, finite_count_ / 2, room_.reserve(count_));
}

double AutomaticLimit::choose(const Mesh& mesh, const Point* vertices) {
  // Odd, as records come in pairs, of which an even step would only see the first.
  std::size_t step = (mesh.triangle_count() / kSample) | 1U;
  unit_ = 1;
  sample(mesh, vertices, step);
  // Points that repeat others leave records unused.
  if (step > 1 && finite_count_ < kSample / 4) {
    step = 1;
    sample(mesh, vertices, step);
  }
  is_complete_ = step == 1 && finite_count_ > 0;
  if (finite_count_ == 0) return kInfinity;
  float typical = median();
  // No unit will do only where the squares are beyond double precision too.
  for (int n = 0; n < kMostUnits && !(typical > kLeastMedian && typical < kMostMedian); ++n) {
    is_complete_ = false;
    unit_ *= typical < 1 ? 0x1p-50 : 0x1p50;
    sample(mesh, vertices, step);
    typical = median();
  }
  const float* const perimeter = perimeters_.data();
  const double* const twice_area = twice_areas_.data();
  const float scale = 1 / (typical * static_cast<float>(Grid::kUnit));
  CellValues area{};
  for (std::size_t i = 0; i < count_; ++i) {
    const float length = perimeter[i] * scale;
    const std::size_t cell = Grid::cell(length);
    if (cell < Grid::kCells) {
      area[cell] += twice_area[i];
    } else if (length < 1) {
      area[0] += twice_area[i];
    }
  }
  return steadiest_limit(area) * typical * unit_;
}

}  // namespace polylidar::detail
