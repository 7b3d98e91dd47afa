// The rules of the gate on log-ratios made up for them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "benchmarks/gate/gate_verdict.hpp"

namespace hullbench {
namespace {

constexpr GateRules kRules;
constexpr int kBlocks = 32;

/// Blocks whose ratios lie evenly from `lowest` to `highest`.
LogRatios spread(const std::string& name, double lowest, double highest) {
  LogRatios ratios{name, {}};
  for (int i = 0; i < kBlocks; ++i) {
    ratios.values.push_back(std::log(lowest + (highest - lowest) * i / (kBlocks - 1)));
  }
  return ratios;
}

SpeedChange change_of(const LogRatios& ratios) {
  return judge({ratios}, kRules).front().change;
}

/// Findings of one quantity that has these changes in the two rounds, with controls and results in order.
GateFindings findings(SpeedChange first, SpeedChange second = SpeedChange::kNone) {
  GateFindings made;
  made.first.push_back({.name = "hull", .change = first});
  made.second.push_back({.name = "hull", .change = second});
  made.null_control.push_back({.name = "hull"});
  made.accuracy.push_back({.name = "ca", .same = true});
  return made;
}

TEST(GateVerdict, JudgesByTheWholeInterval) {
  EXPECT_EQ(change_of(spread("", 0.99, 1.01)), SpeedChange::kNone);
  EXPECT_EQ(change_of(spread("", 1.08, 1.12)), SpeedChange::kSlower);
  EXPECT_EQ(change_of(spread("", 0.88, 0.92)), SpeedChange::kFaster);
  EXPECT_EQ(change_of(spread("", 1.03, 1.04)), SpeedChange::kNone);  // slower, but by less than the threshold
  // Slower for certain; by more than the threshold or not cannot be told.
  EXPECT_EQ(change_of(spread("", 1.02, 1.10)), SpeedChange::kUndecided);
  EXPECT_EQ(change_of(spread("", 0.80, 1.25)), SpeedChange::kUndecided);
}

TEST(GateVerdict, TheRatioIsTheMedianOfTheBlocks) {
  const Judged row = judge({spread("hull", 1.0, 1.2)}, kRules).front();
  EXPECT_EQ(row.name, "hull");
  EXPECT_NEAR(row.ratio, 1.1, 1e-4);  // the middle of logarithms is not quite that of ratios
  EXPECT_LT(row.interval.low, row.ratio);
  EXPECT_GT(row.interval.high, row.ratio);
}

TEST(GateVerdict, FewBlocksDecideNothing) {
  EXPECT_EQ(change_of({"hull", {0.2, 0.2, 0.2, 0.2, 0.2}}), SpeedChange::kUndecided);
}

TEST(GateVerdict, ManyQuantitiesAskForMoreEvidence) {
  // 7 of 7 above: p = 1/128, enough for one quantity at 0.025 but not for four.
  const LogRatios slower{"hull", std::vector<double>(7, 0.1)};
  const LogRatios same{"other", {-0.01, 0.01, -0.01, 0.01, -0.01, 0.01, 0.01}};
  EXPECT_EQ(judge({slower}, kRules).front().change, SpeedChange::kSlower);
  EXPECT_NE(judge({slower, same, same, same}, kRules).front().change, SpeedChange::kSlower);
}

TEST(GateVerdict, NothingFoundPasses) {
  const GateVerdict verdict = decide(findings(SpeedChange::kNone), kRules);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_EQ(verdict.sentence, "no regression");
}

TEST(GateVerdict, ARegressionThatBothRoundsSeeFails) {
  const GateVerdict verdict = decide(findings(SpeedChange::kSlower, SpeedChange::kSlower), kRules);
  EXPECT_EQ(verdict.exit_code, 3);
  EXPECT_EQ(verdict.sentence, "regression: hull");
}

TEST(GateVerdict, ACandidateThatIsNotConfirmedPasses) {
  for (const SpeedChange second : {SpeedChange::kNone, SpeedChange::kFaster}) {
    const GateVerdict verdict = decide(findings(SpeedChange::kSlower, second), kRules);
    EXPECT_EQ(verdict.exit_code, 0);
    EXPECT_EQ(verdict.unconfirmed, std::vector<std::string>{"hull"});
  }
}

TEST(GateVerdict, ACandidateThatTheSecondRoundCannotDecideIsInconclusive) {
  GateFindings found = findings(SpeedChange::kSlower, SpeedChange::kUndecided);
  for (int round = 0; round < 2; ++round) {
    const GateVerdict verdict = decide(found, kRules);
    EXPECT_EQ(verdict.exit_code, 5);
    EXPECT_EQ(verdict.undecided, std::vector<std::string>{"hull"});
    EXPECT_TRUE(verdict.unconfirmed.empty());
    found.second.clear();  // nor one that it did not measure
  }
}

TEST(GateVerdict, AnImprovementThatIsNotConfirmedPasses) {
  for (const SpeedChange second : {SpeedChange::kNone, SpeedChange::kSlower, SpeedChange::kUndecided}) {
    const GateVerdict verdict = decide(findings(SpeedChange::kFaster, second), kRules);
    EXPECT_EQ(verdict.exit_code, 0);
    EXPECT_EQ(verdict.unconfirmed, std::vector<std::string>{"hull"});
  }
}

TEST(GateVerdict, RunningOutOfTimeIsInconclusiveUnlessAResultChanged) {
  GateFindings found = findings(SpeedChange::kNone);
  found.out_of_time = true;
  EXPECT_EQ(decide(found, kRules).exit_code, 5);
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 1e-6};
  EXPECT_EQ(decide(found, kRules).exit_code, 3);
}

TEST(GateVerdict, AnImprovementIsListed) {
  const GateVerdict verdict = decide(findings(SpeedChange::kFaster, SpeedChange::kFaster), kRules);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_EQ(verdict.improvements, std::vector<std::string>{"hull"});
}

TEST(GateVerdict, AFailedControlMakesARegressionInconclusive) {
  for (const SpeedChange control : {SpeedChange::kSlower, SpeedChange::kFaster}) {
    GateFindings found = findings(SpeedChange::kSlower, SpeedChange::kSlower);
    found.null_control.front().change = control;
    EXPECT_EQ(decide(found, kRules).exit_code, 5);
  }
}

TEST(GateVerdict, NoiseIsInconclusiveUnlessThereIsARegression) {
  EXPECT_EQ(decide(findings(SpeedChange::kUndecided), kRules).exit_code, 5);
  GateFindings found = findings(SpeedChange::kSlower, SpeedChange::kSlower);
  found.first.push_back({.name = "other", .change = SpeedChange::kUndecided});
  EXPECT_EQ(decide(found, kRules).exit_code, 3);
}

TEST(GateVerdict, AChangedResultFailsEvenWhereTheClockIsNotTrusted) {
  GateFindings found = findings(SpeedChange::kUndecided);
  found.null_control.front().change = SpeedChange::kSlower;
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 1e-6};
  const GateVerdict verdict = decide(found, kRules);
  EXPECT_EQ(verdict.exit_code, 3);
  EXPECT_EQ(verdict.sentence, "result changed: ca");
}

