// The tables of more shapes than anybody wants rows of: by convexity and by kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/tables.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

using Row = std::vector<std::string>;

/// Members of a family: on the k-th every method takes k ms and errs by k %, and the convexities take turns.
std::vector<InventedShape> members_of(const std::string& family, std::int64_t count, std::int64_t n,
                                      const std::vector<double>& convexities) {
  std::vector<InventedShape> shapes;
  for (std::int64_t k = 1; k <= count; ++k) {
    const double convexity = convexities[static_cast<std::size_t>(k - 1) % convexities.size()];
    shapes.push_back({family + "-" + std::to_string(k), n, convexity, k, 0.01 * static_cast<double>(k)});
  }
  return shapes;
}

/// What the rows of a group and a method show.
std::vector<Row> rows_of(const table::Table& section, const std::string& group, const std::string& method) {
  std::vector<Row> found;
  const std::vector<Row> shown = table::shown(section);
  for (std::size_t row = 0; row < section.rows.size(); ++row) {
    if (shown[row + 1][0] == group && section.rows[row][1].text() == method) found.push_back(shown[row + 1]);
  }
  return found;
}

/// The only one of them.
Row row_of(const table::Table& section, const std::string& group, const std::string& method) {
  const std::vector<Row> found = rows_of(section, group, method);
  if (found.size() == 1) return found.front();
  ADD_FAILURE() << found.size() << " rows of " << group << " and " << method;
  return Row(section.columns.size());
}

bool has_remark(const table::Table& section, const std::string& part) {
  return std::ranges::any_of(section.remarks,
                             [&](const std::string& remark) { return contains(remark, part); });
}

bool has_row_of_the_paper(const table::Table& section) {
  return std::ranges::any_of(section.rows,
                             [](const auto& row) { return row[1].text().ends_with(", in the paper"); });
}

constexpr const char* kHigh = "high (from 0.75)";
constexpr const char* kMid = "mid (from 0.55)";
constexpr const char* kLow = "low (below 0.55)";
constexpr const char* kByConvexity = "invented_convexity";
constexpr const char* kByConvexityOthers = "invented_convexity_others";

TEST(ClassTables, AreForMoreThanSixtyShapes) {
  const auto with = [](std::int64_t count) {
    return report::make_document(report_on_shapes(members_of("star", count, 8000, {0.8})));
  };
  EXPECT_TRUE(table_in(with(60), "invented_shapes"));
  EXPECT_FALSE(table_in(with(60), kByConvexity));
  const table::Document document = with(61);
  EXPECT_FALSE(table_in(document, "invented_shapes"));
  const table::Table* section = table_in(document, kByConvexity);
  ASSERT_TRUE(section);
  EXPECT_EQ(table::shown(*section).front(),
            (Row{"Convexity", "Method", "Shapes", "Failed", "Invalid", "L2 mean, %", "std", "max",
                 "Time mean, ms", "std", "max", "Equal work mean, ms"}));
  // 1 to 61: mean 31, variance 61 * 62 / 12.
  EXPECT_EQ(rows_of(*section, kHigh, "Polylidar (paper)"),
            (std::vector<Row>{{kHigh, "Polylidar (paper)", "61", "0", "0", "31.0", "17.8", "61.0", "31.0",
                               "17.8", "61.0", "46.5"}}));
  EXPECT_TRUE(section->caption.starts_with("61 shapes (")) << section->caption;
  expect_says(section->caption, "n = 8000");
}

TEST(ClassTables, HaveThePapersRowsBeneathOursOfStarPolygonsAtItsSize) {
  const table::Document document =
      report::make_document(report_on_shapes(members_of("star", 61, 8000, {0.8, 0.6, 0.5})));
  const table::Table* section = table_in(document, kByConvexity);
  ASSERT_TRUE(section);
  EXPECT_EQ(rows_of(*section, kHigh, "Polylidar, in the paper"),
            (std::vector<Row>{{kHigh, "Polylidar, in the paper", "–", "–", "–", "4.4", "0.5", "6.1", "4.6",
                               "0.1", "5.0", "–"}}));
  EXPECT_EQ(row_of(*section, kMid, "Polylidar, in the paper")[5], "8.0");
  EXPECT_EQ(row_of(*section, kLow, "Polylidar, in the paper")[5], "15.5");
  EXPECT_TRUE(rows_of(*section, kHigh, "CGAL, in the paper").empty());
  EXPECT_TRUE(has_remark(*section, "Table V, 19600 polygons"));
}

