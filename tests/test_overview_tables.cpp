// The tables of methods and of parameters.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/overview_tables.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

using Row = std::vector<std::string>;

/// The row that begins with these cells; empty, and a failure, when there is none.
Row row_of(const table::Table& table, const Row& begin) {
  for (const Row& row : table::shown(table)) {
    if (Row(row.begin(), row.begin() + static_cast<Row::difference_type>(begin.size())) == begin) return row;
  }
  ADD_FAILURE() << "no row of " << begin.front();
  return {};
}

bool has_row(const table::Table& table, const std::string& begin) {
  for (const Row& row : table::shown(table)) {
    if (row.front() == begin) return true;
  }
  return false;
}

json* method_in(json& report, const std::string& name) {
  for (json& method : report.at("methods")) {
    if (method.at("name") == name) return &method;
  }
  return nullptr;
}

TEST(MethodsTable, SaysWhatTheAdaptersSay) {
  json report = invented_report({2000});
  EXPECT_EQ(table::shown(report::methods_table({report})).front(),
            (Row{"Method", "The library returns", "Holes", "Several polygons", "Version", "Licence"}));
  EXPECT_EQ(row_of(report::methods_table({report}), {"Polylidar"}),
            (Row{"Polylidar", "polygons", "yes", "yes", "1.0", "MIT"}));
  (*method_in(report, "polylidar"))["capabilities"]["holes"] = false;
  EXPECT_EQ(row_of(report::methods_table({report}), {"Polylidar"}),
            (Row{"Polylidar", "polygons", "no", "yes", "1.0", "MIT"}));
  (*method_in(report, "polylidar"))["capabilities"]["several_polygons"] = false;
  (*method_in(report, "polylidar"))["native_output"] = "triangles";
  EXPECT_EQ(row_of(report::methods_table({report}), {"Polylidar"}),
            (Row{"Polylidar", "triangles", "no", "no", "1.0", "MIT"}));
}

TEST(MethodsTable, OfAMethodThatNeverStartedHasDashes) {
  json report = invented_report({2000});
  json& missing = *method_in(report, "postgis_legacy");
  for (const char* key : {"native_output", "licence"}) missing[key] = "";
  missing["capabilities"] = json::object();
  EXPECT_EQ(row_of(report::methods_table({report}), {"PostGIS 2.5"}),
            (Row{"PostGIS 2.5", "–", "–", "–", "–", "–"}));
}

TEST(MethodsTable, HasAMethodOfSeveralReportsOnce) {
  const json report = invented_report({2000});
  EXPECT_EQ(report::methods_table({report, report}).rows.size(), report.at("methods").size());
}

TEST(MethodsTable, OfNoReportsIsEmpty) {
  EXPECT_TRUE(report::methods_table({}).rows.empty());
  EXPECT_TRUE(report::parameters_table({}).rows.empty());
}

/// The invented report with a plan of these methods.
json report_with_methods(const std::vector<json>& methods) {
  json report = invented_report({2000});
  report["plan"]["methods"] = methods;
  report["rules"] = {{"paper_alpha", "2 sqrt(A / n)"}};
  return report;
}

json method(const std::string& name, const std::string& protocol, const json& parameters) {
  return {{"method", name}, {"protocol", protocol}, {"parameters", parameters}};
}

TEST(ParametersTable, HasNumbersAndFormulasAColumnAnExperiment) {
  const json first =
      report_with_methods({method("polylidar", "paper", {{"alpha", {{"rule", "paper_alpha"}}}}),
                           method("spatialite", "paper", {{"c", 2.5}, {"allow_holes", 1}})});
  json second = report_with_methods({method("polylidar", "paper", {{"alpha", nullptr}})});
  second["plan"]["title"] = "Another";
  const table::Table table = report::parameters_table({first, second});
  EXPECT_EQ(table::shown(table),
            (std::vector<Row>{{"Method", "Parameter", "Invented numbers", "Another"},
                              {"Polylidar (paper)", "alpha", "2 sqrt(A / n)", "no limit"},
                              {"SpatiaLite (paper)", "allow_holes", "1", ""},
                              {"SpatiaLite (paper)", "c", "2.5", ""}}));
}

