#include "benchmarks/metrics/area.hpp"

#include <algorithm>
#include <cmath>

#include "benchmarks/metrics/area_overlay.hpp"
#include "benchmarks/metrics/shape_measures.hpp"

namespace hullbench::metrics {
namespace {

using polylidar::MultiPolygon;

std::optional<double> ratio(double numerator, double denominator) {
  if (!(denominator > 0)) return std::nullopt;
  return numerator / denominator;
}

}  // namespace

AreaScores area_scores(const GeosSession& geos, const MultiPolygon& result, const CheckedShape& shape,
                       const PreparedTruth& truth, const GeosSession::Geometry& truth_geometry) {
  AreaScores scores;
  scores.valid = shape.invalid_reason.empty();
  scores.invalid_reason = shape.invalid_reason;
  const double area = polylidar::area(result);
  scores.area = std::isfinite(area) ? area : 0;
  scores.ground_truth_area = truth.area();
  scores.ground_truth_convexity = truth.convexity();
  if (!scores.valid) return scores;

  const GeosSession::Geometry difference =
      geos.own(GEOSSymDifference_r(geos.context(), truth_geometry.get(), shape.geometry.get()),
               "symmetric difference");
  const double apart = geos.area(difference);
  // What is in one of two shapes only is the sum of their areas less twice what they share, so a second
  // overlay would tell nothing new. Rounding must not make an area negative.
  const double bias = scores.area - truth.area();
  const double shared = std::max(0.0, (truth.area() + scores.area - apart) / 2);
  scores.symmetric_difference_area = apart;
  scores.l2 = ratio(apart, truth.area());
  scores.l2_paper = ratio(apart, scores.area);
  scores.iou = ratio(shared, shared + apart);
  scores.omission = ratio(std::max(0.0, (apart - bias) / 2), truth.area());
  scores.commission = ratio(std::max(0.0, (apart + bias) / 2), truth.area());
  scores.area_bias = ratio(bias, truth.area());
  scores.perimeter_ratio = ratio(perimeter(result), truth.perimeter());
  return scores;
}

AreaScores area_scores(const MultiPolygon& result, const MultiPolygon& ground_truth) {
  const PreparedTruth truth(ground_truth);
  const GeosSession geos;
  return area_scores(geos, result, check_shape(geos, result), truth, truth.geometry(geos));
}

}  // namespace hullbench::metrics
