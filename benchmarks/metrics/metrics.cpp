#include "benchmarks/metrics/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "benchmarks/metrics/anchors.hpp"
#include "benchmarks/metrics/boundary_band.hpp"
#include "benchmarks/metrics/checked_shape.hpp"
#include "benchmarks/metrics/prepared_truth.hpp"
#include "benchmarks/metrics/shape_measures.hpp"

namespace hullbench::metrics {

struct CaseScorer::State {
  State(std::span<const Point> points, MultiPolygon ground_truth)
      : truth(std::move(ground_truth)),
        prepared(truth),
        boundary(truth),
        input(points),
        point_count(std::max<std::size_t>(1, points.size())),
        h(std::sqrt(prepared.area() / static_cast<double>(point_count))),
        anchors(find_anchors(points, truth, prepared)),
        band(inner_band(geos, prepared.geometry(geos), kBandWidthInH * h)) {}

  MultiPolygon truth;
  PreparedTruth prepared;
  PreparedBoundary boundary;  ///< of `truth`
  InputPoints input;
  std::size_t point_count;  ///< at least 1
  double h;
  Anchors anchors;
  GeosSession geos;            ///< of `band`
  GeosSession::Geometry band;  ///< of the truth; see boundary_band.hpp
};

Metrics describe(std::span<const Point> points, const MultiPolygon& result, const MultiPolygon& window,
                 std::span<const PartResults> draws) {
  Metrics metrics;
  metrics.has_truth = false;
  metrics.area.invalid_reason = invalid_reason(result);
  metrics.area.valid = metrics.area.invalid_reason.empty();
  metrics.area.area = area_of_result(result);
  metrics.contract = InputPoints(points).score(result);
  metrics.polygon_count = result.size();
  metrics.hole_count = count_holes(result);
  metrics.vertex_count = polylidar::vertex_count(result);
  if (!metrics.area.valid) return metrics;

  const double convex_area = convex_hull_area(points);
  if (convex_area > 0) metrics.convex_hull_share = metrics.area.area / convex_area;
  metrics.stability = stability(result, draws);
  if (!window.empty()) metrics.window_iou = intersection_over_union(result, window);
  return metrics;
}

CaseScorer::CaseScorer(std::span<const Point> points, const MultiPolygon& ground_truth)
    : state_(std::make_unique<const State>(points, ground_truth)) {}

CaseScorer::~CaseScorer() = default;

Metrics CaseScorer::score(const MultiPolygon& result) const {
  const GeosSession geos;
  const CheckedShape shape = check_shape(geos, result);

  Metrics metrics;
  metrics.area = state_->prepared.score(geos, result, shape);
  metrics.counts = count_shape(result, state_->truth, state_->h);
  metrics.contract = state_->input.score(result);
  metrics.l2_convex_hull = state_->anchors.l2_convex_hull;
  metrics.l2_best_triangles = state_->anchors.l2_best_triangles;
  metrics.skill = skill(metrics.area.l2, state_->anchors, state_->point_count);
  metrics.spacing = state_->h;
  metrics.polygon_count = result.size();
  metrics.hole_count = count_holes(result);
  metrics.vertex_count = polylidar::vertex_count(result);
  if (!metrics.area.valid) return metrics;

  metrics.boundary = boundary_scores(PreparedBoundary(result), state_->boundary, state_->h);
  const GeosSession::Geometry band = inner_band(geos, shape.geometry, kBandWidthInH * state_->h);
  metrics.boundary_iou = band_iou(geos, band, geos.clone(state_->band));
  metrics.holes = match_holes(result, state_->truth);
  return metrics;
}

AreaScores CaseScorer::area_scores(const MultiPolygon& result) const {
  const GeosSession geos;
  return state_->prepared.score(geos, result, check_shape(geos, result));
}

}  // namespace hullbench::metrics
