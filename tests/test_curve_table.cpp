// The table of a plan with an axis.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/curve_table.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/report/tables.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_shapes.hpp"

namespace hullbench::testing {
namespace {

using Cells = std::vector<std::vector<std::string>>;

/// Two shapes at three levels of noise. Polylidar's L2 on the first is 10 % plus ten times the level, on the
/// second 20 points more.
json noisy_report() {
  std::vector<InventedShape> shapes;
  for (const char* shape : {"ca", "hi"}) {
    for (const char* level : {"2", "0", "0.5"})
      shapes.push_back({std::string(shape) + "~noise:" + level, 2000, 0.5});
  }
  json report = report_on_shapes(shapes);
  report["plan"]["axis"] = {{"of", "noise"}, {"title", "Noise"}, {"unit", "h"}};
  for (json& run : report.at("runs")) {
    const std::string dataset = run.at("dataset").get<std::string>();
    const double level = std::stod(dataset.substr(dataset.find(':') + 1));
    run["levels"] = {{"noise", level}};
    if (run.at("status") == "ok")
      run["metrics"]["l2"] = 0.1 + 0.1 * level + (dataset.starts_with("hi") ? 0.2 : 0);
  }
  return report;
}

table::Table table_of(const json& report) {
  const table::Document document = report::make_document(report);
  EXPECT_EQ(document.tables.size(), 1U);
  return document.tables.at(0);
}

TEST(StressTitle, SaysSeveralStressesOneAfterTheOther) {
  EXPECT_EQ(report::stress_title("noise:0.5"), "noise 0.5");
  EXPECT_EQ(report::stress_title("gradient:16~outliers:3~noise:0.5"), "gradient 16, outliers 3, noise 0.5");
}

TEST(CurveTable, HasAColumnALevelAndAMedianACell) {
  const table::Table table = table_of(noisy_report());
  EXPECT_TRUE(table.id.ends_with("_curves"));
  const Cells rows = table::shown(table);
  EXPECT_EQ(rows.at(0), (std::vector<std::string>{"Noise, h", "0", "0.5", "2", "Failed"}));
  EXPECT_EQ(rows.at(1), (std::vector<std::string>{"Polylidar (paper)", "20.0", "25.0", "40.0", "0"}));
}

TEST(CurveTable, AMethodThatIsNotInstalledHasNotFailed) {
  json report = noisy_report();
  run_on(report, "polylidar", "hi~noise:2")["status"] = "not_installed";
  const Cells rows = table::shown(table_of(report));
  EXPECT_EQ(rows.at(1), (std::vector<std::string>{"Polylidar (paper) [1]", "20.0", "25.0", "30.0", "0"}));
}

TEST(CurveTable, AFailureIsInfinitelyBad) {
  json report = noisy_report();
  json& run = run_on(report, "polylidar", "hi~noise:2");
  run["status"] = "crash";
  run["detail"] = "SIGSEGV";
  const std::vector<std::string> cells = table::shown(table_of(report)).at(1);
  EXPECT_EQ((std::vector<std::string>(cells.begin() + 1, cells.end())),
            (std::vector<std::string>{"20.0", "25.0", "∞", "1"}));
  EXPECT_EQ(cells[0], "Polylidar (paper) [1]");
  EXPECT_EQ(report::make_document(report).notes.at(0),
            "[1] Polylidar (paper) on Hawaii, noise 2, n = 2000: crash, SIGSEGV.");
}

TEST(CurveTable, AnAxisOfPointsOrOfWords) {
  json report = noisy_report();
  report["plan"]["axis"] = {{"of", "n"}, {"title", "Points"}, {"unit", ""}};
  EXPECT_EQ(table::shown(table_of(report)).at(0), (std::vector<std::string>{"Points", "2000", "Failed"}));
  report["plan"]["axis"]["of"] = "sampling";
  run_on(report, "polylidar", "hi~noise:2")["dataset"] = "hi";
  EXPECT_EQ(table::shown(table_of(report)).at(0),
            (std::vector<std::string>{"Points", "noise 2", "noise 0", "noise 0.5", "uniform", "Failed"}));
  report["plan"]["axis"]["of"] = "gap";
  EXPECT_EQ(table::shown(table_of(report)).at(0), (std::vector<std::string>{"Points", "Failed"}));
}

}  // namespace
}  // namespace hullbench::testing
