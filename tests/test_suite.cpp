// Several plans in one call: a folder with a run of each and the tables of all, gone on with when
// interrupted.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

class SuiteTest : public HullbenchTest {
 protected:
  fs::path suite() const { return folder() / "suite"; }

  /// "first" with 500 and "second" with 600 points.
  std::vector<std::string> run_both(const std::vector<std::string>& more = {"--out", "suite"}) const {
    const std::string first = write(small_plan("first", california({500})));
    const std::string second = write(small_plan("second", california({600})));
    return joined({"run", first, second}, more);
  }
};

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

/// The names of the rows of a run, each of which must be there once.
std::set<std::string> rows_of(const fs::path& run) {
  std::set<std::string> names;
  for (const json& line : record::load_json_lines(run / "runs.jsonl").lines)
    EXPECT_TRUE(names.insert(line.at("name")).second) << line.at("name") << " is there twice";
  return names;
}

std::vector<std::string> records_of(const fs::path& suite) {
  std::vector<std::string> texts;
  for (const char* run : {"first", "second"}) {
    for (const char* file : {"runs.jsonl", "repetitions.jsonl", "run.json", "report.json"})
      texts.push_back(read_text(suite / run / file));
  }
  return texts;
}

TEST_F(SuiteTest, IsARunOfEveryPlanAndTheTablesOfAll) {
  const Outcome outcome = succeeded(hullbench(run_both()));
  expect_says(outcome.err, "table 1 of 2: Plan first");
  expect_says(outcome.err, "table 2 of 2: Plan second");
  expect_says(outcome.err, "4 ok, 0 failed, 0 not installed");
  EXPECT_EQ(names_in(suite()),
            (std::set<std::string>{"first", "second", "suite.json", "tables", "tables.md"}));
  EXPECT_EQ(rows_of(suite() / "first"), (std::set<std::string>{"polylidar/ca/n:500/holes:0/protocol:paper",
                                                               "polylidar/ca/n:500/holes:1/protocol:paper"}));
  EXPECT_EQ(rows_of(suite() / "second"),
            (std::set<std::string>{"polylidar/ca/n:600/holes:0/protocol:paper",
                                   "polylidar/ca/n:600/holes:1/protocol:paper"}));
  EXPECT_EQ(read_text(suite() / "tables.md"), outcome.out);
  expect_says(outcome.out, "## Plan first\n");
  expect_says(outcome.out, "## Plan second\n");
  const std::set<std::string> tables = names_in(suite() / "tables");
  for (const char* table : {"methods", "parameters", "first_ca_time", "second_ca_holes_error"}) {
    EXPECT_TRUE(tables.contains(std::string(table) + ".csv")) << table;
    EXPECT_TRUE(tables.contains(std::string(table) + ".tex")) << table;
  }
  const Outcome printed = succeeded(hullbench({"tables", "suite"}));
  EXPECT_EQ(printed.out, outcome.out);
  // Who draws a report learns from it, and from nowhere else, which values of a metric are better.
  EXPECT_EQ(json::parse(read_text(suite() / "first" / "report.json")).at("metrics"),
            json::parse(hullbench({"metrics", "--json"}).out));
}

TEST_F(SuiteTest, HasItsTablesWrittenAnewOnlyWhenThatIsAskedFor) {
  const Outcome outcome = succeeded(hullbench(run_both()));
  const std::set<std::string> tables = names_in(suite() / "tables");
  fs::remove_all(suite() / "tables");
  fs::remove(suite() / "tables.md");
  EXPECT_EQ(hullbench({"tables", "suite"}).code, 0);
  EXPECT_FALSE(fs::exists(suite() / "tables.md"));
  EXPECT_EQ(hullbench({"tables", "suite", "--write"}).code, 0);
  EXPECT_EQ(read_text(suite() / "tables.md"), outcome.out);
  EXPECT_EQ(names_in(suite() / "tables"), tables);
}

