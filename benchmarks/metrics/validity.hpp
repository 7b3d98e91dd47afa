// Whether a result is a valid multipolygon, and why not.
#pragma once

#include <string>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// Why `shape` is not a valid multipolygon in the sense of the OGC (06-103r4, 6.1.14), in GEOS's words and
/// with the place; empty when it is valid, as an empty shape is. Throws std::runtime_error when GEOS fails.
std::string invalid_reason(const MultiPolygon& shape);

}  // namespace hullbench::metrics
