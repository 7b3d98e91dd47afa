// The tables of the plan real: what each says, that a missing package says so, and that no error is in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/tables.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

/// Two sets on which Polylidar's hull has two parts and a hole; the package of the third is missing.
json real_report() {
  json report = report_on_shapes({{"real-one", 100, 1}, {"real-two", 200, 1}, {"real-gone", 5, 1}});
  report["plan"]["name"] = "real";
  report["datasets"] = json::array({{{"name", "real-one"},
                                     {"title", "Trees"},
                                     {"source", "package 1.2"},
                                     {"licence", "GPL-2+"},
                                     {"sha256", nullptr},
                                     {"area", nullptr},
                                     {"holes_area", nullptr},
                                     {"members", 0}}});
  json kept = json::array();
  for (json run : report.at("runs")) {
    if (run.at("protocol") == "paper") run["protocol"] = "default";
    if (run.at("protocol") != "default") continue;
    if (run.at("dataset") == "real-gone") {
      run["n"] = 0;
      run["status"] = "not_installed";
      run["detail"] = "the package p is not installed; 'make deps-real' installs it";
    } else if (run.at("status") == "ok") {
      run["metrics"] = {{"valid", true},
                        {"l2", nullptr},
                        {"polygons", 2},
                        {"holes", 1},
                        {"points_covered", 0.9996},
                        {"convex_hull_share", 0.5},
                        {"agreement_halves", 0.25},
                        {"agreement_subsamples", 1},
                        {"window_iou", run.at("dataset") == "real-one" ? json(0.75) : json(nullptr)}};
    }
    kept.push_back(run);
  }
  report["runs"] = kept;
  return report;
}

using Rows = std::vector<std::vector<std::string>>;

Rows rows_in(const json& report, const std::string& id) {
  return rows_of(report::make_document(report), id);
}

std::size_t column_of(const Rows& rows, const std::string& title) {
  const auto found = std::find_if(rows.at(0).begin(), rows.at(0).end(),
                                  [&](const std::string& one) { return one.starts_with(title); });
  return static_cast<std::size_t>(found - rows.at(0).begin());
}

TEST(RealTable, HasARowASetAndAColumnAMethod) {
  const json report = real_report();
  for (const auto& [id, value] : {std::pair{"real_covered", "100.0"}, std::pair{"real_parts", "2, 1 hole"},
                                  std::pair{"real_area", "50.0"}, std::pair{"real_halves", "25.0"},
                                  std::pair{"real_subsamples", "100"}}) {
    const Rows rows = rows_in(report, id);
    ASSERT_EQ(rows.size(), 4U) << id;
    EXPECT_EQ(rows.at(1).at(0), "Trees, 100") << id;
    EXPECT_EQ(rows.at(1).at(column_of(rows, "Polylidar")), value) << id;
  }
  const Rows window = rows_in(report, "real_window");
  ASSERT_EQ(window.size(), 2U);
  EXPECT_EQ(window.at(1).at(column_of(window, "Polylidar")), "75.0");
}

TEST(RealTable, AMissingPackageSaysWhatInstallsIt) {
  const table::Document document = report::make_document(real_report());
  const Rows rows = rows_in(real_report(), "real_covered");
  EXPECT_EQ(rows.at(3).at(1), "not installed");
  expect_says(rows.at(3).at(0), "[1]");
  const bool told = std::ranges::any_of(document.notes, [](const std::string& note) {
    return note.starts_with("[1]") && note.find("'make deps-real'") != std::string::npos;
  });
  EXPECT_TRUE(told);
}

TEST(RealTable, AFailureIsAWordAndCountsAsZeroInTheMedians) {
  json report = real_report();
  run_on(report, "polylidar", "real-two")["status"] = "timeout";
  const Rows rows = rows_in(report, "real_halves");
  EXPECT_EQ(rows.at(2).at(column_of(rows, "Polylidar")), "timeout");
  const Rows methods = rows_in(report, "real_methods");
  const auto polylidar =
      std::ranges::find_if(methods, [](const auto& row) { return row.at(0).starts_with("Polylidar"); });
  ASSERT_NE(polylidar, methods.end());
  EXPECT_EQ(polylidar->at(1), "1 of 2");  // of the third set nothing was tried
  EXPECT_EQ(polylidar->at(3), "12.5");    // the median of 25 and 0
}

TEST(RealTable, AnEmptyResultIsNoHull) {
  json report = real_report();
  run_on(report, "polylidar", "real-one")["metrics"]["polygons"] = 0;
  const Rows rows = rows_in(report, "real_covered");
  EXPECT_EQ(rows.at(1).at(column_of(rows, "Polylidar")), "empty");
}

TEST(RealTable, SaysWhereThePointsAreFromAndNothingOfErrors) {
  const Rows sources = rows_in(real_report(), "real_sources");
  EXPECT_EQ(sources.at(1).at(2), "package 1.2");
  EXPECT_EQ(sources.at(1).at(3), "GPL-2+");
  EXPECT_EQ(sources.at(1).at(4).size(), 64U);
  for (const table::Table& table : report::make_document(real_report()).tables) {
    EXPECT_EQ(table.id.find("error"), std::string::npos) << table.id;
    EXPECT_EQ(table.caption.find("L2"), std::string::npos) << table.caption;
  }
}

}  // namespace
}  // namespace hullbench::testing
