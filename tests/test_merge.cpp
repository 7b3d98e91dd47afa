// Shards of a plan, measured apart and put together, are the run that one machine would have made.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

/// The lines of runs.jsonl without what another machine may have otherwise.
std::vector<std::string> accuracy_lines(const fs::path& run) {
  std::vector<std::string> lines;
  for (json line : record::load_json_lines(run / "runs.jsonl").lines) {
    for (const char* key : {"time_ns", "phases_ns", "canary_ns", "machine", "flags"}) line.erase(key);
    line["metrics"].erase("peak_memory_bytes");
    lines.push_back(line.dump());
  }
  return lines;
}

/// The tables of errors in tables/, by name.
std::map<std::string, std::string> accuracy_tables(const fs::path& run) {
  std::map<std::string, std::string> tables;
  for (const auto& entry : fs::directory_iterator(run / "tables")) {
    const std::string name = entry.path().filename().string();
    if (name.find("error") != std::string::npos) tables[name] = read_text(entry.path());
  }
  return tables;
}

class MergeTest : public HullbenchTest {
 protected:
  /// Two methods on California with and without holes at three sizes: twelve runs of six cases.
  std::string plan(const std::string& name = "small") const {
    json plan = small_plan(name, california({300, 400, 500}), 1);
    plan["methods"].push_back({{"method", "cgal_alpha_shape"},
                               {"protocol", "paper"},
                               {"parameters", plan["methods"][0]["parameters"]}});
    return write(plan);
  }

  void run(const std::string& out, const std::vector<std::string>& words) const {
    succeeded(hullbench(joined(joined({"run"}, words), {"--out", out})));
  }

  void run_shards(int count, const std::vector<std::string>& plans) const {
    for (int number = 1; number <= count; ++number) {
      run("shard" + std::to_string(number),
          joined(plans, {"--shard", std::to_string(number) + "/" + std::to_string(count)}));
    }
  }

  void change_header(const std::string& name, const std::function<void(json&)>& change) const {
    change_json(name + "/run.json", change);
  }

  /// Makes the run in `name` say that it is of another machine.
  void move_to_machine(const std::string& name, const std::string& machine) const {
    change_header(name, [&](json& header) { header["environment"]["machine_id"] = machine; });
    change_rows(name, [&](json& row) { row["machine"] = machine; });
  }

  void expect_valid_run(const std::string& name) const {
    for (const char* file : {"/run.json", "/runs.jsonl", "/report.json"}) expect_valid(name + file);
    if (const std::string why = missing({SYSTEM_PYTHON ":jsonschema"}); !why.empty()) {
      GTEST_SKIP() << why;
    }
    succeeded(run_program({SYSTEM_PYTHON, VALIDATE_REPORT, (folder() / name / "report.json").string(),
                           (folder() / name / "runs.jsonl").string()}));
  }
};

TEST_F(MergeTest, OfAllShardsIsTheWholeRunInItsAccuracy) {
  run("whole", {plan()});
  run_shards(3, {plan()});
  const Outcome merged = succeeded(hullbench({"merge", "shard3", "shard1", "shard2", "--out", "merged"}));
  ASSERT_EQ(accuracy_lines(folder() / "whole").size(), 12U);
  EXPECT_EQ(accuracy_lines(folder() / "merged"), accuracy_lines(folder() / "whole"));
  EXPECT_EQ(accuracy_tables(folder() / "whole").size(), 4U);
  EXPECT_EQ(accuracy_tables(folder() / "merged"), accuracy_tables(folder() / "whole"));
  EXPECT_NE(merged.out.find("time of equal work, ms"), std::string::npos) << "all are of this one machine";
  expect_says(merged.err, "12 of 12 planned runs");
  EXPECT_EQ(read_text(folder() / "merged" / "tables.md"), merged.out);
  EXPECT_EQ(hullbench({"tables", "merged"}).out, merged.out);
  expect_valid_run("merged");
  expect_valid_run("shard1");
}

TEST_F(MergeTest, KeepsThePassesOfItsShards) {
  run_shards(2, {plan(), "--repetitions", "3", "--passes", "2"});
  const Outcome merged = succeeded(hullbench({"merge", "shard1", "shard2", "--out", "merged"}));
  EXPECT_EQ(read_json("merged/run.json").at("passes"), 2);
  const std::vector<json> rows = read_lines("merged/runs.jsonl");
  EXPECT_EQ(rows.size(), 12U);
  for (const json& row : rows) {
    EXPECT_EQ(row.at("passes"), (json{1, 1, 2}));
    EXPECT_EQ(row.at("rounds"), (json{0, 1, 2}));
    EXPECT_EQ(row.at("canary_ns").size(), 3U);
  }
  expect_valid_run("merged");
}

