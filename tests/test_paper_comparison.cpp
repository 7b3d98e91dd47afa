// What differs from the paper: which values are compared, which are large, and what is said of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/paper_comparison.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

/// The comparison of these; none when there is none.
std::optional<report::Comparison> find(const std::vector<report::Comparison>& comparisons,
                                       const std::string& method, const std::string& quantity,
                                       const std::string& row = "") {
  const auto found = std::ranges::find_if(comparisons, [&](const report::Comparison& comparison) {
    return comparison.method == method && comparison.quantity == quantity && comparison.row == row;
  });
  if (found == comparisons.end()) return std::nullopt;
  return *found;
}

report::Comparison with_ratio(double ratio) {
  return {"Table IV", "", "polylidar", "time", 8, 8 * ratio};
}

TEST(PaperComparison, RatioIsOursOverTheirs) {
  EXPECT_EQ(with_ratio(0.5).ratio(), 0.5);
  EXPECT_EQ(with_ratio(4).ratio(), 4);
}

TEST(PaperComparison, IsLargeFromAQuarterMoreInBothDirections) {
  ASSERT_EQ(report::paper().at("differences").at("large_from"), 1.25);
  EXPECT_FALSE(with_ratio(1).is_large());
  EXPECT_FALSE(with_ratio(1.249).is_large());
  EXPECT_TRUE(with_ratio(1.25).is_large());
  EXPECT_TRUE(with_ratio(100).is_large());
  EXPECT_FALSE(with_ratio(0.801).is_large());
  EXPECT_TRUE(with_ratio(0.8).is_large());
  EXPECT_TRUE(with_ratio(0.01).is_large());
}

/// Two of the paper's letters: errors 10 and 20 %, 2 and 4 ms.
json letters_report() {
  return report_on_shapes({{"letter_a", 2000, 0.5, 2, 0.1}, {"letter_z", 2000, 0.5, 4, 0.2}});
}

TEST(PaperComparison, OfLettersTakesTheMeans) {
  const auto comparisons = report::compare_with_paper(letters_report());
  // The paper's four methods, each with error and time; PostGIS 3 is none of them.
  EXPECT_EQ(comparisons.size(), 8U);
  const auto error = find(comparisons, "polylidar", "error");
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where, "Table IV");
  EXPECT_EQ(error->published, 12.8);
  EXPECT_DOUBLE_EQ(error->measured.value_or(-1), 15);
  const auto time = find(comparisons, "spatialite", "time");
  ASSERT_TRUE(time);
  EXPECT_EQ(time->published, 230.2);
  EXPECT_DOUBLE_EQ(time->measured.value_or(-1), 3);
  EXPECT_FALSE(find(comparisons, "postgis", "time"));
  const auto missing = find(comparisons, "postgis_legacy", "time");
  ASSERT_TRUE(missing) << "what is not installed is said, not left out";
  EXPECT_FALSE(missing->measured);
  EXPECT_TRUE(missing->is_large());
  ASSERT_TRUE(report::reason_of(*missing));
  EXPECT_NE(report::reason_of(*missing)->find("was not installed"), std::string::npos);
  report::Comparison measured = *missing;
  measured.measured = 10 * measured.published;
  ASSERT_TRUE(report::reason_of(measured));
  EXPECT_EQ(report::reason_of(measured)->find("was not installed"), std::string::npos)
      << *report::reason_of(measured);
}

TEST(PaperComparison, FailuresOfMethodsThatThePaperDoesNotHaveNarrowNothing) {
  json report = letters_report();
  int changed = 0;
  for (json& run : report["runs"]) {
    if (run["method"] != "postgis" || run["dataset"] != "letter_z") continue;
    run["status"] = "timeout";
    run["detail"] = "no answer within 120 s";
    ++changed;
  }
  ASSERT_EQ(changed, 1);
  const auto error = find(report::compare_with_paper(report), "polylidar", "error");
  ASSERT_TRUE(error);
  EXPECT_DOUBLE_EQ(error->measured.value_or(-1), 15);
}

TEST(PaperComparison, OfFloorsIsWithTheTableOfFloors) {
  const auto comparisons = report::compare_with_paper(
      report_on_shapes({{"floor-1", 80000, 0.5, 48, 0.022}, {"floor-2", 90000, 0.5, 48, 0.022}}));
  const auto time = find(comparisons, "polylidar", "time");
  ASSERT_TRUE(time);
  EXPECT_EQ(time->where, "Table III");
  EXPECT_EQ(time->published, 47.9);
  EXPECT_DOUBLE_EQ(time->measured.value_or(-1), 48);
}

