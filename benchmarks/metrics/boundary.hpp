// How far the boundaries of a result and of its ground truth lie apart.
#pragma once

#include <optional>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/segment_tree.hpp"

namespace hullbench::metrics {

/// A distance and the point where it is taken.
struct Witness {
  double distance = 0;
  Point place;
};

/// Boundaries are all rings, those of holes too. They are measured at their vertices and between these at
/// most `spacing` apart (sample_spacing), so that a largest distance is at most spacing / 2 too short and
/// never too long, and a mean or percentile is at most spacing / 2 off. Distances in the unit of the points.
/// All but the F-scores are empty when the result has no boundary.
struct BoundaryScores {
  std::optional<Witness> hausdorff_to_truth;   ///< largest distance from the result's boundary to the truth's
  std::optional<Witness> hausdorff_to_result;  ///< largest distance from the truth's boundary to the result's
  std::optional<double> hausdorff;             ///< the larger one of both
  std::optional<double> p95;   ///< the larger 95th percentile, by length, of the distances either way
  std::optional<double> mean;  ///< of the distances either way, by length of both boundaries together
  /// Harmonic mean of precision (share of the result's boundary within the tolerance of the truth's) and
  /// recall (share of the truth's boundary within the tolerance of the result's); 0 when both are 0, as they
  /// are of an empty result. Tolerances of 1, 2 and 4 nominal spacings.
  double f_score_1h = 0;
  double f_score_2h = 0;
  double f_score_4h = 0;
};

/// A shape's boundary, ready to be measured against others.
class PreparedBoundary {
 public:
  /// Coordinates of `shape`, which must outlive this, are finite.
  explicit PreparedBoundary(const MultiPolygon& shape);

  const MultiPolygon& shape() const { return *shape_; }
  const SegmentTree& segments() const { return segments_; }
  double length() const { return length_; }  ///< in the unit of the points

 private:
  const MultiPolygon* shape_;
  SegmentTree segments_;
  double length_;
};

/// The distance between the places where boundaries are measured: h / 4, or a 2^18th part of `length` where
/// that is more, so that an output that is all tangle cannot take for ever. h: the nominal spacing of the
/// points.
double sample_spacing(double h, double length);

/// Scores a valid `result` against `truth` with tolerances of `h` > 0. Safe from several threads at once.
BoundaryScores boundary_scores(const PreparedBoundary& result, const PreparedBoundary& truth, double h);

}  // namespace hullbench::metrics
