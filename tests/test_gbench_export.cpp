// Google Benchmark's JSON: its content, and that Google Benchmark's own tool reads it.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "benchmarks/base/files.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/report/gbench_export.hpp"
#include "benchmarks/report/report.hpp"
#include "invented_run.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

json exported(int copies = 1) {
  const TemporaryFolder folder;
  write_invented_run(folder.path(), {2000});
  const json report = report::make_report(folder.path());
  std::vector<json> reports(static_cast<std::size_t>(copies), report);
  if (copies > 1) reports[1]["plan"]["name"] = "second";
  return report::gbench_report(reports);
}

TEST(GbenchExport, ContextSaysWhereAndWhatIsNotMeasured) {
  const json context = exported().at("context");
  EXPECT_EQ(context.at("date"), "2026-01-02T03:04:05Z");
  EXPECT_EQ(context.at("host_name"), "0123abcd");
  EXPECT_EQ(context.at("num_cpus"), 2);
  EXPECT_EQ(context.at("cpu_scaling_enabled"), false);
  EXPECT_EQ(context.at("caches"), json::array());
  EXPECT_EQ(context.at("load_avg"), json({0.5, 0.25, 0.125}));
  EXPECT_EQ(context.at("library_build_type"), "release");
  EXPECT_EQ(context.at("json_schema_version"), 1);
  EXPECT_EQ(context.at("cpu_time"), "not measured; real_time is repeated");
}

TEST(GbenchExport, HasEveryRepetitionAndTheAggregates) {
  const json entries = exported().at("benchmarks");
  // Polylidar on California, 2000 points: 260, 2 x 250 x 1.02 + 20 and so on, in microseconds.
  const std::string name = "polylidar/ca/n:2000/holes:0/protocol:paper";
  const double times[] = {520000, 530000, 525000};
  for (std::size_t repetition = 0; repetition < 3; ++repetition) {
    const json expected = {{"name", name},
                           {"family_index", 0},
                           {"per_family_instance_index", 0},
                           {"run_name", name},
                           {"run_type", "iteration"},
                           {"repetitions", 3},
                           {"repetition_index", repetition},
                           {"threads", 1},
                           {"iterations", 1},
                           {"real_time", times[repetition]},
                           {"cpu_time", times[repetition]},
                           {"time_unit", "ns"}};
    EXPECT_EQ(entries.at(repetition), expected);
  }
  const std::pair<const char*, double> aggregates[] = {
      {"mean", 525000}, {"median", 525000}, {"stddev", 5000}, {"cv", 5000.0 / 525000}};
  for (std::size_t place = 0; place < 4; ++place) {
    const auto& [aggregate, value] = aggregates[place];
    const json& entry = entries.at(3 + place);
    EXPECT_EQ(entry.at("name"), name + "_" + aggregate);
    EXPECT_EQ(entry.at("run_type"), "aggregate");
    EXPECT_EQ(entry.at("aggregate_name"), aggregate);
    EXPECT_EQ(entry.at("iterations"), 3);
    EXPECT_DOUBLE_EQ(entry.at("real_time").get<double>(), value);
  }
}

TEST(GbenchExport, LeavesOutFailures) {
  std::set<std::string> names;
  const json result = exported();
  for (const json& entry : result.at("benchmarks")) names.insert(entry.at("run_name"));
  // Of 14 runs two are not installed, one ran out of time and one is invalid.
  EXPECT_EQ(names.size(), 10U);
  EXPECT_EQ(names.count("spatialite/hi/n:2000/holes:0/protocol:paper"), 0U);
  EXPECT_EQ(names.count("postgis/hi/n:2000/holes:0/protocol:auto"), 0U);
}

TEST(GbenchExport, OfSeveralReportsNamesTheirPlans) {
  std::set<std::string> names;
  const json result = exported(2);
  for (const json& entry : result.at("benchmarks")) names.insert(entry.at("run_name"));
  EXPECT_EQ(names.size(), 20U);
  EXPECT_EQ(names.count("second/polylidar/ca/n:2000/holes:0/protocol:paper"), 1U);
}

TEST(GbenchExport, ASecondRunOfANameHasItsOwn) {
  const TemporaryFolder folder;
  write_invented_run(folder.path(), {2000});
  record::RunRecord other = invented_record();
  other.seed = 2;
  other.id = record::run_identity(other);
  record::JsonLinesWriter(folder.path() / "runs.jsonl").append(other);
  const json entries = report::gbench_report({report::make_report(folder.path())}).at("benchmarks");
  EXPECT_EQ(entries.back().at("name"), other.name + "/run:2_cv");
}

TEST(GbenchExport, GoogleBenchmarksOwnToolComparesTwo) {
  const std::string why = missing({COMPARE_PY, SYSTEM_PYTHON ":numpy", SYSTEM_PYTHON ":scipy"});
  if (!why.empty()) GTEST_SKIP() << why;
  const TemporaryFolder folder;
  json header = invented_run();
  header["plan"]["methods"] = json::array();
  for (const char* run : {"a", "b"}) {
    write_invented_run(folder.path() / run, {2000});
    write_json_file(folder.path() / run / "run.json", header);
  }
  // In b everything takes half as long again.
  std::vector<record::RunRecord> records = invented_records({2000});
  fs::remove(folder.path() / "b" / "runs.jsonl");
  record::JsonLinesWriter lines(folder.path() / "b" / "runs.jsonl");
  for (record::RunRecord& record : records) {
    for (std::int64_t& time : record.time_ns) time += time / 2;
    lines.append(record);
  }
  for (const std::string run : {"a", "b"}) {
    succeeded(run_program({HULLBENCH, "tables", run, "--export-gbench", run + ".json"},
                          {folder.path(), {}, false}));
  }
  const Outcome compared =
      succeeded(run_program({SYSTEM_PYTHON, COMPARE_PY, "--no-color", "benchmarks", "a.json", "b.json"},
                            {folder.path(), {}, false}));
  // 525 us and 787.5 us: +0.5 in its "Time" column; and its test of the three repetitions.
  const std::string name = "polylidar/ca/n:2000/holes:0/protocol:paper";
  const std::size_t line = compared.out.find(name + "_median ");
  ASSERT_NE(line, std::string::npos) << compared.out;
  EXPECT_NE(compared.out.substr(line, compared.out.find('\n', line) - line).find("+0.5000"),
            std::string::npos)
      << compared.out;
  expect_says(compared.out, name + "_pvalue");
  expect_says(compared.out, "U Test, Repetitions: 3 vs 3");
}

TEST(GbenchExport, AFileThatCannotBeWrittenIsRefusedBeforeTheWork) {
  const TemporaryFolder folder;
  write_invented_run(folder.path() / "a", {2000});
  for (const std::string file : {"nowhere/x.json", "a"}) {
    expect_refusal(
        run_program({HULLBENCH, "tables", "a", "--export-gbench", file}, {folder.path(), {}, false}), 2,
        "cannot write " + file);
  }
}

}  // namespace
}  // namespace hullbench::testing
