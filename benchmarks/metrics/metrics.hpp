// All scores of a result against the shape its points came from. METRICS.md defines each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/agreement.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/boundary.hpp"
#include "benchmarks/metrics/output_contract.hpp"
#include "benchmarks/metrics/topology.hpp"
#include "benchmarks/metrics/validity.hpp"

namespace hullbench::metrics {

/// Scores of one result; what is not defined is empty (null in records), never NaN. An invalid result has its
/// validity, reason, area, counts and contract, and nothing else.
struct Metrics {
  AreaScores area;
  std::optional<BoundaryScores> boundary;  ///< none for an invalid result
  std::optional<double> boundary_iou;      ///< see boundary_band.hpp; 0 for an empty result
  ShapeCounts counts;
  HoleScores holes;
  ContractScores contract;
  std::optional<double> skill;  ///< see anchors.hpp
  double l2_convex_hull = 0;
  double l2_best_triangles = 0;
  /// h = sqrt(A / n), the nominal spacing of n points (at least 1) on the ground truth's area A, in the unit
  /// of the points.
  double spacing = 0;
  bool has_truth = true;  ///< else only what describe gives is defined
  /// Area of the result over that of the points' convex hull; none where there is a truth, for an invalid
  /// result and for points without an area.
  std::optional<double> convex_hull_share;
  std::optional<Stability> stability;  ///< where the method was run on parts of the points too
  std::optional<double> window_iou;    ///< IoU with the window in which the points were looked for
  std::size_t polygon_count = 0;
  std::size_t hole_count = 0;
  std::size_t vertex_count = 0;
  /// Largest resident size of the worker during an untimed run; the harness fills it in.
  std::optional<std::int64_t> peak_memory_bytes;
};

/// What can be said of `result` where there is no ground truth, as of degenerate input and real points:
/// validity, area and its share of the convex hull's, counts and contract, and of `draws`, what the method
/// made of parts of the points, if there are any, the stability; of a `window`, if it is not empty, the IoU
/// with it. The ground truth's area and convexity are 0. Throws std::runtime_error when GEOS fails, and as
/// polylidar::concave_hull for the points.
Metrics describe(std::span<const Point> points, const MultiPolygon& result, const MultiPolygon& window = {},
                 std::span<const PartResults> draws = {});

/// Scores results on one case. What all of them share, such as the anchors of skill, is worked out once.
class CaseScorer {
 public:
  /// `points` may be few or none. Copies what it needs. Throws std::runtime_error when `ground_truth` is
  /// empty or invalid or when GEOS fails, and as polylidar::delaunay for the points.
  CaseScorer(std::span<const Point> points, const MultiPolygon& ground_truth);
  ~CaseScorer();

  /// Safe from several threads at once. Throws std::runtime_error when GEOS fails.
  Metrics score(const MultiPolygon& result) const;

  /// The area scores alone, for searches that score many results: those of `score`, as safe.
  AreaScores area_scores(const MultiPolygon& result) const;

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace hullbench::metrics
