#include "benchmarks/report/ratios.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "benchmarks/statistics/statistics.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::report {
namespace {

/// The round of each repetition; of older records, which do not tell it, its position.
std::vector<std::int64_t> rounds_of(const record::RunRecord& run) {
  if (run.rounds.size() == run.time_ns.size()) return run.rounds;
  std::vector<std::int64_t> rounds(run.time_ns.size());
  for (std::size_t i = 0; i < rounds.size(); ++i) rounds[i] = static_cast<std::int64_t>(i);
  return rounds;
}

/// `ratio_of` gives the ratios of a case that both solved.
Ratios ratios_over(const Measurements& measurements, const Line& line, const Line& reference,
                   const std::vector<Case>& cases,
                   const std::function<statistics::Passes(const Runs&, const Runs&)>& ratio_of) {
  Ratios result;
  std::vector<CaseRatios> ratios;
  for (const Case& which : cases) {
    const Runs ours = measurements.find(line, which);
    const Runs theirs = measurements.find(reference, which);
    if (is_missing(ours) || is_missing(theirs)) continue;
    const bool failed = first_failure(ours) != nullptr;
    const bool reference_failed = first_failure(theirs) != nullptr;
    if (failed && reference_failed) continue;
    statistics::Passes passes = failed             ? statistics::Passes{{kInfinity}}
                                : reference_failed ? statistics::Passes{{0}}
                                                   : ratio_of(ours, theirs);
    if (passes.empty()) continue;
    result.failures += failed ? 1 : 0;
    ratios.emplace_back(which, std::move(passes));
  }
  result.cases = ratios.size();
  if (ratios.empty()) return result;
  std::vector<double> middles;
  middles.reserve(ratios.size());
  for (const CaseRatios& one : ratios) middles.push_back(one.middle);
  result.median = statistics::median(middles);
  std::tie(result.least, result.most) =
      std::pair(*std::ranges::min_element(middles), *std::ranges::max_element(middles));
  result.interval = interval_over(ratios);
  return result;
}

double median_of_all(const statistics::Passes& passes) {
  std::vector<double> values;
  for (const auto& pass : passes) values.insert(values.end(), pass.begin(), pass.end());
  return statistics::median(values);
}

}  // namespace

Ratios time_ratios(const Measurements& measurements, const Line& line, const Line& reference,
                   const std::vector<Case>& cases) {
  if (!measurements.has_times()) return {};
  return ratios_over(measurements, line, reference, cases, [](const Runs& ours, const Runs& theirs) {
    return round_ratios(ours, theirs, &counterpart, [](const record::RunRecord& run) { return run.time_ns; });
  });
}

Ratios metric_ratios(const Measurements& measurements, const Line& line, const Line& reference,
                     const std::vector<Case>& cases, const std::string& metric) {
  return ratios_over(measurements, line, reference, cases, [&](const Runs& ours, const Runs& theirs) {
    return metric_ratio(ours, theirs, metric);
  });
}

const record::RunRecord* counterpart(const record::RunRecord& run, const Runs& references) {
  const auto found = std::ranges::find_if(references, [&](const record::RunRecord* other) {
    return other->dataset_sha256 == run.dataset_sha256 && other->seed == run.seed;
  });
  return found == references.end() ? nullptr : *found;
}

statistics::Passes round_ratios(
    const Runs& runs, const Runs& references, Partner partner,
    const std::function<std::vector<std::int64_t>(const record::RunRecord&)>& times_of) {
  std::map<std::int64_t, std::vector<double>> by_pass;
  for (const record::RunRecord* run : runs) {
    const record::RunRecord* reference = partner(*run, references);
    if (reference == nullptr) continue;
    const std::vector<std::int64_t> times = times_of(*run);
    const std::vector<std::int64_t> reference_times = times_of(*reference);
    const std::vector<std::int64_t> rounds = rounds_of(*run);
    const std::vector<std::int64_t> reference_rounds = rounds_of(*reference);
    if (times.size() != rounds.size() || reference_times.size() != reference_rounds.size()) continue;
    std::map<std::int64_t, std::int64_t> beside;  // the reference's time by round
    for (std::size_t i = 0; i < reference_rounds.size(); ++i)
      beside[reference_rounds[i]] = reference_times[i];
    for (std::size_t i = 0; i < rounds.size(); ++i) {
      const auto other = beside.find(rounds[i]);
      if (other == beside.end() || other->second <= 0) continue;
      const std::int64_t pass = run->passes.size() == rounds.size() ? run->passes[i] : 1;
      by_pass[pass].push_back(static_cast<double>(times[i]) / static_cast<double>(other->second));
    }
  }
  statistics::Passes passes;
  for (auto& [pass, ratios] : by_pass) passes.push_back(std::move(ratios));
  return passes;
}

statistics::Passes metric_ratio(const Runs& runs, const Runs& references, const std::string& name) {
  const std::vector<double> ours = all_values(runs, name);
  const std::vector<double> theirs = all_values(references, name);
  if (ours.empty() || theirs.empty()) return {};
  const double by = statistics::median(theirs);
  if (by <= 0) return {};
  return {{statistics::median(ours) / by}};
}

CaseRatios::CaseRatios(Case of_case, statistics::Passes by_pass)
    : which(std::move(of_case)), passes(std::move(by_pass)), middle(median_of_all(passes)) {}

std::optional<statistics::Interval> interval_over(std::span<const CaseRatios> cases) {
  std::map<std::string, std::vector<statistics::Passes>> by_shape;
  for (const CaseRatios& one : cases) by_shape[base_shape(one.which.dataset)].push_back(one.passes);
  std::vector<std::vector<statistics::Passes>> clusters;
  clusters.reserve(by_shape.size());
  for (auto& [shape, values] : by_shape) clusters.push_back(std::move(values));
  return statistics::nested_median_interval(clusters);
}

}  // namespace hullbench::report
