#include "benchmarks/metrics/prepared_truth.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "benchmarks/metrics/shape_measures.hpp"

namespace hullbench::metrics {

PreparedTruth::PreparedTruth(const MultiPolygon& shape) {
  if (shape.empty()) throw std::runtime_error("the ground truth is empty; there is nothing to score against");
  CheckedShape checked = check_shape(geos_, shape);
  if (!checked.invalid_reason.empty()) {
    throw std::runtime_error("the ground truth is not a valid multipolygon: " + checked.invalid_reason);
  }
  geometry_ = std::move(checked.geometry);
  area_ = geos_.area(geometry_);
  const GeosSession::Geometry hull =
      geos_.own(GEOSConvexHull_r(geos_.context(), geometry_.get()), "making a convex hull");
  // A convex shape's two areas are summed in different orders.
  convexity_ = std::min(1.0, area_ / geos_.area(hull));
  perimeter_ = perimeter(shape);
}

}  // namespace hullbench::metrics
