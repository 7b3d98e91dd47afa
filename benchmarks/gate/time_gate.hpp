// The gate on time: blocks, a verdict, and a second look with the roles reversed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "benchmarks/gate/gate_probes.hpp"
#include "benchmarks/gate/gate_verdict.hpp"

namespace hullbench {

struct TimeGateSettings {
  std::filesystem::path base_probe;
  std::filesystem::path head_probe;
  std::filesystem::path folder;  ///< for copies of the programs
  ProbeSettings probe;
  std::size_t blocks = 0;  ///< >= 1 in a round; of each, two runs of base, two of head and two of base's copy
  std::uint64_t seed = 1;  ///< of the orders in the blocks
};

/// Measures, and fills in the findings but for accuracy. When the first round is too noisy to decide, it
/// goes on to twice as many blocks, unless the round took so long that a gate of three rounds would not end
/// within two minutes. `samples` gets the log-ratios. What it is at goes to standard error. Throws as
/// measure_blocks.
GateFindings gate_times(const TimeGateSettings& settings, const GateRules& rules, nlohmann::json& samples);

}  // namespace hullbench
