// The program as its users meet it: what it prints, its exit codes, bad input, bad circumstances and
// interruptions.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

class CommandLineTest : public HullbenchTest {
 protected:
  /// A plan file of polylidar on California; its path.
  std::string plan(const std::vector<int>& sizes, int repetitions) const {
    return write(small_plan("small", california(sizes), repetitions));
  }

  std::string write_plan(const std::string& text) const {
    write_text(folder() / "small.json", text);
    return (folder() / "small.json").string();
  }
};

void expect_no_repetition_twice(const fs::path& run, int repetitions) {
  std::set<std::pair<std::string, int>> seen;
  for (const json& line : record::load_json_lines(run / "repetitions.jsonl").lines) {
    EXPECT_TRUE(seen.emplace(line["id"].get<std::string>(), line["repetition"].get<int>()).second) << line;
  }
  for (const json& line : record::load_json_lines(run / "runs.jsonl").lines)
    EXPECT_EQ(line["time_ns"].size(), static_cast<std::size_t>(repetitions));
}

/// The lines below "Subcommands:" begin with their names.
std::vector<std::string> subcommands_in(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help);
  std::string line;
  const std::regex title("subcommands:", std::regex::icase);
  while (std::getline(lines, line) && !std::regex_match(line, title)) {
  }
  std::smatch found;
  while (std::getline(lines, line) && !line.empty()) {
    if (std::regex_search(line, found, std::regex("^  ([a-z]+)"))) names.push_back(found[1]);
  }
  return names;
}

/// What 'hullbench list' says where a server is named that is not there.
void expect_every_method_in(const std::string& listing) {
  const std::vector<std::string> names = run::MethodCatalog(run::manifest_folders({})).names();
  EXPECT_GT(names.size(), 20U);
  for (const std::string& name : names) expect_says(listing, "  " + name + "  ");
  expect_says(listing, "remedy: ");
}

TEST_F(CommandLineTest, EverySubcommandsHelpHasAnExample) {
  expect_says(succeeded(hullbench({"--help"})).out, "130  interrupted");
  succeeded(hullbench({"--version"}));
  // In their order, so that what one leaves another can take.
  std::vector<std::pair<std::string, std::string>> examples;
  std::vector<std::vector<std::string>> commands;
  for (const std::string& name : subcommands_in(hullbench({"--help"}).out)) {
    commands.push_back({name});
    for (const std::string& nested : subcommands_in(hullbench({name, "--help"}).out))
      commands.push_back({name, nested});
  }
  EXPECT_GE(commands.size(), 16U);
  for (std::vector<std::string> words : commands) {
    const std::string name = words.back();
    words.emplace_back("--help");
    const std::string help = succeeded(hullbench(words)).out;
    std::smatch found;
    ASSERT_TRUE(std::regex_search(help, found, std::regex("Example: (.*hullbench .+)\n"))) << help;
    expect_says(help, "Exit codes:");
    examples.emplace_back(name, found[1]);
  }

  write_text(folder() / "points.csv", "lon,lat\n0,0\n1,0\n1,1\n0,1\n");
  fs::create_symlink("results/latest", folder() / "before");
  // A search takes time; two shards, kept polygons, this project's README and the libraries of a skeleton are
  // not here.
  const std::set<std::string> left_out = {"tune", "merge",  "rescore", "readme", "adapter",
                                          "test", "submit", "pack",    "check"};
  const ProgramOptions options = {{}, {{"HULLBENCH_POSTGIS_DSN", "host=127.0.0.1 port=1"}}, false};
  for (const auto& [name, example] : examples) {
    if (left_out.contains(name)) continue;
    const Outcome outcome = shell(example, options);
    EXPECT_EQ(outcome.code, 0) << example << "\n" << outcome.err;
    if (name == "list") expect_every_method_in(outcome.out);
  }
}

TEST_F(CommandLineTest, UnknownWordsAndOptions) {
  expect_refusal(hullbench({}), 2, "subcommand is required");
  expect_refusal(hullbench({"fly"}), 2, "hullbench --help");
  expect_refusal(hullbench({"run"}), 2, "PLAN is required");
  expect_refusal(hullbench({"run", "states", "--fast"}), 2, "--fast");
  expect_refusal(hullbench({"run", "states", "--repetitions", "0"}), 2, "--repetitions");
  expect_refusal(hullbench({"run", "states", "--repetitions", "many"}), 2, "--repetitions");
  expect_refusal(hullbench({"run", "states", "--passes", "0"}), 2, "--passes");
  expect_refusal(hullbench({"run", "states", "--passes", "101"}), 2, "--passes");
  expect_refusal(hullbench({"run", "states", "--mem-limit", "1"}), 2, "--mem-limit");
  expect_refusal(hullbench({"run", "states", "--filter", "("}), 2, "is not a regular expression");
  expect_refusal(hullbench({"worker", "--method", "magic"}), 2, "there is no method 'magic'");
}

