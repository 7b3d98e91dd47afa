// What a concave hull promises of its output, whatever the shape: it covers its input, is made of it, and its
// rings run as they should.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// A point counts as on the result's edge when it is no farther from it than this share of the result's
/// largest coordinate: 2^-47 = 7.1e-15. Text with 15 significant digits, as many as every double keeps on its
/// way through text and back, moves a coordinate c by at most 5e-15 |c|, so a vertex and every edge at it by
/// at most sqrt(2) times that, 7.07e-15 of the largest coordinate. In metres of a national grid (6e6) it is
/// 43 nanometres, in degrees 0.14 micrometres on the ground: no point that anybody misses.
inline constexpr double kRoundingOfText = 0x1p-47;

struct ContractScores {
  /// Share of the input points in the result by the even-odd rule or on its boundary, but for rounding
  /// (kRoundingOfText). Empty without points and when a coordinate of the result is not finite.
  std::optional<double> points_covered;
  /// Share of the result's vertices that are input points, to the last bit. Empty without vertices.
  std::optional<double> vertices_from_input;
  /// Whether all shells run counter-clockwise and all holes clockwise. Empty without rings.
  std::optional<bool> oriented;
};

/// The points of one case, which the results on it are held against.
class InputPoints {
 public:
  /// Coordinates are finite. O(n log n).
  explicit InputPoints(std::span<const Point> points);

  /// Of any shape, valid or not. Safe from several threads at once.
  ContractScores score(const MultiPolygon& result) const;

 private:
  std::vector<Point> sorted_;  ///< by y, then x
};

}  // namespace hullbench::metrics
