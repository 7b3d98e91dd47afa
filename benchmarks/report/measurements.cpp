#include "benchmarks/report/measurements.hpp"

#include <algorithm>
#include <tuple>

namespace hullbench::report {

bool is_measured(const record::RunRecord& run) {
  const auto valid = run.metrics.find("valid");
  return run.status == record::Status::kOk && valid != run.metrics.end() && *valid == true;
}

bool is_invalid(const record::RunRecord& run) {
  if (run.status == record::Status::kInvalidOutput) return true;
  const auto valid = run.metrics.find("valid");
  return run.status == record::Status::kOk && (valid == run.metrics.end() || *valid != true);
}

bool is_missing(const Runs& runs) {
  return std::ranges::all_of(
      runs, [](const record::RunRecord* run) { return run->status == record::Status::kNotInstalled; });
}

const record::RunRecord* first_failure(const Runs& runs) {
  const auto found =
      std::ranges::find_if(runs, [](const record::RunRecord* run) { return !is_measured(*run); });
  return found == runs.end() ? nullptr : *found;
}

bool is_worse_than_convex_hull(const record::RunRecord& run) {
  return is_measured(run) && record::is_worse_than_convex_hull(run.metrics);
}

std::vector<std::int64_t> times(const record::RunRecord& run, Boundary boundary) {
  if (boundary == Boundary::kEqualWork) return run.time_ns;
  std::vector<std::int64_t> result;
  for (const record::PhaseTimes& phases : run.phases_ns) {
    if (const auto found = phases.find("run"); found != phases.end()) result.push_back(found->second);
  }
  return result;
}

std::vector<std::int64_t> step_times(const record::RunRecord& run, const std::vector<std::string>& parts) {
  std::vector<std::int64_t> result;
  for (const record::PhaseTimes& phases : run.phases_ns) {
    bool told = false;
    std::int64_t sum = 0;
    for (const auto& [phase, time] : phases) {
      const std::size_t dot = phase.find('.');
      if (dot == std::string::npos) continue;
      if (std::ranges::find(parts, phase.substr(dot + 1)) == parts.end()) continue;
      told = true;
      sum += time;
    }
    if (!told) return {};
    result.push_back(sum);
  }
  return result;
}

std::optional<double> metric(const record::RunRecord& run, const std::string& name) {
  const auto found = run.metrics.find(name);
  if (found == run.metrics.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::vector<double> all_values(const Runs& runs, const std::string& name) {
  std::vector<double> result;
  for (const record::RunRecord* run : runs) {
    if (const auto value = metric(*run, name)) result.push_back(*value);
  }
  return result;
}

std::set<std::string> machines_of(const json& report, bool with_times) {
  const std::string own = report.value(json::json_pointer("/environment/machine_id"), std::string());
  std::set<std::string> machines;
  for (const json& line : report.at("runs")) {
    if (with_times && line.at("time_ns").empty()) continue;
    const std::string machine = line.value("machine", std::string());
    machines.insert(machine.empty() ? own : machine);
  }
  machines.erase("");
  return machines;
}

std::set<std::string> builds_of(const json& report) {
  std::set<std::string> builds;
  const auto add = [&](const json& run) {
    const json::json_pointer place("/tool/binary_sha256");
    if (run.contains(place)) builds.insert(run.at(place).get<std::string>());
  };
  if (report.contains("merged")) {
    for (const json& part : report["merged"]) add(part);
  } else {
    add(report);
  }
  return builds;
}

std::string no_times_sentence(const std::set<std::string>& machines, const std::set<std::string>& builds) {
  if (machines.size() <= 1 && builds.size() <= 1) return "";
  const bool by_machine = machines.size() > 1;
  std::string names;
  for (const std::string& name : by_machine ? machines : builds)
    names += (names.empty() ? "" : ", ") + name.substr(0, 8);
  return "Times are not shown: they were taken " +
         (by_machine ? "on " + std::to_string(machines.size()) + " machines ("
                     : "with " + std::to_string(builds.size()) + " builds of the program (") +
         names + "), and times of different " + (by_machine ? "machines" : "builds") +
         " do not go into one table.";
}

Measurements::Measurements(const json& report)
    : why_no_times_(no_times_sentence(machines_of(report), builds_of(report))) {
  for (const json& line : report.at("runs")) {
    record::RunRecord& run = runs_.emplace_back(line.get<record::RunRecord>());
    if (has_times()) continue;
    run.time_ns.clear();
    run.phases_ns.clear();
  }
  const auto is_timed = [](const record::RunRecord& run) { return !run.time_ns.empty(); };
  if (has_times() && std::ranges::any_of(runs_, is_measured) && std::ranges::none_of(runs_, is_timed))
    why_no_times_ = "Times are not shown: the records were kept without them.";
  std::map<std::string, std::size_t> first_seen;  // by data set
  for (std::size_t position = 0; position < runs_.size(); ++position) {
    const record::RunRecord& run = runs_[position];
    const Case which{run.dataset, run.holes, run.n};
    index_[{Line{run.method, run.protocol}, which}].push_back(position);
    first_seen.emplace(run.dataset, position);
    cases_.push_back(which);
  }
  const auto place = [&](const Case& which) {
    return std::make_tuple(first_seen.at(which.dataset), which.holes, which.n);
  };
  std::ranges::sort(cases_, [&](const Case& a, const Case& b) { return place(a) < place(b); });
  cases_.erase(std::unique(cases_.begin(), cases_.end()), cases_.end());
}

Runs Measurements::find(const Line& line, const Case& which) const {
  Runs result;
  const auto found = index_.find({line, which});
  if (found == index_.end()) return result;
  for (const std::size_t position : found->second) result.push_back(&runs_[position]);
  return result;
}

}  // namespace hullbench::report