TEST_F(CommandLineTest, UnknownPlanAndBrokenPlans) {
  expect_refusal(hullbench({"run", "stats"}), 2, "there is no plan 'stats'; known are");
  expect_refusal(hullbench({"run", "./"}), 2, "there is no plan './'");
  expect_refusal(hullbench({"run", "/nowhere/plan.json"}), 2, "there is no plan '/nowhere/plan.json'");
  expect_refusal(hullbench({"run", write_plan("{\"name\": ")}), 2, "is not JSON: mend it at line 1");
  expect_refusal(hullbench({"run", write_plan(R"({"name": "small", "speed": 1})")}), 2, "speed is not a key");
}

TEST_F(CommandLineTest, UnknownMethodAndDataSetInAPlan) {
  std::string text = read_text(plan({500}, 1));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return write_plan(changed.replace(changed.find(from), from.size(), to));
  };
  expect_refusal(hullbench({"run", with("polylidar", "magic")}), 2, "the method 'magic', which is not known");
  expect_refusal(hullbench({"run", with("\"ca\"", "\"mars\"")}), 2,
                 "the data set 'mars', which is not known");
  EXPECT_FALSE(fs::exists(folder() / "results"));
}

TEST_F(CommandLineTest, AParameterThatTheMethodDoesNotHave) {
  std::string text = read_text(plan({500}, 1));
  text.replace(text.find("\"alpha\""), 7, "\"beta\"");
  expect_end(hullbench({"run", write_plan(text)}), 2,
             "gives polylidar the parameter 'beta', which it does not have");
}

TEST_F(CommandLineTest, OutputFolderThatCannotBeWritten) {
  const std::string small = plan({500}, 1);
  const std::string other = write(small_plan("other", california({600}), 1));
  fs::create_directory(folder() / "sealed");
  fs::permissions(folder() / "sealed", fs::perms::owner_read | fs::perms::owner_exec);
  ProgramOptions options;
  options.obey_permissions = true;
  ProgramOptions in_sealed = options;
  in_sealed.folder = folder() / "sealed";
  // Of one plan and of several, which is a suite.
  for (const std::vector<std::string>& run :
       std::vector<std::vector<std::string>>{{"run", small}, {"run", small, other}}) {
    expect_refusal(
        hullbench(joined(run, {"--out", "sealed"}), options), 2,
        "cannot write to the output folder sealed (Permission denied); choose another one with --out");
    expect_refusal(hullbench(joined(run, {"--out", "sealed/new"}), options), 2,
                   "cannot write to the output folder sealed/new (Permission denied)");
    expect_refusal(hullbench(joined(run, {"--out", "small.json"})), 2,
                   "cannot write to the output folder small.json");
    expect_refusal(hullbench(run, in_sealed), 2, "results/runs (Permission denied)");
  }
  fs::permissions(folder() / "sealed", fs::perms::owner_all);
}

TEST_F(CommandLineTest, OutputFolderWithSomethingElse) {
  const std::string small = plan({500}, 1);
  expect_refusal(hullbench({"run", small, "--out", "."}), 2, "holds something else than a run");
  EXPECT_EQ(hullbench({"run", small, "--out", "mine"}).code, 0);
  expect_refusal(hullbench({"run", small, "--out", "mine", "--seed", "2"}), 2, "holds another run");
  EXPECT_EQ(hullbench({"run", small, "--out", "mine", "--seed", "2", "--force"}).code, 0);
  // A user's folder that has the name of the scratch folder.
  fs::create_directories(folder() / "thesis" / "scratch");
  write_text(folder() / "thesis" / "scratch" / "notes", "mine");
  expect_refusal(hullbench({"run", small, "--out", "thesis"}), 2, "holds something else than a run");
  EXPECT_EQ(read_text(folder() / "thesis" / "scratch" / "notes"), "mine");
}

TEST_F(CommandLineTest, FullDisk) {
  const std::string small = plan({500}, 1000);
  // A limit on the size of files stands for a full disk; its signal is ignored, so that writing fails
  // instead.
  expect_end(shell("trap '' XFSZ; ulimit -f 40; exec hullbench run small.json --out run"), 1,
             "repetitions.jsonl: is the disk full?");
  EXPECT_EQ(hullbench({"run", small, "--out", "run"}).code, 0);
  expect_no_repetition_twice(folder() / "run", 1000);
}

