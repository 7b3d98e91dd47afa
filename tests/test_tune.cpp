// `hullbench tune` as its users meet it: made-up methods whose best is known, failures, interruptions,
// shards, and the plan it writes measured by `hullbench run`.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "datasets/datasets.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

constexpr int kCorners = 64;

/// The polygon that the made-up method `disc` answers with.
MultiPolygon disc(const std::vector<Point>& points, double radius) {
  Point centre = {0, 0};
  for (const Point& point : points) {
    centre.x += point.x / static_cast<double>(points.size());
    centre.y += point.y / static_cast<double>(points.size());
  }
  Ring ring;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    ring.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return {{ring, {}}};
}

class TuneTest : public HullbenchTest {
 protected:
  void SetUp() override {
    const std::string why = missing({SYSTEM_PYTHON ":numpy"});
    if (!why.empty()) GTEST_SKIP() << why;
    fs::create_directories(methods());
    method("disc", R"([{"name": "radius", "unit": "length", "description": "Of the disc.", "minimum": 0,
                        "maximum": null, "default": 1}])",
           "def run(points, radius):\n"
           "    with open('" +
               calls().string() +
               "', 'a') as calls: calls.write('x')\n"
               "    angles = 2 * math.pi * numpy.arange(64) / 64\n"
               "    ring = points.mean(axis=0) + radius * numpy.stack([numpy.cos(angles), "
               "numpy.sin(angles)], 1)\n"
               "    return [[ring]]\n");
  }

  /// A method in Python, for which a manifest is written.
  void method(const std::string& name, const std::string& parameters, const std::string& run,
              bool holes = false) const {
    const json manifest = {{"manifest_version", 1},
                           {"name", name},
                           {"title", name},
                           {"licence", "MIT"},
                           {"citation", "a test"},
                           {"native_output", "a ring"},
                           {"parameters", json::parse(parameters)},
                           {"capabilities", {{"holes", holes}, {"several_polygons", false}}},
                           {"command", {SYSTEM_PYTHON, "./" + name + ".py"}}};
    write_text(methods() / (name + ".json"), manifest.dump());
    write_text(methods() / (name + ".py"),
               "import sys\nsys.path.insert(0, '" HULLBENCH_SOURCE_DIRECTORY
               "/adapters/process')\nimport hullbench_worker\nimport math, numpy, os, time\n\n" +
                   run + "\nhullbench_worker.serve(version='1', run=run)\n");
  }

  std::vector<std::string> tune_words(const std::string& plan, const std::string& methods_expression,
                                      const std::string& out,
                                      const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"tune",  plan,           "--methods",  methods_expression,
                                      "--out", folder() / out, "--adapters", methods()};
    return joined(std::move(words), more);
  }

  Outcome tune(const std::string& plan, const std::string& methods_expression, const std::string& out,
               const std::vector<std::string>& more = {}) const {
    return hullbench(tune_words(plan, methods_expression, out, more));
  }

  std::string plan(const json& cases) const { return write(small_plan("small", cases)); }

  json summary(const std::string& out) const { return read_json(out + "/tune.json"); }
  std::vector<json> sweep(const std::string& out) const { return read_lines(out + "/sweep.jsonl"); }

  /// A byte for every call of `disc`.
  fs::path calls() const { return folder() / "calls"; }
  fs::path methods() const { return folder() / "methods"; }
};

const json& method_of(const json& summary, const std::string& name) {
  for (const json& method : summary.at("methods")) {
    if (method.at("method") == name) return method;
  }
  throw std::out_of_range("no method " + name);
}

/// Training shapes, and as many test shapes.
json both_sides(int members) {
  return json::array({{{"dataset", {"star", "country"}}, {"members", members}, {"n", {200}}}});
}

