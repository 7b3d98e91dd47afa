#include "benchmarks/metrics/boundary_band.hpp"

#include <algorithm>

namespace hullbench::metrics {
namespace {

constexpr int kChordsPerQuarter = 8;

}  // namespace

GeosSession::Geometry inner_band(const GeosSession& geos, const GeosSession::Geometry& shape, double width) {
  GeosSession::Geometry rest =
      geos.own(GEOSBuffer_r(geos.context(), shape.get(), -width, kChordsPerQuarter), "buffer");
  // GEOS's buffer of a valid shape can touch itself where it must not, of points on a lattice for instance.
  // That is no fault of the shape.
  if (GEOSisValid_r(geos.context(), rest.get()) != 1)
    rest = geos.own(GEOSMakeValid_r(geos.context(), rest.get()), "making a buffer valid");
  return geos.own(GEOSDifference_r(geos.context(), shape.get(), rest.get()), "difference");
}

std::optional<double> band_iou(const GeosSession& geos, const GeosSession::Geometry& a,
                               const GeosSession::Geometry& b) {
  const double common = geos.common_area(a, b);
  const double either = geos.area(a) + geos.area(b) - common;
  if (!(either > 0)) return std::nullopt;
  // Rounding must not make the areas of the parts larger than that of the whole.
  return std::min(1.0, common / either);
}

}  // namespace hullbench::metrics
