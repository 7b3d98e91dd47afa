// A report of rows from several machines has no times in its tables and judges no claim about them.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/measurements.hpp"
#include "benchmarks/report/paper_comparison.hpp"
#include "benchmarks/report/readme.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/report/tables.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

constexpr const char* kSentence =
    "Times are not shown: they were taken on 2 machines (0123abcd, ba5eba11), and times of different "
    "machines do not go into one table.";

/// `report` as if merged of two runs, the second of which measured every other row on another machine.
json on_two_machines(json report) {
  json other = report.at("environment");
  other["machine_id"] = "ba5eba11";
  other["cpu"]["model"] = "Invented CPU 4000";
  report["merged"] = json::array();
  for (const json& environment : {report.at("environment"), other}) {
    report["merged"].push_back({{"shard", nullptr},
                                {"created", report.at("created")},
                                {"resumed", json::array()},
                                {"tool", report.at("tool")},
                                {"environment", environment}});
  }
  for (std::size_t i = 0; i < report.at("runs").size(); i += 2) report["runs"][i]["machine"] = "ba5eba11";
  report["summary"] = report::make_summary(report);
  return report;
}

using TableRows = std::vector<std::vector<std::string>>;

/// The rows of a table of the invented plan, the header first.
TableRows invented_rows(const table::Document& document, const std::string& id) {
  return rows_of(document, "invented_" + id);
}

/// Everything of a document that could hold a time: no word of one may stand there.
void expect_no_times(const table::Document& document) {
  for (const table::Table& table : document.tables) {
    const std::string csv = table::to_csv(table);
    for (const char* word : {" ms", "±", "Time", "time of", "time as", "Equal work"}) {
      EXPECT_EQ(csv.find(word), std::string::npos) << table.id << ": " << word << "\n" << csv;
      EXPECT_EQ(table.caption.find(word), std::string::npos) << table.id << ": " << table.caption;
    }
  }
}

TEST(Machines, OfAReportAreThoseOfItsTimes) {
  json report = invented_report({2000});
  EXPECT_EQ(report::machines_of(report), (std::set<std::string>{"0123abcd"}));
  EXPECT_TRUE(report::Measurements(report).has_times());
  EXPECT_EQ(report::Measurements(report).why_no_times(), "");
  // A row without a time was not timed anywhere.
  for (json& run : report["runs"]) {
    if (run["time_ns"].empty()) run["machine"] = "ba5eba11";
  }
  EXPECT_EQ(report::machines_of(report).size(), 1U);
  report["runs"][0]["machine"] = "ba5eba11";
  EXPECT_EQ(report::Measurements(report).why_no_times(), kSentence);
}

TEST(Machines, SeveralLeaveNoTimeToTablesAndClaims) {
  const report::Measurements measurements(on_two_machines(invented_report({2000})));
  EXPECT_FALSE(measurements.has_times());
  for (const record::RunRecord& run : measurements.runs()) {
    EXPECT_TRUE(run.time_ns.empty() && run.phases_ns.empty()) << run.name;
  }
}

TEST(Machines, SeveralHaveNoTableOfTimesAndASentenceWhy) {
  const json report = on_two_machines(invented_report({2000, 64000}));
  const table::Document document = report::make_document(report);
  expect_no_times(document);
  const std::string text = markdown_of(report);
  std::string unbroken = text;
  for (std::size_t at = 0; (at = unbroken.find("\n  ", at)) != std::string::npos;)
    unbroken.replace(at, 3, " ");
  EXPECT_NE(unbroken.find(kSentence), std::string::npos) << text;
  EXPECT_EQ(unbroken.find("Times are medians"), std::string::npos);
  EXPECT_NE(unbroken.find("Machine 0123abcd: Invented CPU 3000"), std::string::npos) << text;
  EXPECT_NE(unbroken.find("Machine ba5eba11: Invented CPU 4000"), std::string::npos) << text;
}

TEST(Machines, SeveralLeaveTheErrorsAsTheyAre) {
  const json one = invented_report({2000, 64000});
  const table::Document whole = report::make_document(one);
  const table::Document mixed = report::make_document(on_two_machines(one));
  for (const char* id : {"ca_error", "ca_holes_error", "hi_error"})
    EXPECT_EQ(invented_rows(mixed, id), invented_rows(whole, id)) << id;
  const TableRows ratios = invented_rows(mixed, "ratios");
  const TableRows all_ratios = invented_rows(whole, "ratios");
  ASSERT_EQ(ratios.size(), all_ratios.size());
  for (std::size_t row = 1; row < ratios.size(); ++row) {
    const auto& all = all_ratios[row];
    EXPECT_EQ(ratios[row], (std::vector<std::string>{all[0], all[1], all[6], all[7], all[8], all[10]}));
  }
}

