// A result as GEOS has it, with the answer to whether it is valid.
#pragma once

#include <string>

#include "benchmarks/metrics/geos_session.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench::metrics {

struct CheckedShape {
  GeosSession::Geometry geometry;  ///< null when it could not be made
  std::string invalid_reason;      ///< empty when valid; see invalid_reason() in validity.hpp
};

/// Throws std::runtime_error when GEOS fails.
CheckedShape check_shape(const GeosSession& geos, const polylidar::MultiPolygon& shape);

}  // namespace hullbench::metrics