TEST(PaperComparison, LeavesOtherProtocolsAlone) {
  json report = letters_report();
  for (json& run : report["runs"]) {
    if (run["method"] == "polylidar") run["protocol"] = "tuned";
  }
  EXPECT_FALSE(find(report::compare_with_paper(report), "polylidar", "time"));
}

std::vector<InventedShape> star_polygons(std::size_t count, std::int64_t n) {
  std::vector<InventedShape> shapes;
  for (std::size_t k = 1; k <= count; ++k) {
    const double convexity = k % 2 == 0 ? 0.8 : 0.3;
    shapes.push_back({"star-" + std::to_string(k), n, convexity, k % 2 == 0 ? 5 : 7, 0.05});
  }
  return shapes;
}

TEST(PaperComparison, OfRandomPolygonsIsByConvexity) {
  const auto comparisons = report::compare_with_paper(report_on_shapes(star_polygons(61, 8000)));
  EXPECT_EQ(comparisons.size(), 4U);  // error and time of Polylidar in two classes
  const auto high = find(comparisons, "polylidar", "time", "high (from 0.75)");
  const auto low = find(comparisons, "polylidar", "time", "low (below 0.55)");
  ASSERT_TRUE(high && low);
  EXPECT_EQ(high->where, "Table V");
  EXPECT_EQ(high->published, 4.6);
  EXPECT_DOUBLE_EQ(high->measured.value_or(-1), 5);
  EXPECT_EQ(low->published, 4.7);
  EXPECT_DOUBLE_EQ(low->measured.value_or(-1), 7);
  EXPECT_TRUE(report::compare_with_paper(report_on_shapes(star_polygons(61, 4000))).empty());
}

/// The run of `method` on California in `report`, as one of `steps`, the method that tells its steps.
json told_by(json& report, const char* method, const char* steps) {
  json run = run_on(report, method, "ca");
  run["method"] = steps;
  return run;
}

/// The invented report with only California with holes at n points.
json steps_report(std::int64_t n) {
  json report = invented_report({n});
  json runs = json::array();
  for (const json& run : report["runs"]) {
    if (run["dataset"] == "ca" && run["holes"] == true) runs.push_back(run);
  }
  report["runs"] = runs;
  return report;
}

TEST(PaperComparison, OfStepsIsForThePapersCaseAlone) {
  json report = steps_report(64000);
  report["runs"].push_back(told_by(report, "polylidar", "polylidar_steps"));
  const auto comparisons = report::compare_with_paper(report);
  // Polylidar 16 ms, in halves for triangulation and shape, and 0.64 ms for the polygon; the wobble's median
  // is 1 %.
  const auto total = find(comparisons, "polylidar", "time");
  ASSERT_TRUE(total);
  EXPECT_EQ(total->where, "Table VI");
  EXPECT_EQ(total->published, 41.4);
  EXPECT_DOUBLE_EQ(total->measured.value_or(-1), 16.16);
  const auto triangulation = find(comparisons, "polylidar_steps", "triangulation");
  ASSERT_TRUE(triangulation);
  EXPECT_FALSE(find(comparisons, "polylidar", "triangulation")) << "one call does not tell its steps";
  EXPECT_EQ(triangulation->published, 36.0);
  EXPECT_DOUBLE_EQ(triangulation->measured.value_or(-1), 8.08);
  const auto polygon = find(comparisons, "polylidar_steps", "polygon");
  ASSERT_TRUE(polygon);
  EXPECT_DOUBLE_EQ(polygon->measured.value_or(-1), 0.64);
  EXPECT_TRUE(find(comparisons, "cgal_alpha_shape", "shape"));
  EXPECT_FALSE(find(comparisons, "cgal_alpha_shape", "polygon")) << "the paper has no value";
}

TEST(PaperComparison, OfStepsIsNotForOtherCases) {
  EXPECT_TRUE(report::compare_with_paper(steps_report(32000)).empty());
  EXPECT_TRUE(report::compare_with_paper(invented_report({64000})).empty());
  json solid = steps_report(64000);
  for (json& run : solid["runs"]) run["holes"] = false;
  EXPECT_TRUE(report::compare_with_paper(solid).empty());
}

