// Tables: the whole text of a small report, and what must hold for any.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <utility>

#include "benchmarks/base/names.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/table/writers.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"

namespace hullbench::testing {
namespace {

std::string line_with(const std::string& text, const std::string& part, std::size_t from = 0) {
  const std::size_t place = text.find(part, from);
  if (place == std::string::npos) return "";
  const std::size_t begin = text.rfind('\n', place) + 1;
  return text.substr(begin, text.find('\n', place) - begin);
}

// After a wanted change: build/tests/write_invented_report FILE >tests/data/tables.md, and read the
// difference.
TEST(Tables, AreAsInTheGoldenFile) {
  EXPECT_EQ(markdown_of(invented_report({2000, 64000})),
            read_text(HULLBENCH_SOURCE_DIRECTORY "/tests/data/tables.md"));
}

TEST(Tables, FitATerminalOf120Columns) {
  std::istringstream lines(markdown_of(invented_report({2000, 4000, 8000, 16000, 32000, 64000})));
  for (std::string line; std::getline(lines, line);) {
    const bool is_heading = line.rfind("###", 0) == 0;
    EXPECT_TRUE(is_heading || table::display_width(line) <= 120) << line;
  }
}

TEST(Tables, HaveTheMethodsDataSetsAndSizesOfTheReport) {
  json report = invented_report({123});
  report["datasets"][0]["title"] = "Elsewhere";
  report["methods"][0]["title"] = "Renamed";
  for (json& run : report["runs"]) {
    if (run["method"] == "cgal_alpha_shape") run["method"] = "unheard_of";
  }
  const std::string text = markdown_of(report);
  expect_says(text, "### Elsewhere with holes: time of equal work");
  expect_says(line_with(text, "Number of points"), " 123 |");
  expect_says(text, "| Renamed (paper)");
  expect_says(text, "| unheard_of (paper)");
}

TEST(Tables, TheIntervalOfARatioIsClusteredByShape) {
  std::vector<std::int64_t> sizes;
  for (std::int64_t n = 1000; n <= 20000; n += 1000) sizes.push_back(n);
  json report = invented_report(sizes);
  for (json& run : report["runs"]) {
    if (run["method"] != "cgal_alpha_shape") continue;
    const int factor = run["dataset"] == "hi" ? 3 : run["holes"] == true ? 2 : 1;
    for (json& time : run["time_ns"]) time = factor * time.get<std::int64_t>();
  }
  // As two shapes, whose interval is their range: California's ratios are 5.95 times 1 and 2, with and
  // without holes, Hawaii's are 5.95 times 3. Of 60 independent values it would be 11.9-11.9.
  const std::string text = markdown_of(report);
  const std::string line = line_with(text, "| CGAL", text.find("ratios to Polylidar"));
  expect_says(line, "| 11.9 | 5.96–17.9 |");
}

/// Adds the runs of `method` once more, as those of another one with times divided by `faster`.
void add_rival(json& report, const std::string& method, const std::string& name, int faster) {
  json more = json::array();
  for (const json& run : report["runs"]) {
    if (run["method"] != method) continue;
    more.push_back(run);
    more.back()["method"] = name;
    for (json& time : more.back()["time_ns"]) time = time.get<std::int64_t>() / faster;
  }
  for (const json& run : more) report["runs"].push_back(run);
}

std::string headline_of(json report) {
  report["summary"] = report::make_summary(report);
  const std::string text = markdown_of(report);
  const std::size_t words = text.find(": the fastest rival");
  if (words == std::string::npos) {
    ADD_FAILURE() << "there is no headline: " << text;
    return "";
  }
  const std::size_t begin = text.rfind("###", words);
  return text.substr(begin, text.find("###", begin + 3) - begin);
}

// CGAL takes 5.95 times Polylidar's time, so half of it is 2.98 and a hundredth 0.0595.
TEST(Headline, IsTheFastestMethodWithTheSamePolygonsAndThenThePapersRival) {
  json report = invented_report({2000, 64000});
  add_rival(report, "cgal_alpha_shape", "twin", 2);
  add_rival(report, "spatialite", "sloppy", 1000);
  const std::string text = headline_of(report);
  EXPECT_NE(line_with(text, "| twin (paper)").find("| yes           |     6 |      0 | 2.98 |"),
            std::string::npos)
      << text;
  EXPECT_LT(text.find("| twin"), text.find("| CGAL alpha shape (paper) | yes")) << text;
  EXPECT_EQ(text.find("sloppy"), std::string::npos) << "other polygons: " << text;
  expect_says(text, "whole spectrum of alphas");
}

TEST(Headline, WhoIsNotDistinguishableFromTheFastestStandsBesideIt) {
  json report = invented_report({2000, 64000});
  add_rival(report, "cgal_alpha_shape", "twin", 2);
  EXPECT_EQ(headline_of(report).find("not distinguishable"), std::string::npos) << headline_of(report);
  add_rival(report, "cgal_alpha_shape", "triplet", 2);
  add_rival(report, "cgal_alpha_shape", "laggard", 1);
  const std::string text = headline_of(report);
  EXPECT_LT(text.find("| twin (paper)"), text.find("| triplet (paper)")) << text;
  expect_says(text, "not distinguishable from the first");
  EXPECT_EQ(text.find("laggard"), std::string::npos) << text;
}

TEST(Headline, TheSameMethodStepByStepIsNoRival) {
  json report = invented_report({2000, 64000});
  add_rival(report, "cgal_alpha_shape", "polylidar_steps", 2);
  EXPECT_EQ(headline_of(report).find("step by step"), std::string::npos) << headline_of(report);
  EXPECT_EQ(headline_of(report).find("polylidar_steps"), std::string::npos) << headline_of(report);
}

TEST(Headline, TheFastestCountsThoughItWasMeasuredOnFewCases) {
  json report = invented_report({2000, 64000});
  add_rival(report, "cgal_alpha_shape", "twin", 2);
  json few = json::array();
  bool one = false;
  for (const json& run : report["runs"]) {
    if (run["method"] == "twin" && std::exchange(one, true)) continue;
    few.push_back(run);
  }
  report["runs"] = few;
  EXPECT_NE(
      line_with(headline_of(report), "| twin (paper)").find("| yes           |     1 |      0 | 2.98 |"),
      std::string::npos)
      << headline_of(report);
}

TEST(Headline, SamePolygonsAreDecidedFromTheRecords) {
  const auto is_twin_with = [](const char* name, const json& value) {
    json report = invented_report({2000, 64000});
    add_rival(report, "cgal_alpha_shape", "twin", 2);
    json& last = report["runs"].back();
    last["metrics"][name] = value;
    return headline_of(report).find("| twin") != std::string::npos;
  };
  EXPECT_TRUE(is_twin_with("area", 13900.0 * (1 + 1e-12)));
  EXPECT_FALSE(is_twin_with("area", 13900.0 * (1 + 1e-8)));
  EXPECT_FALSE(is_twin_with("vertices", 401));
  EXPECT_FALSE(is_twin_with("polygons", 2));
  EXPECT_FALSE(is_twin_with("holes", 11));
  EXPECT_FALSE(is_twin_with("l2", 0.5));
}

TEST(Headline, ATwinThatFailsInMostCasesIsNotTheFastest) {
  json report = invented_report({2000, 64000});
  add_rival(report, "cgal_alpha_shape", "twin", 2);
  int failed = 0;
  for (json& run : report["runs"]) {
    if (run["method"] != "twin" || ++failed > 4) continue;
    run["status"] = "timeout";
    run["detail"] = "no answer";
  }
  EXPECT_EQ(headline_of(report).find("| twin"), std::string::npos);
}

TEST(Headline, WithoutATwinItSaysSo) {
  json report = invented_report({2000});
  for (json& run : report["runs"]) {
    if (run["method"] == "cgal_alpha_shape") run["metrics"]["vertices"] = 500;
  }
  const std::string text = headline_of(report);
  expect_says(text, "| CGAL alpha shape (paper) | no ");
  expect_says(text, "but there is none in this run");
}

// In the machine's slow round everything takes ten times as long.
TEST(Ratios, AreTakenRoundByRound) {
  json report = invented_report({2000});
  for (json& run : report["runs"]) {
    if (run["status"] != "ok") continue;
    if (run["method"] == "polylidar") {
      run["time_ns"] = {100, 1000, 100};
      run["rounds"] = {4, 5, 6};
    } else if (run["method"] == "cgal_alpha_shape") {
      run["time_ns"] = {300, 3000, 3000};
      run["rounds"] = {6, 5, 9};  // of round 9 the other has no time
    }
  }
  const auto ratio = [&] {
    return line_with(markdown_of(report), "| CGAL", markdown_of(report).find("ratios to Polylidar"));
  };
  expect_says(ratio(), "| 3 of 3 | 3.00 | 3.00–3.00 |");
  for (json& run : report["runs"]) run.erase("rounds");  // then by position: 3, 3 and 30
  expect_says(ratio(), " 3.00 | 3.00–30.0 |");
}

TEST(Ratios, AFailureIsInfinitelyBadOnEitherSide) {
  json report = invented_report({2000, 64000});
  const std::string text = markdown_of(report);
  const std::string failing = line_with(text, "| PostGIS (auto)", text.find("ratios to Polylidar"));
  expect_says(failing, "| 4 of 6 | 10.4 |    > 10.4 |  10.4 |    ∞ |");
  for (json& run : report["runs"]) {
    if (run["name"] != "polylidar/ca/n:2000/holes:0/protocol:paper") continue;
    run["status"] = "crash";
    run["detail"] = "SIGSEGV";
  }
  const std::string crashed = markdown_of(report);
  const std::string line = line_with(crashed, "| CGAL", crashed.find("ratios to Polylidar"));
  expect_says(line, "| 6 of 6 | 5.95 |");
  expect_says(line, "|     0 | 5.95 |");
  const std::string own = line_with(crashed, "| Polylidar (paper)", crashed.find("ratios to Polylidar"));
  expect_says(own, "| 5 of 6 |");
}

TEST(Tables, ARowSaysItsNumberOfRepetitionsWhereItIsNotTheUsualOne) {
  json report = invented_report({2000, 64000});
  for (json& run : report["runs"]) {
    if (run["method"] != "spatialite" || run["status"] != "ok") continue;
    run["time_ns"] = json::array({1000000});
    run["phases_ns"] = json::array({{{"load", 1}, {"run", 900000}, {"extract", 100000}}});
  }
  const std::string text = markdown_of(report);
  expect_says(text, "| SpatiaLite (paper), 1 repetition ");
  expect_says(text, "| Polylidar (paper) ");
  expect_says(text, "over 3 repetitions");
  json& run = report["runs"][2];
  ASSERT_EQ(run["method"], "spatialite");
  run["time_ns"] = {1000000, 1000000};
  expect_says(markdown_of(report), "| SpatiaLite (paper), 1 to 2 repetitions ");
  // Of fewer than three times nobody knows how they scatter.
  EXPECT_EQ(text.find("1.00 ±"), std::string::npos);
  run["time_ns"] = {1000000, 1000000, 1000000};
  expect_says(markdown_of(report), "1.00 ±0.00");
}

TEST(Tables, RowsOfAnUnsteadyMachineAreCounted) {
  json report = invented_report({2000});
  report["runs"][0]["flags"] = {"remeasured_round"};
  report["runs"][1]["flags"] = {"remeasured_round", "unsteady_machine"};
  const std::string text = markdown_of(report);
  expect_says(text, "in a round of 2 of 11 rows, which was measured again");
  expect_says(text, "after the last try in 1 of 11 rows");
}

TEST(Tables, FirstCallsInAFreshProcessHaveATable) {
  json report = invented_report({2000});
  EXPECT_EQ(markdown_of(report).find("First call"), std::string::npos);
  report["runs"][0]["cold_time_ns"] = 5250000;  // ten times its median of 0.525 ms
  const std::string text = markdown_of(report);
  const std::size_t table = text.find("### First call in a fresh process");
  ASSERT_NE(table, std::string::npos);
  expect_says(line_with(text, "| Polylidar (paper)", table),
              "|     1 |       5.25 |     0.525 |              10.0 |");
}

TEST(Tables, AnErrorAboveThatOfTheConvexHullIsMarked) {
  json report = invented_report({2000});
  report["runs"][0]["metrics"]["l2_convex_hull"] = 0.01;
  const std::string text = markdown_of(report);
  expect_says(line_with(text, "| Polylidar (paper)", text.find("error L2")), "7.83 (7.98) †");
  expect_says(text, "†: the error is above");
}

TEST(Tables, ProtocolsNeverShareALine) {
  json report = invented_report({2000});
  json other = report["runs"][0];
  other["protocol"] = "tuned";
  other["time_ns"] = {9000000, 9000000, 9000000};
  report["runs"].push_back(other);
  const std::string text = markdown_of(report);
  expect_says(line_with(text, "Polylidar (paper)"), "0.525 ±0.005");
  expect_says(line_with(text, "Polylidar (tuned)"), "9.00 ±0.00");
}

TEST(Tables, RunsOfOneCellArePutTogether) {
  json report = invented_report({2000});
  json other_seed = report["runs"][0];
  other_seed["seed"] = 2;
  other_seed["time_ns"] = {1000000, 1000000, 1000000};
  report["runs"].push_back(other_seed);
  // Of 0.520 0.525 0.530 1 1 1 the median is 0.765, the deviations 0.245 0.240 0.235 and three times 0.235.
  expect_says(line_with(markdown_of(report), "Polylidar (paper)"), "0.765 ±0.235");
}

TEST(Tables, AResultThatIsNotValidHasNoTimeThoughItsStatusIsOk) {
  json report = invented_report({2000});
  report["runs"][0]["metrics"]["valid"] = false;
  const std::string line = line_with(markdown_of(report), "Polylidar (paper)");
  expect_says(line, "invalid");
  EXPECT_EQ(line.find("0.525"), std::string::npos) << line;
}

TEST(Tables, AMissingMethodWithoutARowIsNamedAllTheSame) {
  json report = invented_report({2000});
  json runs = json::array();
  for (const json& run : report["runs"]) {
    if (run["method"] != "postgis_legacy") runs.push_back(run);
  }
  report["runs"] = runs;
  expect_says(markdown_of(report), "PostGIS 2.5 is not installed");
}

TEST(Tables, PapersValuesStandBesideOursOnlyAtThePapersSize) {
  expect_says(markdown_of(invented_report({64000})), "CGAL, in the paper");
  const std::string small = markdown_of(invented_report({2000}));
  EXPECT_EQ(small.find("CGAL, in the paper"), std::string::npos);
  expect_says(small, "which was not measured here");
}

TEST(Tables, OfOtherDataSetsHaveNoClaimsOfThePaper) {
  json report = invented_report({2000});
  for (json& run : report["runs"]) run["dataset"] = "letters";
  const std::string text = markdown_of(report);
  EXPECT_EQ(text.find("claims"), std::string::npos);
  expect_says(text, "### letters: time");
}

TEST(Tables, OfNoRunsSaySo) {
  json report = invented_report({2000});
  report["runs"] = json::array();
  report["summary"] = report::make_summary(report);
  expect_says(markdown_of(report), "Rows by status: none.");
}

TEST(Tables, NeverShowNaN) {
  json report = invented_report({2000});
  for (json& run : report["runs"]) {
    if (run["metrics"].contains("l2")) run["metrics"]["l2"] = nullptr;
  }
  const std::string text = markdown_of(report);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  expect_says(text, "– (");
}

TEST(NumberFormat, ThreeDigitsWithoutExponent) {
  EXPECT_EQ(three_digits(0), "0");
  EXPECT_EQ(three_digits(0.0012344), "0.00123");
  EXPECT_EQ(three_digits(0.531), "0.531");
  EXPECT_EQ(three_digits(5.314), "5.31");
  EXPECT_EQ(three_digits(53.14), "53.1");
  EXPECT_EQ(three_digits(531.4), "531");
  EXPECT_EQ(three_digits(53100.4), "53100");
  EXPECT_EQ(three_digits(9.999), "10.0");
  EXPECT_EQ(three_digits(99.99), "100");
  EXPECT_EQ(three_digits(0.9999), "1.00");
}

}  // namespace
}  // namespace hullbench::testing
