// The goals that the core's speed and memory have (goals.json), and what a run says of them.
#pragma once

#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/statistics/bootstrap.hpp"

namespace hullbench::micro {

/// What was measured of one benchmark.
struct Measured {
  std::vector<double> times;         ///< by repetition: real time of one call, in nanoseconds
  std::optional<double> peak_bytes;  ///< a point, beyond the caller's points
};

/// By the benchmark's name, "function/point set/number of points".
using Measurements = std::map<std::string, Measured>;

/// kMet, kMissed: the interval is on that side of the limit. kUndecided: it holds the limit.
enum class Verdict { kMet, kMissed, kUndecided, kNotMeasured, kInformation };

/// What came of one goal.
struct VerdictLine {
  std::string what;             ///< which numbers it compares
  std::optional<double> value;  ///< the median of the repetitions' values; empty when not measured
  /// Of the median over the repetitions, by the sign test, with a confidence of 98 %; of fewer than 7
  /// repetitions their range. Empty for memory, which has one value.
  std::optional<statistics::Interval> interval;
  std::string goal;  ///< such as "<= 0.40"; empty for information
  Verdict verdict = Verdict::kNotMeasured;
  std::string remark;  ///< on what is hoped for beyond the goal; may be empty
};

/// The benchmarks without which some goal is not measured.
std::set<std::string> benchmarks_of_goals();

/// The benchmarks of the goals that these measurements leave undecided.
std::set<std::string> benchmarks_of_undecided_goals(const Measurements& measurements);

/// One line a goal, always all of them and in the same order; a value that is the limit itself meets it.
std::vector<VerdictLine> core_verdicts(const Measurements& measurements);

/// kExitRegression when a goal is missed; otherwise kExitNothing when one was not measured; otherwise
/// kExitInconclusive when one is undecided.
ExitCode exit_code(const std::vector<VerdictLine>& lines);

void print_verdicts(const std::vector<VerdictLine>& lines, std::ostream& out);

/// One line a benchmark: median time, its spread and the memory.
void print_measurements(const Measurements& measurements, std::ostream& out);

/// How many points a benchmark has; its name's last part.
double points_of(const std::string& benchmark);

}  // namespace hullbench::micro
