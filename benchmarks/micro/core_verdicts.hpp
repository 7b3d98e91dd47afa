// The goals that the core's speed and memory have (goals.json), and what a run says of them.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace hullbench::micro {

/// What was measured of one benchmark.
struct Measured {
  std::vector<double> times;         ///< by repetition: real time of one call, in nanoseconds
  std::optional<double> peak_bytes;  ///< a point, beyond the caller's points
};

/// By the benchmark's name, "function/point set/number of points".
using Measurements = std::map<std::string, Measured>;

/// kMet, kMissed: every repetition is on that side of the limit. kUndecided: not every one is. With 7
/// repetitions, the smallest and the largest enclose the true median with a confidence of 98 % (sign test).
enum class Verdict { kMet, kMissed, kUndecided, kNotMeasured, kInformation };

/// What came of one goal.
struct VerdictLine {
  std::string what;             ///< which numbers it compares
  std::optional<double> value;  ///< of the medians; empty when not measured
  /// The smallest and the largest value of single repetitions; empty for memory, which has one value.
  std::optional<double> smallest, largest;
  std::string goal;  ///< such as "<= 0.40"; empty for information
  Verdict verdict = Verdict::kNotMeasured;
  std::string remark;  ///< on what is hoped for beyond the goal; may be empty
};

/// The benchmarks without which some goal is not measured.
std::set<std::string> benchmarks_of_goals();

/// One line a goal, always all of them and in the same order; a value that is the limit itself meets it.
std::vector<VerdictLine> core_verdicts(const Measurements& measurements);

/// The project's exit codes: 3 when a goal is missed; otherwise 6 when one was not measured; otherwise 5 when
/// one is undecided; otherwise 0.
int exit_code(const std::vector<VerdictLine>& lines);

void print_verdicts(const std::vector<VerdictLine>& lines, std::ostream& out);

/// One line a benchmark: median time, its spread and the memory.
void print_measurements(const Measurements& measurements, std::ostream& out);

/// How many points a benchmark has; its name's last part.
double points_of(const std::string& benchmark);

}  // namespace hullbench::micro
