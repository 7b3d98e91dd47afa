// What is kept to be drawn: points, ground truth and results on a grid.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/record/validate.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

/// A square of side 10 at (100, 200) with `count` points on its diagonal.
PointSet square(std::size_t count) {
  PointSet set;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = 10 * static_cast<double>(k) / static_cast<double>(count);
    set.points.push_back({100 + t, 200 + t});
  }
  set.ground_truth = {{{{100, 200}, {110, 200}, {110, 210}, {100, 210}}, {}}};
  set.ground_truth_area = 100;
  set.sha256 = std::string(64, 'a');
  return set;
}

record::RunRecord record(const std::string& dataset, double l2) {
  record::RunRecord result;
  result.method = "polylidar";
  result.dataset = dataset;
  result.n = 10;
  result.protocol = "paper";
  result.name = "polylidar/" + dataset + "/n:10/holes:0/protocol:paper";
  result.id = std::string(64, 'b');
  result.output_sha256 = std::string(64, 'c');
  result.metrics["l2"] = std::isfinite(l2) ? json(l2) : json();
  return result;
}

const MultiPolygon kTriangle = {{{{100, 200}, {110, 200}, {105, 210}}, {}}};

class PicturesTest : public HullbenchTest {
 protected:
  std::vector<json> lines() const { return read_lines(record::kPicturesFile); }

  /// The data sets whose results are kept.
  std::set<std::string> kept() const {
    std::set<std::string> result;
    for (const json& line : lines()) {
      if (line.at("kind") == "result") result.insert(line.at("case").get<std::string>());
    }
    return result;
  }
};

TEST_F(PicturesTest, ACaseIsTheRunsNameWithoutMethodAndProtocol) {
  EXPECT_EQ(record::case_of_run("polylidar/ca/n:2000/holes:1/protocol:paper"), "ca/n:2000/holes:1");
}

TEST_F(PicturesTest, StandOnAGridThatGivesThePlacesBack) {
  record::PictureBook(folder(), 1).add(record("square", 0.5), square(4), kTriangle);
  ASSERT_EQ(lines().size(), 2U);
  const json drawn_case = lines()[0];
  const json result = lines()[1];
  EXPECT_EQ(drawn_case.at("points_total"), 4);
  EXPECT_EQ(drawn_case.at("ground_truth"), json::parse("[[[0,0, 65535,0, 65535,65535, 0,65535]]]"));
  const double step = drawn_case.at("step").get<double>();
  EXPECT_NEAR(step, 10.0 / 65535, 1e-15);
  const auto x = [&](std::size_t i) { return 100 + step * result.at("polygons")[0][0][i].get<double>(); };
  EXPECT_NEAR(x(0), 100, step / 2);
  EXPECT_NEAR(x(2), 110, step / 2);
  EXPECT_NEAR(x(4), 105, step / 2);
  EXPECT_EQ(result.at("run"), "polylidar/square/n:10/holes:0/protocol:paper");
  EXPECT_EQ(record::validate_file(folder() / record::kPicturesFile), std::vector<std::string>());
}

TEST_F(PicturesTest, OfManyPointsFewAreKept) {
  record::PictureBook(folder(), 1).add(record("square", 0.5), square(10001), kTriangle);
  const json drawn_case = lines()[0];
  EXPECT_EQ(drawn_case.at("points_total"), 10001);
  EXPECT_EQ(drawn_case.at("points").size(), 2 * record::PictureBook::kMostPoints);
  // They reach from the first to nearly the last, which lies in the other corner.
  EXPECT_EQ(drawn_case.at("points")[0], 0);
  EXPECT_GT(drawn_case.at("points").back().get<int>(), 65400);
}

TEST_F(PicturesTest, ACaseIsWrittenOnceForAllItsResultsAndStarts) {
  record::PictureBook(folder(), 2).add(record("square", 0.5), square(4), kTriangle);
  record::PictureBook(folder(), 2).add(record("square", 0.4), square(4), kTriangle);
  ASSERT_EQ(lines().size(), 3U);
  EXPECT_EQ(lines()[0].at("kind"), "case");
  EXPECT_EQ(lines()[2].at("kind"), "result");
}

TEST_F(PicturesTest, OfALargePlanTheWorstOfEachFamilyAreKept) {
  const std::size_t many = record::PictureBook::kAllPictures + 1;
  const std::size_t most = record::PictureBook::kWorstPictures;
  record::PictureBook(folder(), many).add(record("star-1", 0.9), square(4), kTriangle);
  {
    // A second start knows what the first one has kept.
    record::PictureBook book(folder(), many);
    for (std::size_t k = 2; k <= most + 1; ++k)
      book.add(record("star-" + std::to_string(k), 0.5), square(4), kTriangle);
    book.add(record("star-100", 0.1), square(4), kTriangle);
    book.add(record("star-101", 0.7), square(4), kTriangle);
    book.add(record("star-102", std::numeric_limits<double>::quiet_NaN()), square(4), kTriangle);
    book.add(record("comb-1", 0.1), square(4), kTriangle);
    // Worse ones take the places of better ones, one each.
    for (std::size_t k = 200; k < 200 + most; ++k)
      book.add(record("star-" + std::to_string(k), 0.8), square(4), kTriangle);
    book.add(record("star-300", 0.6), square(4), kTriangle);
  }
  const std::set<std::string> cases = kept();
  EXPECT_TRUE(cases.contains("star-1/n:10/holes:0"));
  EXPECT_FALSE(cases.contains("star-100/n:10/holes:0")) << "better than all that are kept";
  EXPECT_TRUE(cases.contains("star-101/n:10/holes:0")) << "worse than most";
  EXPECT_TRUE(cases.contains("star-102/n:10/holes:0")) << "an invalid one is the worst";
  EXPECT_TRUE(cases.contains("comb-1/n:10/holes:0")) << "another family";
  EXPECT_FALSE(cases.contains("star-300/n:10/holes:0")) << "worse than the first ones, but not any more";
  // The first 12 took the free places; one more of the same error is not worse.
  EXPECT_FALSE(cases.contains("star-" + std::to_string(most + 1) + "/n:10/holes:0"));
}

