// Two runs side by side: the pairs, the calls, and the program's answers.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/base/files.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/report/compare.hpp"
#include "benchmarks/report/compare_document.hpp"
#include "benchmarks/report/report.hpp"
#include "invented_run.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

/// A successful run of polylidar with these times.
record::RunRecord run_on(const std::string& dataset, const std::vector<std::int64_t>& times) {
  record::RunRecord run = invented_record();
  run.dataset = dataset;
  run.time_ns = times;
  run.phases_ns.resize(times.size());
  run.name = run_name(run);
  run.id = record::run_identity(run);
  return run;
}

json report_of(const std::vector<record::RunRecord>& runs, const std::string& plan = "p") {
  return {{"plan", {{"name", plan}}}, {"runs", runs}};
}

const std::vector<std::int64_t> kSlow = {200, 204, 202, 206, 208, 210};
const std::vector<std::int64_t> kFast = {100, 102, 101, 103, 104, 105};

TEST(CompareRuns, CallsWhatIsApartAndNothingElse) {
  const report::RunsCompared compared =
      report::compare_runs({report_of({run_on("a", kSlow), run_on("b", kFast), run_on("c", kFast)})},
                           {report_of({run_on("a", kFast), run_on("b", kSlow), run_on("c", kFast)})});
  ASSERT_EQ(compared.pairs.size(), 3U);
  EXPECT_EQ(compared.judged, 3U);
  EXPECT_EQ(compared.pairs[0].change, report::Change::kFaster);
  EXPECT_EQ(compared.pairs[1].change, report::Change::kSlower);
  EXPECT_EQ(compared.pairs[2].change, report::Change::kNotApart);
  // Two orders of 12! / (6! 6!), and three pairs.
  EXPECT_NEAR(compared.pairs[0].adjusted_p_value, 3 * 2.0 / 924, 1e-15);
}

TEST(CompareRuns, ManyPairsNeedMoreThanOneDoes) {
  // Four against four values lie apart with p = 2 / 70: enough alone, not among two.
  const std::vector<std::int64_t> slow = {20, 21, 22, 23};
  const std::vector<std::int64_t> fast = {10, 11, 12, 13};
  EXPECT_EQ(report::compare_runs({report_of({run_on("a", slow)})}, {report_of({run_on("a", fast)})})
                .pairs[0]
                .change,
            report::Change::kFaster);
  const report::RunsCompared two = report::compare_runs({report_of({run_on("a", slow), run_on("b", slow)})},
                                                        {report_of({run_on("a", fast), run_on("b", fast)})});
  EXPECT_EQ(two.pairs[0].change, report::Change::kNotApart);
  EXPECT_LT(two.pairs[0].time->interval->high, 1);
}

TEST(CompareRuns, FewRepetitionsAreNotJudged) {
  const report::RunsCompared compared =
      report::compare_runs({report_of({run_on("a", {5})})}, {report_of({run_on("a", {10})})});
  EXPECT_EQ(compared.pairs[0].change, report::Change::kNotJudged);
  EXPECT_EQ(compared.pairs[0].time->ratio, 2);
  EXPECT_EQ(compared.judged, 0U);
}

TEST(CompareRuns, FailuresAreChangesToo) {
  record::RunRecord crashed = run_on("a", {});
  crashed.status = record::Status::kCrash;
  const auto change = [](const record::RunRecord& a, const record::RunRecord& b) {
    return report::compare_runs({report_of({a})}, {report_of({b})}).pairs.at(0).change;
  };
  EXPECT_EQ(change(run_on("a", kFast), crashed), report::Change::kNowFails);
  EXPECT_EQ(change(crashed, run_on("a", kFast)), report::Change::kNowWorks);
  EXPECT_EQ(change(crashed, crashed), report::Change::kFailsInBoth);
  record::RunRecord invalid = run_on("a", kFast);
  invalid.metrics["valid"] = false;
  EXPECT_EQ(change(run_on("a", kFast), invalid), report::Change::kNowFails);
}

TEST(CompareRuns, PairsByPlanFirstThenByNameThenInOrder) {
  // "a" stands in both plans of A; B has its plans the other way round, and a run of "a" of a third plan.
  const std::vector<json> a = {report_of({run_on("a", {1}), run_on("a", {2})}, "x"),
                               report_of({run_on("a", {3}), run_on("b", {4})}, "y")};
  const std::vector<json> b = {report_of({run_on("a", {30})}, "y"), report_of({run_on("a", {10})}, "x"),
                               report_of({run_on("a", {20}), run_on("c", {50})}, "z")};
  const report::RunsCompared compared = report::compare_runs(a, b);
  std::vector<std::pair<std::int64_t, std::int64_t>> times;
  for (const report::RunPair& pair : compared.pairs) times.emplace_back(pair.a.time_ns[0], pair.b.time_ns[0]);
  const std::vector<std::pair<std::int64_t, std::int64_t>> expected = {{1, 10}, {2, 20}, {3, 30}};
  EXPECT_EQ(times, expected);
  EXPECT_EQ(compared.only_a, std::vector<std::string>{run_on("b", {4}).name});
  EXPECT_EQ(compared.only_b, std::vector<std::string>{run_on("c", {5}).name});
}