TEST_F(MergeTest, DoesNotDependOnTheOrderOfTheRuns) {
  run_shards(3, {plan()});
  change_header("shard2", [](json& header) {
    header["created"] = "2020-01-01T00:00:00Z";
    header["tool"]["binary_sha256"] = std::string(64, 'a');
  });
  ASSERT_EQ(hullbench({"merge", "shard3", "shard1", "shard2", "--out", "one"}).code, 0);
  ASSERT_EQ(hullbench({"merge", "shard2", "shard3", "shard1", "--out", "other"}).code, 0);
  for (const char* file : {"run.json", "runs.jsonl", "report.json", "tables.md"})
    EXPECT_EQ(read_text(folder() / "one" / file), read_text(folder() / "other" / file)) << file;
  const std::string tables = read_text(folder() / "one" / "tables.md");
  EXPECT_EQ(tables.find(", ms"), std::string::npos) << tables;
  expect_says(tables, "they were taken with 2 builds of the program (");
}

TEST_F(MergeTest, TellsWhereItsRowsCameFrom) {
  run_shards(2, {plan()});
  ASSERT_EQ(hullbench({"merge", "shard1", "shard2", "--out", "merged"}).code, 0);
  const json header = read_json("merged/run.json");
  EXPECT_TRUE(header.at("shard").is_null());
  ASSERT_EQ(header.at("merged").size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const json shard = read_json(folder() / ("shard" + std::to_string(i + 1)) / "run.json");
    for (const char* key : {"shard", "created", "resumed", "tool", "environment"})
      EXPECT_EQ(header["merged"][i].at(key), shard.at(key)) << key;
  }
}

TEST_F(MergeTest, MayBeMergedAgain) {
  run_shards(3, {plan()});
  // Begun within the same second, under different loads.
  for (int number = 1; number <= 3; ++number) {
    change_header("shard" + std::to_string(number), [&](json& header) {
      header["created"] = "2020-01-01T00:00:00Z";
      header["environment"]["load_average"] = {0.5 * number, 0.5, 0.5};
    });
  }
  ASSERT_EQ(hullbench({"merge", "shard1", "shard2", "shard3", "--out", "at_once"}).code, 0);
  for (int last = 1; last <= 3; ++last) {
    SCOPED_TRACE(last);
    std::vector<std::string> others = {"merge"};
    for (int number = 3; number >= 1; --number) {
      if (number != last) others.push_back("shard" + std::to_string(number));
    }
    const std::string two = "without" + std::to_string(last);
    const std::string in_turn = "in_turn" + std::to_string(last);
    others.insert(others.end(), {"--out", two});
    ASSERT_EQ(hullbench(others).code, 4);
    ASSERT_EQ(hullbench({"merge", "shard" + std::to_string(last), two, "--out", in_turn}).code, 0);
    for (const char* file : {"runs.jsonl", "run.json"})
      EXPECT_EQ(read_text(folder() / in_turn / file), read_text(folder() / "at_once" / file)) << file;
  }
}

TEST_F(MergeTest, WithoutAShardSaysHowManyRunsAreMissing) {
  run_shards(3, {plan()});
  const Outcome merged = expect_end(hullbench({"merge", "shard1", "shard3", "--out", "merged"}), 4,
                                    "4 of 12 planned runs are missing");
  expect_says(merged.out, "4 of 12 planned runs are missing");
  EXPECT_EQ(accuracy_lines(folder() / "merged").size(), 8U);
  expect_valid_run("merged");
}

TEST_F(MergeTest, OfNoRowIsNotWritten) {
  run("run", {plan()});
  write_text(folder() / "run" / "runs.jsonl", "");
  expect_refusal(hullbench({"merge", "run", "--out", "merged"}), 6, "none of the folders has a finished run");
  EXPECT_FALSE(fs::exists(folder() / "merged"));
}

