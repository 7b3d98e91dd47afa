// The rules of the gate on log-ratios made up for them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "benchmarks/gate/gate_verdict.hpp"

namespace hullbench {
namespace {

constexpr gate::GateRules kRules;
constexpr int kBlocks = 32;

/// Blocks whose ratios lie evenly from `lowest` to `highest`.
gate::LogRatios spread(const std::string& name, double lowest, double highest) {
  gate::LogRatios ratios{name, {}};
  for (int i = 0; i < kBlocks; ++i) {
    ratios.values.push_back(std::log(lowest + (highest - lowest) * i / (kBlocks - 1)));
  }
  return ratios;
}

gate::SpeedChange change_of(const gate::LogRatios& ratios) {
  return gate::judge({ratios}, kRules).front().change;
}

/// Findings of one quantity that has these changes in the two rounds, with controls and results in order.
gate::GateFindings findings(gate::SpeedChange first, gate::SpeedChange second = gate::SpeedChange::kNone) {
  gate::GateFindings made;
  made.first.push_back({.name = "hull", .change = first});
  made.second.push_back({.name = "hull", .change = second});
  made.null_control.push_back({.name = "hull"});
  made.accuracy.push_back({.name = "ca", .same = true});
  return made;
}

TEST(GateVerdict, JudgesByTheWholeInterval) {
  EXPECT_EQ(change_of(spread("", 0.99, 1.01)), gate::SpeedChange::kNone);
  EXPECT_EQ(change_of(spread("", 1.08, 1.12)), gate::SpeedChange::kSlower);
  EXPECT_EQ(change_of(spread("", 0.88, 0.92)), gate::SpeedChange::kFaster);
  EXPECT_EQ(change_of(spread("", 1.03, 1.04)),
            gate::SpeedChange::kNone);  // slower, but by less than the threshold
  // Slower for certain; by more than the threshold or not cannot be told.
  EXPECT_EQ(change_of(spread("", 1.02, 1.10)), gate::SpeedChange::kUndecided);
  EXPECT_EQ(change_of(spread("", 0.80, 1.25)), gate::SpeedChange::kUndecided);
}

TEST(GateVerdict, TheRatioIsTheMedianOfTheBlocks) {
  const gate::Judged row = gate::judge({spread("hull", 1.0, 1.2)}, kRules).front();
  EXPECT_EQ(row.name, "hull");
  EXPECT_NEAR(row.ratio, 1.1, 1e-4);  // the middle of logarithms is not quite that of ratios
  EXPECT_LT(row.interval.low, row.ratio);
  EXPECT_GT(row.interval.high, row.ratio);
}

TEST(GateVerdict, FewBlocksDecideNothing) {
  EXPECT_EQ(change_of({"hull", {0.2, 0.2, 0.2, 0.2, 0.2}}), gate::SpeedChange::kUndecided);
}

TEST(GateVerdict, ManyQuantitiesAskForMoreEvidence) {
  // 7 of 7 above: p = 1/128, enough for one quantity at 0.025 but not for four.
  const gate::LogRatios slower{"hull", std::vector<double>(7, 0.1)};
  const gate::LogRatios same{"other", {-0.01, 0.01, -0.01, 0.01, -0.01, 0.01, 0.01}};
  EXPECT_EQ(gate::judge({slower}, kRules).front().change, gate::SpeedChange::kSlower);
  EXPECT_NE(gate::judge({slower, same, same, same}, kRules).front().change, gate::SpeedChange::kSlower);
}

TEST(GateVerdict, NothingFoundPasses) {
  const gate::GateVerdict verdict = gate::decide(findings(gate::SpeedChange::kNone), kRules);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_EQ(verdict.sentence, "no regression");
}

TEST(GateVerdict, ARegressionThatBothRoundsSeeFails) {
  const gate::GateVerdict verdict =
      gate::decide(findings(gate::SpeedChange::kSlower, gate::SpeedChange::kSlower), kRules);
  EXPECT_EQ(verdict.exit_code, 3);
  EXPECT_EQ(verdict.sentence, "regression: hull");
}

TEST(GateVerdict, ACandidateThatIsNotConfirmedPasses) {
  for (const gate::SpeedChange second : {gate::SpeedChange::kNone, gate::SpeedChange::kFaster}) {
    const gate::GateVerdict verdict = gate::decide(findings(gate::SpeedChange::kSlower, second), kRules);
    EXPECT_EQ(verdict.exit_code, 0);
    EXPECT_EQ(verdict.unconfirmed, std::vector<std::string>{"hull"});
  }
}

TEST(GateVerdict, ACandidateThatTheSecondRoundCannotDecideIsInconclusive) {
  gate::GateFindings found = findings(gate::SpeedChange::kSlower, gate::SpeedChange::kUndecided);
  for (int round = 0; round < 2; ++round) {
    const gate::GateVerdict verdict = gate::decide(found, kRules);
    EXPECT_EQ(verdict.exit_code, 5);
    EXPECT_EQ(verdict.undecided, std::vector<std::string>{"hull"});
    EXPECT_TRUE(verdict.unconfirmed.empty());
    found.second.clear();  // nor one that it did not measure
  }
}

TEST(GateVerdict, AnImprovementThatIsNotConfirmedPasses) {
  for (const gate::SpeedChange second :
       {gate::SpeedChange::kNone, gate::SpeedChange::kSlower, gate::SpeedChange::kUndecided}) {
    const gate::GateVerdict verdict = gate::decide(findings(gate::SpeedChange::kFaster, second), kRules);
    EXPECT_EQ(verdict.exit_code, 0);
    EXPECT_EQ(verdict.unconfirmed, std::vector<std::string>{"hull"});
  }
}

TEST(GateVerdict, RunningOutOfTimeIsInconclusiveUnlessAResultChanged) {
  gate::GateFindings found = findings(gate::SpeedChange::kNone);
  found.out_of_time = true;
  EXPECT_EQ(gate::decide(found, kRules).exit_code, 5);
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 1e-6};
  EXPECT_EQ(gate::decide(found, kRules).exit_code, 3);
}

TEST(GateVerdict, AnImprovementIsListed) {
  const gate::GateVerdict verdict =
      gate::decide(findings(gate::SpeedChange::kFaster, gate::SpeedChange::kFaster), kRules);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_EQ(verdict.improvements, std::vector<std::string>{"hull"});
}

TEST(GateVerdict, AFailedControlMakesARegressionInconclusive) {
  for (const gate::SpeedChange control : {gate::SpeedChange::kSlower, gate::SpeedChange::kFaster}) {
    gate::GateFindings found = findings(gate::SpeedChange::kSlower, gate::SpeedChange::kSlower);
    found.null_control.front().change = control;
    EXPECT_EQ(gate::decide(found, kRules).exit_code, 5);
  }
}

TEST(GateVerdict, NoiseIsInconclusiveUnlessThereIsARegression) {
  EXPECT_EQ(gate::decide(findings(gate::SpeedChange::kUndecided), kRules).exit_code, 5);
  gate::GateFindings found = findings(gate::SpeedChange::kSlower, gate::SpeedChange::kSlower);
  found.first.push_back({.name = "other", .change = gate::SpeedChange::kUndecided});
  EXPECT_EQ(gate::decide(found, kRules).exit_code, 3);
}

TEST(GateVerdict, AChangedResultFailsEvenWhereTheClockIsNotTrusted) {
  gate::GateFindings found = findings(gate::SpeedChange::kUndecided);
  found.null_control.front().change = gate::SpeedChange::kSlower;
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 1e-6};
  const gate::GateVerdict verdict = gate::decide(found, kRules);
  EXPECT_EQ(verdict.exit_code, 3);
  EXPECT_EQ(verdict.sentence, "result changed: ca");
}