TEST_F(SuiteTest, ThatIsFinishedIsNotMeasuredAgain) {
  const Outcome first = succeeded(hullbench(run_both()));
  const auto records = records_of(suite());
  fs::remove_all(suite() / "tables");
  const Outcome second = succeeded(hullbench(run_both()));
  EXPECT_EQ(second.out, first.out);
  expect_says(second.err, "Plan first is finished already");
  expect_says(second.err, "Plan second is finished already");
  expect_says(second.err, "4 ok, 0 failed, 0 not installed");
  EXPECT_EQ(records_of(suite()), records);
  EXPECT_TRUE(names_in(suite() / "tables").contains("methods.csv"));
}

TEST_F(SuiteTest, GoesThroughAllPlansPassByPass) {
  json once = small_plan("once", california({400}), 1);
  const std::vector<std::string> words = {"run",       write(small_plan("first", california({500}), 3)),
                                          write(once), write(small_plan("second", california({600}), 2)),
                                          "--passes",  "2",
                                          "--out",     "suite"};
  const Outcome outcome = succeeded(hullbench(words));
  std::size_t place = 0;
  for (const char* words_said :
       {"table 1 of 3, pass 1 of 2: Plan first\n", "table 2 of 3, pass 1 of 2: Plan once\n",
        "table 3 of 3, pass 1 of 2: Plan second\n", "pass 1 of 2 is done; 'hullbench tables suite'",
        "table 1 of 3, pass 2 of 2: Plan first\n", "table 3 of 3, pass 2 of 2: Plan second\n"}) {
    place = outcome.err.find(words_said, place);
    ASSERT_NE(place, std::string::npos) << words_said << " is not there or not in its place: " << outcome.err;
  }
  const std::map<std::string, json> passes = {{"first", {1, 1, 2}}, {"once", {1}}, {"second", {1, 2}}};
  for (const auto& [plan, expected] : passes) {
    EXPECT_EQ(rows_of(suite() / plan).size(), 2U);
    for (const json& row : record::load_json_lines(suite() / plan / "runs.jsonl").lines)
      EXPECT_EQ(row.at("passes"), expected) << plan;
    EXPECT_TRUE(fs::exists(suite() / plan / "report.json")) << plan;
  }
  const Outcome again = hullbench(words);
  expect_says(again.err, "Plan once is finished already");
  EXPECT_EQ(again.out, outcome.out);
}

TEST_F(SuiteTest, IsMeasuredAnewByForce) {
  ASSERT_EQ(hullbench(run_both()).code, 0);
  const auto repetitions = [&](const char* plan) { return read_text(suite() / plan / "repetitions.jsonl"); };
  const std::string first = repetitions("first");
  const std::string second = repetitions("second");
  EXPECT_EQ(hullbench(run_both({"--out", "suite", "--force"})).code, 0);
  // Nobody measures the same nanoseconds twice.
  EXPECT_NE(repetitions("first"), first);
  EXPECT_NE(repetitions("second"), second);
  EXPECT_EQ(rows_of(suite() / "first").size(), 2U);
}

TEST_F(SuiteTest, HasTheExitCodeOfItsWorstRow) {
  const std::vector<std::string> words = {"run",
                                          write(small_plan("first", california({500}))),
                                          write(small_plan("second", california({64000}), 1)),
                                          "--out",
                                          "suite",
                                          "--timeout",
                                          "0.002"};
  // No machine loads and triangulates 64000 points in two milliseconds.
  EXPECT_EQ(hullbench(words).code, 4);
  EXPECT_EQ(hullbench(words).code, 4) << "said of finished runs too";
}

TEST_F(SuiteTest, WithTheSamePlanTwiceIsRefused) {
  const std::string plan = write(small_plan("first", california({500})));
  expect_refusal(hullbench({"run", plan, plan}), 2, "the plan 'first' is named twice; leave one out");
  EXPECT_FALSE(fs::exists(folder() / "results"));
}

TEST_F(SuiteTest, InAFolderWithSomethingElseIsRefused) {
  fs::create_directory(suite());
  write_text(suite() / "thesis.tex", "precious");
  expect_refusal(hullbench(run_both()), 2, "the output folder suite holds something else");
  EXPECT_EQ(names_in(suite()), (std::set<std::string>{"thesis.tex"}));
}