TEST_F(CommandLineTest, FullStandardOutput) {
  succeeded(hullbench({"run", plan({500}, 1), "--out", "run"}));
  for (const std::string words :
       {"metrics --json", "tables run", "league run", "--help", "run small.json --dry-run"}) {
    expect_end(shell("hullbench " + words + " > /dev/full"), 1,
               "cannot write standard output; is the disk full?");
  }
  EXPECT_EQ(shell("hullbench metrics --json | head -c 1").err, "") << "whoever reads has enough";
}

TEST_F(CommandLineTest, DevicesAndLinksAreWrittenTo) {
  succeeded(hullbench({"run", plan({500}, 1), "--out", "run"}));
  fs::create_symlink("there.json", folder() / "link.json");
  succeeded(hullbench({"league", "run", "--out", "link.json"}));
  EXPECT_TRUE(fs::is_symlink(folder() / "link.json"));
  EXPECT_TRUE(fs::is_regular_file(folder() / "there.json"));
  ASSERT_EQ(::mkfifo((folder() / "pipe").c_str(), 0600), 0);
  const Outcome piped = shell("cat pipe & hullbench league run --out pipe > /dev/null; wait");
  EXPECT_TRUE(json::parse(piped.out).is_object());
  EXPECT_TRUE(fs::is_fifo(folder() / "pipe"));
}

TEST_F(CommandLineTest, ADamagedRunKeepsItsRows) {
  const std::string small = plan({500, 600}, 1);
  succeeded(hullbench({"run", small, "--out", "run"}));
  const std::string rows = read_text(folder() / "run/runs.jsonl");
  const std::size_t second = rows.find('\n') + 1;
  write_text(folder() / "run/runs.jsonl", rows.substr(0, second) + "{\"garbage\":1}\n" + rows.substr(second));
  expect_refusal(hullbench({"run", small, "--out", "run"}), 2,
                 "line 2 of run/runs.jsonl is not a run's record");
  expect_refusal(hullbench({"tables", "run"}), 2, "delete the line to keep the others");
  write_text(folder() / "run/run.json", "");
  expect_refusal(hullbench({"run", small, "--out", "run"}), 2,
                 "has measured rows, but its run.json cannot be read");
}

TEST_F(CommandLineTest, AFolderThatIsNoRunIsWrongUsageOfEveryCommand) {
  succeeded(hullbench({"run", plan({500}, 1), "--out", "run"}));
  const json whole = json::parse(read_text(folder() / "run/run.json"));
  json incomplete = whole;
  incomplete.erase("environment");
  const auto expect_refused = [&](const std::string& run, const std::string& words) {
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"tables", run},
                                               {"report", run, "--out", "new"},
                                               {"league", run},
                                               {"compare", run, run},
                                               {"merge", run, "--out", "new"},
                                               {"rescore", run, "--out", "new"},
                                               {"readme", run, "README.md"}}) {
      SCOPED_TRACE(command[0] + ": " + words);
      expect_refusal(hullbench(command), 2, words);
    }
  };
  write_text(folder() / "README.md", "# Title\n");
  expect_refused("nowhere", "there is no run");
  fs::create_directory(folder() / "empty");
  expect_refused("empty", "there is no run in empty");
  write_text(folder() / "run/run.json", "{");
  expect_refused("run", "run/run.json is not a run's description");
  write_text(folder() / "run/run.json", incomplete.dump());
  expect_refused("run", "Missing required property 'environment'");
  write_text(folder() / "run/run.json", whole.dump());
  write_text(folder() / "run/runs.jsonl", "garbage\n");
  expect_refused("run", "line 1 of run/runs.jsonl is not JSON");
  expect_end(hullbench({"validate", "run/runs.jsonl"}), 1, "line 1 of run/runs.jsonl is not JSON");
}

TEST_F(CommandLineTest, PlansOfASuiteThatWereNotStartedAreTold) {
  const std::string small = plan({500}, 1);
  json other = small_plan("other", california({600}), 1);
  succeeded(hullbench({"run", small, write(other), "--out", "suite"}));
  fs::remove_all(folder() / "suite/other");
  const std::string words = "of the suite in suite these plans were not started: other";
  expect_says(succeeded(hullbench({"tables", "suite"})).err, words);
  const Outcome merged = hullbench({"merge", "suite", "--out", "whole"});
  EXPECT_EQ(merged.code, 4);
  expect_says(merged.err, words);
}

TEST_F(CommandLineTest, NumbersThatAreNone) {
  const std::string small = plan({500}, 1);
  for (const std::string number : {"nan", "inf", "0", "-1"})
    expect_refusal(hullbench({"run", small, "--timeout", number}), 2,
                   "'" + number + "' is no number of seconds");
  for (const std::string number : {"18446744073709551616", "-1", "1.5", "nan"})
    expect_refusal(hullbench({"run", small, "--seed", number}), 2,
                   "'" + number + "' is no whole number from 0 to");
  expect_refusal(hullbench({"run", write_plan("{\"timeout_s\": 1e400}")}), 2,
                 "a number that is too large for a double");
  write_text(folder() / "none.jsonl", "");
  expect_end(hullbench({"validate", "none.jsonl"}), 1, "It has no record.");
}