TEST(Machines, SeveralLeaveOnlyTheClaimsAboutErrors) {
  const json one = invented_report({2000, 64000});
  const json mixed = on_two_machines(one);
  std::size_t about_time = 0;
  std::size_t judged = 0;
  for (std::size_t i = 0; i < report::paper().at("claims").at("list").size(); ++i) {
    const json& claim = mixed.at("summary").at("claims").at(i);
    if (report::is_about_time(report::paper()["claims"]["list"][i])) {
      ++about_time;
      EXPECT_TRUE(claim["verdict"].is_null() && claim["value"].is_null() && claim["equal_work"].is_null())
          << claim;
      EXPECT_EQ(claim["detail"], kSentence);
    } else {
      EXPECT_EQ(claim, one.at("summary").at("claims").at(i));
      if (!claim["verdict"].is_null()) ++judged;
    }
  }
  EXPECT_GT(about_time, 0U);
  EXPECT_GT(judged, 0U);
  EXPECT_EQ(invented_rows(report::make_document(mixed), "claims").size() - 1,
            report::paper()["claims"]["list"].size() - about_time);
}

TEST(Machines, SeveralKeepEveryTimeInTheReport) {
  const json one = invented_report({2000});
  const json mixed = on_two_machines(one);
  EXPECT_EQ(mixed.at("summary").at("rows"), one.at("summary").at("rows"));
  EXPECT_EQ(mixed.at("runs")[0].at("time_ns"), one.at("runs")[0].at("time_ns"));
  EXPECT_EQ(record::validate_report(mixed), std::vector<std::string>{});
}

TEST(Machines, SeveralLeaveTablesOfManyShapesTheirErrors) {
  const std::vector<InventedShape> letters = {{"letter_a", 2000, 0.5, 2, 0.1},
                                              {"letter_z", 2000, 0.5, 4, 0.2}};
  const json one = report_on_shapes(letters);
  const json mixed = on_two_machines(one);
  expect_no_times(report::make_document(mixed));
  const TableRows rows = invented_rows(report::make_document(mixed), "summary");
  const TableRows all = invented_rows(report::make_document(one), "summary");
  ASSERT_EQ(rows.size(), all.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    ASSERT_EQ(rows[row].size(), 6U);
    EXPECT_TRUE(std::equal(rows[row].begin(), rows[row].end(), all[row].begin()));
  }
}

TEST(Machines, SeveralAreNotComparedWithThePapersTimes) {
  const json one = report_on_shapes({{"letter_a", 2000, 0.5, 2, 0.1}, {"letter_z", 2000, 0.5, 4, 0.2}});
  const auto comparisons = report::compare_with_paper(on_two_machines(one));
  EXPECT_EQ(comparisons.size(), 4U);
  for (const report::Comparison& comparison : comparisons) EXPECT_EQ(comparison.quantity, "error");
  expect_says(report::differences_table({on_two_machines(one)}).remarks.front(), kSentence);
}

TEST(Machines, OfSeveralReportsDoNotShareOneTable) {
  const json one = report_on_shapes({{"letter_a", 2000, 0.5, 2, 0.1}, {"letter_z", 2000, 0.5, 4, 0.2}});
  json other = one;
  other["environment"]["machine_id"] = "ba5eba11";
  const std::size_t rows = report::differences_table({one}).rows.size();
  EXPECT_EQ(report::differences_table({one, one}).rows.size(), 2 * rows);
  const table::Table mixed = report::differences_table({one, other});
  EXPECT_EQ(mixed.rows.size(), rows);
  expect_says(mixed.remarks.front(), kSentence);
}

TEST(Machines, SeveralAreSaidInTheReadme) {
  json report = on_two_machines(invented_report({2000}));
  report["plan"]["methods"] = json::array();
  const std::string text = report::readme_results({report}, "results/x");
  expect_says(text, "Times are not shown");
}

TEST(Machines, OneWithSeveralBuildsHasNoTimes) {
  const json one = invented_report({2000});
  json report = on_two_machines(one);
  report["merged"][1]["environment"] = report["environment"];
  for (json& run : report["runs"]) run["machine"] = "0123abcd";
  EXPECT_EQ(report::Measurements(report).why_no_times(), "");
  report["merged"][0]["tool"]["binary_sha256"] = std::string(64, 'b');
  report["merged"][1]["tool"]["binary_sha256"] = std::string(64, 'a');
  const std::string sentence =
      "Times are not shown: they were taken with 2 builds of the program (aaaaaaaa, bbbbbbbb), and times of "
      "different builds do not go into one table.";
  EXPECT_EQ(report::Measurements(report).why_no_times(), sentence);
  expect_says(report::differences_table({report}).remarks.front(), sentence);
  expect_no_times(report::make_document(report));
}

TEST(Machines, OneOfAMergedRunHasItsTimes) {
  json report = on_two_machines(invented_report({2000, 64000}));
  report["merged"][1]["environment"] = report["environment"];
  for (json& run : report["runs"]) run["machine"] = "0123abcd";
  report["summary"] = report::make_summary(report);
  const std::string text = markdown_of(report);
  expect_says(text, "time of equal work, ms");
  expect_says(text, "Merged of 2 runs, all timed on machine 0123abcd.");
  EXPECT_EQ(text.find("Times are not shown"), std::string::npos);
}

}  // namespace
}  // namespace hullbench::testing