TEST_F(SuiteTest, InAFolderWithAnotherSuiteIsRefused) {
  ASSERT_EQ(hullbench(run_both()).code, 0);
  const auto records = records_of(suite());
  expect_refusal(hullbench(run_both({"--out", "suite", "--seed", "7"})), 2, "holds something else");
  EXPECT_EQ(records_of(suite()), records);
}

TEST_F(SuiteTest, IsNotReadAfterARunWasForcedIntoItsFolder) {
  ASSERT_EQ(hullbench(run_both()).code, 0);
  const Outcome run = succeeded(hullbench({"run", "first.json", "--out", "suite", "--force"}));
  EXPECT_EQ(hullbench({"tables", "suite"}).out, run.out);
}

TEST_F(SuiteTest, LeavesOutAPlanWithoutRuns) {
  const Outcome outcome = succeeded(hullbench(run_both({"--out", "suite", "--filter", "n:600/holes:1"})));
  EXPECT_FALSE(fs::exists(suite() / "first"));
  EXPECT_EQ(rows_of(suite() / "second"),
            (std::set<std::string>{"polylidar/ca/n:600/holes:1/protocol:paper"}));
  EXPECT_EQ(json::parse(read_text(suite() / "suite.json")).at("plans"), json::array({"second"}));
  EXPECT_EQ(hullbench({"tables", "suite"}).out, outcome.out);
}

TEST_F(SuiteTest, WithoutAnyRunIsNotBegun) {
  expect_refusal(hullbench(run_both({"--filter", "cgal"})), 6,
                 "no run of the plans 'first', 'second' has a name that matches 'cgal'");
  EXPECT_FALSE(fs::exists(folder() / "results"));
}

TEST_F(SuiteTest, WithoutOutIsTheLatestRun) {
  const Outcome outcome = succeeded(hullbench(run_both({})));
  EXPECT_EQ(read_text(folder() / "results" / "latest" / "tables.md"), outcome.out);
  EXPECT_EQ(hullbench({"tables"}).out, outcome.out);
}

TEST_F(SuiteTest, ADryRunPrintsTheNamesOfAllPlans) {
  EXPECT_EQ(hullbench(run_both({"--dry-run", "--filter", "holes:0"})).out,
            "polylidar/ca/n:500/holes:0/protocol:paper\npolylidar/ca/n:600/holes:0/protocol:paper\n");
}

class InterruptedSuiteTest : public SuiteTest {
 protected:
  static constexpr int kRepetitions = 40;

  std::vector<std::string> words(const std::vector<std::string>& more = {"--out", "suite"}) const {
    const std::string first = write(small_plan("first", california({500})));
    const std::string second = write(small_plan("second", california({2000, 3000}), kRepetitions));
    return joined({"run", first, second}, more);
  }

  /// Starts the suite and sends `signal` in the middle of the second plan; how it ended.
  Outcome stop_in_second(const std::vector<std::string>& words, int signal, std::size_t lines,
                         const fs::path& in) const {
    Program program(command(words), in_folder());
    EXPECT_TRUE(wait_until([&] {
      const std::string text = read_text(in / "second" / "repetitions.jsonl");
      return static_cast<std::size_t>(std::ranges::count(text, '\n')) >= lines;
    }));
    program.send_signal(signal);
    return program.wait();
  }

  static std::map<int, int> lines_by_pass(const fs::path& suite) {
    std::map<int, int> counts;
    for (const json& line : record::load_json_lines(suite / "second" / "repetitions.jsonl").lines)
      ++counts[line.at("pass").get<int>()];
    return counts;
  }

  static void expect_whole(const fs::path& suite) {
    EXPECT_EQ(rows_of(suite / "first").size(), 2U);
    EXPECT_EQ(rows_of(suite / "second").size(), 4U);
    std::set<std::pair<std::string, int>> seen;
    for (const json& line : record::load_json_lines(suite / "second" / "repetitions.jsonl").lines)
      EXPECT_TRUE(seen.emplace(line.at("id"), line.at("repetition")).second) << line;
    EXPECT_EQ(seen.size(), std::size_t{4} * kRepetitions);
    for (const json& line : record::load_json_lines(suite / "second" / "runs.jsonl").lines)
      EXPECT_EQ(line.at("time_ns").size(), std::size_t{kRepetitions});
  }
};

