// The runner from plan to rows: good methods beside misbehaving ones, and runs that go on after an
// interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <thread>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/base/utc_now.hpp"
#include "benchmarks/cli/listing.hpp"
#include "benchmarks/record/environment.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "benchmarks/run/runner.hpp"
#include "benchmarks/run/workbench.hpp"
#include "datasets/datasets.hpp"
#include "datasets/random.hpp"
#include "datasets/sha256.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

/// A plan of these methods on California with 500 points, without holes.
plan::Plan plan_of(const std::vector<std::string>& methods, int repetitions = 3) {
  json source = {{"name", "test"},
                 {"repetitions", repetitions},
                 {"timeout_s", 20},
                 {"mem_limit_mib", 512},
                 {"cases", {{{"dataset", "ca"}, {"n", {500}}}}},
                 {"methods", json::array()}};
  for (const std::string& method : methods) {
    const bool real = method == "polylidar";
    source["methods"].push_back(
        {{"method", method},
         {"protocol", "paper"},
         {"parameters", real ? json{{"alpha", {{"rule", "paper_alpha"}}}} : json{{"size", 1}}}});
  }
  return plan::parse_plan(source.dump(), "test");
}

worker::Method worker_of(const std::string& name) {
  worker::Method method;
  method.name = method.title = name;
  method.command = {MISBEHAVING_WORKER, name};
  if (name == "polylidar" || name == "convex_hull") method.command = {HULLBENCH, "worker", "--method", name};
  return method;
}

/// Of a method that compiles while it runs.
worker::Method compiling_worker_of(const std::string& name) {
  worker::Method method = worker_of(name);
  method.jit = true;
  return method;
}

worker::Method gone(const std::string& name) {
  worker::Method method = worker_of(name);
  method.command = {"/nowhere/worker"};
  return method;
}

json header_of(const plan::Plan& plan) {
  const std::string hash = sha256_hex("the program");
  return {{"schema_version", record::kSchemaVersion},
          {"created", utc_now()},
          {"tool",
           {{"name", "hullbench"},
            {"version", "1"},
            {"commit", nullptr},
            {"dirty", nullptr},
            {"binary_sha256", hash}}},
          {"environment", record::collect_environment()},
          {"plan", plan::plan_to_json(plan)},
          {"seed", plan.seed},
          {"filter", nullptr},
          {"repetitions", plan.repetitions},
          {"datasets", json::array()}};
}

class RunnerTest : public ::testing::Test {
 protected:
  void TearDown() override { set_interrupted(false); }

  /// All passes, or those up to `most_passes`; `machine_` is asked.
  run::RunResult measure(const plan::Plan& plan, const worker::MethodFinder& find_method = &worker_of,
                         const std::vector<int>& cores = {}, std::optional<int> most_passes = {}) {
    const json header = header_of(plan);
    const auto directory = run::open_run_directory(header, {folder_.path() / "run", false, folder_.path()});
    const auto runs = plan::planned_runs(plan, "");
    const int passes = most_passes.value_or(plan.passes);
    std::vector<run::ProgressSection> sections;
    for (int pass = 1; pass <= passes; ++pass)
      sections.push_back({"test", run::progress_runs(plan, runs, pass), "test"});
    std::ostringstream progress_text;
    run::Progress progress(progress_text, false, 80, sections);
    run::RunResult result;
    for (int pass = 1; pass <= passes && !result.interrupted; ++pass) {
      progress.enter(static_cast<std::size_t>(pass - 1));
      result = run::run_plan(plan, runs, header, {find_method, std::nullopt, cores, folders_, machine_},
                             *directory, progress, pass);
    }
    seconds_left_ = progress.seconds_left();
    said_ = progress_text.str();
    return result;
  }

  run::RunResult measure_first_pass(const plan::Plan& plan) { return measure(plan, &worker_of, {}, 1); }

  std::vector<json> lines(const std::string& file) const {
    return record::load_json_lines(folder_.path() / "run" / file).lines;
  }

  std::map<std::string, record::RunRecord> rows() const {
    std::map<std::string, record::RunRecord> result;
    for (const json& line : lines("runs.jsonl")) {
      const auto record = line.get<record::RunRecord>();
      EXPECT_TRUE(result.emplace(record.method, record).second) << record.name << " is there twice";
    }
    return result;
  }

  TemporaryFolder folder_;
  std::string said_;
  double seconds_left_ = 0;  ///< in the end
  run::MachineWatch* machine_ = nullptr;
  DataFolders folders_;
};

/// Two points in each cell of a lattice of 20 x 20, as a recording without a truth.
void write_recording(const fs::path& scene) {
  fs::create_directories(scene);
  Random random(7);
  std::ofstream points(scene / "points.txt");
  for (int i = 0; i < 800; ++i)
    points << i % 20 + random.uniform() << " " << i / 20 % 20 + random.uniform() << "\n";
}

/// A plan of these methods on real points, with so many draws.
plan::Plan real_plan_of(const std::vector<std::string>& methods, const std::string& dataset, int draws) {
  json source = plan::plan_to_json(plan_of({"polylidar"}, 1));
  source["cases"] = {{{"dataset", dataset}}};
  source["draws"] = draws;
  source["methods"] = json::array();
  for (const std::string& method : methods)
    source["methods"].push_back({{"method", method}, {"protocol", "default"}});
  return plan::parse_plan(source.dump(), "test");
}

TEST_F(RunnerTest, RealPointsAreHalvedToSeeWhetherTheResultStays) {
  write_recording(folder_.path() / "recordings" / "scene");
  folders_.recordings = folder_.path() / "recordings";
  const plan::Plan plan = real_plan_of({"polylidar", "convex_hull"}, "real-recorded-1", 2);
  EXPECT_EQ(exit_code(measure(plan)), 0);
  const auto first = rows();
  for (const auto& [method, row] : first) {
    EXPECT_EQ(to_string(row.status), "ok") << row.detail;
    EXPECT_EQ(row.n, 800);
    EXPECT_TRUE(row.metrics.at("l2").is_null());
    EXPECT_TRUE(row.metrics.at("window_iou").is_null());
    for (const char* name : {"agreement_halves", "agreement_subsamples"}) {
      EXPECT_GT(row.metrics.at(name).get<double>(), 0.8) << method;
      EXPECT_LE(row.metrics.at(name).get<double>(), 1) << method;
    }
  }
  EXPECT_EQ(first.at("convex_hull").metrics.at("points_covered"), 1);
  EXPECT_EQ(first.at("convex_hull").metrics.at("convex_hull_share"), 1);
  EXPECT_GT(first.at("convex_hull").metrics.at("agreement_subsamples").get<double>(),
            first.at("convex_hull").metrics.at("agreement_halves").get<double>());
  fs::remove_all(folder_.path() / "run");
  measure(plan);
  for (const auto& [method, row] : rows()) {
    json again = row.metrics;
    again["peak_memory_bytes"] = first.at(method).metrics.at("peak_memory_bytes");
    EXPECT_EQ(again, first.at(method).metrics) << method;
  }
}

TEST_F(RunnerTest, WithoutDrawsNothingIsSaidOfStability) {
  write_recording(folder_.path() / "recordings" / "scene");
  folders_.recordings = folder_.path() / "recordings";
  measure(real_plan_of({"convex_hull"}, "real-recorded-1", 0));
  EXPECT_TRUE(rows().at("convex_hull").metrics.at("agreement_halves").is_null());
  EXPECT_EQ(rows().at("convex_hull").metrics.at("points_covered"), 1);
}

