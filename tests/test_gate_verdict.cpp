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

Change change_of(const LogRatios& ratios) {
  return judge({ratios}, kRules).front().change;
}

/// Findings of one quantity that has these changes in the two rounds, with controls and results in order.
GateFindings findings(Change first, Change second = Change::kNone) {
  GateFindings made;
  made.first.push_back({.name = "hull", .change = first});
  made.second.push_back({.name = "hull", .change = second});
  made.null_control.push_back({.name = "hull"});
  made.accuracy.push_back({.name = "ca", .same = true});
  return made;
}

TEST(GateVerdict, JudgesByTheWholeInterval) {
  EXPECT_EQ(change_of(spread("", 0.99, 1.01)), Change::kNone);
  EXPECT_EQ(change_of(spread("", 1.08, 1.12)), Change::kSlower);
  EXPECT_EQ(change_of(spread("", 0.88, 0.92)), Change::kFaster);
  EXPECT_EQ(change_of(spread("", 1.03, 1.04)), Change::kNone);  // slower, but by less than the threshold
  EXPECT_EQ(change_of(spread("", 1.02, 1.10)),
            Change::kNone);  // above the threshold, but not the whole of it
  EXPECT_EQ(change_of(spread("", 0.80, 1.25)), Change::kUndecided);
}

TEST(GateVerdict, TheRatioIsTheMedianOfTheBlocks) {
  const Judged row = judge({spread("hull", 1.0, 1.2)}, kRules).front();
  EXPECT_EQ(row.name, "hull");
  EXPECT_NEAR(row.ratio, 1.1, 1e-4);  // the middle of logarithms is not quite that of ratios
  EXPECT_LT(row.interval.lower, row.ratio);
  EXPECT_GT(row.interval.upper, row.ratio);
}

TEST(GateVerdict, FewBlocksDecideNothing) {
  EXPECT_EQ(change_of({"hull", {0.2, 0.2, 0.2, 0.2, 0.2}}), Change::kUndecided);
}

TEST(GateVerdict, ManyQuantitiesAskForMoreEvidence) {
  // 7 of 7 above: p = 1/128, enough for one quantity at 0.025 but not for four.
  const LogRatios slower{"hull", std::vector<double>(7, 0.1)};
  const LogRatios same{"other", {-0.01, 0.01, -0.01, 0.01, -0.01, 0.01, 0.01}};
  EXPECT_EQ(judge({slower}, kRules).front().change, Change::kSlower);
  EXPECT_NE(judge({slower, same, same, same}, kRules).front().change, Change::kSlower);
}

TEST(GateVerdict, NothingFoundPasses) {
  const GateVerdict verdict = decide(findings(Change::kNone), kRules);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_EQ(verdict.sentence, "no regression");
}

TEST(GateVerdict, ARegressionThatBothRoundsSeeFails) {
  const GateVerdict verdict = decide(findings(Change::kSlower, Change::kSlower), kRules);
  EXPECT_EQ(verdict.exit_code, 3);
  EXPECT_EQ(verdict.sentence, "regression: hull");
}

TEST(GateVerdict, ACandidateThatIsNotConfirmedPasses) {
  for (const Change second : {Change::kNone, Change::kFaster, Change::kUndecided}) {
    const GateVerdict verdict = decide(findings(Change::kSlower, second), kRules);
    EXPECT_EQ(verdict.exit_code, 0);
    EXPECT_EQ(verdict.unconfirmed, std::vector<std::string>{"hull"});
  }
}

TEST(GateVerdict, AnImprovementIsListed) {
  const GateVerdict verdict = decide(findings(Change::kFaster, Change::kFaster), kRules);
  EXPECT_EQ(verdict.exit_code, 0);
  EXPECT_EQ(verdict.improvements, std::vector<std::string>{"hull"});
}

TEST(GateVerdict, AFailedControlMakesARegressionInconclusive) {
  for (const Change control : {Change::kSlower, Change::kFaster}) {
    GateFindings found = findings(Change::kSlower, Change::kSlower);
    found.null_control.front().change = control;
    EXPECT_EQ(decide(found, kRules).exit_code, 5);
  }
}

TEST(GateVerdict, NoiseIsInconclusiveUnlessThereIsARegression) {
  EXPECT_EQ(decide(findings(Change::kUndecided), kRules).exit_code, 5);
  GateFindings found = findings(Change::kSlower, Change::kSlower);
  found.first.push_back({.name = "other", .change = Change::kUndecided});
  EXPECT_EQ(decide(found, kRules).exit_code, 3);
}

TEST(GateVerdict, AChangedResultFailsEvenWhereTheClockIsNotTrusted) {
  GateFindings found = findings(Change::kUndecided);
  found.null_control.front().change = Change::kSlower;
  found.accuracy.front() = {.name = "ca", .same = false, .difference = 1e-6};
  const GateVerdict verdict = decide(found, kRules);
  EXPECT_EQ(verdict.exit_code, 3);
  EXPECT_EQ(verdict.sentence, "result changed: ca");
}

TEST(GateVerdict, AccuracyHasAToleranceAndNoneForWhatCannotBeCompared) {
  GateFindings found = findings(Change::kNone);
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
