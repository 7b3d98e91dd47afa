// How well shapes agree, where there is no truth to hold them against: two of them, or what one method makes
// of some points and of parts of these.
#pragma once

#include <optional>
#include <span>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// Area of the intersection over area of the union. 0 when only one of them has an area; empty when neither
/// has or when one is not valid. Throws std::runtime_error when GEOS fails.
std::optional<double> intersection_over_union(const MultiPolygon& a, const MultiPolygon& b);

/// What a method made of parts of its points in one draw; none where it gave no result.
struct PartResults {
  std::optional<MultiPolygon> half;        ///< of a random half of the points
  std::optional<MultiPolygon> other_half;  ///< of the others
  std::optional<MultiPolygon> most;        ///< of a random 90 % of the points
};

/// Means over the draws of an IoU. A part without a valid result with an area agrees with nothing: its IoU
/// is 0.
struct Stability {
  double halves = 0;      ///< of the results of both halves
  double subsamples = 0;  ///< of the results of 90 % and of all points
};

/// Of the result of all points and those of the draws, of which there is at least one; none for an invalid
/// `whole`. Throws std::runtime_error when GEOS fails.
std::optional<Stability> stability(const MultiPolygon& whole, std::span<const PartResults> draws);

}  // namespace hullbench::metrics