TEST_F(RunnerTest, AMethodThatFailsOnRealPointsHasARowWithoutStability) {
  write_recording(folder_.path() / "recordings" / "scene");
  folders_.recordings = folder_.path() / "recordings";
  json source = plan::plan_to_json(real_plan_of({"convex_hull", "crash"}, "real-recorded-1", 1));
  source["methods"][1]["parameters"] = {{"size", 1}};
  source["methods"][1]["note"] = "a test's";
  EXPECT_EQ(exit_code(measure(plan::parse_plan(source.dump(), "test"))), kExitFailures);
  EXPECT_EQ(to_string(rows().at("crash").status), "crash");
  EXPECT_FALSE(rows().at("convex_hull").metrics.at("agreement_halves").is_null());
}

TEST_F(RunnerTest, RealPointsThatAreNotInstalledAreRowsThatSaySo) {
  folders_.system = folder_.path() / "empty";
  const plan::Plan plan = real_plan_of({"polylidar", "convex_hull"}, "real-house", 1);
  const run::RunResult result = measure(plan);
  EXPECT_EQ(result.counts.at(record::Status::kNotInstalled), 2);
  EXPECT_EQ(exit_code(result), kExitNothing);
  for (const auto& [method, row] : rows()) {
    EXPECT_EQ(to_string(row.status), "not_installed");
    expect_says(row.detail, "r-cran-spdata");
    expect_says(row.detail, "'make deps-real'");
    EXPECT_FALSE(row.method_version.empty());
    EXPECT_EQ(row.n, 0);
  }
  const json report = report::make_report(folder_.path() / "run");
  EXPECT_EQ(record::validate_report(report), std::vector<std::string>());
}

/// Two recordings in `folder`, the first one with the points `odd`. Returns the first one's folder.
fs::path write_odd_and_good_recording(const fs::path& folder, const std::string& odd) {
  write_recording(folder / "a");
  write_recording(folder / "b");
  write_text(folder / "a" / "points.txt", odd);
  return folder / "a";
}

/// The plan, which has the first recording, with the second one too.
json with_second_recording(const plan::Plan& plan) {
  json source = plan::plan_to_json(plan);
  source["cases"].push_back({{"dataset", "real-recorded-2"}});
  return source;
}

/// The rows of a run by "METHOD/DATASET".
std::map<std::string, record::RunRecord> by_dataset(const std::vector<json>& lines) {
  std::map<std::string, record::RunRecord> result;
  for (const json& line : lines) {
    const auto row = line.get<record::RunRecord>();
    EXPECT_TRUE(result.emplace(row.method + "/" + row.dataset, row).second) << row.name << " is there twice";
  }
  return result;
}

TEST_F(RunnerTest, PointsThatCannotBeReadAreRowsThatSaySoAndTheOthersAreMeasured) {
  folders_.recordings = folder_.path() / "recordings";
  const fs::path broken = write_odd_and_good_recording(folders_.recordings, "0 0\n0 nan\n1 1\n");
  const json source = with_second_recording(real_plan_of({"polylidar", "convex_hull"}, "real-recorded-1", 1));
  const plan::Plan plan = plan::parse_plan(source.dump(), "test");
  EXPECT_EQ(exit_code(measure(plan)), kExitFailures);
  for (const auto& [name, row] : by_dataset(lines("runs.jsonl"))) {
    const bool is_broken = row.dataset == "real-recorded-1";
    EXPECT_EQ(to_string(row.status), is_broken ? "error" : "ok") << name << ": " << row.detail;
    if (is_broken) expect_says(row.detail, "there are no points: ");
    if (is_broken) expect_says(row.detail, "line 2, has a number that is not finite");
  }
  EXPECT_EQ(lines("runs.jsonl").size(), 4U);
  EXPECT_EQ(record::validate_report(report::make_report(folder_.path() / "run")), std::vector<std::string>());

  // Once they can be read, they are measured.
  fs::remove_all(broken);
  write_recording(broken);
  EXPECT_EQ(exit_code(measure(plan)), 0);
  EXPECT_EQ(to_string(by_dataset(lines("runs.jsonl")).at("polylidar/real-recorded-1").status), "ok");
}

TEST_F(RunnerTest, PointsThatNothingCanBeMadeOfEndNoRun) {
  folders_.recordings = folder_.path() / "recordings";
  write_odd_and_good_recording(folders_.recordings, "0 0\n1e-200 1\n1e200 0\n");
  json source = with_second_recording(real_plan_of({"polylidar", "good"}, "real-recorded-1", 0));
  source["methods"][0]["protocol"] = "auto";
  source["methods"][0]["parameters"] = {{"max_edge_length", {{"rule", "auto_edge_length"}}}};
  EXPECT_EQ(exit_code(measure(plan::parse_plan(source.dump(), "test"))), kExitFailures);
  const auto measured = by_dataset(lines("runs.jsonl"));
  ASSERT_EQ(measured.size(), 4U);
  const record::RunRecord& without_parameters = measured.at("polylidar/real-recorded-1");
  EXPECT_EQ(to_string(without_parameters.status), "error");
  expect_says(without_parameters.detail, "the parameters cannot be chosen: coordinates span more than");
  const record::RunRecord& without_score = measured.at("good/real-recorded-1");
  EXPECT_EQ(to_string(without_score.status), "error");
  expect_says(without_score.detail, "the result cannot be scored: coordinates span more than");
  EXPECT_EQ(to_string(measured.at("polylidar/real-recorded-2").status), "ok");
  EXPECT_EQ(to_string(measured.at("good/real-recorded-2").status), "ok");
  EXPECT_EQ(record::validate_file(folder_.path() / "run" / "runs.jsonl"), std::vector<std::string>());
}