TEST_F(CommandLineTest, AWorkerAnswersWhatIsNoRequestAndGoesOn) {
  const std::string requests =
      R"({"request":"hello"}\n{"request":5}\n[]\n{"request":"dance"}\n{"request":"quit"}\n)";
  const Outcome outcome =
      succeeded(shell("printf '" + requests + "' | hullbench worker --method convex_hull"));
  std::istringstream lines(outcome.out);
  std::vector<json> replies;
  for (std::string line; std::getline(lines, line);) replies.push_back(json::parse(line));
  ASSERT_EQ(replies.size(), 4U) << outcome.out;
  EXPECT_TRUE(replies[0].contains("method"));
  for (const std::size_t odd : {1U, 2U}) EXPECT_EQ(replies[odd]["error"]["message"], "this is no request");
  EXPECT_EQ(replies[3]["error"]["message"], "unknown request 'dance'");
}

TEST_F(CommandLineTest, APlansFileNeedsNoEnding) {
  fs::copy_file(plan({500}, 1), folder() / "my_plan");
  EXPECT_EQ(succeeded(hullbench({"run", "my_plan", "--dry-run"})).out,
            "polylidar/ca/n:500/holes:0/protocol:paper\npolylidar/ca/n:500/holes:1/protocol:paper\n");
}

TEST_F(CommandLineTest, DryRunPrintsNamesAndDoesNothing) {
  const Outcome outcome =
      succeeded(hullbench({"run", plan({500, 600}, 1), "--filter", "holes:1", "--dry-run"}));
  EXPECT_EQ(outcome.out,
            "polylidar/ca/n:500/holes:1/protocol:paper\npolylidar/ca/n:600/holes:1/protocol:paper\n");
  EXPECT_EQ(outcome.err, "");
  EXPECT_FALSE(fs::exists(folder() / "results"));
}

TEST_F(CommandLineTest, ARunLeavesItsFilesAndSaysWhich) {
  const Outcome outcome = succeeded(hullbench({"run", plan({500}, 2)}));
  expect_says(outcome.err, "2 ok, 0 failed, 0 not installed");
  expect_says(outcome.err, "results/latest/report.json");
  const fs::path latest = folder() / "results" / "latest";
  EXPECT_EQ(read_text(latest / "tables.md"), outcome.out);
  for (const char* file : {"report.json", "runs.jsonl", "run.json"}) {
    EXPECT_EQ(hullbench({"validate", (latest / file).string()}).code, 0) << file;
  }
  const Outcome tables = succeeded(hullbench({"tables"}));
  EXPECT_EQ(tables.out, outcome.out);
  EXPECT_EQ(hullbench({"tables", latest.string()}).out, outcome.out);
}

TEST_F(CommandLineTest, OptionsReplaceThePlansValues) {
  ASSERT_EQ(hullbench({"run", plan({500}, 5), "--repetitions", "2", "--seed", "7", "--filter", "holes:0",
                       "--out", "run"})
                .code,
            0);
  const auto rows = read_lines("run/runs.jsonl");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["time_ns"].size(), 2U);
  EXPECT_EQ(rows[0]["seed"], 7);
}

TEST_F(CommandLineTest, SeveralPassesAreSaidAndRecorded) {
  const Outcome outcome =
      succeeded(hullbench({"run", plan({500}, 3), "--passes", "2", "--filter", "holes:0", "--out", "run"}));
  expect_says(outcome.err, "hullbench: pass 1 of 2: ");
  expect_says(outcome.err, "pass 1 of 2 is done; 'hullbench tables run' prints");
  expect_says(outcome.err, "hullbench: pass 2 of 2: ");
  const auto rows = read_lines("run/runs.jsonl");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["passes"], (json{1, 1, 2}));
  EXPECT_EQ(rows[0]["canary_ns"].size(), 3U);
  for (const json& canary : rows[0]["canary_ns"]) {
    EXPECT_GT(canary["memory"], 0);
    EXPECT_GT(canary["compute"], 0);
  }
  const json report = json::parse(read_text(folder() / "run" / "report.json"));
  EXPECT_EQ(report["passes"], 2);
  EXPECT_EQ(report["repetitions"], 3);
  EXPECT_EQ(hullbench({"validate", "run/report.json"}).code, 0);
  expect_refusal(hullbench({"run", plan({500}, 3), "--passes", "3", "--filter", "holes:0", "--out", "run"}),
                 2, "holds another run");
}

