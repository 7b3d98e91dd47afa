// A method beside another one over many cases: times round by round, errors case by case, and failures as
// infinitely bad.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/report/measurements.hpp"
#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::report {

/// The ratio of a failure to a result.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A line's values over a reference's. A case's ratio of times is the median over the rounds that both were
/// measured in: a slow phase of the machine is then in both. A case on which the line failed and the
/// reference did not has the ratio infinity, one the other way round 0, and one on which both failed none.
struct Ratios {
  std::size_t cases = 0;         ///< that have a ratio
  std::size_t failures = 0;      ///< of these the line's; a method that is not installed has none
  std::optional<double> median;  ///< of the cases; may be infinite
  std::optional<statistics::Interval>
      interval;      ///< of the median, nested (bootstrap.hpp); its ends may be infinite
  double least = 0;  ///< 0 without a case
  double most = 0;   ///< may be infinite
};

/// Ratios of the times of equal work. None without times.
Ratios time_ratios(const Measurements& measurements, const Line& line, const Line& reference,
                   const std::vector<Case>& cases);

/// Ratios of a metric that is better the lower it is; of several runs of a case the median counts. Cases on
/// which the reference has 0 have none.
Ratios metric_ratios(const Measurements& measurements, const Line& line, const Line& reference,
                     const std::vector<Case>& cases, const std::string& metric);

/// Of `references` the run on the same points as `run`; null when there is none.
const record::RunRecord* counterpart(const record::RunRecord& run, const Runs& references);

/// Which run stands beside another one, such as `counterpart`.
using Partner = const record::RunRecord* (*)(const record::RunRecord& run, const Runs& references);

/// The ratios of the times of `runs` to those of their partners by pass, one a round that both have.
/// `times_of` gives the nanoseconds of every repetition of a run; where it gives another number of them, the
/// run has no ratios.
statistics::Passes round_ratios(
    const Runs& runs, const Runs& references, Partner partner,
    const std::function<std::vector<std::int64_t>(const record::RunRecord&)>& times_of);

/// The ratio of the medians of a metric; none where it is not above 0.
statistics::Passes metric_ratio(const Runs& runs, const Runs& references, const std::string& name);

/// The ratios of a case.
struct CaseRatios {
  CaseRatios(Case of_case, statistics::Passes by_pass);

  Case which;
  statistics::Passes passes;  ///< at least one value
  double middle;              ///< the median of all
};

/// Of the median of the cases' medians, nested (bootstrap.hpp); its clusters are the base shapes
/// (datasets.hpp), each with and without holes and sampled in any way.
std::optional<statistics::Interval> interval_over(std::span<const CaseRatios> cases);

}  // namespace hullbench::report
