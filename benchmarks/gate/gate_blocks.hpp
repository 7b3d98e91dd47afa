// Base, head and a second copy of base in turns.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/gate/gate_probes.hpp"
#include "benchmarks/gate/gate_verdict.hpp"

namespace hullbench::gate {

/// The log-ratios of all blocks, by quantity.
struct Blocks {
  std::map<std::string, std::vector<double>> change;        ///< ln(head / base)
  std::map<std::string, std::vector<double>> null_control;  ///< ln(copy of base / base)

  std::size_t count() const { return change.empty() ? 0 : change.begin()->second.size(); }
};

/// Where the copies of the two programs are that run.
struct Programs {
  std::filesystem::path base;
  std::filesystem::path head;
  std::filesystem::path base_again;
};

/// Copies the two programs, base twice, to places in `folder` whose paths are equally long (the length of a
/// path moves a process's stack). Throws std::filesystem::filesystem_error.
Programs place_programs(const std::filesystem::path& base, const std::filesystem::path& head,
                        const std::filesystem::path& folder);

/// Appends `count` blocks to `blocks`, or fewer: none begins after `deadline`. A block runs each of the three
/// programs once, in random order, and then once more in the opposite order, so that any two of them run as
/// ABBA or BAAB: what grows steadily with time cancels. Its log-ratio is that of the geometric means of the
/// two runs. `seed` chooses the orders; `before_process` is called before every process. Throws as
/// run_probe, and std::runtime_error when a program's results differ from one process to the next.
void measure_blocks(const Programs& programs, const ProbeSettings& settings, std::size_t count,
                    std::uint64_t seed, std::chrono::steady_clock::time_point deadline,
                    const std::function<void()>& before_process, Blocks& blocks);

/// The log-ratios as judge takes them; `sign` -1 turns them round.
std::vector<LogRatios> log_ratios(const std::map<std::string, std::vector<double>>& values, double sign = 1);

}  // namespace hullbench::gate