TEST_F(CommandLineTest, AFilterOfThePlanIsForWhoAsksForNone) {
  json source = small_plan("small", california({500}));
  source["filter"] = "holes:1";
  const std::string small = write(source);
  const std::string with_holes = "polylidar/ca/n:500/holes:1/protocol:paper\n";
  EXPECT_EQ(hullbench({"run", small, "--dry-run"}).out, with_holes);
  EXPECT_EQ(hullbench({"run", small, "--dry-run", "--filter", "holes:0"}).out,
            "polylidar/ca/n:500/holes:0/protocol:paper\n");
  ASSERT_EQ(hullbench({"run", small, "--out", "run"}).code, 0);
  const auto rows = read_lines("run/runs.jsonl");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["name"].get<std::string>() + "\n", with_holes);
  source["filter"] = "cgal";
  expect_refusal(hullbench({"run", write(source)}), 6,
                 "no run of the plan 'small' has a name that matches the plan's own filter");
  source["filter"] = "(";
  expect_refusal(hullbench({"run", write(source)}), 2, "is not a regular expression");
}

TEST_F(CommandLineTest, MembersOfAFamilyHaveARowEach) {
  const json cases = json::array({{{"dataset", "comb"}, {"members", 3}, {"n", {500}}}});
  const std::string combs = write(small_plan("combs", cases));
  const Outcome outcome = succeeded(hullbench({"run", combs, "--out", "run"}));
  std::set<std::string> names;
  std::set<std::string> points;
  for (const json& row : read_lines("run/runs.jsonl")) {
    EXPECT_EQ(row["status"], "ok") << row;
    names.insert(row["dataset"]);
    points.insert(row["dataset_sha256"]);
  }
  EXPECT_EQ(names, (std::set<std::string>{"comb-1", "comb-2", "comb-3"}));
  EXPECT_EQ(points.size(), 3U) << "the members are different shapes";
  expect_says(outcome.out, "Comb 3");
}

/// A scene in a folder of recordings: a floor of 4 m by 3 m with a point every 0.1 m, moved by `shift`
/// metres.
void write_scene(const fs::path& scene, double shift) {
  fs::create_directories(scene);
  std::string points = "# x y z\n";
  for (int x = 0; x <= 40; ++x) {
    for (int y = 0; y <= 30; ++y)
      points += std::to_string(shift + 0.1 * x) + " " + std::to_string(0.1 * y) + " 0.01\n";
  }
  write_text(scene / "points.txt", points);
  const json ring = {{shift, 0}, {shift + 4, 0}, {shift + 4, 3}, {shift, 3}, {shift, 0}};
  const json shape = {{"type", "Polygon"}, {"coordinates", json::array({ring})}};
  write_text(scene / "gt.geojson", shape.dump());
}

TEST_F(CommandLineTest, RecordedFloorsTakeThePlaceOfTheSimulatedOnes) {
  write_scene(folder() / "floors" / "kitchen", 0);
  write_scene(folder() / "floors" / "hall", 5);
  const Outcome outcome = succeeded(hullbench({"run", "rgbd", "--recordings", "floors", "--filter",
                                               "^polylidar/", "--repetitions", "1", "--out", "run"}));
  std::set<std::string> names;
  for (const json& row : read_lines("run/runs.jsonl")) {
    EXPECT_EQ(row["status"], "ok") << row;
    EXPECT_EQ(row["n"], 41 * 31);
    // The outline of the grid is the floor's own, within the rounding of its coordinates to six decimals.
    EXPECT_LT(row["metrics"]["l2"].get<double>(), 1e-5) << row;
    names.insert(row["dataset"]);
  }
  EXPECT_EQ(names, (std::set<std::string>{"recorded-1", "recorded-2"}));
  expect_says(outcome.out, "Recorded floor 1");
  expect_says(outcome.out, "Recorded floor 2");
  EXPECT_EQ(outcome.out.find("Simulated floor"), std::string::npos) << outcome.out;
}

TEST_F(CommandLineTest, RecordingsAreAddedToTheRealPointsWithoutATruth) {
  write_scene(folder() / "floors" / "hall", 5);
  fs::remove(folder() / "floors" / "hall" / "gt.geojson");
  const Outcome outcome = succeeded(hullbench(
      {"run", "real", "--recordings", "floors", "--filter", "^convex_hull/real-recorded", "--out", "run"}));
  const std::vector<json> rows = read_lines("run/runs.jsonl");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["dataset"], "real-recorded-1");
  EXPECT_EQ(rows[0]["n"], 41 * 31);
  EXPECT_EQ(rows[0]["metrics"]["l2"], nullptr);
  EXPECT_EQ(rows[0]["metrics"]["points_covered"], 1);
  EXPECT_GT(rows[0]["metrics"]["agreement_subsamples"].get<double>(), 0.9);
  expect_says(outcome.out, "Recorded points 1, 1271");
}

