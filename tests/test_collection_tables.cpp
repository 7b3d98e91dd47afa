// The tables of many shapes at one size.
#include <gtest/gtest.h>

#include <cstdint>
#include <regex>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

// On the k-th letter every method takes k ms and errs by 10 k %.
json letters_report(const std::vector<std::string>& letters) {
  std::vector<InventedShape> shapes;
  for (const std::string& letter : letters) {
    const auto k = static_cast<std::int64_t>(shapes.size() + 1);
    shapes.push_back({letter, 2000, 0.5, k, 0.1 * static_cast<double>(k)});
  }
  return report_on_shapes(shapes);
}

// With single spaces, whatever the columns' widths.
std::string tables(const json& report) {
  return std::regex_replace(markdown_of(report), std::regex(" +"), " ");
}

const std::vector<std::string> kLetters = {"letter_a", "letter_j", "letter_z"};

TEST(CollectionTables, HaveMeanDeviationAndMaximumOfTheShapes) {
  const std::string text = tables(letters_report(kLetters));
  expect_says(text, "### 3 shapes, n = 2000");
  expect_says(text, "| Polylidar (paper) | 3 | 0 | 20.0 | 10.0 | 30.0 | 2.00 | 1.00 | 3.00 | 3.00 |");
}

TEST(CollectionTables, DivideByTheTruthsAreaWhereThePaperHasNoSuchTable) {
  json report = letters_report(kLetters);
  report["plan"].erase("paper");
  const std::string text = tables(report);
  expect_says(text, "error (of the ground truth's area) and time as the paper took it");
  expect_says(text, "| Polylidar (paper) | 3 | 0 | 10.0 | 5.0 | 15.0 | 2.00 | 1.00 | 3.00 | 3.00 |");
  expect_says(text, "Error L2 of every shape, % of the ground truth's area");
}

TEST(CollectionTables, HaveThePapersValuesBeneathOurs) {
  const std::string text = tables(letters_report(kLetters));
  expect_says(text, "| Polylidar, in the paper | 26 | – | 12.8 | 1.8 | 16.8 | 1.2 | 0.3 | 2.4 | – |");
  expect_says(text, "\n| letter_a | 10.0 (13.6) | 10.0 | 10.0 (13.4) |");
  EXPECT_TRUE(contains(text, "\n| letter_z | 30.0 | 30.0 | 30.0 |")) << "not published: " << text;
  expect_says(text, "in brackets the paper's");
}

TEST(CollectionTables, OfOtherShapesHaveNoPublishedValues) {
  std::vector<std::string> names;
  for (char c = 'a'; c < 'k'; ++c) names.push_back(std::string("shape_") + c);
  const std::string text = tables(letters_report(names));
  expect_says(text, "### 10 shapes, n = 2000");
  EXPECT_FALSE(contains(text, "in the paper |")) << text;
  EXPECT_FALSE(contains(text, "in brackets the paper's")) << text;
}

TEST(CollectionTables, MeansAreOfTheCasesThatAllSolvedAndAFailureIsNamed) {
  json report = letters_report(kLetters);
  json& run = run_on(report, "spatialite", "letter_j");
  run["status"] = "timeout";
  run["detail"] = "no answer within 120 s";
  const std::string text = tables(report);
  expect_says(text, "| SpatiaLite (paper) [1] | 2 | 1 | 20.0 | 14.1 | 30.0 |");
  expect_says(text, "| Polylidar (paper) | 2 | 0 | 20.0 | 14.1 | 30.0 | 2.00 | 1.41 | 3.00 |");
  expect_says(text, "those that each of them solved");
  expect_says(text, "| letter_j | 20.0 (10.0) | 20.0 | timeout |");
  expect_says(text, "[1] SpatiaLite (paper) on letter_j, n = 2000: timeout, no answer within 120 s.");
}

TEST(CollectionTables, AMethodThatSolvedLessThanHalfNarrowsNobodysStatistics) {
  json report = letters_report(kLetters);
  for (const char* letter : {"letter_j", "letter_z"}) {
    json& run = run_on(report, "spatialite", letter);
    run["status"] = "timeout";
    run["detail"] = "no answer within 120 s";
  }
  const std::string text = tables(report);
  expect_says(text, "| SpatiaLite (paper) [1] [2] | 0 | 2 | – | – | – |");
  expect_says(text, "| Polylidar (paper) | 3 | 0 | 20.0 | 10.0 | 30.0 |");
}

TEST(CollectionTables, MarkAnErrorAboveThatOfTheConvexHull) {
  json report = letters_report(kLetters);
  for (json& run : report["runs"]) {
    if (run["status"] != "ok") continue;
    run["metrics"]["l2"] = 0.5;
    run["metrics"]["l2_convex_hull"] = run["method"] == "cgal_alpha_shape" ? 0.4999999 : 0.5;
  }
  const std::string text = tables(report);
  expect_says(text, "\n| letter_a | 10.0 (13.6) | 10.0 † | 10.0 (13.4) |");
  expect_says(text, "- †: the error is above that of the points' convex hull.");
  expect_says(text, "above that of the points' convex hull: CGAL alpha shape (paper) 3 of 3.");
}

TEST(CollectionTables, AMethodThatIsNotInstalledHasNoValues) {
  const std::string text = tables(letters_report(kLetters));
  expect_says(text, "| 0 | 0 | – | – | – | – | – | – | – |");
}

TEST(CollectionTables, AreNotForAFewShapesThatThePaperHasNoTableOf) {
  const std::string text = tables(invented_report({2000}));
  EXPECT_FALSE(contains(text, "shapes, n =")) << text;
}

}  // namespace
}  // namespace hullbench::testing