TEST(ClassTables, HaveNoRowsOfThePaperAtOtherSizesAndOfOtherShapes) {
  for (const auto& [family, n] : {std::pair("star", 4000), std::pair("comb", 8000)}) {
    const table::Document document =
        report::make_document(report_on_shapes(members_of(family, 61, n, {0.8, 0.5})));
    EXPECT_FALSE(table_in(document, kByConvexity));
    const table::Table* section = table_in(document, kByConvexityOthers);
    ASSERT_TRUE(section) << family;
    EXPECT_FALSE(has_row_of_the_paper(*section));
    EXPECT_FALSE(has_remark(*section, "The paper's values"));
  }
}

TEST(ClassTables, AShapeOnABorderIsInTheHigherClass) {
  // One shape right below each border, and all others on the borders.
  std::vector<InventedShape> shapes = members_of("star", 62, 8000, {0.75, 0.55});
  shapes.push_back({"star-63", 8000, std::nextafter(0.75, 0), 1, 0.01});
  shapes.push_back({"star-64", 8000, std::nextafter(0.55, 0), 1, 0.01});
  const table::Document document = report::make_document(report_on_shapes(shapes));
  const table::Table* section = table_in(document, kByConvexity);
  ASSERT_TRUE(section);
  EXPECT_EQ(row_of(*section, kHigh, "Polylidar (paper)")[2], "31");
  EXPECT_EQ(row_of(*section, kMid, "Polylidar (paper)")[2], "32");
  EXPECT_EQ(row_of(*section, kLow, "Polylidar (paper)")[2], "1");
}

TEST(ClassTables, AnInvalidResultIsCountedAndNotInTheStatistics) {
  json report = report_on_shapes(members_of("star", 61, 8000, {0.8}));
  json& run = run_on(report, "polylidar", "star-61");
  run["status"] = "invalid_output";
  run["detail"] = "the result is an invalid polygon: Self-intersection";
  run["metrics"]["valid"] = false;
  const table::Document document = report::make_document(report);
  const table::Table* section = table_in(document, kByConvexity);
  ASSERT_TRUE(section);
  const Row row = row_of(*section, kHigh, "Polylidar (paper)");
  EXPECT_EQ(Row(row.begin() + 1, row.begin() + 8),
            (Row{"Polylidar (paper) [1]", "60", "1", "1", "30.5", "17.5", "60.0"}));
  EXPECT_TRUE(has_remark(*section, "Polylidar (paper): of 61 results, each checked by GEOS, 1 are invalid."));
  EXPECT_TRUE(
      has_remark(*section, "SpatiaLite (paper): of 61 results, each checked by GEOS, 0 are invalid."));
}

TEST(ClassTables, AFailureIsMarkedAndNotInTheStatistics) {
  json report = report_on_shapes(members_of("star", 61, 8000, {0.8}));
  json& run = run_on(report, "spatialite", "star-61");
  run["status"] = "timeout";
  run["detail"] = "no answer within 120 s";
  const table::Document document = report::make_document(report);
  const table::Table* section = table_in(document, kByConvexity);
  ASSERT_TRUE(section);
  const Row row = row_of(*section, kHigh, "SpatiaLite (paper)");
  EXPECT_EQ(Row(row.begin() + 1, row.begin() + 6), (Row{"SpatiaLite (paper) [1]", "60", "1", "0", "30.5"}));
  EXPECT_TRUE(
      has_remark(*section, "SpatiaLite (paper): of 60 results, each checked by GEOS, 0 are invalid."));
  ASSERT_FALSE(document.notes.empty());
  EXPECT_EQ(document.notes.front().find("[1] SpatiaLite (paper) on star-61, n = 8000: timeout, no answer"),
            0U)
      << document.notes.front();
}