TEST_F(CommandLineTest, RecordingsThatAreNotThere) {
  fs::create_directories(folder() / "empty" / "scene");
  expect_refusal(hullbench({"run", "rgbd", "--recordings", "empty"}), 2, "empty has no recording; put each");
  expect_refusal(hullbench({"run", "rgbd", "--recordings", "nowhere"}), 2, "nowhere is not a folder");
  write_scene(folder() / "floors" / "kitchen", 0);
  expect_refusal(hullbench({"run", plan({500}, 1), "--recordings", "floors"}), 2,
                 "the plan 'small' has no simulated floors");
  EXPECT_FALSE(fs::exists(folder() / "results"));
}

TEST_F(CommandLineTest, LimitsReachTheWorkers) {
  // No machine loads and triangulates 64000 points in a millisecond.
  const Outcome outcome = hullbench({"run", plan({64000}, 1), "--timeout", "0.001", "--mem-limit", "1000",
                                     "--filter", "holes:0", "--out", "run"});
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  const auto rows = read_lines("run/runs.jsonl");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["status"], "timeout");
  const json header = json::parse(read_text(folder() / "run" / "run.json"));
  EXPECT_EQ(header["plan"]["timeout_s"], 0.001);
  EXPECT_EQ(header["plan"]["mem_limit_mib"], 1000);
}

TEST_F(CommandLineTest, TablesAndValidateOfWhatIsNotThere) {
  expect_refusal(hullbench({"tables"}), 2, "there is no run in results/latest");
  expect_refusal(hullbench({"tables", "/nowhere"}), 2, "there is no run in /nowhere");
  expect_refusal(hullbench({"validate", "/nowhere.json"}), 2, "there is no file /nowhere.json");
  write_text(folder() / "report.json", "{");
  EXPECT_EQ(hullbench({"validate", "report.json"}).code, 1);
  write_text(folder() / "tune.json.xz",
             "\xFD"
             "7zXZ");
  expect_refusal(hullbench({"validate", "tune.json.xz"}), 2, "tune.json.xz is compressed; give it unpacked");
}

TEST_F(CommandLineTest, ValidateTellsWhatAManifestsSchemaCannot) {
  json manifest = {{"manifest_version", 1},
                   {"name", "mine"},
                   {"title", "Mine"},
                   {"licence", "MIT"},
                   {"citation", "A paper"},
                   {"native_output", "a ring"},
                   {"parameters", json::array()},
                   {"capabilities", {{"holes", true}, {"several_polygons", false}}},
                   {"command", {"true"}},
                   {"runs", {{{"protocol", "auto"}, {"parameters", json::object()}}}}};
  write_text(folder() / "mine.json", manifest.dump());
  EXPECT_EQ(hullbench({"validate", "mine.json"}).code, 0);
  manifest["runs"].push_back(manifest["runs"][0]);
  write_text(folder() / "mine.json", manifest.dump());
  expect_end(hullbench({"validate", "mine.json"}), 1, "repeats");
}

TEST_F(CommandLineTest, MetricsAreListed) {
  expect_end(hullbench({"metrics"}), 0, "", "  l2  ratio, lower is better\n");
  EXPECT_EQ(hullbench({"metrics", "--markdown"}).out.find("### validity\n"), 0U);
  expect_refusal(hullbench({"metrics", "--json", "--markdown"}), 2, "excludes");
}

TEST_F(CommandLineTest, ListKnowsEveryMethodAndDataSet) {
  const Outcome outcome = succeeded(
      hullbench({"list", "--json"}, {{}, {{"HULLBENCH_POSTGIS_DSN", "host=127.0.0.1 port=1"}}, false}));
  const json listing = json::parse(outcome.out);
  std::map<std::string, json> methods;
  for (const json& method : listing["methods"]) methods[method["name"]] = method;
  for (const char* name :
       {"polylidar", "polylidar_steps", "cgal_alpha_shape", "cgal_delaunay", "sfcgal_alpha_shape",
        "spatialite", "spatialite_steps", "postgis", "postgis_legacy", "postgis_steps", "geos_concave_hull",
        "chi_shape", "knn_hull", "pcl_concave_hull", "convex_hull"}) {
    ASSERT_TRUE(methods.contains(name)) << name;
  }
  EXPECT_TRUE(methods["polylidar"]["installed"].get<bool>());
  // Every version, of what is built here and of what a manifest describes, ends with the hash of its sources.
  const std::regex with_hash(R"(.+\+[0-9a-f]{8})");
  std::set<std::string> hashes;
  for (const auto& [name, method] : methods) {
    if (!method["installed"].get<bool>()) continue;
    const auto version = method["version"].get<std::string>();
    EXPECT_TRUE(std::regex_match(version, with_hash)) << name << ": " << version;
    hashes.insert(version.substr(version.size() - 8));
  }
  EXPECT_GE(hashes.size(), 7U) << "each has its own";
  EXPECT_FALSE(methods["postgis"]["installed"].get<bool>());
  EXPECT_FALSE(methods["postgis"]["remedy"].get<std::string>().empty());
  EXPECT_GE(listing["datasets"].size(), 2U);
}

