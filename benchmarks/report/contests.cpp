#include "benchmarks/report/contests.hpp"

#include <algorithm>
#include <tuple>

#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/statistics/judge.hpp"

namespace hullbench::report {
namespace {

using record::RunRecord;

std::string order_of(const RunRecord& run, const RunRecord& beside) {
  switch (statistics::side_of_times(run.time_ns, beside.time_ns)) {
    case statistics::Side::kBelow:
      return "faster";
    case statistics::Side::kAbove:
      return "slower";
    case statistics::Side::kUndecided:
      break;
  }
  return "undecided";
}

/// The protocol under which the reference method is the reference; empty when it was not run.
std::string reference_protocol(const std::vector<RunRecord>& runs) {
  const Line line = reference_line();
  std::string first;
  for (const RunRecord& run : runs) {
    if (run.method != line.method) continue;
    if (run.protocol == line.protocol) return line.protocol;
    if (first.empty()) first = run.protocol;
  }
  return first;
}

bool beats_other_methods(const RunRecord& run, const Runs& runs) {
  bool has_rival = false;
  for (const RunRecord* other : runs) {
    if (teller_of(other->method) == teller_of(run.method)) continue;
    if (statistics::side_of_times(run.time_ns, other->time_ns) != statistics::Side::kBelow) return false;
    has_rival = true;
  }
  return has_rival;
}

void judge_case(const Runs& runs, const std::string& protocol, std::map<std::string, Contest>& contests) {
  const std::string method = reference_line().method;
  const auto reference = std::ranges::find_if(
      runs, [&](const RunRecord* run) { return run->method == method && run->protocol == protocol; });
  for (const RunRecord* run : runs) {
    Contest& contest = contests[run->id];
    if (reference != runs.end() && run != *reference) contest.order = order_of(*run, **reference);
  }
  for (const RunRecord* run : runs) contests[run->id].is_fastest = beats_other_methods(*run, runs);
}

}  // namespace

std::map<std::string, Contest> judge_contests(const std::vector<RunRecord>& runs) {
  std::map<std::tuple<std::string, bool, std::string, std::uint64_t>, Runs> by_points;
  for (const RunRecord& run : runs) {
    if (is_measured(run) && !run.time_ns.empty())
      by_points[{run.dataset, run.holes, run.dataset_sha256, run.seed}].push_back(&run);
  }
  const std::string protocol = reference_protocol(runs);
  std::map<std::string, Contest> contests;
  for (const auto& [points, there] : by_points) judge_case(there, protocol, contests);
  return contests;
}

}  // namespace hullbench::report