TEST_F(TuneTest, FindsTheBestOfAMadeUpMethod) {
  const Outcome tuned =
      succeeded(tune(plan(json::array({{{"dataset", "ca"}, {"n", {300}}}})), "disc", "out"));
  EXPECT_EQ(tuned.out, read_text(folder() / "out" / "tuning.md"));
  const PointSet set = make_point_set("ca", false, 300, 1);
  double best = 2;
  for (int step = -300; step <= 500; ++step) {
    const double octave = 0.01 * step;
    const double radius = plan::mean_spacing(set.points) * std::exp2(octave);
    best = std::min(best, metrics::area_scores(disc(set.points, radius), set.ground_truth).l2.value_or(2));
  }
  const json oracle = method_of(summary("out"), "disc").at("oracle").at(0);
  // The refinement ends within 0.18 octaves, its best is the middle of it or nearer, and the slope is
  // below 1.
  EXPECT_NEAR(oracle.at("l2").get<double>(), best, 0.09);
  EXPECT_EQ(sweep("out").size(), 9U + 6U + 1U) << "the sweep, the refinement and the default";
  for (const json& line : sweep("out")) EXPECT_LE(oracle.at("l2"), line.at("metrics").at("l2"));
  expect_valid("out/tune.json");
  expect_valid("out/sweep.jsonl");
}

TEST_F(TuneTest, TheSchemasRefuseWhatIsWrong) {
  ASSERT_EQ(tune(plan(both_sides(1)), "disc", "out").code, 0);
  json broken = summary("out");
  broken["methods"][0]["curve"][0]["relative"]["median"] = "good";
  write_text(folder() / "broken.json", broken.dump());
  json line = sweep("out").front();
  line["side"] = "left";
  write_text(folder() / "broken.jsonl", line.dump() + "\n");
  EXPECT_EQ(hullbench({"validate", "broken.json"}).code, 1);
  EXPECT_EQ(hullbench({"validate", "broken.jsonl"}).code, 1);
}

TEST_F(TuneTest, ItsPlanMeasuresWhatItFound) {
  const Outcome tuned = succeeded(tune(plan(both_sides(3)), "polylidar|disc", "out"));
  const Outcome run = succeeded(hullbench({"run", folder() / "out" / "small-tuned.json", "--out",
                                           folder() / "run", "--adapters", methods(), "--repetitions", "1"}));
  std::map<std::string, std::pair<double, std::string>> found;  // l2 and hash of the polygon
  std::set<std::string> tested;
  for (const json& line : sweep("out")) {
    for (const json& protocol : line.at("protocols")) {
      found[line.at("method").get<std::string>() + "/" + line.at("name").get<std::string>() + "/protocol:" +
            protocol.get<std::string>()] = {line.at("metrics").at("l2"), line.at("output_sha256")};
    }
    if (line.at("side") == "test") tested.insert(line.at("dataset"));
  }
  ASSERT_FALSE(tested.empty());
  ASSERT_LT(tested.size(), 6U);
  const auto rows = read_lines("run/runs.jsonl");
  std::set<std::string> measured;
  for (const json& row : rows) {
    ASSERT_TRUE(found.contains(row.at("name"))) << row.at("name");
    measured.insert(row.at("name"));
    EXPECT_EQ(row.at("metrics").at("l2"), found.at(row.at("name")).first) << row.at("name");
    EXPECT_EQ(row.at("output_sha256"), found.at(row.at("name")).second) << row.at("name");
    EXPECT_TRUE(row.at("protocol") != "tuned" || tested.contains(row.at("dataset"))) << row.at("name");
  }
  EXPECT_EQ(measured.size(), found.size());
  EXPECT_TRUE(found.contains("polylidar/country-1/n:200/holes:0/protocol:paper"));
  EXPECT_TRUE(found.contains("disc/country-1/n:200/holes:0/protocol:default"))
      << "which the plan does not name";
  EXPECT_FALSE(found.contains("polylidar/country-1/n:200/holes:0/protocol:default"))
      << "the plan names polylidar, and no default of it";
}

TEST_F(TuneTest, TheLeagueIsTheSameAgainFromTheRowsThatAreKept) {
  ASSERT_EQ(tune(plan(json::array({{{"dataset", {"star-1", "country-1", "symbol-1", "country-2~lattice:0"}},
                                    {"n", {200}}}})),
                 "polylidar|disc", "out")
                .code,
            0)
      << "star-1 is for training";
  succeeded(
      hullbench({"run", folder() / "out" / "small-tuned.json", write(small_plan("other", both_sides(1))),
                 "--out", folder() / "suite", "--adapters", methods(), "--repetitions", "1"}));
  const Outcome league = succeeded(hullbench({"league", "suite", "--out", "league.json"}));
  expect_valid("league.json");
  expect_says(league.out, "lattice †");
  const std::string keep = SYSTEM_PYTHON " " HULLBENCH_SOURCE_DIRECTORY "/results/keep_league.py ";
  // NOLINTNEXTLINE(cert-env33-c): the command line is the test's own
  ASSERT_EQ(std::system((keep + (folder() / "suite").string() + " " + (folder() / "kept").string()).c_str()),
            0);
  EXPECT_EQ(hullbench({"league", "kept"}).out, league.out);
  for (const auto& run : fs::directory_iterator(folder() / "kept")) {
    if (!run.is_directory()) continue;
    expect_valid((run.path() / "run.json").string());
    expect_valid((run.path() / "runs.jsonl.xz").string());
  }
}