TEST(GateVerdict, AccuracyHasAToleranceAndNoneForWhatCannotBeCompared) {
  GateFindings found = findings(SpeedChange::kNone);
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 1e-9};
  EXPECT_EQ(decide(found, kRules).exit_code, 0);
  found.accuracy.front().difference = 1.1e-9;
  EXPECT_EQ(decide(found, kRules).exit_code, 3);
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 0, .reason = "invalid"};
  EXPECT_EQ(decide(found, kRules).exit_code, 3);
}

TEST(GateVerdict, InstructionsNeedNoStatistics) {
  GateRules rules;
  rules.threshold = 0.02;
  const auto code_of = [&](double base_again, double head) {
    return decide(judge_instructions({{"hull", 1000, base_again, head}}, rules), rules).exit_code;
  };
  EXPECT_EQ(code_of(1000, 1019), 0);
  EXPECT_EQ(code_of(1000, 1021), 3);
  EXPECT_EQ(code_of(1002, 1021), 5);  // base differs from itself by more than 0.1 %
  const GateVerdict faster = decide(judge_instructions({{"hull", 1000, 1000, 950}}, rules), rules);
  EXPECT_EQ(faster.exit_code, 0);
  EXPECT_EQ(faster.improvements, std::vector<std::string>{"hull"});
}

}  // namespace
}  // namespace hullbench
