#include "benchmarks/gate/time_gate.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "benchmarks/gate/gate_blocks.hpp"

namespace hullbench::gate {
namespace {

constexpr std::size_t kProcessesPerBlock = 6;

void measure(const std::string& title, const Programs& programs, const TimeGateSettings& settings,
             const ProbeSettings& probe, std::size_t count, std::uint64_t seed, Blocks& blocks) {
  std::size_t begun = 0;
  const auto before_process = [&] {
    if (settings.on_process) settings.on_process(title, ++begun, count * kProcessesPerBlock);
  };
  measure_blocks(programs, probe, count, seed, settings.deadline, before_process, blocks);
}

bool has(const std::vector<Judged>& rows, SpeedChange change) {
  return std::ranges::any_of(rows, [&](const Judged& row) { return row.change == change; });
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
    return std::ranges::none_of(quantities,
                                [&](const std::string& name) { return name.ends_with(" " + entry.name); });
  });
  return probe;
}

void keep_only(const std::set<std::string>& quantities, Blocks& blocks) {
  const auto is_other = [&](const auto& entry) { return quantities.count(entry.first) == 0; };
  std::erase_if(blocks.change, is_other);
  std::erase_if(blocks.null_control, is_other);
}

json json_of(const Blocks& blocks) {
  return {{"change", blocks.change}, {"null_control", blocks.null_control}};
}

}  // namespace

GateFindings gate_times(const TimeGateSettings& settings, const GateRules& rules, json& samples) {
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
  for (Judged& row : judge(log_ratios(second.null_control), rules))
    findings.null_control.push_back(std::move(row));
  return findings;
}

}  // namespace hullbench::gate