TEST_F(TuneTest, AMethodWithoutANumberHasItsDefaultOnly) {
  ASSERT_EQ(tune(plan(both_sides(2)), "convex_hull", "out").code, 0);
  const json method = method_of(summary("out"), "convex_hull");
  EXPECT_TRUE(method.at("axis").is_null());
  EXPECT_TRUE(method.at("tuned").is_null());
  for (const json& score : method.at("protocols")) {
    EXPECT_EQ(score.at("protocol"), "default");
    EXPECT_TRUE(score.at("regret_median").is_null());
  }
  EXPECT_EQ(sweep("out").size(), 2U) << "of the test cases";
}

TEST_F(TuneTest, AMethodThatAPlanDoesNotWantSearchedKeepsWhatThePlanHas) {
  json plan = small_plan("small", both_sides(2));
  plan["methods"] = json::array();
  plan["methods"].push_back({{"method", "disc"},
                             {"protocol", "default"},
                             {"parameters", {{"radius", 0.3}}},
                             {"note", "its own"},
                             {"search", false}});
  ASSERT_EQ(tune(write(plan), "disc", "out").code, 0);
  const json method = method_of(summary("out"), "disc");
  EXPECT_TRUE(method.at("axis").is_null());
  EXPECT_TRUE(method.at("tuned").is_null());
  EXPECT_EQ(sweep("out").size(), 2U) << "of the test cases";
  const json tuned = read_json("out/small-tuned.json");
  ASSERT_EQ(tuned.at("methods").size(), 1U);
  for (const char* key : {"protocol", "parameters", "search"})
    EXPECT_EQ(tuned.at("methods")[0].at(key), plan.at("methods")[0].at(key)) << key;
}

TEST_F(TuneTest, AValueIsChosenOnCasesThatTheMethodCanMatch) {
  const json cases = {{{"dataset", {"star", "parts"}}, {"members", 3}, {"n", {200}}},
                      {{"dataset", "country-1"}, {"n", {200}}}};
  succeeded(tune(plan(cases), "disc", "out"));
  const json method = method_of(summary("out"), "disc");
  EXPECT_EQ(method.at("tuned").at("training_cases"), 3) << "a disc is no several parts";
  EXPECT_EQ(method.at("rounds").back().at("cases"), 3);
  for (const json& line : sweep("out"))
    EXPECT_NE(line.at("dataset").get<std::string>().substr(0, 5), "parts");
  expect_valid("out/tune.json");
}

/// Of a disc that becomes nearly nothing under a condition.
std::string shrinking_disc(const std::string& parameters, const std::string& condition) {
  return "def run(points, " + parameters + "):\n    if " + condition +
         ": radius = 1e-6\n"
         "    angles = 2 * math.pi * numpy.arange(64) / 64\n"
         "    return [[points.mean(axis=0) + radius * numpy.stack([numpy.cos(angles), numpy.sin(angles)], "
         "1)]]\n";
}

TEST_F(TuneTest, HolesAreSwitchedOffWhereThatIsBetter) {
  method("reluctant", R"([{"name": "radius", "unit": "length", "description": "Of the disc.", "minimum": 0,
                           "maximum": null, "default": 1},
                          {"name": "allow_holes", "unit": "switch", "description": "Breaks it.", "minimum": 0,
                           "maximum": 1, "default": 0}])",
         shrinking_disc("radius, allow_holes", "allow_holes"), true);
  succeeded(tune(plan(both_sides(2)), "reluctant", "out"));
  const json found = method_of(summary("out"), "reluctant");
  EXPECT_EQ(found.at("tuned").at("fixed"), (json{{"allow_holes", 0}}));
  EXPECT_LT(found.at("tuned").at("training_median"), 0.9);
  for (const json& choice :
       found.at("oracle"))  // the middle of the points may lie outside, where no disc is good
    EXPECT_TRUE(choice.at("parameters").at("allow_holes") == 0 || choice.at("l2") > 0.99) << choice;
  for (const json& round : found.at("rounds"))
    EXPECT_EQ(round.at("scores").size(), round.at("scores_without_holes").size());
  for (const json& entry : read_json("out/small-tuned.json").at("methods")) {
    if (entry.at("protocol") != "tuned") continue;
    EXPECT_EQ(entry.at("parameters").at("allow_holes"), 0);
  }
  expect_valid("out/tune.json");
}