TEST(ClassTables, OtherFamiliesStandApartAndByKind) {
  std::vector<InventedShape> shapes = members_of("star", 61, 8000, {0.8});
  for (const char* family : {"comb", "spiral"}) {
    const auto more = members_of(family, 3, 8000, {0.3});
    shapes.insert(shapes.end(), more.begin(), more.end());
  }
  json report = report_on_shapes(shapes);
  for (const auto& [name, title] :
       {std::pair("star", "Star-shaped"), std::pair("comb", "Comb"), std::pair("spiral", "Spiral")}) {
    report["datasets"].push_back({{"name", name}, {"title", title}, {"members", 100}});
  }
  const table::Document document = report::make_document(report);
  EXPECT_EQ(row_of(*table_in(document, kByConvexity), kHigh, "Polylidar (paper)")[2], "61");
  const table::Table* others = table_in(document, kByConvexityOthers);
  ASSERT_TRUE(others);
  EXPECT_TRUE(others->caption.starts_with("6 shapes (comb and spiral), n = 8000, by convexity"))
      << others->caption;
  EXPECT_EQ(row_of(*others, kLow, "Polylidar (paper)")[2], "6");
  const table::Table* kinds = table_in(document, "invented_kinds");
  ASSERT_TRUE(kinds);
  EXPECT_EQ(row_of(*kinds, "Comb", "Polylidar (paper)")[2], "3");
  EXPECT_EQ(row_of(*kinds, "Spiral", "Polylidar (paper)")[2], "3");
  EXPECT_TRUE(rows_of(*kinds, "Star-shaped", "Polylidar (paper)").empty());
}

TEST(ClassTables, AShapeThatNothingWasScoredOnHasNoClass) {
  json report = report_on_shapes(members_of("star", 61, 8000, {0.8}));
  for (json& run : report["runs"]) {
    if (run["dataset"] != "star-5") continue;
    run["status"] = "timeout";
    run["metrics"] = json::object();
  }
  const table::Document document = report::make_document(report);
  EXPECT_EQ(row_of(*table_in(document, kByConvexity), "not known", "Polylidar (paper)")[2], "0");
}

TEST(ClassTables, ShapesWithPointsOfTheirOwnHaveThemOnAverage) {
  const json report = report_on_shapes(
      {{"floor-1", 80000, 0.5, 1, 0.01}, {"floor-2", 90000, 0.5, 2, 0.02}, {"floor-3", 90001, 0.5, 3, 0.03}});
  const table::Document document = report::make_document(report);
  const table::Table* section = table_in(document, "invented_summary");
  ASSERT_TRUE(section);
  EXPECT_TRUE(section->caption.starts_with("3 shapes, 86667 points on average: ")) << section->caption;
}

TEST(ClassTables, FloorsThatThePaperHasNotAreApart) {
  const table::Document document =
      report::make_document(report_on_shapes({{"floor-1", 80000, 0.5, 1, 0.01},
                                              {"floor-2", 90000, 0.5, 2, 0.02},
                                              {"lowfloor-1", 20000, 0.5, 9, 0.09}}));
  const table::Table* papers_own = table_in(document, "invented_summary");
  const table::Table* others = table_in(document, "invented_summary_others");
  ASSERT_TRUE(papers_own);
  ASSERT_TRUE(others);
  EXPECT_TRUE(papers_own->caption.starts_with("2 shapes, 85000 points on average: ")) << papers_own->caption;
  EXPECT_TRUE(others->caption.starts_with("1 shapes, n = 20000: ")) << others->caption;
  EXPECT_TRUE(has_remark(*papers_own, "Table III"));
  EXPECT_FALSE(has_remark(*others, "The paper's values"));
  ASSERT_TRUE(table_in(document, "invented_shapes_others"));
  EXPECT_EQ(table_in(document, "invented_shapes")->rows.size(), 2U);
}

}  // namespace
}  // namespace hullbench::testing
