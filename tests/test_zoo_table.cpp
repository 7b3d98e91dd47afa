// The table of the plan zoo: what each cell says, and that it takes the place of the other tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/tables.hpp"
#include "benchmarks/report/zoo_table.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_run.hpp"
#include "invented_shapes.hpp"

namespace hullbench::testing {
namespace {

record::RunRecord good_run() {
  record::RunRecord run = invented_record();
  run.metrics["valid"] = true;
  run.metrics["polygons"] = 1;
  run.metrics["points_covered"] = 0.95;
  run.metrics["l2"] = 0.2;
  run.metrics["l2_convex_hull"] = 0.3;
  return run;
}

std::string word_with(const char* metric, const json& value, bool has_area = true) {
  record::RunRecord run = good_run();
  run.metrics[metric] = value;
  return report::zoo_word(run, has_area);
}

std::string word_of(record::Status status, bool has_area = true) {
  record::RunRecord run = good_run();
  run.status = status;
  return report::zoo_word(run, has_area);
}

TEST(ZooTable, SaysHowARunEnded) {
  using record::Status;
  EXPECT_EQ(report::zoo_word(good_run(), true), "ok");
  EXPECT_EQ(word_of(Status::kTimeout), "time-out");
  EXPECT_EQ(word_of(Status::kMemory), "no memory");
  EXPECT_EQ(word_of(Status::kCrash), "crash");
  EXPECT_EQ(word_of(Status::kError), "error");
  EXPECT_EQ(word_of(Status::kUnsupported), "error");
  EXPECT_EQ(word_of(Status::kInvalidOutput), "invalid");
  EXPECT_EQ(word_of(Status::kNotInstalled), table::kNothing);
}

TEST(ZooTable, SaysWhatIsWrongWithAResult) {
  EXPECT_EQ(word_with("valid", false), "invalid");
  EXPECT_EQ(word_with("polygons", 0), "empty");
  EXPECT_EQ(word_with("points_covered", 0.9), "ok");
  EXPECT_EQ(word_with("points_covered", 0.89), "lost points");
  EXPECT_EQ(word_with("l2", 0.39), "ok");
  EXPECT_EQ(word_with("l2", 0.41), "wrong");  // by more than a tenth worse than the convex hull
  EXPECT_EQ(word_with("l2_convex_hull", 0.05), "wrong");
  EXPECT_EQ(word_with("l2", nullptr), "ok");  // of no known shape
  record::RunRecord as_bad_as_the_hull = good_run();
  as_bad_as_the_hull.metrics["l2"] = 0.51;
  as_bad_as_the_hull.metrics["l2_convex_hull"] = 0.51;
  EXPECT_EQ(report::zoo_word(as_bad_as_the_hull, true), "wrong");
}

TEST(ZooTable, PointsWithoutAnAreaHaveAnEmptyHull) {
  EXPECT_EQ(word_with("polygons", 0, false), "ok");
  EXPECT_EQ(word_with("polygons", 1, false), "wrong");
  EXPECT_EQ(word_of(record::Status::kError, false), "ok");
  EXPECT_EQ(word_of(record::Status::kCrash, false), "crash");
}

/// Two cases. Of the second one all results are empty, the convex hull too.
json zoo_report(const std::string& one = "zoo-one", const std::string& flat = "zoo-flat") {
  json report = report_on_shapes({{one, 5, 1}, {flat, 5, 1}});
  report["plan"]["name"] = "zoo";
  report["datasets"][0]["name"] = one;
  report["datasets"][0]["title"] = "One point";
  for (json& run : report.at("runs")) {
    if (run.at("method") == "cgal_alpha_shape") {
      run["method"] = "convex_hull";
      run["protocol"] = "default";
    }
    if (run.at("status") != "ok") continue;
    run["metrics"]["l2"] = 0.1;
    run["metrics"]["points_covered"] = 1;
    run["metrics"]["polygons"] = run.at("dataset") == flat ? 0 : 1;
  }
  run_on(report, "polylidar", one)["status"] = "crash";
  return report;
}

TEST(ZooTable, HasARowACaseAndAColumnAMethod) {
  const table::Document document = report::make_document(zoo_report());
  EXPECT_EQ(document.tables.at(0).id, "zoo_cases");
  const std::vector<std::vector<std::string>> rows = table::shown(document.tables.at(0));
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows.at(1).at(0), "zoo-one");
  EXPECT_EQ(rows.at(1).at(1), "One point");
  EXPECT_EQ(rows.at(1).at(2), "crash");
  EXPECT_EQ(rows.at(2).at(0), "zoo-flat");
  EXPECT_EQ(rows.at(2).at(2), "ok");
  EXPECT_EQ(rows.at(3).at(0), "ok, of 2");
  EXPECT_EQ(rows.at(3).at(2), "1");
  for (const table::Table& table : document.tables) EXPECT_EQ(table.id.find("collection"), std::string::npos);
}

TEST(ZooTable, WhichPointsHaveAnAreaIsKnownWithoutTheConvexHullsRow) {
  // One point, of which the hull must be empty, and points with an area.
  const auto rows =
      rows_of(report::make_document(zoo_report("zoo-qgis-65899", "zoo-libpysal-111")), "zoo_cases");
  ASSERT_EQ(rows.size(), 4U);
  const auto hull = std::ranges::find(rows.at(0), "convex_hull (default)") - rows.at(0).begin();
  const auto column = static_cast<std::size_t>(hull);
  EXPECT_EQ(rows.at(1).at(column), "wrong");
  EXPECT_EQ(rows.at(2).at(column), "empty");
}

}  // namespace
}  // namespace hullbench::testing