TEST_F(RunnerTest, AGoodMethodGetsACompleteRow) {
  const run::RunResult result = measure(plan_of({"polylidar"}));
  EXPECT_EQ(exit_code(result), 0);
  const record::RunRecord row = rows().at("polylidar");
  EXPECT_EQ(to_string(row.status), "ok") << row.detail;
  EXPECT_EQ(row.name, "polylidar/ca/n:500/holes:0/protocol:paper");
  EXPECT_EQ(row.id, record::run_identity(row));
  ASSERT_EQ(row.time_ns.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const record::PhaseTimes& phases = row.phases_ns.at(i);
    EXPECT_EQ(row.time_ns[i], phases.at("run") + phases.at("extract"));
    EXPECT_TRUE(phases.contains("load"));
    EXPECT_GT(phases.at("run.hull"), 0);
    EXPECT_LE(phases.at("run.hull") + phases.at("extract.polygon"), row.time_ns[i]);
  }
  EXPECT_TRUE(row.parameters.contains("alpha"));
  EXPECT_EQ(row.parameters.at("max_edge_length"), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(row.metrics.at("valid").get<bool>());
  // 500 points give a coarse outline, but California it is.
  EXPECT_LT(row.metrics.at("l2").get<double>(), 0.3);
  EXPECT_GT(row.metrics.at("iou").get<double>(), 0.7);
  EXPECT_GT(row.metrics.at("skill").get<double>(), 0.5);
  EXPECT_EQ(row.metrics.at("vertices_from_input"), 1.0);
  EXPECT_EQ(row.metrics.at("oriented"), true);
  // Not told by every system; a process that runs has some memory.
  if (row.metrics.at("peak_memory_bytes").is_number()) {
    EXPECT_GT(row.metrics.at("peak_memory_bytes").get<std::int64_t>(), 100'000);
  }
  EXPECT_EQ(row.output_sha256.size(), 64U);
  EXPECT_EQ(row.rounds, (std::vector<std::int64_t>{0, 1, 2}));
  EXPECT_EQ(row.passes, (std::vector<std::int64_t>{1, 1, 1}));
  EXPECT_TRUE(row.canary_ns.empty()) << "nobody looked";
  EXPECT_FALSE(row.cold_time_ns);
}

TEST_F(RunnerTest, EveryMisbehaviourIsARowAndTheOthersAreMeasured) {
  const std::map<std::string, record::Status> expected = {{"crash", record::Status::kCrash},
                                                          {"memory", record::Status::kMemory},
                                                          {"early_exit", record::Status::kCrash},
                                                          {"garbage", record::Status::kError},
                                                          {"garbage_result", record::Status::kInvalidOutput},
                                                          {"no_result", record::Status::kInvalidOutput},
                                                          {"wrong_nonce", record::Status::kInvalidOutput},
                                                          {"invalid_polygon", record::Status::kInvalidOutput},
                                                          {"changing_result", record::Status::kInvalidOutput},
                                                          {"says_unsupported", record::Status::kUnsupported},
                                                          {"says_error", record::Status::kError},
                                                          {"crash_at_start", record::Status::kCrash},
                                                          {"crash_on_load", record::Status::kCrash},
                                                          {"fork", record::Status::kOk},
                                                          {"fork_and_fork", record::Status::kTimeout},
                                                          {"flood_output", record::Status::kInvalidOutput},
                                                          {"flood_line", record::Status::kError},
                                                          {"flood_errors_for_ever", record::Status::kTimeout},
                                                          {"hang", record::Status::kTimeout},
                                                          {"polylidar", record::Status::kOk},
                                                          {"good", record::Status::kOk}};
  std::vector<std::string> methods;
  methods.reserve(expected.size());
  for (const auto& [method, status] : expected) methods.push_back(method);
  plan::Plan plan = plan_of(methods, 2);
  for (plan::PlanMethod& method : plan.methods) {
    if (expected.at(method.method) == record::Status::kTimeout) method.timeout_s = 0.5;
  }
  EXPECT_EQ(exit_code(measure(plan)), 4);
  for (const auto& [method, status] : expected) {
    const std::vector<std::string> command = worker_of(method).command;
    EXPECT_TRUE(wait_until([&] { return !runs_somewhere(command); })) << method;
  }
  const auto measured = rows();
  ASSERT_EQ(measured.size(), expected.size());
  for (const auto& [method, status] : expected) {
    const record::RunRecord& row = measured.at(method);
    EXPECT_EQ(to_string(row.status), to_string(status)) << method << ": " << row.detail;
    EXPECT_EQ(row.detail.empty(), status == record::Status::kOk) << method;
  }
  EXPECT_EQ(measured.at("crash").detail, "SIGSEGV");
  expect_says(measured.at("changing_result").detail, "different results");
  EXPECT_EQ(record::validate_file(folder_.path() / "run" / "runs.jsonl"), std::vector<std::string>());
  const json report = report::make_report(folder_.path() / "run");
  EXPECT_EQ(record::validate_report(report), std::vector<std::string>());
  EXPECT_EQ(report["methods"].size(), expected.size());
}

TEST_F(RunnerTest, AnAcceptedStatusIsNoFailure) {
  plan::Plan plan = plan_of({"says_error", "good"}, 1);
  EXPECT_EQ(exit_code(measure(plan)), 4);
  fs::remove_all(folder_.path() / "run");
  plan.accepted = {"error"};
  const run::RunResult result = measure(plan);
  EXPECT_EQ(exit_code(result), 0);
  EXPECT_EQ(result.accepted, 1);
  EXPECT_EQ(result.counts.at(record::Status::kOk), 1);
  EXPECT_FALSE(result.counts.contains(record::Status::kError));
  fs::remove_all(folder_.path() / "run");
  plan.accepted = {"crash"};
  EXPECT_EQ(exit_code(measure(plan)), 4);
}

TEST(ExitCode, RowsThatAreAllAcceptedAreMeasured) {
  run::RunResult result;
  EXPECT_EQ(exit_code(result), 6);
  run::count_row(result, record::Status::kError, {"error"});
  EXPECT_EQ(exit_code(result), 0);
  run::count_row(result, record::Status::kCrash, {"error"});
  EXPECT_EQ(exit_code(result), 4);
}

TEST_F(RunnerTest, RowsUnderStressSayTheirShapeAndLevel) {
  plan::Plan plan = plan_of({"polylidar"}, 1);
  plan.expanded_cases = {{"ca~noise:0.5", false, 200}};
  EXPECT_EQ(exit_code(measure(plan)), 0);
  const record::RunRecord row = rows().at("polylidar");
  EXPECT_EQ(row.name, "polylidar/ca~noise:0.5/n:200/holes:0/protocol:paper");
  EXPECT_EQ(row.base_shape, "ca");
  EXPECT_EQ(row.levels, (std::map<std::string, double>{{"noise", 0.5}}));
  EXPECT_EQ(record::validate_file(folder_.path() / "run" / "runs.jsonl"), std::vector<std::string>());
}

TEST_F(RunnerTest, PointsWithoutAShapeAreMeasuredAndNotScored) {
  plan::Plan plan = plan_of({"polylidar", "good", "invalid_polygon"}, 1);
  for (const char* dataset : {"degenerate_empty", "degenerate_collinear"}) {
    fs::remove_all(folder_.path() / "run");
    plan.expanded_cases = {{dataset, false, 0}};
    EXPECT_EQ(exit_code(measure(plan)), 4);
    const auto measured = rows();
    const record::RunRecord& empty = measured.at("polylidar");
    EXPECT_EQ(to_string(empty.status), "ok") << empty.detail;
    EXPECT_EQ(empty.metrics.at("polygons"), 0);
    EXPECT_EQ(empty.metrics.at("l2"), nullptr);
    const record::RunRecord& square = measured.at("good");
    EXPECT_EQ(to_string(square.status), "ok") << square.detail;
    EXPECT_EQ(square.metrics.at("area"), 1);
    EXPECT_EQ(square.metrics.at("l2"), nullptr);
    EXPECT_EQ(to_string(measured.at("invalid_polygon").status), "invalid_output");
    EXPECT_EQ(record::validate_file(folder_.path() / "run" / "runs.jsonl"), std::vector<std::string>());
  }
}

TEST_F(RunnerTest, AMethodsOwnLimitsTakeThePlaceOfThePlans) {
  plan::Plan plan = plan_of({"says_limits", "good"}, 1);
  const auto limit_of = [&] { return std::stoll(rows().at("says_limits").detail); };
  measure(plan);
  EXPECT_EQ(limit_of(), 512);
  fs::remove_all(folder_.path() / "run");
  plan.methods[0].mem_limit_mib = 300;
  measure(plan);
  EXPECT_EQ(limit_of(), 300);
}

TEST_F(RunnerTest, AMethodsOwnRepetitionsTakeThePlaceOfThePlans) {
  plan::Plan plan = plan_of({"good", "polylidar"}, 2);
  plan.methods[0].repetitions = 1;
  plan.methods[1].repetitions = 3;
  EXPECT_EQ(exit_code(measure(plan)), 0);
  EXPECT_EQ(rows().at("good").time_ns.size(), 1U);
  EXPECT_EQ(rows().at("polylidar").time_ns.size(), 3U);
  EXPECT_EQ(exit_code(measure(plan)), 0);
  EXPECT_EQ(rows().at("polylidar").time_ns.size(), 3U);
}

TEST_F(RunnerTest, WithoutWarmUpOneRunIsUntimedAllTheSame) {
  plan::Plan plan = plan_of({"polylidar", "garbage_result", "invalid_polygon"});
  plan.warmup = 0;
  measure(plan);
  EXPECT_EQ(rows().at("polylidar").time_ns.size(), 3U);
  EXPECT_TRUE(rows().at("polylidar").metrics.at("valid").get<bool>());
  EXPECT_EQ(rows().at("garbage_result").time_ns.size(), 0U);
  EXPECT_EQ(rows().at("invalid_polygon").time_ns.size(), 3U);
  // Gone on with, the scores must be made again.
  fs::remove(folder_.path() / "run" / "runs.jsonl");
  EXPECT_EQ(exit_code(measure(plan)), 4);
  EXPECT_TRUE(rows().at("polylidar").metrics.at("valid").get<bool>());
}

TEST_F(RunnerTest, AnUntimedRunChecksEvenASingleRepetition) {
  for (const int warmup : {0, 1}) {
    plan::Plan plan = plan_of({"polylidar", "changing_result", "crash_on_second"}, 1);
    plan.warmup = warmup;
    measure(plan);
    EXPECT_EQ(to_string(rows().at("polylidar").status), "ok");
    EXPECT_EQ(to_string(rows().at("changing_result").status), "invalid_output");
    EXPECT_EQ(to_string(rows().at("crash_on_second").status), "crash");
    fs::remove_all(folder_.path() / "run");
  }
}

TEST_F(RunnerTest, AnInvalidPolygonIsTimedAndScoredAsInvalid) {
  measure(plan_of({"invalid_polygon"}));
  const record::RunRecord row = rows().at("invalid_polygon");
  EXPECT_EQ(row.time_ns.size(), 3U);
  EXPECT_FALSE(row.metrics.at("valid").get<bool>());
  EXPECT_TRUE(row.detail.starts_with("the result is an invalid polygon: ")) << row.detail;
  EXPECT_TRUE(row.metrics.at("l2").is_null());
}

TEST_F(RunnerTest, ARowSaysItsMachineAndWhetherItWasFasterThanAnyMethodCanBe) {
  // 110 ns and 1010 ns for 500 points.
  measure(plan_of({"polylidar", "instant", "good"}));
  const auto has_flag = [&](const std::string& method) {
    const std::vector<std::string> flags = rows().at(method).flags;
    return std::ranges::count(flags, record::kFasterThanFloor) == 1;
  };
  EXPECT_TRUE(has_flag("instant"));
  EXPECT_FALSE(has_flag("good"));
  EXPECT_FALSE(has_flag("polylidar"));
  for (const auto& [name, row] : rows()) {
    EXPECT_EQ(to_string(row.status), "ok") << row.detail;
    EXPECT_EQ(row.machine, record::machine_id());
  }
}

TEST_F(RunnerTest, ARowSaysThatItsResultIsWorseThanTheConvexHull) {
  plan::Plan plan = plan_of({"polylidar", "good", "convex_hull", "invalid_polygon"}, 1);
  plan.methods[2].parameters.clear();
  measure(plan);
  // A square somewhere else.
  EXPECT_EQ(rows().at("good").flags, std::vector<std::string>{record::kWorseThanConvexHull});
  EXPECT_TRUE(rows().at("polylidar").flags.empty());
  EXPECT_TRUE(rows().at("convex_hull").flags.empty()) << "as good as itself";
  EXPECT_TRUE(rows().at("invalid_polygon").flags.empty()) << "it has no error";
}

TEST_F(RunnerTest, ACrashKeepsTheRepetitionsBeforeIt) {
  measure(plan_of({"crash_on_second"}));
  const record::RunRecord row = rows().at("crash_on_second");
  EXPECT_EQ(row.detail, "SIGABRT");
  // The first run was the warm-up, the second one the first repetition.
  EXPECT_EQ(row.time_ns.size(), 0U);
  EXPECT_TRUE(row.metrics.at("valid").get<bool>());
}

TEST_F(RunnerTest, AParameterOutOfItsRangeIsAnErrorRow) {
  plan::Plan plan = plan_of({"good"});
  plan.methods[0].parameters = {{"size", 11.0}};
  EXPECT_EQ(exit_code(measure(plan)), 4);
  EXPECT_EQ(rows().at("good").detail, "good takes 'size' from 0 to 10, not 11");
}

TEST_F(RunnerTest, AFinishedRunIsNotMeasuredAgain) {
  const fs::path run = folder_.path() / "run";
  plan::Plan plan = plan_of({"polylidar", "good", "crash"}, 4);
  for (plan.passes = 1; plan.passes <= 3; plan.passes += 2) {
    SCOPED_TRACE(plan.passes);
    measure(plan);
    const std::string before = read_text(run / "runs.jsonl");
    const std::string repetitions = read_text(run / "repetitions.jsonl");
    EXPECT_EQ(exit_code(measure(plan)), 4);
    EXPECT_EQ(read_text(run / "runs.jsonl"), before);
    EXPECT_EQ(read_text(run / "repetitions.jsonl"), repetitions);
    fs::remove_all(run);
  }
}

TEST_F(RunnerTest, RepetitionsOfAnEarlierStartAreKept) {
  const plan::Plan plan = plan_of({"polylidar", "good"}, 5);
  measure(plan);
  // As if the first start had been killed in the middle of a line, after two repetitions of each and before
  // any row.
  const fs::path run = folder_.path() / "run";
  fs::remove(run / "runs.jsonl");
  std::string kept;
  for (const json& line : lines("repetitions.jsonl")) {
    if (line["repetition"] < 2) kept += line.dump() + "\n";
  }
  write_text(run / "repetitions.jsonl", kept + R"({"id": "torn)");
  write_text(run / "runs.jsonl", "{\"schema_ver");

  EXPECT_EQ(exit_code(measure(plan)), 0);
  EXPECT_EQ(read_text(run / "repetitions.jsonl").substr(0, kept.size()), kept);
  std::set<std::pair<std::string, int>> seen;
  for (const json& line : lines("repetitions.jsonl")) {
    EXPECT_TRUE(seen.emplace(line["id"].get<std::string>(), line["repetition"].get<int>()).second);
  }
  EXPECT_EQ(seen.size(), 10U);
  for (const auto& [method, row] : rows()) EXPECT_EQ(row.time_ns.size(), 5U) << method;
}

TEST_F(RunnerTest, ARowOfAnotherVersionDataOrParametersIsMeasuredAgain) {
  const plan::Plan plan = plan_of({"good", "polylidar"});
  const std::vector<std::function<void(record::RunRecord&)>> differences = {
      [](record::RunRecord& record) { record.method_version = "0.9"; },
      [](record::RunRecord& record) { record.dataset_sha256 = sha256_hex("other points"); },
      [](record::RunRecord& record) { record.parameters.at("size") = 2; },
      [](record::RunRecord& record) { record.seed = 7; }};
  for (const auto& make_different : differences) {
    measure(plan);
    const record::RunRecord whole = rows().at("good");
    std::string text;
    for (const json& line : lines("runs.jsonl")) {
      auto record = line.get<record::RunRecord>();
      if (record.method == "good") make_different(record);
      record.id = record::run_identity(record);
      text += json(record).dump() + "\n";
    }
    write_text(folder_.path() / "run" / "runs.jsonl", text);
    ASSERT_NE(rows().at("good").id, whole.id);
    measure(plan);
    EXPECT_EQ(rows().size(), 2U);
    EXPECT_EQ(rows().at("good").id, whole.id);
    EXPECT_EQ(rows().at("good").parameters, whole.parameters);
    EXPECT_EQ(rows().at("good").dataset_sha256, whole.dataset_sha256);
  }
}

TEST_F(RunnerTest, ARowOfAMethodThatIsGoneIsKept) {
  const plan::Plan plan = plan_of({"good"});
  measure(plan);

  EXPECT_EQ(exit_code(measure(plan, &gone)), 0);
  EXPECT_EQ(to_string(rows().at("good").status), "ok");
}

TEST_F(RunnerTest, AMethodThatCanRunNowIsMeasured) {
  const plan::Plan plan = plan_of({"good"});

  EXPECT_EQ(exit_code(measure(plan, &gone)), 4);
  EXPECT_EQ(to_string(rows().at("good").status), "error");
  fs::remove(folder_.path() / "run" / "runs.jsonl");
  EXPECT_EQ(exit_code(measure(plan)), 0);
}

TEST_F(RunnerTest, AnInterruptionKeepsWhatIsThereAndTheNextStartGoesOn) {
  const plan::Plan plan = plan_of({"polylidar", "hang"});
  const auto interrupt_at_hang = [](const std::string& method) {
    if (method == "hang") set_interrupted(true);
    return worker_of(method);
  };
  EXPECT_EQ(exit_code(measure(plan, interrupt_at_hang)), 130);
  set_interrupted(false);
  EXPECT_EQ(exit_code(measure(plan,
                              [](const std::string& method) {
                                return method == "hang" ? gone(method) : worker_of(method);
                              })),
            4);
  EXPECT_EQ(rows().size(), 2U);
}

/// A plan of `count` cases so small that they make one batch.
plan::Plan plan_of_small_cases(const std::vector<std::string>& methods, int count) {
  json source = plan::plan_to_json(plan_of(methods, 2));
  source["cases"][0]["n"] = json::array();
  for (int i = 0; i < count; ++i) source["cases"][0]["n"].push_back(100 + i);
  return plan::parse_plan(source.dump(), "test");
}

TEST_F(RunnerTest, ABatchGivesTheSameRowsOnOneCoreAndOnSeveral) {
  const plan::Plan plan = plan_of_small_cases({"polylidar", "good", "invalid_polygon", "crash"}, 20);
  std::vector<std::vector<json>> rows;
  for (const std::vector<int>& cores : {std::vector<int>{}, std::vector<int>{0, 1}}) {
    EXPECT_EQ(exit_code(measure(plan, &worker_of, cores)), 4);
    rows.push_back(lines("runs.jsonl"));
    for (json& row : rows.back()) {
      for (const char* key : {"time_ns", "phases_ns"}) row[key] = row[key].size();
      row["metrics"].erase("peak_memory_bytes");
    }
    fs::remove_all(folder_.path() / "run");
  }
  EXPECT_EQ(rows[0].size(), 4 * 20U);
  EXPECT_EQ(rows[0], rows[1]);
}

/// How many lines of a file are there now.
std::ptrdiff_t line_count(const fs::path& file) {
  const std::string text = read_text(file);
  return std::ranges::count(text, '\n');
}

TEST_F(RunnerTest, AnInterruptionWithinABatchKeepsTheRowsOfItsFinishedCases) {
  const plan::Plan plan = plan_of_small_cases({"polylidar", "good"}, 150);
  const fs::path run = folder_.path() / "run";
  const std::jthread interrupter([&] {
    wait_until([&] { return line_count(run / "repetitions.jsonl") >= 30; });
    set_interrupted(true);
  });
  EXPECT_EQ(exit_code(measure(plan)), 130);
  const std::string kept = read_text(run / "runs.jsonl");
  // Two repetitions of two methods are a finished case; of the next one some may be there.
  const std::ptrdiff_t repetitions = line_count(run / "repetitions.jsonl");
  EXPECT_GE(repetitions, 30);
  EXPECT_LT(repetitions, 150 * 4);
  EXPECT_EQ(line_count(run / "runs.jsonl"), repetitions / 4 * 2);
  for (const json& row : lines("runs.jsonl")) EXPECT_EQ(row["time_ns"].size(), 2U) << row;

  set_interrupted(false);
  const run::RunResult second = measure(plan);
  EXPECT_EQ(exit_code(second), 0);
  EXPECT_TRUE(read_text(run / "runs.jsonl").starts_with(kept));
  EXPECT_EQ(line_count(run / "runs.jsonl"), 150 * 2);
  EXPECT_EQ(line_count(run / "repetitions.jsonl"), 150 * 4);
}

TEST_F(RunnerTest, PassesShareTheRepetitionsAndCountTheRounds) {
  plan::Plan plan = plan_of({"polylidar", "counts_runs", "good"}, 10);
  plan.methods[1].repetitions = 3;
  plan.methods[2].repetitions = 1;
  plan.passes = 3;
  EXPECT_EQ(exit_code(measure(plan)), 0);
  using Numbers = std::vector<std::int64_t>;
  const auto measured = rows();
  EXPECT_EQ(measured.at("polylidar").rounds, (Numbers{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(measured.at("polylidar").passes, (Numbers{1, 1, 1, 1, 2, 2, 2, 3, 3, 3}));
  EXPECT_EQ(measured.at("counts_runs").rounds, (Numbers{0, 4, 7})) << "the first round of each pass";
  EXPECT_EQ(measured.at("counts_runs").passes, (Numbers{1, 2, 3}));
  EXPECT_EQ(measured.at("good").rounds, Numbers{0});
  EXPECT_EQ(measured.at("good").passes, Numbers{1});
  // Each time the second run of a new process, whose first one was the warm-up.
  EXPECT_EQ(measured.at("counts_runs").time_ns, (Numbers{1002, 1002, 1002}));
  for (const auto& [method, row] : measured) EXPECT_EQ(row.time_ns.size(), row.phases_ns.size()) << method;
  EXPECT_EQ(record::validate_file(folder_.path() / "run" / "runs.jsonl"), std::vector<std::string>());
  EXPECT_EQ(seconds_left_, 0.0);
}

TEST_F(RunnerTest, AResultIsScoredInTheFirstPassOnly) {
  plan::Plan plan = plan_of({"polylidar", "good"}, 4);
  plan.passes = 2;
  EXPECT_EQ(exit_code(measure_first_pass(plan)), 0);
  const auto first = rows();
  const std::string pictures = read_text(folder_.path() / "run" / "pictures.jsonl");
  EXPECT_EQ(first.at("polylidar").time_ns.size(), 2U);
  EXPECT_EQ(lines("runs.jsonl").size(), 2U);
  EXPECT_EQ(exit_code(measure(plan)), 0);
  for (const auto& [method, row] : rows()) {
    EXPECT_EQ(row.metrics, first.at(method).metrics) << method;
    EXPECT_EQ(row.id, first.at(method).id) << method;
    ASSERT_EQ(row.time_ns.size(), 4U) << method;
    EXPECT_TRUE(
        std::equal(first.at(method).time_ns.begin(), first.at(method).time_ns.end(), row.time_ns.begin()))
        << method;
  }
  EXPECT_EQ(read_text(folder_.path() / "run" / "pictures.jsonl"), pictures);
  EXPECT_EQ(record::validate_file(folder_.path() / "run" / "runs.jsonl"), std::vector<std::string>());
}

TEST_F(RunnerTest, ALaterPassHasNoUntimedRunOfAMethodThatTakesLong) {
  plan::Plan plan = plan_of({"takes_long", "counts_runs"}, 2);
  plan.passes = 2;
  EXPECT_EQ(exit_code(measure(plan)), 0);
  EXPECT_EQ(rows().at("takes_long").time_ns, (std::vector<std::int64_t>{2'000'000'002, 2'000'000'001}));
  EXPECT_EQ(rows().at("counts_runs").time_ns, (std::vector<std::int64_t>{1002, 1002}));
}

TEST_F(RunnerTest, ALaterPassMustGiveTheSameResult) {
  plan::Plan plan = plan_of({"changes_when_started", "good"}, 4);
  plan.passes = 2;
  EXPECT_EQ(exit_code(measure(plan)), 4);
  const record::RunRecord row = rows().at("changes_when_started");
  EXPECT_EQ(to_string(row.status), "invalid_output");
  expect_says(row.detail, "different results");
  EXPECT_EQ(row.passes, (std::vector<std::int64_t>{1, 1})) << "the times before it stay";
  EXPECT_EQ(rows().at("good").passes, (std::vector<std::int64_t>{1, 1, 2, 2}));
}

TEST_F(RunnerTest, ALaterPassStartsOnlyWhatHasSomethingLeftToDo) {
  plan::Plan plan = plan_of({"crash", "good", "polylidar"}, 4);
  plan.methods[1].repetitions = 1;
  plan.passes = 2;
  std::vector<std::string> started;
  const auto note = [&](const std::string& name) {
    started.push_back(name);
    return worker_of(name);
  };
  EXPECT_EQ(exit_code(measure(plan, note)), 4);
  EXPECT_EQ(started, (std::vector<std::string>{"crash", "good", "polylidar", "polylidar"}));
  EXPECT_EQ(to_string(rows().at("crash").status), "crash");
  EXPECT_EQ(rows().at("good").time_ns.size(), 1U);
  EXPECT_EQ(rows().at("polylidar").time_ns.size(), 4U);
  EXPECT_EQ(seconds_left_, 0.0);
}

TEST_F(RunnerTest, ARunThatStoppedInTheSecondPassGoesOnThere) {
  plan::Plan plan = plan_of({"polylidar", "good"}, 6);
  plan.passes = 2;
  measure_first_pass(plan);
  const fs::path run = folder_.path() / "run";
  const std::string rows_of_first = read_text(run / "runs.jsonl");
  const auto first = rows();
  measure(plan);
  // As if it had been killed in the second pass, after its first round.
  std::string kept;
  for (const json& line : lines("repetitions.jsonl")) {
    if (line["round"] < 4) kept += line.dump() + "\n";
  }
  write_text(run / "repetitions.jsonl", kept);
  write_text(run / "runs.jsonl", rows_of_first);

  EXPECT_EQ(exit_code(measure(plan)), 0);
  EXPECT_TRUE(read_text(run / "repetitions.jsonl").starts_with(kept));
  std::set<std::pair<std::string, int>> seen;
  for (const json& line : lines("repetitions.jsonl"))
    EXPECT_TRUE(seen.emplace(line["id"].get<std::string>(), line["repetition"].get<int>()).second) << line;
  EXPECT_EQ(seen.size(), 12U);
  for (const auto& [method, row] : rows()) {
    EXPECT_EQ(row.rounds, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5})) << method;
    EXPECT_EQ(row.passes, (std::vector<std::int64_t>{1, 1, 1, 2, 2, 2})) << method;
    EXPECT_EQ(row.metrics, first.at(method).metrics) << method;
  }
}

TEST_F(RunnerTest, ARowWithoutItsRepetitionsIsMeasuredAnew) {
  plan::Plan plan = plan_of({"polylidar"}, 4);
  plan.passes = 2;
  measure_first_pass(plan);
  fs::remove(folder_.path() / "run" / "repetitions.jsonl");
  EXPECT_EQ(exit_code(measure(plan)), 0);
  EXPECT_EQ(rows().at("polylidar").passes, (std::vector<std::int64_t>{1, 1, 2, 2}));
}

TEST_F(RunnerTest, RowsOfALaterPassTakeThePlacesOfTheEarlierOnes) {
  plan::Plan plan = plan_of_small_cases({"polylidar", "good"}, 3);
  plan.passes = 2;
  measure_first_pass(plan);
  const auto names = [&] {
    std::vector<std::string> result;
    for (const json& line : lines("runs.jsonl")) result.push_back(line["name"].get<std::string>());
    return result;
  };
  const std::vector<std::string> first = names();
  measure(plan);
  EXPECT_EQ(first.size(), 6U);
  EXPECT_EQ(names(), first);
  for (const json& line : lines("runs.jsonl")) EXPECT_EQ(line["passes"], (json{1, 2})) << line;
}

/// Tells a machine whose memory is slow at these looks, counted from 1.
class SlowAt {
 public:
  explicit SlowAt(std::set<int> looks)
      : watch(
            [this, looks = std::move(looks)] {
              return record::CanaryTimes{looks.contains(++count_) ? 200 : 100, 1000};
            },
            std::chrono::nanoseconds(0)) {}

 private:
  int count_ = 0;

 public:
  run::MachineWatch watch;
};

TEST_F(RunnerTest, ARoundOnAMachineInAnotherStateIsMeasuredAgain) {
  SlowAt machine({6});
  machine_ = &machine.watch;
  measure(plan_of({"counts_runs"}, 8));
  const record::RunRecord row = rows().at("counts_runs");
  // The first run is the warm-up; the seventh, of the sixth round, does not count.
  EXPECT_EQ(row.time_ns, (std::vector<std::int64_t>{1002, 1003, 1004, 1005, 1006, 1008, 1009, 1010}));
  EXPECT_EQ(row.rounds, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(row.canary_ns, std::vector<record::CanaryTimes>(8, record::CanaryTimes{100, 1000}));
  EXPECT_EQ(row.flags, (std::vector<std::string>{record::kRemeasuredRound, record::kWorseThanConvexHull}));
  EXPECT_EQ(lines("repetitions.jsonl").size(), 8U);
  EXPECT_EQ(seconds_left_, 0.0);
}

TEST_F(RunnerTest, AMachineThatStaysInAnotherStateIsSaid) {
  SlowAt machine({6, 7, 8});
  machine_ = &machine.watch;
  plan::Plan plan = plan_of({"counts_runs"}, 8);
  plan.passes = 2;
  measure(plan);
  const record::RunRecord row = rows().at("counts_runs");
  // Four rounds in the first pass. The second is a new process; its second round is measured three times.
  EXPECT_EQ(row.time_ns, (std::vector<std::int64_t>{1002, 1003, 1004, 1005, 1002, 1005, 1006, 1007}));
  std::vector<record::CanaryTimes> canaries(8, record::CanaryTimes{100, 1000});
  canaries[5] = {200, 1000};
  EXPECT_EQ(row.canary_ns, canaries);
  EXPECT_EQ(row.flags, (std::vector<std::string>{record::kRemeasuredRound, record::kUnsteadyMachine,
                                                 record::kWorseThanConvexHull}));
  // Said of the repetition for ever, whoever goes on.
  int unsteady = 0;
  for (const json& line : lines("repetitions.jsonl")) unsteady += line.value("unsteady", false) ? 1 : 0;
  EXPECT_EQ(unsteady, 1);
  fs::remove(folder_.path() / "run" / "runs.jsonl");
  machine_ = nullptr;
  measure(plan);
  EXPECT_EQ(rows().at("counts_runs").flags, row.flags);
  EXPECT_EQ(rows().at("counts_runs").canary_ns, canaries);
}

TEST_F(RunnerTest, AllMethodsOfARoundAreMeasuredAgainButThoseThatFailed) {
  SlowAt machine({6});
  machine_ = &machine.watch;
  measure(plan_of({"counts_runs", "crash", "polylidar"}, 7));
  EXPECT_EQ(rows().at("counts_runs").time_ns.back(), 1009);
  EXPECT_EQ(rows().at("polylidar").flags, std::vector<std::string>{record::kRemeasuredRound});
  EXPECT_EQ(to_string(rows().at("crash").status), "crash");
  EXPECT_TRUE(rows().at("crash").flags.empty());
}

TEST_F(RunnerTest, AMethodThatCompilesIsWarmBeforeItsFirstCase) {
  plan::Plan plan = plan_of_small_cases({"gets_faster"}, 2);
  EXPECT_EQ(exit_code(measure(plan, &compiling_worker_of)), 0);
  const auto measured = lines("runs.jsonl");
  ASSERT_EQ(measured.size(), 2U);
  // 115 runs until it got no faster, the untimed one, and the repetitions.
  EXPECT_EQ(measured[0]["time_ns"], (json{800'117, 800'118}));
  EXPECT_EQ(measured[0]["cold_time_ns"], 8'000'001);
  EXPECT_EQ(measured[1]["time_ns"], (json{800'140, 800'141})) << "20 runs warm it up for other points";
  EXPECT_FALSE(measured[1].contains("cold_time_ns"));
  EXPECT_EQ(record::validate_file(folder_.path() / "run" / "runs.jsonl"), std::vector<std::string>());
}

TEST_F(RunnerTest, WhereTimesHardlyMatterOnlyTheProcessIsWarmedUp) {
  plan::Plan plan = plan_of_small_cases({"gets_faster"}, 2);
  plan.warmup = 0;
  EXPECT_EQ(exit_code(measure(plan, &compiling_worker_of)), 0);
  const auto measured = lines("runs.jsonl");
  ASSERT_EQ(measured.size(), 2U);
  // 115 runs, the untimed one, and the repetitions.
  EXPECT_EQ(measured[0]["time_ns"], (json{800'117, 800'118}));
  EXPECT_EQ(measured[1]["time_ns"], (json{800'120, 800'121}));
}

TEST_F(RunnerTest, EveryPassWarmsItsOwnProcesses) {
  plan::Plan plan = plan_of({"gets_faster"}, 2);
  plan.passes = 2;
  EXPECT_EQ(exit_code(measure(plan, &compiling_worker_of)), 0);
  EXPECT_EQ(rows().at("gets_faster").time_ns, (std::vector<std::int64_t>{800'117, 800'117}));
  EXPECT_EQ(rows().at("gets_faster").cold_time_ns, 8'000'001);
}

TEST_F(RunnerTest, AWarmUpThatFailsIsTheRowsFailure) {
  EXPECT_EQ(exit_code(measure(plan_of({"crash"}), &compiling_worker_of)), 4);
  EXPECT_EQ(to_string(rows().at("crash").status), "crash");
  EXPECT_EQ(rows().at("crash").detail, "SIGSEGV");
}

TEST_F(RunnerTest, OnlyTheFirstCallOfAProcessIsAColdOne) {
  const plan::Plan plan = plan_of({"polylidar"}, 1);
  const auto drawn = std::make_shared<const run::DrawnCase>(plan.expanded_cases[0], 1, folders_);
  run::Workbench bench(folder_.path() / "scratch");
  bench.add(compiling_worker_of("polylidar"), {512, std::nullopt});
  worker::MethodSession& session = *bench.find("polylidar");
  session.begin_start();
  session.finish_start();
  const auto warm_up = [&](double alpha) {
    run::MethodRun run(drawn, "polylidar", {});
    run.begin(session, session.info(), 20);
    run.record.parameters["alpha"] = alpha;
    bench.warm_up(run, run::WarmUpFor::kEachRow);
    return run.record;
  };
  EXPECT_EQ(to_string(warm_up(-1).status), "error");
  EXPECT_GT(session.pid(), 0) << "the worker lives on";
  const record::RunRecord later = warm_up(1);
  EXPECT_EQ(to_string(later.status), "ok") << later.detail;
  EXPECT_FALSE(later.cold_time_ns) << "the process has run before";
  session.quit(std::chrono::seconds(10));
  EXPECT_TRUE(warm_up(1).cold_time_ns) << "another process";
}

TEST_F(RunnerTest, WorkFilesDoNotStay) {
  measure(plan_of({"polylidar", "crash"}));
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder_.path() / "run"))
    names.insert(entry.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"pictures.jsonl", "repetitions.jsonl", "run.json", "runs.jsonl"}));
}