TEST_F(CommandLineTest, ADatabaseThatIsNotThereIsAVisibleRow) {
  const ProgramOptions options = {{}, {{"HULLBENCH_POSTGIS_DSN", "host=127.0.0.1 port=1"}}, false};
  const Outcome outcome = hullbench({"run", "states", "--filter", "postgis/hi/n:2000/holes:0/protocol:auto",
                                     "--repetitions", "1", "--out", "run"},
                                    options);
  EXPECT_EQ(outcome.code, 6) << outcome.err;
  const auto rows = read_lines("run/runs.jsonl");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["status"], "not_installed");
  expect_says(outcome.err, "postgis does not start (not_installed): ");
  expect_says(outcome.err, "0 ok, 0 failed, 1 not installed");
}

TEST_F(CommandLineTest, WhatWasNotInstalledIsMeasuredWhenItIsThere) {
  const ProgramOptions missing = {
      {}, {{"HULLBENCH_POSTGRES_BIN", (folder() / "no-programs").string()}}, false};
  const auto run = [&](const std::vector<std::string>& plans, const ProgramOptions& options) {
    const std::string filter = "^(convex_hull|postgis)/(hi|letter_a)/n:2000/holes:0";
    const std::string out = plans.size() == 1 ? "run" : "suite";
    const std::vector<std::string> words = joined({"run"}, plans);
    return hullbench(joined(words, {"--filter", filter, "--repetitions", "1", "--out", out}), options);
  };
  const auto statuses = [&](const fs::path& rows) {
    std::map<std::string, int> counts;
    for (const json& row : read_lines(rows)) ++counts[row["status"]];
    return counts;
  };
  const std::map<std::string, int> both = {{"ok", 3}};

  fs::create_directory(folder() / "no-programs");
  const Outcome first = run({"states"}, missing);
  ASSERT_EQ(first.code, 0) << first.err;
  expect_says(first.err, "postgis does not start (not_installed): PostgreSQL is not installed");
  expect_says(first.err, "apt-get install postgresql-postgis");
  expect_says(first.err, "1 ok, 0 failed, 2 not installed");
  EXPECT_EQ(statuses("run/runs.jsonl"), (std::map<std::string, int>{{"not_installed", 2}, {"ok", 1}}));
  const Outcome second = run({"states"}, {});
  expect_says(second.err,
              "1 of 3 runs are finished and not measured again (--force starts anew); tried again "
              "because a package was missing: 2\n");
  EXPECT_EQ(statuses("run/runs.jsonl"), both);
  expect_says(run({"states"}, {}).err,
              "3 of 3 runs are finished and not measured again (--force starts anew)\n");

  ASSERT_EQ(run({"states", "alphabet"}, missing).code, 0);
  const Outcome suite = run({"states", "alphabet"}, {});
  EXPECT_EQ(suite.err.find("is finished already"), std::string::npos) << suite.err;
  expect_says(suite.err, "6 ok, 0 failed, 0 not installed");
  for (const char* plan : {"states", "alphabet"}) {
    EXPECT_EQ(statuses(fs::path("suite") / plan / "runs.jsonl"), both) << plan;
  }
  expect_says(run({"states", "alphabet"}, {}).err, "State shapes is finished already");
}

TEST_F(CommandLineTest, AWorkerThatIsKilledIsARowAndTheRestIsMeasured) {
  const std::string small = plan({64000, 500}, 200);
  Program program(command({"run", small, "--out", "run"}), in_folder());
  const fs::path repetitions = folder() / "run" / "repetitions.jsonl";
  ASSERT_TRUE(wait_until([&] { return fs::exists(repetitions) && fs::file_size(repetitions) > 0; }));
  const std::vector<pid_t> workers = children_of(program.pid());
  ASSERT_EQ(workers.size(), 1U);
  ::kill(workers[0], SIGKILL);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  std::map<std::string, int> counts;
  for (const json& row : read_lines("run/runs.jsonl")) {
    ++counts[row["status"]];
    if (row["status"] != "crash") continue;
    expect_says(row["detail"].get<std::string>(), "SIGKILL");
  }
  EXPECT_EQ(counts, (std::map<std::string, int>{{"crash", 1}, {"ok", 3}}));
}

class InterruptionTest : public CommandLineTest {
 protected:
  static constexpr int kRepetitions = 40;