TEST_F(InterruptedSuiteTest, GoesOnFromWhereItStopped) {
  std::vector<std::string> firsts;
  for (const auto& [signal, code] : {std::pair(SIGKILL, 128 + SIGKILL), std::pair(SIGINT, 130)}) {
    const Outcome stopped = stop_in_second(words(), signal, signal == SIGKILL ? 20 : 60, suite());
    ASSERT_EQ(stopped.code, code) << stopped.err;
    EXPECT_EQ(stopped.out, "");
    EXPECT_FALSE(fs::exists(suite() / "tables.md"));
    EXPECT_FALSE(fs::exists(suite() / "second" / "report.json"));
    firsts.push_back(read_text(suite() / "first" / "runs.jsonl"));
  }
  const std::string repetitions = read_text(suite() / "second" / "repetitions.jsonl");
  const Outcome whole = succeeded(hullbench(words()));
  expect_says(whole.err, "Plan first is finished already");
  firsts.push_back(read_text(suite() / "first" / "runs.jsonl"));
  EXPECT_FALSE(firsts.front().empty());
  EXPECT_EQ(firsts, std::vector<std::string>(3, firsts.front()));
  EXPECT_TRUE(read_text(suite() / "second" / "repetitions.jsonl").starts_with(repetitions));
  expect_whole(suite());
  EXPECT_EQ(read_text(suite() / "tables.md"), whole.out);
}

TEST_F(InterruptedSuiteTest, GoesOnInThePassInWhichItStopped) {
  const std::vector<std::string> in_two_passes = words({"--passes", "2", "--out", "suite"});
  // Of its 160 repetitions 80 are of the first pass.
  for (const auto& [signal, code] : {std::pair(SIGKILL, 128 + SIGKILL), std::pair(SIGINT, 130)}) {
    const Outcome stopped = stop_in_second(in_two_passes, signal, signal == SIGKILL ? 95 : 110, suite());
    ASSERT_EQ(stopped.code, code) << stopped.err;
    EXPECT_EQ(lines_by_pass(suite()).at(1), 80);
    EXPECT_TRUE(fs::exists(suite() / "first" / "report.json"));
    EXPECT_FALSE(fs::exists(suite() / "second" / "report.json"));
    // Those of the first pass are there, whole and readable.
    expect_end(hullbench({"tables", "suite"}), 0, "", "## Plan second\n");
  }
  const std::string repetitions = read_text(suite() / "second" / "repetitions.jsonl");
  succeeded(hullbench(in_two_passes));
  EXPECT_TRUE(read_text(suite() / "second" / "repetitions.jsonl").starts_with(repetitions));
  expect_whole(suite());
  EXPECT_EQ(lines_by_pass(suite()), (std::map<int, int>{{1, 80}, {2, 80}}));
}

TEST_F(InterruptedSuiteTest, IsFoundWithoutOutUntilItIsFinished) {
  const fs::path latest = folder() / "results" / "latest";
  ASSERT_EQ(stop_in_second(words({}), SIGINT, 20, latest).code, 130);
  const std::string first = read_text(latest / "first" / "runs.jsonl");
  EXPECT_EQ(hullbench(words({})).code, 0);
  EXPECT_EQ(names_in(folder() / "results" / "runs").size(), 1U);
  EXPECT_EQ(read_text(latest / "first" / "runs.jsonl"), first);
  expect_whole(latest);
  EXPECT_EQ(hullbench(words({})).code, 0);
  EXPECT_EQ(names_in(folder() / "results" / "runs").size(), 2U);
}

TEST_F(InterruptedSuiteTest, HasTheTablesOfWhatIsThere) {
  ASSERT_EQ(stop_in_second(words(), SIGINT, 1, suite()).code, 130);
  const Outcome tables = succeeded(hullbench({"tables", "suite"}));
  expect_says(tables.out, "## Plan first\n");
  fs::remove_all(suite() / "first");
  fs::remove_all(suite() / "second");
  EXPECT_EQ(hullbench({"tables", "suite"}).code, 0);
  write_text(suite() / "suite.json", "{");
  expect_refusal(hullbench({"tables", "suite"}), 2, "cannot read suite/suite.json");
}

}  // namespace
}  // namespace hullbench::testing
