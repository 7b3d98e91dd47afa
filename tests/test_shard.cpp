// Which runs a shard has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/run/runner.hpp"
#include "benchmarks/run/shard.hpp"

namespace hullbench {
namespace {

/// Two methods on California, with and without holes, at six sizes that double.
plan::Plan twelve_cases() {
  const json methods = {{{"method", "polylidar"}, {"protocol", "default"}},
                        {{"method", "cgal_alpha_shape"}, {"protocol", "default"}}};
  const json cases = {
      {{"dataset", "ca"}, {"holes", {false, true}}, {"n", {2000, 4000, 8000, 16000, 32000, 64000}}}};
  return plan::parse_plan(json{{"name", "twelve"}, {"cases", cases}, {"methods", methods}}.dump(), "twelve");
}

std::set<std::size_t> cases_of(const std::vector<plan::PlannedRun>& runs) {
  std::set<std::size_t> cases;
  for (const plan::PlannedRun& run : runs) cases.insert(run.case_index);
  return cases;
}

TEST(Shard, IsReadAsWritten) {
  const run::Shard shard = run::parse_shard("2/30");
  EXPECT_EQ(shard.number, 2U);
  EXPECT_EQ(shard.count, 30U);
  EXPECT_EQ(to_string(shard), "2/30");
  EXPECT_EQ(to_string(run::parse_shard("1/1")), "1/1");
}

TEST(Shard, ThatCannotBeIsRefused) {
  for (const char* text : {"", "/", "1", "1/", "/2", "0/2", "3/2", "-1/2", "+1/2", "1/2/3", "1.0/2", "a/b",
                           " 1/2", "1/2 ", "1/10001", "1/99999999999999999999"}) {
    EXPECT_THROW(run::parse_shard(text), ConfigurationError) << text;
  }
}

TEST(Shard, EveryRunIsInOneOfThemInThePlansOrder) {
  const plan::Plan plan = twelve_cases();
  const auto runs = plan::planned_runs(plan, "");
  ASSERT_EQ(runs.size(), 24U);
  for (const std::size_t count : {1U, 2U, 3U, 5U, 12U, 20U}) {
    std::multiset<std::string> seen;
    for (std::size_t number = 1; number <= count; ++number) {
      const auto part = run::runs_of_shard(plan, runs, {number, count});
      EXPECT_EQ(part.empty(), number > 12) << number << "/" << count;
      EXPECT_TRUE(std::is_sorted(
          part.begin(), part.end(),
          [](const plan::PlannedRun& a, const plan::PlannedRun& b) { return a.case_index < b.case_index; }));
      for (const plan::PlannedRun& run : part) seen.insert(run.name);
    }
    std::multiset<std::string> all;
    for (const plan::PlannedRun& run : runs) all.insert(run.name);
    EXPECT_EQ(seen, all) << count;
  }
}

TEST(Shard, HasWholeCases) {
  const plan::Plan plan = twelve_cases();
  const auto runs = plan::planned_runs(plan, "");
  for (std::size_t number = 1; number <= 5; ++number) {
    const auto part = run::runs_of_shard(plan, runs, {number, 5});
    EXPECT_EQ(part.size(), 2 * cases_of(part).size()) << number;
  }
}

// Dealt out like cards, the cases would give one of four shards 168000 points to measure.
TEST(Shard, HasItsShareOfTheWork) {
  const plan::Plan plan = twelve_cases();
  const auto runs = plan::planned_runs(plan, "");
  std::map<std::size_t, std::int64_t> work;
  for (std::size_t number = 1; number <= 4; ++number) {
    for (const plan::PlannedRun& run : run::runs_of_shard(plan, runs, {number, 4}))
      work[number] += run::estimated_points(plan.expanded_cases[run.case_index]);
  }
  // 504000 points in all, of which the largest case has 128000.
  for (const auto& [number, points] : work) EXPECT_LE(points, 2 * 64000) << number;
}

TEST(Shard, IsOfTheRunsThatTheFilterLeft) {
  const plan::Plan plan = twelve_cases();
  const auto runs = plan::planned_runs(plan, "^polylidar/.*n:(2000|4000)/");
  ASSERT_EQ(cases_of(runs).size(), 4U);
  for (std::size_t number = 1; number <= 4; ++number)
    EXPECT_EQ(run::runs_of_shard(plan, runs, {number, 4}).size(), 1U) << number;
}

}  // namespace
}  // namespace hullbench