TEST_F(TuneTest, WhatAutoChoosesIsSearchedBesideItsNumbers) {
  method("two", R"([{"name": "power", "unit": "1", "description": "0, or it breaks.", "minimum": 0,
                     "maximum": null, "default": 2},
                    {"name": "radius", "unit": "length", "description": "Of the disc.", "minimum": 0,
                     "maximum": null, "default": 1}])",
         shrinking_disc("power, radius", "power > 0"));
  json source = small_plan("small", both_sides(2));
  source["methods"] =
      json::array({{{"method", "two"},
                    {"protocol", "auto"},
                    {"parameters", {{"power", 0}, {"radius", {{"rule", "auto_edge_length"}}}}}}});
  source["methods"].push_back({{"method", "polylidar"},
                               {"protocol", "auto"},
                               {"parameters", {{"alpha", {{"rule", "auto_circumradius"}}}}}});
  succeeded(tune(write(source), "two|polylidar", "out"));
  const json found = method_of(summary("out"), "two");
  EXPECT_EQ(found.at("axis").at("parameter"), "radius");
  EXPECT_EQ(found.at("fixed"), (json{{"power", 0}}));
  EXPECT_LT(found.at("tuned").at("training_median"), 0.9);
  for (const json& choice : found.at("oracle")) EXPECT_EQ(choice.at("parameters").at("power"), 0);
  EXPECT_EQ(method_of(summary("out"), "polylidar").at("axis").at("parameter"), "max_perimeter")
      << "there are no numbers, so it is the usual axis";
}

TEST_F(TuneTest, FailuresAreEvaluationsAndInfinitelyBad) {
  method("moody", R"([{"name": "radius", "unit": "length", "description": "Of the disc.", "minimum": 0,
                       "maximum": null}])",
         "def run(points, radius):\n"
         "    if len(points) == 201: os.abort()\n"
         "    if radius > 3 * abs(points).max(): os.abort()\n"
         "    c = points.mean(axis=0)\n"
         "    if len(points) == 202: return [[[c, c + [radius, radius], c + [radius, 0], c + [0, radius]]]]\n"
         "    return [[[c, c + [radius, 0], c + [radius, radius], c + [0, radius]]]]\n");
  const Outcome tuned =
      tune(plan(json::array({{{"dataset", "star"}, {"members", 4}, {"n", {200}}}})), "moody", "out");
  ASSERT_EQ(tuned.code, 0) << tuned.err << "a failure at some value is no failure of the method";
  const Outcome failing =
      tune(plan(json::array({{{"dataset", "star-1"}, {"n", {201}}}})), "moody", "failing");
  EXPECT_EQ(failing.code, 4) << failing.err;
  for (const json& line : sweep("failing")) {
    EXPECT_EQ(line.at("status"), "crash");
    EXPECT_EQ(line.at("detail"), "SIGABRT");
    EXPECT_TRUE(line.at("metrics").empty());
  }
  EXPECT_EQ(sweep("failing").size(), 25U);
  EXPECT_EQ(tune(plan(json::array({{{"dataset", "star-1"}, {"n", {202}}}})), "moody", "crossing").code, 4);
  const json crossing = sweep("crossing").front();
  EXPECT_EQ(crossing.at("status"), "invalid_output");
  EXPECT_TRUE(crossing.at("detail").get<std::string>().starts_with("the result is an invalid polygon: "));
  EXPECT_TRUE(crossing.at("metrics").empty());
  EXPECT_TRUE(method_of(summary("failing"), "moody").at("tuned").is_null());
  expect_valid("failing/tune.json");
  expect_valid("failing/sweep.jsonl");
}