class PlaceTest : public ::testing::Test {
 protected:
  json header_ = header_of(plan_of({"good"}));
  TemporaryFolder folder_;

  std::unique_ptr<run::RunDirectory> open(bool force = false) {
    return run::open_run_directory(header_, {std::nullopt, force, folder_.path()});
  }
  /// The folder of a run that was begun and left.
  fs::path begun_run() {
    const auto directory = open();
    directory->write_header(header_);
    return directory->path();
  }
  std::unique_ptr<run::RunDirectory> open_out(const fs::path& out, bool force = false) {
    return run::open_run_directory(header_, {out, force, folder_.path()});
  }
};

TEST_F(PlaceTest, TheFolderSaysWhenWhereAndWhat) {
  header_["created"] = "2026-01-31T12:34:56Z";
  header_["tool"]["commit"] = "0123456789abcdef";
  const auto directory = open();
  EXPECT_EQ(directory->path(),
            folder_.path() / "runs" / ("20260131T123456Z-" + record::machine_id() + "-0123456"));
}

TEST_F(PlaceTest, AnUnfinishedRunGoesOn) {
  const fs::path path = begun_run();
  header_["created"] = "2030-01-01T00:00:00Z";
  EXPECT_EQ(open()->path(), path);
  EXPECT_NE(open(true)->path(), path);
}