TEST(GateVerdict, AccuracyHasAToleranceAndNoneForWhatCannotBeCompared) {
  gate::GateFindings found = findings(gate::SpeedChange::kNone);
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 1e-9};
  EXPECT_EQ(gate::decide(found, kRules).exit_code, 0);
  found.accuracy.front().difference = 1.1e-9;
  EXPECT_EQ(gate::decide(found, kRules).exit_code, 3);
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 0, .reason = "invalid"};
  EXPECT_EQ(gate::decide(found, kRules).exit_code, 3);
}

TEST(GateVerdict, InstructionsNeedNoStatistics) {
  gate::GateRules rules;
  rules.threshold = 0.02;
  const auto code_of = [&](double base_again, double head) {
    return gate::decide(gate::judge_instructions({{"hull", 1000, base_again, head}}, rules), rules).exit_code;
  };
  EXPECT_EQ(code_of(1000, 1019), 0);
  EXPECT_EQ(code_of(1000, 1021), 3);
  EXPECT_EQ(code_of(1002, 1021), 5);  // base differs from itself by more than 0.1 %
  const gate::GateVerdict faster =
      gate::decide(gate::judge_instructions({{"hull", 1000, 1000, 950}}, rules), rules);
  EXPECT_EQ(faster.exit_code, 0);
  EXPECT_EQ(faster.improvements, std::vector<std::string>{"hull"});
}

}  // namespace
}  // namespace hullbench