/// The method in two runs: in A it took 10 everywhere, in B these times, each on a data set of its own at
/// four sizes.
report::MethodChange change_on(const std::map<std::string, std::int64_t>& times) {
  std::vector<record::RunRecord> a;
  std::vector<record::RunRecord> b;
  for (const auto& [dataset, time] : times) {
    for (const std::int64_t n : {1000, 2000, 3000, 4000}) {
      a.push_back(run_on(dataset, {10}));
      b.push_back(run_on(dataset, {time}));
      for (record::RunRecord* run : {&a.back(), &b.back()}) {
        run->n = n;
        run->name = run_name(*run);
      }
    }
  }
  return report::compare_runs({report_of(a)}, {report_of(b)}).methods.at(0);
}

TEST(CompareRuns, AMethodsMedianIsClusteredByShape) {
  const report::MethodChange method =
      change_on({{"shape-20", 20}, {"shape-30", 30}, {"shape-40", 40}, {"shape-50", 50}, {"shape-60", 60}});
  EXPECT_EQ(method.pairs, 20U);
  EXPECT_EQ(method.ratio, 4);
  // Five shapes, as five values: the whole range. Twenty independent values would give 3 to 5.
  ASSERT_TRUE(method.interval.has_value());
  EXPECT_EQ(method.interval->low, 2);
  EXPECT_EQ(method.interval->high, 6);
}

TEST(CompareRuns, VariantsOfAShapeAreOne) {
  // The members of a graded family, and one shape sampled in several ways.
  const report::MethodChange graded = change_on(
      {{"channel-1", 20}, {"channel-2", 30}, {"channel-3", 40}, {"channel-4", 50}, {"channel-5", 60}});
  EXPECT_EQ(graded.ratio, 4);
  EXPECT_FALSE(graded.interval.has_value());
  EXPECT_FALSE(change_on({{"ca", 20}, {"ca~noise:0.5", 30}, {"ca~noise:1", 40}}).interval.has_value());
}

