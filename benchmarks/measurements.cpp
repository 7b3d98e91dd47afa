#include "benchmarks/measurements.hpp"

#include <algorithm>
#include <tuple>

namespace hullbench {

bool is_measured(const RunRecord& run) {
  const auto valid = run.metrics.find("valid");
  return run.status == Status::kOk && !run.time_ns.empty() && valid != run.metrics.end() && *valid == true;
}

bool is_invalid(const RunRecord& run) {
  if (run.status == Status::kInvalidOutput) return true;
  const auto valid = run.metrics.find("valid");
  return run.status == Status::kOk && (valid == run.metrics.end() || *valid != true);
}

std::vector<std::int64_t> times(const RunRecord& run, Boundary boundary) {
  if (boundary == Boundary::kEqualWork) return run.time_ns;
  std::vector<std::int64_t> result;
  for (const PhaseTimes& phases : run.phases_ns) {
    if (const auto found = phases.find("run"); found != phases.end()) result.push_back(found->second);
  }
  return result;
}

std::vector<std::int64_t> step_times(const RunRecord& run, const std::vector<std::string>& parts) {
  std::vector<std::int64_t> result;
  for (const PhaseTimes& phases : run.phases_ns) {
    bool told = false;
    std::int64_t sum = 0;
    for (const auto& [phase, time] : phases) {
      const std::size_t dot = phase.find('.');
      if (dot == std::string::npos) continue;
      if (std::find(parts.begin(), parts.end(), phase.substr(dot + 1)) == parts.end()) continue;
      told = true;
      sum += time;
    }
    if (!told) return {};
    result.push_back(sum);
  }
  return result;
}

std::optional<double> metric(const RunRecord& run, const std::string& name) {
  const auto found = run.metrics.find(name);
  if (found == run.metrics.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

Measurements::Measurements(const nlohmann::json& report) {
  for (const nlohmann::json& line : report.at("runs")) runs_.push_back(line.get<RunRecord>());
  std::map<std::string, std::size_t> first_seen;  // by data set
  for (std::size_t position = 0; position < runs_.size(); ++position) {
    const RunRecord& run = runs_[position];
    const Case which{run.dataset, run.holes, run.n};
    index_[{run.method, run.protocol, which}].push_back(position);
    first_seen.emplace(run.dataset, position);
    cases_.push_back(which);
  }
  const auto place = [&](const Case& which) {
    return std::make_tuple(first_seen.at(which.dataset), which.holes, which.n);
  };
  std::sort(cases_.begin(), cases_.end(), [&](const Case& a, const Case& b) { return place(a) < place(b); });
  cases_.erase(std::unique(cases_.begin(), cases_.end()), cases_.end());
}

std::vector<const RunRecord*> Measurements::find(const std::string& method, const std::string& protocol,
                                                 const Case& which) const {
  std::vector<const RunRecord*> result;
  const auto found = index_.find({method, protocol, which});
  if (found == index_.end()) return result;
  for (const std::size_t position : found->second) result.push_back(&runs_[position]);
  return result;
}

}  // namespace hullbench
