#include "benchmarks/gate/time_gate.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/gate/gate_blocks.hpp"

namespace hullbench::gate {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kProcessesPerBlock = 6;

/// One line that is rewritten on a terminal; elsewhere a plain line now and then.
class RoundProgress {
 public:
  RoundProgress(std::string title, std::size_t processes) : title_(std::move(title)), total_(processes) {}
  ~RoundProgress() {
    if (terminal_) std::cerr << "\r\033[K" << std::flush;
  }
  RoundProgress(const RoundProgress&) = delete;
  RoundProgress& operator=(const RoundProgress&) = delete;

  void begin_process() {
    ++begun_;
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ && begun_ > 1 && now - shown_ < 15s) return;
    shown_ = now;
    std::cerr << (terminal_ ? "\r\033[K" : "") << title_ << " [" << begun_ << "/" << total_ << "]"
              << (terminal_ ? "" : "\n") << std::flush;
  }

 private:
  std::string title_;
  std::size_t total_;
  std::size_t begun_ = 0;
  bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  std::chrono::steady_clock::time_point shown_;
};

void measure(const std::string& title, const Programs& programs, const TimeGateSettings& settings,
             const ProbeSettings& probe, std::size_t count, std::uint64_t seed, Blocks& blocks) {
  RoundProgress progress(title, count * kProcessesPerBlock);
  measure_blocks(
      programs, probe, count, seed, settings.deadline, [&] { progress.begin_process(); }, blocks);
}

bool has(const std::vector<Judged>& rows, SpeedChange change) {
  return std::any_of(rows.begin(), rows.end(), [&](const Judged& row) { return row.change == change; });
}

void append(std::vector<Judged>& rows, const std::vector<Judged>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

/// The quantities to look at again.
std::set<std::string> candidates(const std::vector<Judged>& rows) {
  std::set<std::string> names;
  for (const Judged& row : rows) {
    if (row.change == SpeedChange::kSlower || row.change == SpeedChange::kFaster) names.insert(row.name);
  }
  return names;
}

/// The same settings with the cases of `quantities` only.
ProbeSettings only(const std::set<std::string>& quantities, ProbeSettings probe) {
  std::erase_if(probe.cases, [&](const GateCase& entry) {
    return std::none_of(quantities.begin(), quantities.end(),
                        [&](const std::string& name) { return name.ends_with(" " + entry.name); });
  });
  return probe;
}

void keep_only(const std::set<std::string>& quantities, Blocks& blocks) {
  const auto is_other = [&](const auto& entry) { return quantities.count(entry.first) == 0; };
  std::erase_if(blocks.change, is_other);
  std::erase_if(blocks.null_control, is_other);
}

nlohmann::json json_of(const Blocks& blocks) {
  return {{"change", blocks.change}, {"null_control", blocks.null_control}};
}

}  // namespace

GateFindings gate_times(const TimeGateSettings& settings, const GateRules& rules, nlohmann::json& samples) {
  GateFindings findings;
  Blocks first;
  const Programs programs = place_programs(settings.base_probe, settings.head_probe, settings.folder);
  measure("measuring", programs, settings, settings.probe, settings.blocks, settings.seed, first);
  findings.first = judge(log_ratios(first.change), rules);
  if (has(findings.first, SpeedChange::kUndecided) && !has(findings.first, SpeedChange::kSlower)) {
    measure("noisy, measuring more", programs, settings, settings.probe, settings.blocks, settings.seed + 1,
            first);
    findings.first = judge(log_ratios(first.change), rules);
  }
  findings.null_control = judge(log_ratios(first.null_control), rules);
  samples["first"] = json_of(first);
  findings.out_of_time = first.count() < kFewestBlocks;

  const std::set<std::string> again = candidates(findings.first);
  if (findings.out_of_time || again.empty()) return findings;
  Blocks second;
  const Programs reversed = place_programs(settings.head_probe, settings.base_probe, settings.folder);
  measure("confirming with the roles reversed", reversed, settings, only(again, settings.probe),
          first.count(), settings.seed + 2, second);
  keep_only(again, second);
  samples["second"] = json_of(second);
  findings.out_of_time = second.count() < first.count();
  if (findings.out_of_time) return findings;
  // Head stood in base's place: its ratios are base / head until they are turned round.
  findings.second = judge(log_ratios(second.change, -1), rules);
  append(findings.null_control, judge(log_ratios(second.null_control), rules));
  return findings;
}

}  // namespace hullbench::gate
