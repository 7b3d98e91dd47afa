// Tables: the whole text of a small report, and what must hold for any.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "benchmarks/number_format.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/tables.hpp"
#include "benchmarks/text_table.hpp"
#include "invented_run.hpp"
#include "temporary_folder.hpp"

namespace hullbench {
namespace {

using nlohmann::json;
using testing::TemporaryFolder;

json invented_report(const std::vector<std::int64_t>& sizes) {
  const TemporaryFolder folder;
  test::write_invented_run(folder.path(), sizes);
  return make_report(folder.path());
}

std::string tables(const json& report) {
  std::ostringstream out;
  print_markdown(make_document(report), out);
  return out.str();
}

std::string line_with(const std::string& text, const std::string& part, std::size_t from = 0) {
  const std::size_t place = text.find(part, from);
  if (place == std::string::npos) return "";
  const std::size_t begin = text.rfind('\n', place) + 1;
  return text.substr(begin, text.find('\n', place) - begin);
}

// After a wanted change: build/tests/write_invented_report FILE >tests/data/tables.md, and read the
// difference.
TEST(Tables, AreAsInTheGoldenFile) {
  std::ifstream in(std::filesystem::path(HULLBENCH_SOURCE_DIRECTORY) / "tests/data/tables.md");
  std::ostringstream golden;
  golden << in.rdbuf();
  EXPECT_EQ(tables(invented_report({2000, 64000})), golden.str());
}

TEST(Tables, FitATerminalOf120Columns) {
  std::istringstream lines(tables(invented_report({2000, 4000, 8000, 16000, 32000, 64000})));
  for (std::string line; std::getline(lines, line);) {
    const bool is_heading = line.rfind("###", 0) == 0;
    EXPECT_TRUE(is_heading || display_width(line) <= 120) << line;
  }
}

TEST(Tables, HaveTheMethodsDataSetsAndSizesOfTheReport) {
  json report = invented_report({123});
  report["datasets"][0]["title"] = "Elsewhere";
  report["methods"][0]["title"] = "Renamed";
  for (json& run : report["runs"]) {
    if (run["method"] == "cgal_alpha_shape") run["method"] = "unheard_of";
  }
  const std::string text = tables(report);
  EXPECT_NE(text.find("### Elsewhere with holes: time of equal work"), std::string::npos);
  EXPECT_NE(line_with(text, "Number of points").find(" 123 |"), std::string::npos);
  EXPECT_NE(text.find("| Renamed (paper)"), std::string::npos);
  EXPECT_NE(text.find("| unheard_of (paper)"), std::string::npos);
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
  // As three values, whose interval is their range: 5.95 times 1, 2 and 3. Of 60 independent values it would
  // be 11.9-11.9.
  const std::string text = tables(report);
  const std::string line = line_with(text, "| CGAL", text.find("ratios to Polylidar"));
  EXPECT_NE(line.find("| 11.9 | 5.95–17.9 |"), std::string::npos) << line;
}

TEST(Tables, ProtocolsNeverShareALine) {
  json report = invented_report({2000});
  json other = report["runs"][0];
  other["protocol"] = "tuned";
  other["time_ns"] = {9000000, 9000000, 9000000};
  report["runs"].push_back(other);
  const std::string text = tables(report);
  EXPECT_NE(line_with(text, "Polylidar (paper)").find("0.525 ±0.005"), std::string::npos);
  EXPECT_NE(line_with(text, "Polylidar (tuned)").find("9.00 ±0.00"), std::string::npos);
}

TEST(Tables, RunsOfOneCellArePutTogether) {
  json report = invented_report({2000});
  json other_seed = report["runs"][0];
  other_seed["seed"] = 2;
  other_seed["time_ns"] = {1000000, 1000000, 1000000};
  report["runs"].push_back(other_seed);
  // Of 0.520 0.525 0.530 1 1 1 the median is 0.765, the deviations 0.245 0.240 0.235 and three times 0.235.
  EXPECT_NE(line_with(tables(report), "Polylidar (paper)").find("0.765 ±0.235"), std::string::npos);
}

TEST(Tables, AFailureIsShownByItsNameWithTheReason) {
  const std::string text = tables(invented_report({2000, 64000}));
  const std::size_t hawaii = text.find("### Hawaii: time");
  EXPECT_NE(line_with(text, "SpatiaLite (paper)", hawaii).find("timeout"), std::string::npos);
  EXPECT_NE(text.find("no answer within 120 s"), std::string::npos);
  EXPECT_NE(line_with(text, "PostGIS (auto)", hawaii).find("invalid"), std::string::npos);
  EXPECT_NE(line_with(text, "PostGIS 2.5 (paper)").find("not installed"), std::string::npos);
  EXPECT_NE(text.find("docker-compose up -d postgis25"), std::string::npos);
}

TEST(Tables, AResultThatIsNotValidHasNoTimeThoughItsStatusIsOk) {
  json report = invented_report({2000});
  report["runs"][0]["metrics"]["valid"] = false;
  const std::string line = line_with(tables(report), "Polylidar (paper)");
  EXPECT_NE(line.find("invalid"), std::string::npos) << line;
  EXPECT_EQ(line.find("0.525"), std::string::npos) << line;
}

TEST(Tables, AMissingMethodWithoutARowIsNamedAllTheSame) {
  json report = invented_report({2000});
  json runs = json::array();
  for (const json& run : report["runs"]) {
    if (run["method"] != "postgis_legacy") runs.push_back(run);
  }
  report["runs"] = runs;
  EXPECT_NE(tables(report).find("PostGIS 2.5 is not installed"), std::string::npos);
}

TEST(Tables, PapersValuesStandBesideOursOnlyAtThePapersSize) {
  EXPECT_NE(tables(invented_report({64000})).find("CGAL, in the paper"), std::string::npos);
  const std::string small = tables(invented_report({2000}));
  EXPECT_EQ(small.find("CGAL, in the paper"), std::string::npos);
  EXPECT_NE(small.find("which was not measured here"), std::string::npos);
}

TEST(Tables, OfOtherDataSetsHaveNoClaimsOfThePaper) {
  json report = invented_report({2000});
  for (json& run : report["runs"]) run["dataset"] = "letters";
  const std::string text = tables(report);
  EXPECT_EQ(text.find("claims"), std::string::npos);
  EXPECT_NE(text.find("### letters: time"), std::string::npos);
}

TEST(Tables, OfNoRunsSaySo) {
  json report = invented_report({2000});
  report["runs"] = json::array();
  report["summary"] = make_summary(report);
  EXPECT_NE(tables(report).find("Rows by status: none."), std::string::npos);
}

TEST(Tables, NeverShowNaN) {
  json report = invented_report({2000});
  for (json& run : report["runs"]) {
    if (run["metrics"].contains("l2")) run["metrics"]["l2"] = nullptr;
  }
  const std::string text = tables(report);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_NE(text.find("– ("), std::string::npos);
}

TEST(TextTable, ColumnsLineUpAndBarsAreEscaped) {
  TextTable table({"name", "a|b"});
  table.add_row({"±é", "1"});
  table.add_row({"x\ny", "12345"});
  std::ostringstream out;
  print_markdown(table, out);
  EXPECT_EQ(out.str(),
            "| name |  a\\|b |\n"
            "|------|------:|\n"
            "| ±é   |     1 |\n"
            "| x y  | 12345 |\n");
  EXPECT_THROW(table.add_row({"too few"}), std::invalid_argument);
}

TEST(TextTable, SameNoteHasTheSameMark) {
  Notes notes;
  EXPECT_EQ(notes.mark("first"), "[1]");
  EXPECT_EQ(notes.mark("second"), "[2]");
  EXPECT_EQ(notes.mark("first"), "[1]");
  EXPECT_EQ(notes.marked(), (std::vector<std::string>{"[1] first", "[2] second"}));
}

TEST(TextTable, LongItemsAreBrokenBetweenWords) {
  std::ostringstream out;
  print_item(std::string(115, 'a') + " bb " + std::string(130, 'c') + " d", out);
  EXPECT_EQ(out.str(), "- " + std::string(115, 'a') + "\n  bb\n  " + std::string(130, 'c') + "\n  d\n");
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
}  // namespace hullbench