TEST_F(PlaceTest, AnotherRunDoesNot) {
  const fs::path path = begun_run();
  const json original = header_;
  const std::vector<std::pair<const char*, json>> changes = {
      {"/filter", "polylidar"}, {"/plan/repetitions", 99},        {"/plan/seed", 99},
      {"/plan/timeout_s", 99},  {"/tool/binary_sha256", "other"}, {"/environment/machine_id", "other"}};
  for (const auto& [pointer, value] : changes) {
    header_ = original;
    header_[json::json_pointer(pointer)] = value;
    const auto directory = open();
    EXPECT_NE(directory->path(), path) << pointer;
    EXPECT_FALSE(directory->resumed());
  }
}

TEST_F(PlaceTest, AFinishedRunDoesNotGoOnByItself) {
  const fs::path path = begun_run();
  write_json_file(path / "report.json", {});
  EXPECT_NE(open()->path(), path);
  EXPECT_EQ(open_out(path)->path(), path);
}

TEST_F(PlaceTest, TwoAtATimeKeepApart) {
  const auto first = open();
  first->write_header(header_);
  EXPECT_NE(open()->path(), first->path());
  EXPECT_THROW(open_out(first->path()), ConfigurationError);
}

TEST_F(PlaceTest, AFolderWithSomethingElseIsRefused) {
  write_text(folder_.path() / "thesis.tex", "precious");
  EXPECT_THROW(open_out(folder_.path()), ConfigurationError);
  EXPECT_TRUE(open_out(folder_.path(), true) != nullptr);
  EXPECT_EQ(read_text(folder_.path() / "thesis.tex"), "precious");
}

