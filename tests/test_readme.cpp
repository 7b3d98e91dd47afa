// The results in the README: where they are put, and the check that they are those of a run.
#include <gtest/gtest.h>

#include <string>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/readme.hpp"
#include "invented_shapes.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

const std::string kBegin = "<!-- results: begin -->\n";
const std::string kEnd = "<!-- results: end -->";

std::string complaint(const std::string& readme) {
  return complaint_of([&] { report::with_results(readme, "new\n"); });
}

TEST(ReadmeMarks, ResultsTakeThePlaceOfWhatStandsBetweenThem) {
  EXPECT_EQ(report::with_results("# Title\n\n" + kBegin + "old\nolder\n" + kEnd + "\n\nRest", "new\n"),
            "# Title\n\n" + kBegin + "new\n" + kEnd + "\n\nRest");
  EXPECT_EQ(report::with_results(kBegin + kEnd, ""), kBegin + kEnd);
}

TEST(ReadmeMarks, MissingOnesAreASentence) {
  const std::string words = " once; put it where the results are to stand";
  const std::string begin = "the README must have the line <!-- results: begin -->" + words;
  const std::string end = "the README must have the line <!-- results: end -->" + words;
  EXPECT_EQ(complaint("# Title\n"), begin);
  EXPECT_EQ(complaint(""), begin);
  EXPECT_EQ(complaint("old\n" + kEnd), begin);
  EXPECT_EQ(complaint(kBegin + "old\n"), end);
  EXPECT_EQ(complaint(kBegin + "old\n" + kBegin + kEnd), begin);
  EXPECT_EQ(complaint(kBegin + "old\n" + kEnd + "\n" + kEnd), end);
}

TEST(ReadmeMarks, TheWrongOrderIsASentence) {
  EXPECT_EQ(complaint(kEnd + "\nold\n" + kBegin),
            "the README's marks of the results stand in the wrong order; swap them");
}

TEST(ReadmeResults, NameTheRunAndHaveThePapersMethodsAtTheLeastAndTheLargestSize) {
  const json report = invented_report({2000, 8000, 64000});
  const std::string text = report::readme_results({report}, "results/reference");
  expect_says(text,
              "in\n[results/reference](results/reference), begun on 2026-01-02: 42 runs, 1 experiment.");
  expect_says(text, "\n### California with holes: time and error of the paper's methods");
  expect_says(text, "| 2000 points, ms |    error, % | 64000 points, ms |    error, % |\n");
  expect_says(
      text,
      "| Polylidar (paper)        |    0.525 ±0.005 | 7.83 (7.98) |        16.8 ±0.2 | 1.38 (1.41) |\n");
  expect_says(text, "| PostGIS 2.5 (paper)      |   not installed |             |");
  EXPECT_EQ(text.find("(auto)"), std::string::npos) << "not the paper's: " << text;
  EXPECT_EQ(text.find("(paper) ["), std::string::npos) << "a note that is not here: " << text;
}

TEST(ReadmeResults, HaveTheFastestRivalWithTheSamePolygons) {
  json report = invented_report({2000});
  EXPECT_EQ(report::readme_results({report}, "x").find("PostGIS (auto)"), std::string::npos);
  report["summary"]["headline"]["rivals"][0].update({{"method", "postgis"}, {"protocol", "auto"}});
  expect_says(report::readme_results({report}, "x"), "PostGIS (auto)");
}

TEST(ReadmeResults, AreOfTheFirstExperimentThatHasTheShape) {
  json other = report_on_shapes({{"star-1", 8000, 0.8}});
  EXPECT_EQ(report::readme_results({other}, "x").find("###"), std::string::npos);
  const std::string text =
      report::readme_results({other, invented_report({2000}), invented_report({64000})}, "x");
  expect_says(text, "| 2000 points");
  EXPECT_EQ(text.find("| 64000 points"), std::string::npos) << text;
}

TEST(ReadmeResults, OfNoRunsAreASentence) {
  EXPECT_EQ(complaint_of([] { report::readme_results({}, "results/reference"); }),
            "there is no run in results/reference yet; measure it first");
}

class ReadmeCommand : public HullbenchTest {
 protected:
  fs::path file() const { return folder() / "README.md"; }

  void measure() const {
    const std::string plan = write(small_plan("states", california({500, 600})));
    ASSERT_EQ(hullbench({"run", plan, "--out", "run"}).code, 0);
  }
};

TEST_F(ReadmeCommand, WritesTheResultsAndSeesWhenADigitIsAnother) {
  measure();
  const std::string before = "# Title 1\n\n" + kBegin;
  const std::string behind = kEnd + "\n\nRest: \"\\ 2\"\n";
  write_text(file(), before + "old\n" + behind);
  EXPECT_EQ(hullbench({"readme", "run", "README.md", "--check"}).code, 1);
  EXPECT_EQ(read_text(file()), before + "old\n" + behind) << "a check writes nothing";
  succeeded(hullbench({"readme", "run", "README.md"}));
  std::string text = read_text(file());
  EXPECT_TRUE(text.starts_with(before) && text.ends_with(behind)) << text;
  EXPECT_EQ(text.find("old"), std::string::npos);

  const Outcome agrees = succeeded(hullbench({"readme", "run", "README.md", "--check"}));
  EXPECT_EQ(agrees.out, "README.md agrees with run\n");
  EXPECT_EQ(hullbench({"readme", "run", "README.md"}).code, 0);
  EXPECT_EQ(read_text(file()), text);

  // The first digit of a measured time.
  const std::size_t cell = text.find(" ±");
  ASSERT_NE(cell, std::string::npos);
  text[cell - 1] = text[cell - 1] == '9' ? '8' : '9';
  write_text(file(), text);
  const Outcome differs = hullbench({"readme", "run", "README.md", "--check"});
  EXPECT_EQ(differs.code, 1);
  EXPECT_EQ(
      differs.err,
      "hullbench: the results in README.md are not those of run; 'hullbench readme run README.md' writes "
      "them anew\n");
  EXPECT_EQ(read_text(file()), text);
}

TEST_F(ReadmeCommand, WhatIsNotThereIsASentence) {
  measure();
  EXPECT_EQ(hullbench({"readme", "run", "README.md"}).err, "hullbench: there is no file README.md\n");
  EXPECT_EQ(hullbench({"readme", "run", "."}).err, "hullbench: there is no file .\n");
  write_text(file(), "# Title\n");
  EXPECT_EQ(hullbench({"readme", "nowhere", "README.md"}).code, 2);
  expect_end(hullbench({"readme", "run", "README.md"}), 1, "must have the line <!-- results: begin --> once");
  EXPECT_EQ(read_text(file()), "# Title\n");
}

}  // namespace
}  // namespace hullbench::testing
