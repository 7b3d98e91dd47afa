// Kept polygons that are scored again, and methods that are handed in.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/sha256.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

/// The rows without what is measured.
json untimed(std::vector<json> rows) {
  for (json& row : rows) {
    for (const char* key : {"time_ns", "phases_ns", "rounds", "passes", "canary_ns"}) row.erase(key);
  }
  return rows;
}

class RescoreTest : public HullbenchTest {
 protected:
  /// A run of two cases in `kept`.
  void SetUp() override {
    const std::string plan = write(small_plan("small", california({500})));
    succeeded(hullbench({"run", plan, "--keep-polygons", "--out", "kept"}));
  }
};

TEST_F(RescoreTest, GivesTheSameScores) {
  expect_end(hullbench({"rescore", "kept", "--out", "again"}), 0, "2 of 2 rows have new scores");
  EXPECT_EQ(read_lines("again/runs.jsonl"), read_lines("kept/runs.jsonl"));
  EXPECT_TRUE(read_json("again/run.json").contains("rescored"));
  expect_valid("again/run.json");
  expect_valid("again/report.json");
  // What was rescored can be rescored.
  EXPECT_EQ(hullbench({"rescore", "again", "--out", "thrice"}).code, 0);
}

TEST_F(RescoreTest, ScoresThatAreMissingOrWrongAreMended) {
  const json before = read_lines("kept/runs.jsonl");
  change_rows("kept", [](json& row) {
    row["metrics"]["l2"] = 0.5;
    row["metrics"].erase("hausdorff");
    row["flags"].push_back("worse_than_convex_hull");
  });
  succeeded(hullbench({"rescore", "kept", "--out", "again"}));
  EXPECT_EQ(json(read_lines("again/runs.jsonl")), before);
}

TEST_F(RescoreTest, ARowThatOnlyItsScoreMadeAFailureIsMended) {
  const json before = read_lines("kept/runs.jsonl");
  change_rows("kept", [](json& row) {
    row["status"] = "invalid_output";
    row["detail"] = "the result is an invalid polygon: Self-intersection";
  });
  succeeded(hullbench({"rescore", "kept", "--out", "again"}));
  EXPECT_EQ(json(read_lines("again/runs.jsonl")), before);
}

TEST_F(RescoreTest, NeedsPolygonsAndPointsOfTheRow) {
  change_rows("kept", [](json& row) { row["dataset_sha256"] = std::string(64, '0'); });
  expect_refusal(hullbench({"rescore", "kept", "--out", "again"}), 2, "are not those that were measured");
  EXPECT_FALSE(fs::exists(folder() / "again"));
  for (const auto& entry : fs::directory_iterator(folder() / "kept" / "polygons"))
    write_text(entry.path(), "x");
  expect_end(hullbench({"rescore", "kept", "--out", "again"}), 2, "its hash is not its name");
  fs::remove_all(folder() / "kept" / "polygons");
  expect_end(hullbench({"rescore", "kept", "--out", "again"}), 6, "no polygons were kept in kept");
  expect_refusal(hullbench({"rescore", "nowhere", "--out", "again"}), 2, "there is no run in nowhere");
  expect_refusal(hullbench({"rescore", "kept", "--out", "kept"}), 2, "--out");
}

TEST_F(RescoreTest, OfASuiteIsASuite) {
  const std::string one = write(small_plan("one", california({300})));
  const std::string two = write(small_plan("two", california({400})));
  ASSERT_EQ(hullbench({"run", one, two, "--keep-polygons", "--out", "both"}).code, 0);
  succeeded(hullbench({"rescore", "both", "--out", "again"}));
  for (const char* name : {"one", "two"}) {
    EXPECT_EQ(untimed(read_lines(fs::path("again") / name / "runs.jsonl")),
              untimed(read_lines(fs::path("both") / name / "runs.jsonl")));
  }
}

class SubmissionTest : public HullbenchTest {
 protected:
  // What hullbench_worker.py needs.
  void SetUp() override {
    const std::string why = missing({SYSTEM_PYTHON ":numpy"});
    if (!why.empty()) GTEST_SKIP() << why;
    ASSERT_EQ(hullbench({"adapter", "new", "my_hull", "--lang", "python", "--out", "methods"}).code, 0);
    // Debian's Python, which has numpy.
    change_json("methods/my_hull.json", [](json& manifest) { manifest["command"][0] = SYSTEM_PYTHON; });
  }

  fs::path pack() const { return folder() / "pack"; }

  /// Expects that what `change` makes of the pack is refused with this sentence, though submission.json knows
  /// of it, and leaves the pack as it was.
  void expect_fault(const std::string& sentence, const std::function<void()>& change,
                    bool is_packed_again = true) const {
    SCOPED_TRACE(sentence);
    fs::copy(pack(), folder() / "kept", fs::copy_options::recursive);
    change();
    if (is_packed_again) pack_again();
    const Outcome outcome = expect_end(hullbench({"submit", "check", "pack"}), 1, "", "FAIL: ");
    expect_says(outcome.out, sentence);
    EXPECT_EQ(outcome.out.find("| Method"), std::string::npos) << "no table of what was not checked";
    fs::remove_all(pack());
    fs::rename(folder() / "kept", pack());
  }

  /// Lets submission.json say what is in the folder now.
  void pack_again() const {
    json submission = read_json("pack/submission.json");
    submission["files"] = json::object();
    for (const auto& entry : fs::recursive_directory_iterator(pack())) {
      const std::string file = entry.path().lexically_relative(pack()).generic_string();
      if (entry.is_regular_file() && file != "submission.json")
        submission["files"][file] = sha256_file(entry.path());
    }
    write_text(pack() / "submission.json", submission.dump());
  }