  std::string the_plan() const { return plan({2000, 3000, 4000}, kRepetitions); }

  /// Starts a run and sends `signal` some time `later` than `lines` repetitions are there; its outcome.
  Outcome stop_after(std::size_t lines, int signal, std::chrono::microseconds later = {}) {
    Program program(command({"run", the_plan(), "--out", "run"}), in_folder());
    const fs::path repetitions = folder() / "run" / "repetitions.jsonl";
    EXPECT_TRUE(wait_until([&] {
      const std::string text = read_text(repetitions);
      return static_cast<std::size_t>(std::ranges::count(text, '\n')) >= lines;
    }));
    std::this_thread::sleep_for(later);
    const std::vector<pid_t> workers = children_of(program.pid());
    program.send_signal(signal);
    Outcome outcome = program.wait();
    for (const pid_t worker : workers) {
      EXPECT_TRUE(wait_until([&] { return !is_running(worker); })) << "a worker is left";
    }
    return outcome;
  }
};

/// The rows without what is timed, in their order; every row has all its repetitions.
std::vector<json> untimed_rows(const fs::path& run) {
  std::vector<json> rows = record::load_json_lines(run / "runs.jsonl").lines;
  for (json& row : rows) {
    EXPECT_EQ(row["time_ns"].size(), row["phases_ns"].size());
    row["time_ns"] = row["time_ns"].size();
    for (const char* key : {"phases_ns", "canary_ns", "flags"}) row.erase(key);
    row["metrics"].erase("peak_memory_bytes");
  }
  return rows;
}

// What is said has the number of a closed stream.
TEST_F(CommandLineTest, ClosedStandardStreamsGetIntoNoRecords) {
  plan({300}, 2);
  for (const std::string closed : {">&- 2>&-", "<&- 2>&-", "2>&-"}) {
    shell("exec hullbench run small.json --out run --force " + closed);
    EXPECT_EQ(read_lines("run/runs.jsonl").size(), 2U) << closed;
    EXPECT_EQ(read_lines("run/repetitions.jsonl").size(), 4U) << closed;
    for (const char* file : {"run/run.json", "run/runs.jsonl"}) expect_valid(file);
  }
}

TEST_F(InterruptionTest, CtrlCKeepsFinishedRowsAndASecondStartGoesOn) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const Outcome stopped =
        expect_end(stop_after(signal == SIGINT ? kRepetitions + 5 : 3 * kRepetitions + 5, signal), 130,
                   "the same command goes on from there");
    EXPECT_EQ(stopped.out, "");
    EXPECT_FALSE(fs::exists(folder() / "run" / "report.json"));
    EXPECT_FALSE(fs::exists(folder() / "run" / "scratch"));
  }
  const std::string kept = read_text(folder() / "run" / "runs.jsonl");
  EXPECT_FALSE(kept.empty());
  expect_end(hullbench({"run", the_plan(), "--out", "run"}), 0, "going on with the run in run");
  EXPECT_EQ(read_text(folder() / "run" / "runs.jsonl").substr(0, kept.size()), kept);
  expect_no_repetition_twice(folder() / "run", kRepetitions);
}

TEST_F(InterruptionTest, KilledAtRandomMomentsTheRowsAreThoseOfAnUninterruptedRun) {
  const char* const given = std::getenv("HULLBENCH_TEST_SEED");
  const auto seed = given != nullptr ? static_cast<std::random_device::result_type>(std::stoul(given))
                                     : std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  // In the middle of a repetition, a row or the report; and, where that many are there already, of the start.
  std::uniform_int_distribution<std::size_t> lines(0, std::size_t{6} * kRepetitions);
  std::uniform_int_distribution<int> microseconds(0, 60'000);
  int killed = 0;
  for (int i = 0; i < 10; ++i) {
    const Outcome outcome = stop_after(i == 0 ? kRepetitions : lines(random), SIGKILL,
                                       std::chrono::microseconds(microseconds(random)));
    ASSERT_TRUE(outcome.code == 0 || outcome.code == 128 + SIGKILL) << outcome.code << outcome.err;
    killed += outcome.code == 0 ? 0 : 1;
  }
  EXPECT_GT(killed, 0);
  EXPECT_EQ(hullbench({"run", the_plan(), "--out", "run"}).code, 0);
  EXPECT_EQ(hullbench({"run", the_plan(), "--out", "whole"}).code, 0);
  const std::vector<json> whole = untimed_rows(folder() / "whole");
  EXPECT_EQ(whole.size(), 6U);
  EXPECT_EQ(untimed_rows(folder() / "run"), whole);
  EXPECT_FALSE(fs::exists(folder() / "run" / "scratch"));
  expect_no_repetition_twice(folder() / "run", kRepetitions);
}

}  // namespace
}  // namespace hullbench::testing
