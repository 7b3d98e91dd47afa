// Scores of a result against the shape its points came from.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// Scores of one result. Areas in the squared unit of the points. A ratio whose denominator is zero is empty
/// (null in records), never NaN. An invalid result has its validity, reason, area and counts, and every
/// overlay-based ratio is empty: it is neither repaired nor dropped.
struct Metrics {
  bool valid = false;          ///< OGC validity of the multipolygon, by GEOS
  std::string invalid_reason;  ///< GEOS's reason with the place; empty when valid
  double area = 0;             ///< of the result
  double ground_truth_area = 0;
  double ground_truth_convexity = 0;  ///< its area / the area of its convex hull, in (0, 1] (the paper's CV)
  std::optional<double> symmetric_difference_area;  ///< area((GT - CS) + (CS - GT))
  std::optional<double> l2;                         ///< symmetric difference / ground truth's area
  std::optional<double> l2_paper;  ///< symmetric difference / result's area (the paper, section V)
  std::optional<double> iou;       ///< intersection / union
  std::size_t polygons = 0;
  std::size_t holes = 0;
  std::size_t vertices = 0;
};

/// Why `shape` is not a valid multipolygon in the sense of the OGC, in GEOS's words and with the place; empty
/// when it is valid, as an empty shape is.
std::string invalid_reason(const polylidar::MultiPolygon& shape);

/// Scores `result` against `ground_truth` with GEOS. An empty result is valid, with l2 = 1, iou = 0 and no
/// l2_paper. Throws std::runtime_error when `ground_truth` is itself empty or invalid, or when GEOS fails.
Metrics score(const polylidar::MultiPolygon& result, const polylidar::MultiPolygon& ground_truth);

}  // namespace hullbench