bool has_note(const table::Document& document, const std::string& words) {
  return std::ranges::any_of(document.notes,
                             [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

table::Document document_of(const json& a, const json& b) {
  return report::comparison_document(report::compare_runs({a}, {b}), {"A.json", {a}}, {"B.json", {b}}, false);
}

TEST(CompareDocument, SaysOtherMachinesPointsParametersAndVersions) {
  record::RunRecord other = run_on("a", kFast);
  other.machine = "ffffffff";
  other.dataset_sha256 = std::string(64, '0');
  other.parameters["alpha"] = 1;
  other.method_version = "2.0";
  record::RunRecord run = run_on("a", kFast);
  run.machine = "0123abcd";
  const table::Document document = document_of(report_of({run}), report_of({other}));
  EXPECT_TRUE(has_note(document, "THE MACHINES DIFFER (A: 0123abcd; B: ffffffff)"));
  EXPECT_TRUE(has_note(document, "OTHER POINTS in 1 of 1 pairs (polylidar)"));
  EXPECT_TRUE(has_note(document, "Other parameters in 1 of 1 pairs"));
  EXPECT_TRUE(has_note(document, "Other versions of polylidar: A 1.0; B 2.0."));
  // Kept records have the first digits of the hashes.
  record::RunRecord kept = run;
  kept.dataset_sha256.resize(12);
  EXPECT_FALSE(has_note(document_of(report_of({kept}), report_of({run})), "OTHER POINTS"));
  EXPECT_TRUE(has_note(document_of(report_of({kept}), report_of({other})), "OTHER POINTS"));
  const table::Document same = document_of(report_of({run}), report_of({run}));
  for (const char* words : {"MACHINES", "OTHER POINTS", "Other parameters", "Other versions"})
    EXPECT_FALSE(has_note(same, words)) << words;
}

TEST(CompareDocument, OfManyPairsShowsThoseThatChanged) {
  std::vector<record::RunRecord> a;
  std::vector<record::RunRecord> b;
  a.reserve(300);
  for (int place = 0; place < 300; ++place) a.push_back(run_on("d-" + std::to_string(place), {1}));
  b = a;
  b[7].status = record::Status::kTimeout;
  const json report_a = report_of(a);
  const json report_b = report_of(b);
  const report::RunsCompared compared = report::compare_runs({report_a}, {report_b});
  const auto rows = [&](bool every_pair) {
    return report::comparison_document(compared, {"A", {report_a}}, {"B", {report_b}}, every_pair)
        .tables.back()
        .rows.size();
  };
  EXPECT_EQ(rows(false), 1U);
  EXPECT_EQ(rows(true), 300U);
}

class CompareCommandTest : public HullbenchTest {
 protected:
  CompareCommandTest() {
    for (const char* name : {"a", "b"}) write_invented_run(path(name), {2000, 64000});
    write_json_file(path("report.json"), report::make_report(path("a")));
    fs::copy(path("a") / "runs.jsonl", path("lines.jsonl"));
  }
  fs::path path(const std::string& name) const { return folder() / name; }
  Outcome compare(const std::string& a, const std::string& b,
                  const std::vector<std::string>& more = {}) const {
    return hullbench(joined({"compare", a, b}, more));
  }
};

TEST_F(CompareCommandTest, TakesFoldersReportsAndLines) {
  for (const char* a : {"a", "report.json", "lines.jsonl", "a/runs.jsonl"}) {
    const Outcome outcome = compare(a, "b");
    EXPECT_EQ(outcome.code, 0) << a << outcome.err;
    EXPECT_NE(outcome.out.find("polylidar/ca/n:2000/holes:0/protocol:paper"), std::string::npos) << a;
    EXPECT_NE(outcome.out.find("fails in both"), std::string::npos) << a;
    EXPECT_NE(outcome.out.find("Faster and slower are of these two runs"), std::string::npos) << a;
  }
}

TEST_F(CompareCommandTest, PrintsEveryFormat) {
  const json parsed = json::parse(compare("a", "b", {"--format", "json"}).out);
  EXPECT_EQ(parsed["pairs"].size(), invented_records({2000, 64000}).size());
  EXPECT_EQ(parsed["pairs"][0]["ratio"], 1.0);
  EXPECT_EQ(parsed["methods"].size(), 5U);
  const Outcome csv = compare("a", "b", {"--format", "csv"});
  EXPECT_EQ(csv.out.substr(0, csv.out.find('\n')),
            "Run,\"A, ms\",\"B, ms\",B / A,95 %,B is,L2 of A,L2 of B,B - A");
  expect_says(compare("a", "b", {"--format", "latex"}).out, "\\label{tab:compare_runs}");
  expect_refusal(compare("a", "b", {"--format", "word"}), 2, "--format");
}

TEST_F(CompareCommandTest, KeptRowsMayHaveNoTimes) {
  write_invented_run(path("timeless"), {2000, 64000});
  change_rows("timeless", [](json& row) {
    if (row.contains("time_ns")) row["time_ns"] = json::array();
  });
  const json parsed = json::parse(compare("a", "timeless", {"--format", "json"}).out);
  EXPECT_TRUE(parsed["pairs"][0]["ratio"].is_null());
  EXPECT_TRUE(parsed["pairs"][0]["median_b_ns"].is_null());
}

TEST_F(CompareCommandTest, NamesRunsThatOnlyOneHas) {
  write_invented_run(path("c"), {2000});
  expect_end(compare("a", "c"), 0, "", "Only in A, 14: polylidar/ca/n:64000/holes:0/protocol:paper");
}

TEST_F(CompareCommandTest, RefusesWhatCannotBeCompared) {
  expect_refusal(compare("nowhere", "b"), 2, "there is no run nowhere");
  fs::create_directory(path("empty"));
  expect_refusal(compare("a", "empty"), 2, "there is no run in empty");
  write_text(path("broken.json"), "{\"runs\": 3}");
  expect_refusal(compare("broken.json", "b"), 2, "broken.json is not a report");
  write_text(path("old.json"), R"({"runs": [], "schema_version": 99})");
  expect_refusal(compare("old.json", "b"), 2, "old.json is of another schema version");
  write_text(path("bad.jsonl"), "{}\n");
  expect_refusal(compare("a", "bad.jsonl"), 2, "bad.jsonl");
  write_text(path("bad.json"), R"({"schema_version": 1, "runs": [{}]})");
  expect_refusal(compare("a", "bad.json"), 2, "cannot be read");
  write_text(path("cut.jsonl.xz"), "no xz");
  expect_refusal(compare("cut.jsonl.xz", "b"), 2, "cut.jsonl.xz");
  write_invented_run(path("other"), {500});
  expect_refusal(compare("a", "other"), 6, "have no run in common");
}

}  // namespace
}  // namespace hullbench::testing