TEST(ParametersTable, TakesARulesFormulaFromTheReport) {
  json report = report_with_methods({method("polylidar", "paper", {{"alpha", {{"rule", "paper_alpha"}}}})});
  report["rules"]["paper_alpha"] = "another formula";
  EXPECT_EQ(row_of(report::parameters_table({report}), {"Polylidar (paper)"})[2], "another formula");
  report.erase("rules");
  EXPECT_EQ(row_of(report::parameters_table({report}), {"Polylidar (paper)"})[2], "paper_alpha");
}

TEST(ParametersTable, HasValuesGivenByCaseAColumnADataSet) {
  const json cases = {{"ca", 2.0}, {"ca/holes", 1.25}, {"hi/holes", 3}};
  const json report =
      report_with_methods({method("polylidar", "paper", {{"alpha", 1.5}}),
                           method("spatialite", "paper", {{"c", {{"cases", cases}}}, {"allow_holes", 1}})});
  const table::Table table = report::parameters_table({report});
  EXPECT_EQ(table::shown(table),
            (std::vector<Row>{{"Method", "Parameter", "California", "Hawaii"},
                              {"Polylidar (paper)", "alpha", "1.5", "1.5"},
                              {"SpatiaLite (paper)", "allow_holes", "1", "1"},
                              {"SpatiaLite (paper)", "c", "2; 1.25 with holes", "3 with holes"}}));
}

TEST(ParametersTable, SaysWhatWasChosenForTheShapeAlone) {
  const json cases = {{"ca/n:2000", 2.0}, {"ca/holes/n:2000", nullptr}};
  const json report =
      report_with_methods({method("polylidar", "paper", {{"alpha", {{"scaled", 1.5}, {"power", 1}}}}),
                           method("spatialite", "paper", {{"c", {{"cases", cases}}}})});
  const table::Table table = report::parameters_table({report});
  EXPECT_EQ(row_of(table, {"Polylidar (paper)"})[2], "1.5 √(A_hull/n)");
  EXPECT_EQ(row_of(table, {"SpatiaLite (paper)"})[2], "case by case");
}

TEST(ParametersTable, SaysAValueOnceThatHolesDoNotChange) {
  const json cases = {{"ca", 2.0}, {"ca/holes", 2.0}, {"hi", 4}};
  const json report = report_with_methods({method("spatialite", "paper", {{"c", {{"cases", cases}}}})});
  EXPECT_EQ(row_of(report::parameters_table({report}), {"SpatiaLite (paper)"}),
            (Row{"SpatiaLite (paper)", "c", "2", "4"}));
}

TEST(ParametersTable, LeavesOutDataSetsWithoutARun) {
  const json cases = {{"ca", 2.0}, {"mars", 4}};
  const json report = report_with_methods({method("spatialite", "paper", {{"c", {{"cases", cases}}}})});
  EXPECT_EQ(table::shown(report::parameters_table({report})).front(),
            (Row{"Method", "Parameter", "California"}));
}

TEST(ParametersTable, IsEmptyWhereAMethodKeepsToOtherDataSets) {
  const json cases = {{"ca", 2.0}, {"hi", 4}};
  json polylidar = method("polylidar", "paper", {{"alpha", 1.5}});
  polylidar["datasets"] = {"hi"};
  const json report =
      report_with_methods({polylidar, method("spatialite", "paper", {{"c", {{"cases", cases}}}})});
  EXPECT_EQ(row_of(report::parameters_table({report}), {"Polylidar (paper)"}),
            (Row{"Polylidar (paper)", "alpha", "", "1.5"}));
}

TEST(ParametersTable, LeavesOutMethodsWithoutRuns) {
  json report = report_with_methods({method("polylidar", "paper", {{"alpha", 1.5}}),
                                     method("polylidar", "tuned", {{"alpha", 2}}),
                                     method("spatialite", "paper", {{"c", 3}})});
  const table::Table all = report::parameters_table({report});
  EXPECT_TRUE(has_row(all, "SpatiaLite (paper)"));
  EXPECT_FALSE(has_row(all, "Polylidar (tuned)"));
  for (json& run : report["runs"]) {
    if (run["method"] == "spatialite") run["method"] = "polylidar";
  }
  EXPECT_FALSE(has_row(report::parameters_table({report}), "SpatiaLite (paper)"));
}

}  // namespace
}  // namespace hullbench::testing
