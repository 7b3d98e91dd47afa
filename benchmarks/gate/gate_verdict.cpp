#include "benchmarks/gate/gate_verdict.hpp"

#include <algorithm>
#include <cmath>

#include "benchmarks/base/words.hpp"
#include "benchmarks/statistics/judge.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::gate {
namespace {

using Names = std::vector<std::string>;

std::vector<double> negated(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

/// The interval of the median ratio and what the sign test says against `limit`: that the ratio is above it,
/// or with `above` false below it.
statistics::Evidence evidence_of(const LogRatios& quantity, const GateRules& rules, double limit,
                                 bool above) {
  const statistics::Interval interval = statistics::sign_interval(quantity.values, rules.confidence);
  const double p = above ? statistics::sign_test_above(quantity.values, std::log(limit))
                         : statistics::sign_test_above(negated(quantity.values), -std::log(limit));
  return {{std::exp(interval.low), std::exp(interval.high)}, p};
}

bool is_change(SpeedChange change) {
  return change == SpeedChange::kSlower || change == SpeedChange::kFaster;
}

/// What a round says of a quantity; undecided where it was not measured.
SpeedChange change_in(const std::vector<Judged>& round, const std::string& name) {
  const auto found = std::ranges::find_if(round, [&](const Judged& row) { return row.name == name; });
  return found == round.end() ? SpeedChange::kUndecided : found->change;
}

/// Sorts the first round's changes by whether the second one confirms them.
void confirm(const GateFindings& findings, GateVerdict& verdict) {
  for (const Judged& row : findings.first) {
    if (row.change == SpeedChange::kUndecided) verdict.undecided.push_back(row.name);
    if (!is_change(row.change)) continue;
    const bool slower = row.change == SpeedChange::kSlower;
    const SpeedChange second = change_in(findings.second, row.name);
    if (second == row.change) {
      (slower ? verdict.regressions : verdict.improvements).push_back(row.name);
    } else if (slower && second == SpeedChange::kUndecided) {
      verdict.undecided.push_back(row.name);
    } else {
      verdict.unconfirmed.push_back(row.name);
    }
  }
}

SpeedChange change_of(double ratio, double threshold) {
  const statistics::Interval exact = {ratio, ratio};
  if (statistics::side_of(exact, 1 + threshold) == statistics::Side::kAbove) return SpeedChange::kSlower;
  const bool faster = statistics::side_of(exact, 1 - threshold) == statistics::Side::kBelow;
  return faster ? SpeedChange::kFaster : SpeedChange::kNone;
}

Judged counted(const std::string& name, double ratio, double threshold) {
  return {.name = name,
          .ratio = ratio,
          .interval = {ratio, ratio},
          .p = 0,
          .change = change_of(ratio, threshold)};
}

}  // namespace

std::vector<Judged> judge(const std::vector<LogRatios>& quantities, const GateRules& rules) {
  const double slower_limit = 1 + rules.threshold;
  const double faster_limit = 1 / slower_limit;
  std::vector<statistics::Evidence> slower;
  std::vector<statistics::Evidence> faster;
  for (const LogRatios& quantity : quantities) {
    slower.push_back(evidence_of(quantity, rules, slower_limit, true));
    faster.push_back(evidence_of(quantity, rules, faster_limit, false));
  }
  const double level = (1 - rules.confidence) / 2;
  const std::vector<statistics::Judgement> is_slower = statistics::judge(slower, slower_limit, level);
  const std::vector<statistics::Judgement> is_faster = statistics::judge(faster, faster_limit, level);

  std::vector<Judged> rows;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    Judged row;
    row.name = quantities[i].name;
    row.ratio = std::exp(statistics::median(quantities[i].values));
    row.interval = slower[i].interval;
    row.p = row.ratio >= 1 ? is_slower[i].p_value : is_faster[i].p_value;
    if (is_slower[i].side == statistics::Side::kAbove) {
      row.change = SpeedChange::kSlower;
    } else if (is_faster[i].side == statistics::Side::kBelow) {
      row.change = SpeedChange::kFaster;
    } else if (statistics::side_of(row.interval, slower_limit) != statistics::Side::kBelow) {
      row.change = SpeedChange::kUndecided;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

GateVerdict decide(const GateFindings& findings, const GateRules& rules) {
  GateVerdict verdict;
  for (const AccuracyRow& row : findings.accuracy) {
    const bool within = row.same || (row.reason.empty() && row.difference <= rules.accuracy_tolerance);
    if (!within) verdict.changed_results.push_back(row.name);
  }
  for (const Judged& row : findings.null_control) {
    if (is_change(row.change)) verdict.failed_controls.push_back(row.name);
  }
  confirm(findings, verdict);

  if (!verdict.changed_results.empty()) {
    verdict.exit_code = kExitRegression;
    verdict.sentence = "result changed: " + joined(verdict.changed_results, ", ");
    if (!verdict.regressions.empty())
      verdict.sentence += "; regression: " + joined(verdict.regressions, ", ");
  } else if (!verdict.failed_controls.empty()) {
    verdict.exit_code = kExitInconclusive;
    verdict.sentence = "inconclusive: the same program differs from itself in " +
                       joined(verdict.failed_controls, ", ") + "; run it again when the machine is quieter";
  } else if (!verdict.regressions.empty()) {
    verdict.exit_code = kExitRegression;
    verdict.sentence = "regression: " + joined(verdict.regressions, ", ");
  } else if (findings.out_of_time) {
    verdict.exit_code = kExitInconclusive;
    verdict.sentence =
        "inconclusive: the time limit came before enough was measured; run it again when the machine is "
        "quieter, or with a longer --time-limit";
  } else if (!verdict.undecided.empty()) {
    verdict.exit_code = kExitInconclusive;
    verdict.sentence = "inconclusive: too noisy to tell no change from a regression in " +
                       joined(verdict.undecided, ", ") + "; run it again when the machine is quieter";
  } else {
    verdict.sentence = "no regression";
  }
  return verdict;
}

GateFindings judge_instructions(const std::vector<InstructionCounts>& counts, const GateRules& rules) {
  GateFindings findings;
  for (const InstructionCounts& row : counts) {
    findings.first.push_back(counted(row.name, row.head / row.base, rules.threshold));
    findings.null_control.push_back(counted(row.name, row.base_again / row.base, rules.null_tolerance));
  }
  findings.second = findings.first;  // a count that repeats confirms itself
  return findings;
}

}  // namespace hullbench::gate