TEST_F(MergeTest, OfSeveralMachinesHasNoTimesInItsTables) {
  run("whole", {plan()});
  run_shards(2, {plan()});
  move_to_machine("shard2", "ba5eba11");
  const Outcome merged = succeeded(hullbench({"merge", "shard1", "shard2", "--out", "merged"}));
  EXPECT_EQ(merged.out.find(", ms"), std::string::npos) << merged.out;
  EXPECT_EQ(merged.out.find("±"), std::string::npos) << merged.out;
  expect_says(merged.out, "Times are not shown: they were taken on 2 machines (");
  expect_says(merged.out, "Machine ba5eba11: ");
  EXPECT_EQ(accuracy_lines(folder() / "merged"), accuracy_lines(folder() / "whole"));
  EXPECT_EQ(accuracy_tables(folder() / "merged"), accuracy_tables(folder() / "whole"));
  std::set<std::string> machines;
  for (const json& line : read_lines("merged/runs.jsonl")) {
    machines.insert(line.at("machine").get<std::string>());
    EXPECT_EQ(line.at("time_ns").size(), 1U);
  }
  EXPECT_EQ(machines.size(), 2U);
  expect_valid_run("merged");
}

TEST_F(MergeTest, FillsInTheMachineOfOlderRows) {
  run_shards(2, {plan()});
  move_to_machine("shard2", "ba5eba11");
  change_rows("shard2", [](json& row) {
    row.erase("machine");
    row.erase("flags");
  });
  ASSERT_EQ(hullbench({"merge", "shard1", "shard2", "--out", "merged"}).code, 0);
  std::size_t moved = 0;
  for (const json& line : read_lines("merged/runs.jsonl"))
    if (line.at("machine") == "ba5eba11") ++moved;
  EXPECT_EQ(moved, read_lines("shard2/runs.jsonl").size());
}

TEST_F(MergeTest, OfTheSameRunTwiceTakesTheFirstThatSucceeded) {
  run("one", {plan()});
  run("other", {plan()});
  change_rows("one", [](json& row) {
    if (row.at("n") != 300) return;
    row["status"] = "timeout";
    row["detail"] = "no answer";
    row["time_ns"] = row["phases_ns"] = json::array();
    row["metrics"] = json::object();
    row["output_sha256"] = "";
  });
  change_header("one", [](json& header) { header["created"] = "2020-01-01T00:00:00Z"; });
  const Outcome merged = succeeded(hullbench({"merge", "other", "one", "--out", "merged"}));
  expect_says(merged.err, "12 were measured more than once");
  const auto one = read_lines("one/runs.jsonl");
  const auto other = read_lines("other/runs.jsonl");
  const auto both = read_lines("merged/runs.jsonl");
  ASSERT_EQ(both.size(), 12U);
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_EQ(both[i], one[i].at("n") == 300 ? other[i] : one[i]);
  }
}

TEST_F(MergeTest, OfDifferentResultsIsRefused) {
  run("one", {plan()});
  run("other", {plan()});
  for (const char* key : {"output_sha256", "metrics"}) {
    const std::string before = read_text(folder() / "other" / "runs.jsonl");
    change_rows("other", [&](json& row) {
      if (row.at("name") != "polylidar/ca/n:400/holes:1/protocol:paper") return;
      if (row[key].is_string()) row[key] = std::string(64, 'a');
      if (row[key].is_object()) row[key]["l2"] = 0.125;
    });
    expect_refusal(hullbench({"merge", "one", "other", "--out", "merged"}), 1,
                   "the run polylidar/ca/n:400/holes:1/protocol:paper has another result in");
    EXPECT_FALSE(fs::exists(folder() / "merged"));
    write_text(folder() / "other" / "runs.jsonl", before);
  }
  // Memory is no result.
  change_rows("other", [](json& row) { row["metrics"]["peak_memory_bytes"] = 12345; });
  EXPECT_EQ(hullbench({"merge", "one", "other", "--out", "merged"}).code, 0) << "and would do otherwise";
}

TEST_F(MergeTest, OfAnUnsteadyMethodIsNotRefused) {
  run("one", {plan()});
  run("other", {plan()});
  for (const char* name : {"one", "other"}) {
    change_rows(name, [&](json& row) {
      if (row.at("method") != "polylidar") return;
      row["status"] = "invalid_output";
      row["detail"] = "two runs on the same points gave different results";
      row["output_sha256"] = std::string(64, name[1] == 'n' ? 'a' : 'b');
    });
  }
  const Outcome merged = hullbench({"merge", "one", "other", "--out", "merged"});
  EXPECT_EQ(merged.code, 4) << "its rows are failures: " << merged.err;
  EXPECT_EQ(accuracy_lines(folder() / "merged").size(), 12U);
}

