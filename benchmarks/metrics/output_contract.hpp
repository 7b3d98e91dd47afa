// What a concave hull promises of its output, whatever the shape: it covers its input, is made of it, and its
// rings run as they should.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::metrics {

struct ContractScores {
  /// Share of the input points in the result by the even-odd rule, its boundary included. Empty without
  /// points and when a coordinate of the result is not finite.
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
  explicit InputPoints(std::span<const polylidar::Point> points);

  /// Of any shape, valid or not. Exact: no tolerance. Safe from several threads at once.
  ContractScores score(const polylidar::MultiPolygon& result) const;

 private:
  std::vector<polylidar::Point> sorted_;  ///< by y, then x
};

}  // namespace hullbench::metrics
