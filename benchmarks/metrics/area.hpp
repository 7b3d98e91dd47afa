// How much of the area is right.
#pragma once

#include <optional>
#include <string>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// Areas in the squared unit of the points. Of an invalid result `area` is the only score: it is neither
/// repaired nor dropped. Of an empty one l2, omission and so on are those of a shape without area.
struct AreaScores {
  bool valid = false;          ///< OGC validity of the multipolygon, by GEOS
  std::string invalid_reason;  ///< GEOS's reason with the place; empty when valid
  double area =
      0;  ///< of the result: shells less holes; 0 when a coordinate is not finite (records hold no NaN)
  double ground_truth_area = 0;
  double ground_truth_convexity = 0;  ///< its area / the area of its convex hull, in (0, 1] (the paper's CV)
  std::optional<double> symmetric_difference_area;  ///< area((GT - R) + (R - GT))
  std::optional<double> l2;                         ///< symmetric difference / ground truth's area
  std::optional<double> l2_paper;         ///< symmetric difference / result's area; none for an empty result
  std::optional<double> iou;              ///< intersection / union
  std::optional<double> omission;         ///< area(GT - R) / ground truth's area
  std::optional<double> commission;       ///< area(R - GT) / ground truth's area
  std::optional<double> area_bias;        ///< (result's area - ground truth's area) / ground truth's area
  std::optional<double> perimeter_ratio;  ///< length of the result's rings / of the ground truth's
};

/// Scores `result` against `ground_truth`, once; for many results of one case see CaseScorer. Throws
/// std::runtime_error when `ground_truth` is itself empty or invalid, or when GEOS fails.
AreaScores area_scores(const MultiPolygon& result, const MultiPolygon& ground_truth);

}  // namespace hullbench::metrics
