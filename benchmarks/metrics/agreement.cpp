#include "benchmarks/metrics/agreement.hpp"

#include "benchmarks/metrics/boundary_band.hpp"
#include "benchmarks/metrics/checked_shape.hpp"
#include "benchmarks/metrics/geos_session.hpp"
#include "benchmarks/metrics/validity.hpp"

namespace hullbench::metrics {
namespace {

double agreement(const std::optional<MultiPolygon>& a, const std::optional<MultiPolygon>& b) {
  return a && b ? intersection_over_union(*a, *b).value_or(0) : 0;
}

}  // namespace

std::optional<double> intersection_over_union(const MultiPolygon& a, const MultiPolygon& b) {
  const GeosSession geos;
  const CheckedShape first = check_shape(geos, a);
  const CheckedShape second = check_shape(geos, b);
  if (!first.invalid_reason.empty() || !second.invalid_reason.empty()) return std::nullopt;
  return band_iou(geos, first.geometry, second.geometry);
}

std::optional<Stability> stability(const MultiPolygon& whole, std::span<const PartResults> draws) {
  if (draws.empty() || !invalid_reason(whole).empty()) return std::nullopt;
  Stability sum;
  for (const PartResults& draw : draws) {
    sum.halves += agreement(draw.half, draw.other_half);
    sum.subsamples += agreement(draw.most, whole);
  }
  const auto count = static_cast<double>(draws.size());
  return Stability{sum.halves / count, sum.subsamples / count};
}

}  // namespace hullbench::metrics