TEST_F(PlaceTest, AnotherRunInTheChosenFolderIsRefusedAndOverwrittenByForce) {
  const fs::path out = folder_.path() / "mine";
  open_out(out)->write_header(header_);
  write_text(out / "runs.jsonl", "");
  header_["filter"] = "other";
  EXPECT_THROW(open_out(out), ConfigurationError);
  EXPECT_FALSE(open_out(out, true)->resumed());
}

TEST_F(PlaceTest, LatestPointsToTheRun) {
  for (const char* created : {"2026-01-01T00:00:00Z", "2027-01-01T00:00:00Z"}) {
    header_["created"] = created;
    header_["filter"] = created;
    const auto directory = open();
    run::point_latest_to(directory->path(), folder_.path());
    EXPECT_EQ(fs::canonical(folder_.path() / "latest"), fs::canonical(directory->path()));
    EXPECT_TRUE(fs::read_symlink(folder_.path() / "latest").is_relative());
  }
}

TEST(ExitCode, SaysWhatHappened) {
  const auto code = [](std::map<record::Status, int> counts) {
    return run::exit_code({false, std::move(counts)});
  };
  EXPECT_EQ(code({{record::Status::kOk, 3}}), 0);
  EXPECT_EQ(
      code({{record::Status::kOk, 3}, {record::Status::kNotInstalled, 1}, {record::Status::kUnsupported, 1}}),
      0);
  EXPECT_EQ(code({{record::Status::kNotInstalled, 1}}), 6);
  EXPECT_EQ(code({}), 6);
  for (const record::Status failure :
       {record::Status::kTimeout, record::Status::kMemory, record::Status::kCrash, record::Status::kError,
        record::Status::kInvalidOutput}) {
    EXPECT_EQ(code({{record::Status::kOk, 3}, {failure, 1}}), 4);
  }
  EXPECT_EQ(run::exit_code({true, {{record::Status::kOk, 3}}}), 130);
}

