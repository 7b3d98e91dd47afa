// The core's rule for its automatic limit with its constants left open, to fit them.
//
// core/src/automatic_limit.hpp states the rule. Here it is in its plainest form: all triangles are looked at,
// in double precision.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::tune {

/// The rule's constants, with the values that stand in core/src/automatic_limit.cpp (a test compares).
/// Lengths are in medians of the perimeters, differences in cells of the grid, 16 to the octave.
struct LimitConstants {
  double usual = 1.6;    ///< where the limit usually is
  double pull = 2;       ///< how much another one costs
  double still = 0.003;  ///< a growth that is as good as none
  double least = 1.1;
  double most = 6;
  std::size_t below = 10;  ///< over so many cells below a limit its growth is taken
  std::size_t above = 2;   ///< and above it

  friend bool operator==(const LimitConstants&, const LimitConstants&) = default;
};

/// The grid of limits.
inline constexpr std::size_t kLimitCells = 64;

/// Where cell `c` begins, in medians: the limit that stands for it.
double cell_limit(std::size_t c);

/// What the rule sees of points.
struct LimitSample {
  double median = 0;  ///< of the triangles' perimeters, in the unit of the points
  std::array<double, kLimitCells> area =
      {};  ///< cell -> area of the triangles in it; of smaller ones in the first
};

/// None for points without a triangle.
std::optional<LimitSample> look_at(std::span<const polylidar::Point> points);

/// The cell that the rule chooses; none where no cell has a cost, for which it takes `usual`.
std::optional<std::size_t> chosen_cell(const LimitSample& sample, const LimitConstants& constants);

/// A shape's points for the fit: what the rule sees, and what each choice would cost.
struct LimitCase {
  std::string shape;  ///< base shape
  LimitSample sample;
  std::array<double, kLimitCells> errors =
      {};  ///< cell -> l2 of the shape with that limit, where it was asked for
};

/// The values of each constant that are tried, all with all.
struct LimitGrid {
  std::vector<double> usual, pull, still, least, most;
  std::vector<std::size_t> below, above;
};

/// About the constants of the core.
LimitGrid usual_limit_grid();

/// The cells whose errors a fit over `grid` needs: from the first to behind the last.
std::array<std::size_t, 2> limit_cells(const LimitGrid& grid);

/// What one choice of constants gives.
struct LimitScore {
  LimitConstants constants;
  double score = 0;  ///< fit_score of the errors
};

LimitScore score_limit(const std::vector<LimitCase>& cases, const LimitConstants& constants);

/// All choices of the grid, by score; of equal ones in the grid's order.
std::vector<LimitScore> fit_limit(const std::vector<LimitCase>& cases, const LimitGrid& grid);

}  // namespace hullbench::tune