TEST_F(TuneTest, WhatDoesNotStartIsSaidAndNothingElseIsExitCodeSix) {
  method("absent", "[]", "import no_such_module\n\ndef run(points):\n    return []\n");
  expect_end(tune(plan(both_sides(1)), "absent", "out"), 6, "absent does not start");
  EXPECT_FALSE(method_of(summary("out"), "absent").at("installed").get<bool>());
  expect_valid("out/tune.json");
}

TEST_F(TuneTest, GoesOnAfterAnInterruptionToTheSameResult) {
  const std::string cases = plan(both_sides(5));
  ASSERT_EQ(tune(cases, "disc|polylidar", "whole").code, 0);
  const auto calls_of_whole = fs::file_size(calls());
  const fs::path file = folder() / "parts" / "sweep.jsonl";
  {
    Program program(command(tune_words(cases, "disc|polylidar", "parts", {"--jobs", "1"})), in_folder());
    ASSERT_TRUE(wait_until([&] { return sweep("parts").size() > 60; }));
    program.send_signal(SIGINT);
    const Outcome outcome = program.wait();
    EXPECT_EQ(outcome.code, 130) << outcome.err;
  }
  const std::size_t kept = sweep("parts").size();
  ASSERT_LT(kept, sweep("whole").size()) << "it was over before the interruption";
  // As a kill leaves it.
  write_text(file, read_text(file) + R"({"dataset": "star)");
  expect_end(tune(cases, "disc|polylidar", "parts"), 0,
             std::to_string(kept) + " evaluations are there already");
  for (const char* name : {"sweep.jsonl", "tune.json", "tuning.md", "small-tuned.json"})
    EXPECT_EQ(read_text(folder() / "parts" / name), read_text(folder() / "whole" / name)) << name;
  // What was known was not evaluated again, but for the one that was interrupted.
  EXPECT_LE(fs::file_size(calls()), 2 * calls_of_whole + 1);
}

TEST_F(TuneTest, ShardsInOneFolderComeTogetherToTheSameResult) {
  const std::string cases = plan(both_sides(3));
  ASSERT_EQ(tune(cases, "disc|polylidar", "whole").code, 0);
  for (const char* shard : {"1/2", "2/2"}) {
    succeeded(tune(cases, "disc|polylidar", "parts", {"--shard", shard}));
  }
  EXPECT_FALSE(fs::exists(folder() / "parts" / "tune.json"));
  expect_valid("parts/sweep-1-of-2.jsonl");
  const auto calls_before = fs::file_size(calls());
  const Outcome all = tune(cases, "disc|polylidar", "parts");
  EXPECT_EQ(fs::file_size(calls()), calls_before) << "nothing is evaluated twice";
  ASSERT_EQ(all.code, 0) << all.err;
  expect_says(all.err, std::to_string(sweep("whole").size()) + " evaluations are there already");
  for (const char* name : {"sweep.jsonl", "tune.json", "tuning.md", "small-tuned.json"})
    EXPECT_EQ(read_text(folder() / "parts" / name), read_text(folder() / "whole" / name)) << name;
  EXPECT_EQ(
      tune(plan(json::array({{{"dataset", "ca"}, {"n", {200}}}})), "disc", "none", {"--shard", "2/2"}).code,
      6);
}

TEST_F(TuneTest, RefusesWhatItCannotDo) {
  const std::string cases = plan(both_sides(1));
  expect_refusal(tune(cases, "no_such_method", "out"), 2,
                 "no method has a name that matches 'no_such_method'");
  expect_refusal(tune(cases, "(", "out"), 2, "is not a regular expression");
  expect_refusal(tune("no_such_plan", "disc", "out"), 2, "there is no plan 'no_such_plan'");
  fs::create_directory(folder() / "old");
  write_text(folder() / "old" / "sweep-1-of-2.jsonl", R"({"kind": "evaluation", "case": "ca/n:200/holes:0"})"
                                                      "\n");
  expect_refusal(tune(cases, "disc", "old"), 2, "sweep-1-of-2.jsonl is not a run's record");
  write_text(folder() / "file", "");
  expect_refusal(tune(cases, "disc", "file"), 2, "cannot write to the output folder");
  const std::string nobodys = plan(json::array({{{"dataset", "star-1~lattice:0"}, {"n", {200}}}}));
  expect_refusal(tune(nobodys, "disc", "out"), 6, "no case is on a side of the split");
}

}  // namespace
}  // namespace hullbench::testing
