#include "benchmarks/report/contests.hpp"

#include <algorithm>
#include <span>
#include <tuple>

#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/statistics/judge.hpp"
#include "benchmarks/statistics/rank_test.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

using record::RunRecord;
using Runs = std::vector<const RunRecord*>;

double median_time(const RunRecord& run) {
  return statistics::median(std::span<const std::int64_t>(run.time_ns));
}

std::string order_of(const RunRecord& run, const RunRecord& beside) {
  const auto ratio = statistics::ratio_of_times(beside.time_ns, run.time_ns);
  if (!ratio || !ratio->interval) return "undecided";
  switch (statistics::side_of(*ratio->interval, 1)) {
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

void judge_case(const Runs& runs, const std::string& protocol, std::map<std::string, Contest>& contests) {
  const std::string method = reference_line().method;
  const auto reference = std::find_if(runs.begin(), runs.end(), [&](const RunRecord* run) {
    return run->method == method && run->protocol == protocol;
  });
  for (const RunRecord* run : runs) {
    Contest& contest = contests[run->id];
    if (reference != runs.end() && run != *reference) contest.order = order_of(*run, **reference);
  }
  if (runs.size() < 2) return;
  const auto fastest = *std::min_element(
      runs.begin(), runs.end(),
      [](const RunRecord* a, const RunRecord* b) { return median_time(*a) < median_time(*b); });
  contests[fastest->id].is_fastest = std::all_of(runs.begin(), runs.end(), [&](const RunRecord* run) {
    return run == fastest || order_of(*fastest, *run) == "faster";
  });
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
