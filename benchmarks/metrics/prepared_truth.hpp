// A ground truth, checked and measured once for all the results that are scored against it.
#pragma once

#include "benchmarks/metrics/geos_session.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench::metrics {

class PreparedTruth {
 public:
  /// Throws std::runtime_error when `shape` is empty or invalid, or when GEOS fails.
  explicit PreparedTruth(const polylidar::MultiPolygon& shape);

  double area() const { return area_; }            ///< squared unit of the points
  double convexity() const { return convexity_; }  ///< area / area of the convex hull, in (0, 1]
  double perimeter() const { return perimeter_; }  ///< of all rings, unit of the points

  /// A copy for `geos` alone; safe from several threads at once.
  GeosSession::Geometry geometry(const GeosSession& geos) const { return geos.clone(geometry_); }

 private:
  GeosSession geos_;
  GeosSession::Geometry geometry_;
  double area_ = 0;
  double convexity_ = 0;
  double perimeter_ = 0;
};

}  // namespace hullbench::metrics
