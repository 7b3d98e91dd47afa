#include "benchmarks/metrics/area.hpp"

#include <algorithm>

#include "benchmarks/metrics/prepared_truth.hpp"
#include "benchmarks/metrics/shape_measures.hpp"

namespace hullbench::metrics {
namespace {

std::optional<double> ratio(double numerator, double denominator) {
  if (!(denominator > 0)) return std::nullopt;
  return numerator / denominator;
}

}  // namespace

AreaScores PreparedTruth::score(const GeosSession& geos, const MultiPolygon& result,
                                const CheckedShape& shape) const {
  AreaScores scores;
  scores.valid = shape.invalid_reason.empty();
  scores.invalid_reason = shape.invalid_reason;
  scores.area = area_of_result(result);
  scores.ground_truth_area = area_;
  scores.ground_truth_convexity = convexity_;
  if (!scores.valid) return scores;

  const GeosSession::Geometry difference =
      geos.own(GEOSSymDifference_r(geos.context(), geometry(geos).get(), shape.geometry.get()),
               "symmetric difference");
  const double apart = geos.area(difference);
  // What is in one of two shapes only is the sum of their areas less twice what they share, so a second
  // overlay would tell nothing new. Rounding must not make an area negative.
  const double bias = scores.area - area_;
  const double shared = std::max(0.0, (area_ + scores.area - apart) / 2);
  scores.symmetric_difference_area = apart;
  scores.l2 = ratio(apart, area_);
  scores.l2_paper = ratio(apart, scores.area);
  scores.iou = ratio(shared, shared + apart);
  scores.omission = ratio(std::max(0.0, (apart - bias) / 2), area_);
  scores.commission = ratio(std::max(0.0, (apart + bias) / 2), area_);
  scores.area_bias = ratio(bias, area_);
  scores.perimeter_ratio = ratio(perimeter(result), perimeter_);
  return scores;
}

AreaScores area_scores(const MultiPolygon& result, const MultiPolygon& ground_truth) {
  const GeosSession geos;
  return PreparedTruth(ground_truth).score(geos, result, check_shape(geos, result));
}

}  // namespace hullbench::metrics