TEST_F(MergeTest, OfOtherDataOrRulesIsRefused) {
  run_shards(2, {plan()});
  const std::string before = read_text(folder() / "shard2" / "run.json");
  const auto refusal = [&](const auto& change) {
    change_header("shard2", change);
    Outcome outcome = hullbench({"merge", "shard1", "shard2", "--out", "merged"});
    write_text(folder() / "shard2" / "run.json", before);
    return outcome;
  };
  const std::string data = "shard1 and shard2 have another data set ca each";
  expect_refusal(refusal([](json& run) { run["datasets"][0]["sha256"] = std::string(64, 'a'); }), 2, data);
  expect_refusal(refusal([](json& run) { run["datasets"][0]["source"] = "elsewhere"; }), 2, data);
  expect_refusal(refusal([](json& run) { run["datasets"][0]["area"] = 1.5; }), 2, data);
  expect_refusal(refusal([](json& run) { run["rules"]["paper_alpha"] = "1"; }), 2,
                 "shard1 and shard2 have another rule paper_alpha each");
  EXPECT_EQ(refusal([](json& run) { run["datasets"][0]["title"] = "CA"; }).code, 0);
}

TEST_F(MergeTest, OfRunsThatDoNotBelongTogetherIsRefused) {
  run("run", {plan()});
  run("other", {plan("other")});
  run("seed", {plan(), "--seed", "7"});
  run("filter", {plan(), "--filter", "n:300"});
  run("repetitions", {plan(), "--repetitions", "2"});
  run("passes", {plan(), "--passes", "2"});
  const auto merge = [&](const std::string& with) {
    return hullbench({"merge", "run", with, "--out", "merged"});
  };
  expect_refusal(merge("other"), 2, "differ in their plan's name (\"");
  expect_refusal(merge("seed"), 2, "differ in their plan's seed (");
  expect_refusal(merge("filter"), 2, "differ in their filter (");
  expect_refusal(merge("repetitions"), 2, "differ in their plan's repetitions (");
  expect_refusal(merge("passes"), 2, "differ in their plan's passes (");
  write_text(folder() / "filter" / "run.json", R"({"schema_version": 99})");
  expect_refusal(merge("filter"), 2, "filter/run.json is of another schema version");
  EXPECT_FALSE(fs::exists(folder() / "merged"));
}

TEST_F(MergeTest, OfTwoVersionsOfAMethodIsRefused) {
  run_shards(2, {plan()});
  change_header("shard2", [](json& header) {
    for (json& method : header["methods"]) {
      if (method["name"] == "cgal_alpha_shape") method["version"] = "0.0";
    }
  });
  const Outcome outcome = hullbench({"merge", "shard1", "shard2", "--out", "merged"});
  expect_refusal(outcome, 2, "cgal_alpha_shape is of version ");
  expect_says(outcome.err, "and of version 0.0 in shard2");
}

TEST_F(MergeTest, TakesAMethodFromWhereItIsInstalled) {
  run("one", {plan()});
  run("other", {plan()});
  change_header("one", [](json& header) {
    for (json& method : header["methods"]) {
      if (method["name"] != "cgal_alpha_shape") continue;
      method["installed"] = false;
      method["version"] = "";
      method["detail"] = "it is not here";
    }
  });
  change_rows("one", [](json& row) {
    if (row.at("method") != "cgal_alpha_shape") return;
    row["status"] = "not_installed";
    row["method_version"] = row["output_sha256"] = "";
    row["time_ns"] = row["phases_ns"] = json::array();
    row["metrics"] = json::object();
    row["id"] = std::string(64, 'b');
  });
  ASSERT_EQ(hullbench({"merge", "one", "other", "--out", "merged"}).code, 0);
  EXPECT_EQ(accuracy_lines(folder() / "merged"), accuracy_lines(folder() / "other"));
  EXPECT_EQ(read_json("merged/run.json").at("methods"), read_json("other/run.json").at("methods"));
}

TEST_F(MergeTest, WritesToAFolderWithSomethingInItByForceOnly) {
  run_shards(2, {plan()});
  fs::create_directory(folder() / "merged");
  write_text(folder() / "merged" / "thesis.tex", "precious");
  expect_refusal(hullbench({"merge", "shard1", "shard2", "--out", "merged"}), 2, "merged is not empty");
  EXPECT_EQ(hullbench({"merge", "shard1", "shard2", "--out", "merged", "--force"}).code, 0);
  EXPECT_EQ(hullbench({"merge", "shard1", "shard2", "--out", "merged", "--force"}).code, 0);
  EXPECT_EQ(read_text(folder() / "merged" / "thesis.tex"), "precious");
  EXPECT_EQ(accuracy_lines(folder() / "merged").size(), 12U);
  expect_refusal(hullbench({"merge", "shard1", "shard2", "--out", "./shard2", "--force"}), 2,
                 "one of the runs to be merged");
  for (const char* out : {"shard2/merged", ".", "shard2/"}) {
    expect_refusal(hullbench({"merge", "shard1", "shard2", "--out", out, "--force"}), 2,
                   "one of the runs to be merged");
  }
  EXPECT_FALSE(fs::exists(folder() / "shard2" / "merged"));
  EXPECT_EQ(hullbench({"merge", "shard1", "shard2", "--out", "shard2_too"}).code, 0) << "that is beside it";
  EXPECT_EQ(hullbench({"run", plan(), "--out", "merged"}).code, 2) << "it is no run to go on with";
}