  void change_rows_of_pack(const std::function<void(json&)>& change) const {
    change_rows("pack/run", [&](json& row) {
      if ("my_hull" == row["method"].get<std::string>()) change(row);
    });
  }

  void change_run(const std::function<void(json&)>& change) const {
    change_json("pack/run/run.json", change);
  }
};

// In one, as making a pack takes its time.
TEST_F(SubmissionTest, APackIsTakenAndWhatIsWrongWithItIsFound) {
  const Outcome packed =
      succeeded(hullbench({"submit", "pack", "my_hull", "--adapters", "methods", "--out", "pack"},
                          {{}, {}, false, std::chrono::minutes(5)}));
  const Outcome outcome = hullbench({"submit", "check", "pack"});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out.find("FAIL"), std::string::npos);
  expect_says(outcome.out, "my_hull (handed in)");
  expect_valid("pack/submission.json");
  expect_valid("pack/run/report.json");
  EXPECT_TRUE(fs::exists(pack() / "method" / "my_hull.json"));
  EXPECT_TRUE(fs::exists(pack() / "method" / "my_hull_worker.py"));
  const json run = read_json("pack/run/run.json");
  for (const json& method : run.at("methods"))
    EXPECT_EQ(method.contains("division"), "my_hull" == method["name"].get<std::string>());
  EXPECT_EQ(read_lines("pack/run/runs.jsonl").size(), 150U);
  expect_refusal(hullbench({"submit", "pack", "my_hull", "--adapters", "methods", "--out", "pack"}), 2,
                 "is not empty");

  // Files.
  const fs::path rows = pack() / "run" / "runs.jsonl";
  expect_fault(
      "extra.txt was not packed", [&] { write_text(pack() / "extra.txt", "new"); }, false);
  expect_fault(
      "run/runs.jsonl was changed", [&] { change_rows_of_pack([](json& row) { row["n"] = 1; }); }, false);
  const std::string polygons =
      fs::directory_iterator(pack() / "run" / "polygons")->path().filename().string();
  expect_fault(
      "run/polygons/" + polygons + " is missing", [&] { fs::remove(pack() / "run" / "polygons" / polygons); },
      false);
  expect_fault("rows have a result whose polygons are not there",
               [&] { fs::remove(pack() / "run" / "polygons" / polygons); });
  expect_fault("other.txt is no file", [&] { fs::create_symlink("/etc/hostname", pack() / "other.txt"); });
  expect_fault("has other characters", [&] { write_text(pack() / "a b", ""); });
  expect_fault("the run is a suite", [&] { write_text(pack() / "run" / "suite.json", "{}"); });
  expect_fault(
      "submission.json is no submission", [&] { write_text(pack() / "submission.json", "{\"kind\": 7}"); },
      false);
  expect_fault(
      "submission.json is not JSON", [&] { write_text(pack() / "submission.json", "{"); }, false);
  expect_fault(
      "nested too deeply", [&] { write_text(pack() / "submission.json", std::string(100'000, '[')); }, false);
  expect_fault("has a text of more than",
               [&] { change_run([](json& one) { one["plan"]["title"] = std::string(100'000, 'x'); }); });
  // Plan and rows.
  expect_fault("its seed are not those", [&] { change_run([](json& one) { one["plan"]["seed"] = 2; }); });
  expect_fault("its accepted are not those",
               [&] { change_run([](json& one) { one["plan"]["accepted"] = {"error"}; }); });
  expect_fault("the method has datasets of its own", [&] {
    change_run([](json& one) {
      for (json& entry : one["plan"]["methods"]) {
        if ("my_hull" == entry["method"].get<std::string>()) entry["datasets"] = {"country-14"};
      }
    });
  });
  expect_fault("protocol:default is missing", [&] {
    const std::string text = read_text(rows);
    write_text(rows, text.substr(text.find('\n') + 1));
  });
  expect_fault("is not the row that its name says",
               [&] { change_rows_of_pack([](json& row) { row["seed"] = 5; }); });
  // Who made it.
  expect_fault("that it was handed in", [&] {
    change_run([](json& one) {
      for (json& method : one["methods"]) method.erase("division");
    });
  });
  // Scores.
  expect_fault(", not 0.001", [&] { change_rows_of_pack([](json& row) { row["metrics"]["l2"] = 0.001; }); });
  expect_fault("has hausdorff",
               [&] { change_rows_of_pack([](json& row) { row["metrics"]["hausdorff"] = 0.001; }); });
}

TEST_F(SubmissionTest, WhatCannotBePacked) {
  expect_refusal(hullbench({"submit", "check", "nowhere"}), 2, "there is no nowhere/submission.json");
  expect_refusal(hullbench({"submit", "pack", "polylidar", "--out", "other"}), 2,
                 "there is nothing to hand in");
  expect_refusal(hullbench({"submit", "pack", "chi_shape", "--out", "other"}), 2,
                 "there is nothing to hand in");
  expect_refusal(hullbench({"submit", "pack", "magic", "--out", "other"}), 2, "magic");
  change_json("methods/my_hull.json", [](json& manifest) { manifest["runs"][0]["timeout_s"] = 3; });
  expect_refusal(hullbench({"submit", "pack", "my_hull", "--adapters", "methods", "--out", "other"}), 2,
                 "timeout_s of its own");
  EXPECT_FALSE(fs::exists(folder() / "other"));
}

}  // namespace
}  // namespace hullbench::testing