TEST(PaperComparison, SpatialitesStepsAreToldByTheMethodThatHasThem) {
  json report = steps_report(64000);
  EXPECT_FALSE(find(report::compare_with_paper(report), "spatialite", "triangulation"));
  report["runs"].push_back(told_by(report, "polylidar", "spatialite_steps"));
  const auto comparisons = report::compare_with_paper(report);
  const auto step = find(comparisons, "spatialite_steps", "triangulation");
  ASSERT_TRUE(step);
  EXPECT_EQ(step->published, 234.2);
  EXPECT_DOUBLE_EQ(step->measured.value_or(-1), 8.08);
  EXPECT_FALSE(find(comparisons, "spatialite", "triangulation"));
  const auto total = find(comparisons, "spatialite", "time");
  ASSERT_TRUE(total) << "its total is of the one call";
  EXPECT_EQ(total->published, 11158.1);
  EXPECT_FALSE(find(comparisons, "spatialite_steps", "time"));
}

/// A comparison that `reason` is meant for, by what it names.
report::Comparison example_of(const json& reason) {
  const auto first = [&](const char* key, const std::string& otherwise) {
    if (!reason.contains(key)) return otherwise;
    const json& value = reason.at(key);
    return (value.is_array() ? value.at(0) : value).get<std::string>();
  };
  report::Comparison comparison = with_ratio(reason.value("we_are", "lower") == "lower" ? 0.5 : 2);
  comparison.where = first("where", comparison.where);
  comparison.method = first("method", comparison.method);
  comparison.quantity = first("quantity", comparison.quantity);
  return comparison;
}

TEST(PaperComparison, EveryReasonIsForADirectionMethodAndQuantityThatThereIs) {
  for (const json& reason : report::paper().at("differences").at("reasons")) {
    report::Comparison comparison = example_of(reason);
    EXPECT_TRUE(report::reason_of(comparison)) << reason;
    const std::string text = reason.at("reason").get<std::string>();
    if (reason.contains("method")) {
      comparison.method = "unheard_of";
      EXPECT_NE(report::reason_of(comparison), text);
      comparison = example_of(reason);
    }
    if (reason.contains("quantity")) {
      comparison.quantity = "unheard of";
      EXPECT_NE(report::reason_of(comparison), text);
      comparison = example_of(reason);
    }
    if (reason.contains("where")) {
      comparison.where = "Table 0";
      EXPECT_NE(report::reason_of(comparison), text);
      comparison = example_of(reason);
    }
    if (reason.contains("we_are")) {
      EXPECT_TRUE(reason["we_are"] == "lower" || reason["we_are"] == "higher") << reason;
      comparison.measured = comparison.published * comparison.published / *comparison.measured;
      EXPECT_NE(report::reason_of(comparison), text);
    }
  }
}

TEST(PaperComparison, WhatNobodyHeardOfHasNoReasonOfAMethod) {
  const report::Comparison unheard = {"Table 0", "", "unheard_of", "unheard of", 1, 2};
  EXPECT_EQ(report::reason_of(unheard), std::nullopt);
}

TEST(DifferencesTable, HasValuePaperHereRatioAndWhetherAReasonIsKnown) {
  // Against 12.8 % and 1.2 ms of Polylidar: 12.8 % is none at all, 3 ms is large.
  json report = letters_report();
  for (json& run : report["runs"]) {
    if (run["method"] == "polylidar") run["metrics"]["l2_paper"] = 0.128;
  }
  const table::Table table = report::differences_table({report});
  const auto rows = table::shown(table);
  ASSERT_EQ(rows.size(), 9U);
  EXPECT_EQ(rows[1],
            (std::vector<std::string>{"Table IV, Polylidar: L2 mean, %", "12.8", "12.8", "1.00", "–"}));
  const auto reason = report::reason_of({"Table IV", "", "polylidar", "time", 1.2, 3});
  EXPECT_EQ(rows[2], (std::vector<std::string>{"Table IV, Polylidar: time, ms", "1.2", "3.00", "2.50",
                                               reason ? rows[2].back() : "not known"}));
  EXPECT_EQ(rows[2].back().starts_with("["), reason.has_value()) << rows[2].back();
  expect_says(table.remarks.front(), "1.25 times");
}

TEST(DifferencesTable, NamesTheClassOfAValue) {
  const auto rows = table::shown(report::differences_table({report_on_shapes(star_polygons(61, 8000))}));
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[2][0], "Table V, high (from 0.75), Polylidar: time, ms");
}

TEST(DifferencesTable, IsEmptyForWhatThePaperHasNoTableOf) {
  EXPECT_TRUE(report::differences_table({invented_report({2000})}).rows.empty());
  EXPECT_TRUE(report::differences_table({}).rows.empty());
}

}  // namespace
}  // namespace hullbench::testing
