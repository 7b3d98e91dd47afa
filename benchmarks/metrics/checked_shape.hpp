// A result as GEOS has it, with the answer to whether it is valid.
#pragma once

#include <string>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/geos_session.hpp"

namespace hullbench::metrics {

struct CheckedShape {
  GeosSession::Geometry geometry;  ///< null when it could not be made
  std::string invalid_reason;      ///< empty when valid; see invalid_reason() in validity.hpp
};

/// Throws std::runtime_error when GEOS fails.
CheckedShape check_shape(const GeosSession& geos, const MultiPolygon& shape);

}  // namespace hullbench::metrics
