// The area scores of a result that GEOS already has.
#pragma once

#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/checked_shape.hpp"
#include "benchmarks/metrics/prepared_truth.hpp"

namespace hullbench::metrics {

/// `shape` is `result` as check_shape gives it, `truth_geometry` the truth's geometry in `geos`. Throws
/// std::runtime_error when GEOS fails.
AreaScores area_scores(const GeosSession& geos, const polylidar::MultiPolygon& result,
                       const CheckedShape& shape, const PreparedTruth& truth,
                       const GeosSession::Geometry& truth_geometry);

}  // namespace hullbench::metrics
