// From what was measured to an exit code: pure rules, no clock and no process.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/statistics/sign_test.hpp"

namespace hullbench::gate {

/// What decides. `threshold` and `accuracy_tolerance` are shares: 0.05 is 5 %.
struct GateRules {
  double threshold = 0.05;           ///< > 0; of time or instructions, more than that is a regression
  double confidence = 0.95;          ///< in (0, 1); of an interval, and of all cases together
  double accuracy_tolerance = 1e-9;  ///< >= 0; symmetric difference over the base result's area
  double null_tolerance = 0.001;     ///< >= 0; instructions: by how much two counts of base may differ
};

/// The log-ratios of one quantity, ln(head / base), one a block.
struct LogRatios {
  std::string name;  ///< "concave_hull ca-64000"
  std::vector<double> values;
};

enum class SpeedChange {
  kNone,      ///< no change above the threshold
  kSlower,    ///< the whole interval is above the threshold
  kFaster,    ///< the whole interval is below 1 / (1 + threshold)
  kUndecided  ///< the interval reaches above the threshold, but not all of it is: too noisy
};

/// One quantity, judged.
struct Judged {
  std::string name;
  double ratio = 1;                        ///< median of head / base
  statistics::Interval interval = {1, 1};  ///< of that ratio
  double p = 1;                            ///< Holm-adjusted, of the direction in which the ratio points
  SpeedChange change = SpeedChange::kNone;
};

/// Judges quantities together. Slower: the sign test that the median is above the threshold, one-sided at
/// (1 - confidence) / 2 after Holm's correction over all of `quantities`; then the whole sign-test interval
/// is above it too. Faster: the same of base / head. Each quantity needs at least one value.
std::vector<Judged> judge(const std::vector<LogRatios>& quantities, const GateRules& rules);

/// The two results of one case, compared.
struct AccuracyRow {
  std::string name;
  bool same = false;  ///< the same bytes
  double difference =
      0;  ///< else: symmetric difference / area of base's result; infinite when not comparable
  std::string reason = {};  ///< why it is not comparable; empty otherwise
};

/// What a gate has found. The second round measures again, with the roles of base and head reversed, what the
/// first one calls slower or faster; its ratios are head / base all the same.
struct GateFindings {
  std::vector<Judged> first;
  std::vector<Judged> second;
  std::vector<Judged> null_control;  ///< base against base, and in the second round head against head
  std::vector<AccuracyRow> accuracy;
  bool out_of_time = false;  ///< a time limit cut the first round too short, or the second one at all
};

struct GateVerdict {
  ExitCode exit_code = kExitOk;  ///< or kExitRegression, of a changed result too, or kExitInconclusive
  std::string sentence;
  std::vector<std::string> regressions;
  std::vector<std::string> improvements;
  std::vector<std::string> unconfirmed;  ///< a change in the first round only
  std::vector<std::string> undecided;    ///< too noisy; slower in the first round and too noisy in the second
  std::vector<std::string> failed_controls;
  std::vector<std::string> changed_results;
};

/// A changed result is a regression whatever the clock says. A null control that is itself called slower or
/// faster makes the gate inconclusive. A regression is what both rounds call slower. A quantity that is too
/// noisy makes it inconclusive, and so does one that the first round calls slower and the second one cannot
/// decide; one that the second round says is no slower does not. A gate that ran out of time is inconclusive.
GateVerdict decide(const GateFindings& findings, const GateRules& rules);

/// The instructions of one quantity: base counted twice, head once. Counts are above 0.
struct InstructionCounts {
  std::string name;
  double base = 0;
  double base_again = 0;
  double head = 0;
};

/// Counts need no statistics: slower is head / base above 1 + threshold, faster below 1 - threshold. The null
/// control fails when the two counts of base differ by more than null_tolerance.
GateFindings judge_instructions(const std::vector<InstructionCounts>& counts, const GateRules& rules);

}  // namespace hullbench::gate
