// Whether head's results are base's.
#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/gate/gate_probes.hpp"
#include "benchmarks/gate/gate_verdict.hpp"

namespace hullbench::gate {

/// Compares CASE.wkb of both folders for every case: bytes first, then the area in one shape only (GEOS) over
/// the area of base's. A result that is missing, malformed, invalid, or empty on one side only is not
/// comparable and has its reason.
std::vector<AccuracyRow> compare_results(const std::vector<GateCase>& cases,
                                         const std::filesystem::path& base,
                                         const std::filesystem::path& head);

}  // namespace hullbench::gate