TEST(Progress, EstimatesFromTheTimesSoFar) {
  std::ostringstream out;
  // Two runs of one method, the second one with twice the points, three units each.
  run::Progress progress(out, false, 80, {{"one", {{"a", "m", 100, 3}, {"b", "m", 200, 3}}}});
  EXPECT_LT(progress.seconds_left(), 0);
  progress.begin(0);
  progress.advance(0, std::chrono::seconds(1));
  // 2 units of 100 points and 3 of 200, at 1 s for 100.
  EXPECT_NEAR(progress.seconds_left(), 8.0, 1e-9);  // rounding only: hardly any wall-clock time has passed
  progress.finish(0);
  EXPECT_NEAR(progress.seconds_left(), 6.0, 1e-9);
  progress.finish(1);
  EXPECT_EQ(progress.seconds_left(), 0.0);
  expect_says(out.str(), "[2/2]");
}

TEST(Progress, BeginsItsLineWithTheSectionsTitle) {
  std::ostringstream out;
  run::Progress progress(out, false, 80,
                         {{"One, table 1 of 3", {{"a", "m", 100, 1}}},
                          {"Two, table 2 of 3", {{"b", "m", 100, 1}}},
                          {"", {{"c", "m", 100, 1}}}});
  for (std::size_t section = 0; section < 3; ++section) {
    progress.enter(section);
    progress.begin(0);
    progress.advance(0, std::chrono::seconds(10));
    progress.finish(0);
  }
  EXPECT_EQ(out.str(),
            "hullbench: One, table 1 of 3 [1/1] 0 s, about 20 s left (estimated): a\n"
            "hullbench: Two, table 2 of 3 [1/1] 0 s, about 10 s left (estimated): b\n"
            "hullbench: [1/1] 0 s, done\n");
}