TEST_F(PicturesTest, OfALargePlanTheWorstOfEachStressAreKept) {
  const std::size_t most = record::PictureBook::kWorstPictures;
  record::PictureBook book(folder(), record::PictureBook::kAllPictures + 1);
  for (std::size_t k = 1; k <= most; ++k)
    book.add(record("star-" + std::to_string(k) + "~noise:0.5", 0.5), square(4), kTriangle);
  book.add(record("star-100~noise:0.5", 0.1), square(4), kTriangle);
  book.add(record("star-100~noise:1", 0.1), square(4), kTriangle);
  book.add(record("star-100", 0.1), square(4), kTriangle);
  const std::set<std::string> cases = kept();
  EXPECT_EQ(cases.size(), most + 2);
  EXPECT_FALSE(cases.contains("star-100~noise:0.5/n:10/holes:0")) << "the family's other members are worse";
  EXPECT_TRUE(cases.contains("star-100~noise:1/n:10/holes:0")) << "another stress";
  EXPECT_TRUE(cases.contains("star-100/n:10/holes:0")) << "none";
}

TEST_F(PicturesTest, AResultThatCannotBeDrawnTakesNoPlaceAmongTheWorst) {
  const std::size_t most = record::PictureBook::kWorstPictures;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  record::PictureBook book(folder(), record::PictureBook::kAllPictures + 1);
  for (std::size_t k = 1; k <= most; ++k)
    book.add(record("star-" + std::to_string(k), nan), square(4),
             {{{{100, 200}, {nan, 200}, {105, 210}}, {}}});
  book.add(record("star-100", 0.1), square(4), kTriangle);
  EXPECT_EQ(kept(), std::set<std::string>{"star-100/n:10/holes:0"});
}

TEST_F(PicturesTest, AResultThatCannotBeDrawnIsLeftOut) {
  record::PictureBook book(folder(), 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  book.add(record("square", 0.5), square(4), {{{{100, 200}, {nan, 200}, {105, 210}}, {}}});
  book.add(record("square", 0.5), square(4), {{{{100, 200}, {1e300, 200}, {105, 210}}, {}}});
  EXPECT_TRUE(lines().empty());
  book.add(record("square", 1), square(4), {});
  EXPECT_EQ(lines().size(), 2U) << "an empty result is drawn: there is nothing to see but the truth";
}

TEST_F(PicturesTest, AFileOfSomethingElseIsSaid) {
  write_text(folder() / record::kPicturesFile, "{\"kind\": \"row\"}\n");
  EXPECT_THROW(record::PictureBook(folder(), 1), std::runtime_error);
}

TEST_F(PicturesTest, OfARunAreThereForItsReport) {
  const std::string plan = write(small_plan("small", california({300, 400}), 1));
  ASSERT_EQ(hullbench({"run", plan, "--out", "whole"}).code, 0);
  EXPECT_EQ(record::validate_file(folder() / "whole" / record::kPicturesFile), std::vector<std::string>());
  const std::vector<json> whole = read_lines(fs::path("whole") / record::kPicturesFile);
  std::set<std::string> runs;
  for (const json& line : read_lines("whole/runs.jsonl")) runs.insert(line.at("name").get<std::string>());
  for (const json& line : whole) {
    if (line.at("kind") == "result") runs.erase(line.at("run").get<std::string>());
  }
  EXPECT_EQ(runs, std::set<std::string>()) << "runs without a picture";

  for (const char* shard : {"1/2", "2/2"}) {
    const std::string out = std::string("shard") + shard[0];
    ASSERT_EQ(hullbench({"run", plan, "--out", out, "--shard", shard}).code, 0);
  }
  ASSERT_EQ(hullbench({"merge", "shard1", "shard2", "--out", "merged"}).code, 0);
  const std::vector<json> merged = read_lines(fs::path("merged") / record::kPicturesFile);
  EXPECT_EQ(std::set<json>(merged.begin(), merged.end()), std::set<json>(whole.begin(), whole.end()));

  succeeded(hullbench({"report", "whole", "--out", "drawn"}));
  EXPECT_EQ(read_lines(fs::path("drawn") / record::kPicturesFile), whole);
  EXPECT_EQ(record::validate_file(folder() / "drawn/report.json"), std::vector<std::string>());
  EXPECT_EQ(hullbench({"report", "nowhere", "--out", "drawn"}).code, 2);
  // Into itself would be to remove what is to be read.
  EXPECT_EQ(hullbench({"report", "whole", "--out", "whole"}).code, 2);
  EXPECT_EQ(read_lines(fs::path("whole") / record::kPicturesFile), whole);
}

}  // namespace
}  // namespace hullbench::testing
