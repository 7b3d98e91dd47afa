// The gate on time: blocks, a verdict, and a second look with the roles reversed.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "benchmarks/base/names.hpp"
#include "benchmarks/gate/gate_probes.hpp"
#include "benchmarks/gate/gate_verdict.hpp"

namespace hullbench::gate {

/// The fewest that can call one of the time tier's 13 quantities slower after Holm's correction: 13 / 2^10 is
/// below 0.025, 13 / 2^9 is not.
constexpr std::size_t kFewestBlocks = 10;

struct TimeGateSettings {
  fs::path base_probe;
  fs::path head_probe;
  fs::path folder;  ///< for copies of the programs
  ProbeSettings probe;
  std::size_t blocks = 0;  ///< in a round, >= kFewestBlocks; of each, two runs of base, head and base's copy
  std::chrono::steady_clock::time_point deadline;  ///< no block begins after it
  std::uint64_t seed = 1;                          ///< of the orders in the blocks
  /// Called before every process with what is being done, the number of the process and how many there are.
  std::function<void(const std::string& title, std::size_t begun, std::size_t total)> on_process = {};
};

/// Measures, and fills in the findings but for accuracy. When the first round is too noisy to decide and
/// calls nothing slower, it goes on to twice as many blocks; the second round has as many as the first ended
/// with. The findings are out of time when the deadline left the first round fewer than kFewestBlocks, or the
/// second one fewer than it needs; that one is then not judged. `samples` gets the log-ratios. Throws as
/// measure_blocks.
GateFindings gate_times(const TimeGateSettings& settings, const GateRules& rules, json& samples);

}  // namespace hullbench::gate
