// A ground truth, checked and measured once for all the results that are scored against it.
#pragma once

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/checked_shape.hpp"
#include "benchmarks/metrics/geos_session.hpp"

namespace hullbench::metrics {

class PreparedTruth {
 public:
  /// Throws std::runtime_error when `shape` is empty or invalid, or when GEOS fails.
  explicit PreparedTruth(const MultiPolygon& shape);

  double area() const { return area_; }  ///< squared unit of the points
  /// A copy for `geos` alone; safe from several threads at once.
  GeosSession::Geometry geometry(const GeosSession& geos) const { return geos.clone(geometry_); }

  /// The area scores of `result`, which check_shape has made `shape` in `geos`; safe from several threads at
  /// once. Throws std::runtime_error when GEOS fails.
  AreaScores score(const GeosSession& geos, const MultiPolygon& result, const CheckedShape& shape) const;

 private:
  GeosSession geos_;
  GeosSession::Geometry geometry_;
  double area_ = 0;
  double convexity_ = 0;  ///< area / area of the convex hull, in (0, 1]
  double perimeter_ = 0;  ///< of all rings, unit of the points
};

}  // namespace hullbench::metrics
