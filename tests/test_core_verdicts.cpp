// The goals of core_benchmarks against measurements made up for them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/micro/core_verdicts.hpp"

namespace hullbench::micro {
namespace {

VerdictLine line_of(const std::vector<VerdictLine>& lines, const std::string& what) {
  const auto found = std::ranges::find_if(lines, [&](const VerdictLine& line) { return line.what == what; });
  if (found == lines.end()) throw std::invalid_argument("no goal is called " + what);
  return *found;
}

VerdictLine line_of(const Measurements& measurements, const std::string& what) {
  return line_of(core_verdicts(measurements), what);
}

// Every benchmark at a time a point at which every goal is met.
Measurements all_met() {
  Measurements measurements;
  for (const std::string& benchmark : benchmarks_of_goals()) {
    double a_point = 100;
    if (benchmark.starts_with("regions/") || benchmark.starts_with("polygons/")) a_point = 5;
    if (benchmark.find("_2_threads/") != std::string::npos) a_point = 50;
    if (benchmark.starts_with("cgal_delaunay/")) a_point = 3000;
    measurements[benchmark] = {{a_point * points_of(benchmark)}, 40.0};
  }
  return measurements;
}

const std::string kAgainstCgal = "concave_hull / cgal_delaunay, ca/2000";

TEST(CoreVerdicts, NothingMeasuredIsSaidOfEveryGoal) {
  const std::vector<VerdictLine> lines = core_verdicts({});
  ASSERT_FALSE(lines.empty());
  for (const VerdictLine& line : lines) {
    EXPECT_EQ(line.verdict, Verdict::kNotMeasured) << line.what;
    EXPECT_FALSE(line.value.has_value()) << line.what;
  }
  EXPECT_EQ(exit_code(lines), 6);
}

TEST(CoreVerdicts, AllGoalsCanBeMet) {
  const std::vector<VerdictLine> lines = core_verdicts(all_met());
  for (const VerdictLine& line : lines) {
    EXPECT_EQ(line.verdict, line.goal.empty() ? Verdict::kInformation : Verdict::kMet) << line.what;
  }
  EXPECT_EQ(exit_code(lines), 0);
}

TEST(CoreVerdicts, AGoalThatSomeRepetitionsMeetIsUndecided) {
  Measurements measurements = all_met();
  measurements["cgal_delaunay/ca/2000"].times = {1e6, 1e6, 1e6};
  measurements["concave_hull/ca/2000"].times = {3.9e5, 4.1e5, 4.2e5};
  EXPECT_EQ(line_of(measurements, kAgainstCgal).verdict, Verdict::kUndecided);
  EXPECT_EQ(exit_code(core_verdicts(measurements)), 5);
  measurements["concave_hull/ca/2000"].times = {3.8e5, 3.9e5, 4.2e5};
  EXPECT_EQ(line_of(measurements, kAgainstCgal).verdict, Verdict::kUndecided) << "one repetition misses it";
  measurements["concave_hull/ca/2000"].times = {3.8e5, 3.9e5, 4e5};
  EXPECT_EQ(line_of(measurements, kAgainstCgal).verdict, Verdict::kMet);
  measurements["concave_hull/ca/2000"].times = {4e5, 4.1e5, 4.2e5};
  EXPECT_EQ(line_of(measurements, kAgainstCgal).verdict, Verdict::kUndecided) << "one is at the limit";
  measurements["concave_hull/ca/2000"].times = {4.05e5, 4.1e5, 4.2e5};
  EXPECT_EQ(line_of(measurements, kAgainstCgal).verdict, Verdict::kMissed);
  EXPECT_EQ(exit_code(core_verdicts(measurements)), 3);
  measurements["concave_hull_2_threads/ca/64000"].times = {5e6, 4e6, 4.5e6};  // 1.28 to 1.6 times faster
  measurements["concave_hull/ca/64000"].times = {6.4e6, 6.4e6, 6.4e6};
  EXPECT_EQ(line_of(measurements, "one thread / 2 threads, ca/64000").verdict, Verdict::kUndecided);
}

TEST(CoreVerdicts, WithManyRepetitionsAFewThatStandOutDoNotCount) {
  Measurements measurements = all_met();
  std::vector<double>& times = measurements["concave_hull/ca/2000"].times;
  measurements["cgal_delaunay/ca/2000"].times.assign(35, 1e6);
  times.assign(35, 3.9e5);
  std::fill_n(times.begin(), 10, 4.1e5);  // P(at most 10 of 35 on one side) is 0.8 %
  EXPECT_EQ(line_of(measurements, kAgainstCgal).verdict, Verdict::kMet);
  EXPECT_TRUE(benchmarks_of_undecided_goals(measurements).empty());
  times[10] = 4.1e5;  // and of 11 it is 2 %
  EXPECT_EQ(line_of(measurements, kAgainstCgal).verdict, Verdict::kUndecided);
  EXPECT_EQ(benchmarks_of_undecided_goals(measurements),
            (std::set<std::string>{"cgal_delaunay/ca/2000", "concave_hull/ca/2000"}));
}

TEST(CoreVerdicts, AMissedGoalWeighsMoreThanOneNotMeasured) {
  const Measurements measurements = {{"concave_hull/ca/2000", {{2}, {}}},
                                     {"cgal_delaunay/ca/2000", {{1}, {}}}};
  EXPECT_EQ(exit_code(core_verdicts(measurements)), 3);
}

TEST(CoreVerdicts, OneGoalNotMeasuredIsNotSuccess) {
  Measurements measurements = all_met();
  measurements.erase("cgal_delaunay/ca/2000");
  const std::vector<VerdictLine> lines = core_verdicts(measurements);
  EXPECT_EQ(line_of(lines, kAgainstCgal).verdict, Verdict::kNotMeasured);
  EXPECT_EQ(exit_code(lines), 6);
}

TEST(CoreVerdicts, ExactlyTheLimitMeetsAGoal) {
  const Measurements upper = {{"concave_hull/ca/2000", {{400}, {}}}, {"cgal_delaunay/ca/2000", {{1000}, {}}}};
  EXPECT_EQ(line_of(upper, kAgainstCgal).verdict, Verdict::kMet);

  const Measurements lower = {{"concave_hull/ca/64000", {{16}, {}}},
                              {"concave_hull_2_threads/ca/64000", {{10}, {}}}};
  EXPECT_EQ(line_of(lower, "one thread / 2 threads, ca/64000").verdict, Verdict::kMet);

  const Measurements memory = {{"concave_hull/ca/1000000", {{1}, 45.0}}};
  EXPECT_EQ(line_of(memory, "peak bytes a point, ca/1000000").verdict, Verdict::kMet);
}

TEST(CoreVerdicts, JustBelowALowerLimitMissesIt) {
  const Measurements measurements = {{"concave_hull/ca/64000", {{15.9}, {}}},
                                     {"concave_hull_2_threads/ca/64000", {{10}, {}}}};
  EXPECT_EQ(line_of(measurements, "one thread / 2 threads, ca/64000").verdict, Verdict::kMissed);
}

TEST(CoreVerdicts, MemoryAboveTheLimitMissesIt) {
  const Measurements measurements = {{"concave_hull/uniform/10000000", {{1}, 45.5}}};
  EXPECT_EQ(line_of(measurements, "peak bytes a point, uniform/10000000").verdict, Verdict::kMissed);
}

TEST(CoreVerdicts, MemoryThatWasNotCountedIsNotMeasured) {
  const Measurements measurements = {{"concave_hull/ca/1000000", {{1}, {}}}};
  EXPECT_EQ(line_of(measurements, "peak bytes a point, ca/1000000").verdict, Verdict::kNotMeasured);
}

TEST(CoreVerdicts, ValueAndIntervalAreOfTheRepetitions) {
  const Measurements measurements = {{"concave_hull/ca/2000", {{3, 1, 2}, {}}},
                                     {"cgal_delaunay/ca/2000", {{10, 10, 40}, {}}}};
  const VerdictLine line = line_of(measurements, kAgainstCgal);
  EXPECT_EQ(line.value, 1.0 / 10) << "of 3 / 10, 1 / 10 and 2 / 40";
  ASSERT_TRUE(line.interval.has_value());
  EXPECT_EQ(line.interval->low, 2.0 / 40);
  EXPECT_EQ(line.interval->high, 3.0 / 10);
}

TEST(CoreVerdicts, WhatIsHopedForIsARemarkOnly) {
  const Measurements far = {{"concave_hull/ca/2000", {{35}, {}}}, {"cgal_delaunay/ca/2000", {{100}, {}}}};
  EXPECT_EQ(line_of(far, kAgainstCgal).remark, "not 0.3");
  EXPECT_EQ(line_of(far, kAgainstCgal).verdict, Verdict::kMet);
  const Measurements there = {{"concave_hull/ca/2000", {{30}, {}}}, {"cgal_delaunay/ca/2000", {{100}, {}}}};
  EXPECT_EQ(line_of(there, kAgainstCgal).remark, "0.3 too");
}

TEST(CoreVerdicts, StepsAreAdded) {
  const Measurements measurements = {{"regions/ca/64000", {{7}, {}}},
                                     {"polygons/ca/64000", {{14}, {}}},
                                     {"concave_hull_whole/ca/64000", {{100}, {}}}};
  const VerdictLine line = line_of(measurements, "(regions + polygons) / whole, ca/64000");
  EXPECT_EQ(line.value, 0.21);
  EXPECT_EQ(line.verdict, Verdict::kMissed);
}

TEST(CoreVerdicts, DifferentSizesAreComparedByThePoint) {
  const Measurements measurements = {{"concave_hull/rgbd/101760", {{101760 * 3}, {}}},
                                     {"concave_hull/uniform/100000", {{100000 * 2}, {}}}};
  const VerdictLine line = line_of(measurements, "time a point, rgbd/101760 / uniform/100000");
  EXPECT_EQ(line.value, 1.5);
  EXPECT_EQ(line.verdict, Verdict::kMet);
}

TEST(CoreVerdicts, GrowthComparesTheLargestTimeAPointWithTheSmallest) {
  const Measurements measurements = {{"concave_hull/uniform/1000", {{1000 * 4}, {}}},
                                     {"concave_hull/uniform/10000", {{10000 * 2}, {}}},
                                     {"concave_hull/uniform/100000", {{100000 * 3}, {}}},
                                     {"concave_hull/uniform/1000000", {{1000000 * 5}, {}}},
                                     {"concave_hull/uniform/10000000", {{10000000 * 9.0}, {}}}};
  const VerdictLine spread = line_of(measurements, "growth: a point, uniform, slowest / fastest size");
  EXPECT_EQ(spread.value, 4.5);
  EXPECT_EQ(spread.verdict, Verdict::kInformation);
  const VerdictLine ends = line_of(measurements, "n log n: a point, uniform/10000000 / uniform/1000");
  EXPECT_EQ(ends.value, 2.25);
  EXPECT_EQ(ends.verdict, Verdict::kMet);
}

TEST(CoreVerdicts, NoLineIsWiderThanATerminal) {
  Measurements measurements = all_met();
  for (auto& [benchmark, measured] : measurements) measured.times.push_back(measured.times.front() * 1.234);
  std::ostringstream out;
  print_measurements(measurements, out);
  print_verdicts(core_verdicts(measurements), out);
  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 110U) << line;
}

}  // namespace
}  // namespace hullbench::micro