TEST_F(MergeTest, WithoutOutIsRefusedWithAHintForEveryCommand) {
  expect_refusal(hullbench({"merge", "shard1"}), 2, "'hullbench merge --help' shows what there is");
}

TEST_F(MergeTest, OfSuitesIsASuite) {
  // Of the second plan, which has one case, only one shard has anything.
  const std::string one_case = write(small_plan("second", {{{"dataset", "ca"}, {"n", {300}}}}, 1));
  run("whole", {plan("first"), one_case});
  run_shards(2, {plan("first"), one_case});
  EXPECT_TRUE(fs::exists(folder() / "shard1" / "second"));
  EXPECT_FALSE(fs::exists(folder() / "shard2" / "second"));
  const Outcome merged = succeeded(hullbench({"merge", "shard2", "shard1", "--out", "merged"}));
  for (const char* name : {"first", "second"}) {
    EXPECT_EQ(accuracy_lines(folder() / "merged" / name), accuracy_lines(folder() / "whole" / name));
    expect_valid_run(std::string("merged/") + name);
  }
  EXPECT_EQ(accuracy_tables(folder() / "merged"), accuracy_tables(folder() / "whole"));
  EXPECT_EQ(read_json("merged/suite.json").at("plans"), json({"first", "second"}));
  EXPECT_EQ(hullbench({"tables", "merged"}).out, merged.out);
  expect_refusal(hullbench({"merge", "shard1", "shard1/first", "--out", "mixed"}), 2,
                 "some of the folders hold a run and some a suite");
  expect_refusal(hullbench({"merge", "shard1", "--out", "whole/first", "--force"}), 2, "first holds a run");
  expect_refusal(hullbench({"merge", "whole/first", "--out", "merged", "--force"}), 2,
                 "merged holds a suite");
  EXPECT_FALSE(fs::exists(folder() / "whole" / "first" / "suite.json"));
}

class ShardTest : public MergeTest {};

TEST_F(ShardTest, ADryRunNamesItsRuns) {
  std::multiset<std::string> names;
  for (const char* shard : {"1/2", "2/2"}) {
    const Outcome outcome = succeeded(hullbench({"run", plan(), "--dry-run", "--shard", shard}));
    EXPECT_EQ(std::ranges::count(outcome.out, '\n'), 6) << outcome.out;
    names.insert(outcome.out);
  }
  std::string all = hullbench({"run", plan(), "--dry-run"}).out;
  EXPECT_EQ(all.size(), names.begin()->size() + names.rbegin()->size());
  EXPECT_NE(*names.begin(), *names.rbegin());
}

TEST_F(ShardTest, ThatCannotBeIsRefused) {
  for (const char* shard : {"0/2", "3/2", "2", "one/two", ""}) {
    expect_refusal(hullbench({"run", plan(), "--shard", shard, "--out", "run"}), 2, "is no shard; give");
  }
  EXPECT_FALSE(fs::exists(folder() / "run"));
}

TEST_F(ShardTest, WithoutACaseIsNotBegun) {
  expect_refusal(hullbench({"run", plan(), "--shard", "7/7", "--out", "run"}), 6,
                 "the plan 'small' has too few cases for shard 7/7");
  EXPECT_FALSE(fs::exists(folder() / "run"));
}

TEST_F(ShardTest, IsGoneOnWithAsItselfOnly) {
  run("shard", {plan(), "--shard", "1/2"});
  const std::string rows = read_text(folder() / "shard" / "runs.jsonl");
  run("shard", {plan(), "--shard", "1/2"});
  EXPECT_EQ(read_text(folder() / "shard" / "runs.jsonl"), rows);
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"--shard", "2/2"}, {"--shard", "1/3"}, {}}) {
    expect_refusal(hullbench(joined({"run", plan(), "--out", "shard"}, other)), 2, "holds another run");
  }
}

}  // namespace
}  // namespace hullbench::testing