TEST(Progress, WhatIsLeftCountsTheTablesThatAreNotBegun) {
  std::ostringstream out;
  // Runs with a method, points and units.
  run::Progress progress(out, false, 80,
                         {{"One", {{"a", "m", 100, 2}}},
                          {"Two", {{"b", "m", 200, 1}, {"c", "m", 100, 1}}},
                          {"Three", {{"d", "other", 100, 1}, {"e", "m", 100, 1}}}});
  EXPECT_LT(progress.seconds_left(), 0);
  progress.begin(0);
  progress.advance(0, std::chrono::seconds(1));
  // At 1 s for 100 points of any method: 1 here, 2 + 1 in the next one, 1 + 1 in the last. Only rounding here
  // and below: hardly any wall-clock time has passed.
  EXPECT_NEAR(progress.seconds_left(), 6, 1e-9);
  progress.enter(1);
  EXPECT_NEAR(progress.seconds_left(), 5, 1e-9) << "what was left of the first is not done any more";
  progress.begin(0);
  progress.advance(0, std::chrono::seconds(8));
  // Of m: 4 s for 100 points here, and 9 s for 300 over all; of other, which nothing is known of, the same
  // 9 s for 300.
  EXPECT_NEAR(progress.seconds_left(), 4 + 3 + 3, 1e-9);
}

TEST(Progress, ALaterPassIsEstimatedByTheEarlierOnesOfItsPlan) {
  std::ostringstream out;
  run::Progress progress(out, false, 80,
                         {{"One", {{"a", "m", 100, 1}}, "one"},
                          {"Two", {{"b", "m", 100, 1}}, "two"},
                          {"One again", {{"a", "m", 100, 1}}, "one"},
                          {"Two again", {{"b", "m", 100, 1}}, "two"}});
  progress.advance(0, std::chrono::seconds(1));
  progress.enter(1);
  progress.advance(0, std::chrono::seconds(5));
  // Only rounding: hardly any wall-clock time has passed.
  EXPECT_NEAR(progress.seconds_left(), 1 + 5, 1e-9);
}

TEST(Progress, WhatIsDoneOnceMoreIsLeft) {
  std::ostringstream out;
  run::Progress progress(out, false, 80, {{"", {{"a", "m", 100, 2}}}});
  progress.advance(0, std::chrono::seconds(1));
  progress.repeat(0);
  EXPECT_NEAR(progress.seconds_left(), 2, 1e-9);
}

TEST(Progress, WritesDurationsForPeople) {
  EXPECT_EQ(run::format_duration(0.2), "0 s");
  EXPECT_EQ(run::format_duration(59.4), "59 s");
  EXPECT_EQ(run::format_duration(200), "3 min 20 s");
  EXPECT_EQ(run::format_duration(7500), "2 h 5 min");
}

}  // namespace
}  // namespace hullbench::testing
