// `hullbench points`: files that hold the points of a run, whatever their format and number.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/datasets.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/points/point_file.hpp"
#include "tool/points/point_writer.hpp"

namespace hullbench::testing {
namespace {

using polylidar::Box;

constexpr const char* kDataset = "ca~gradient:16~outliers:5~noise:0.5";

class PointsCommandTest : public ::testing::Test {
 protected:
  static Outcome points(const std::vector<std::string>& arguments) {
    return run_program(joined({HULLBENCH, "points"}, arguments));
  }
  /// The same through the shell, after `before`.
  static Outcome in_shell(const std::string& before, const std::string& arguments) {
    return run_program({"/bin/sh", "-c", before + " '" + HULLBENCH + "' points " + arguments});
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string written(const std::string& dataset, const std::string& n, const std::string& name) const {
    const Outcome outcome = succeeded(points({dataset, "--n", n, "--seed", "7", "--out", path(name)}));
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "");
    return path(name);
  }
  /// Names of files that are not whole.
  std::string leftovers() const {
    std::string names;
    for (const auto& entry : fs::directory_iterator(folder_.path())) {
      if (entry.path().string().find("unfinished") != std::string::npos) names += entry.path().string();
    }
    return names;
  }

 private:
  TemporaryFolder folder_;
};

/// A little-endian number at `place` of the file.
template <class Number>
Number at(const std::string& bytes, std::size_t place) {
  static_assert(std::endian::native == std::endian::little, "on other machines the bytes must be turned");
  Number number{};
  if (place + sizeof number <= bytes.size()) std::memcpy(&number, bytes.data() + place, sizeof number);
  return number;
}

/// Read by the tables of the LAS 1.2 specification, not by anything of ours.
struct ReadLas {
  explicit ReadLas(const std::string& bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "LASF");
    EXPECT_EQ(at<std::uint8_t>(bytes, 24), 1);
    EXPECT_EQ(at<std::uint8_t>(bytes, 25), 2);
    EXPECT_EQ(at<std::uint16_t>(bytes, 94), 227);
    EXPECT_EQ(at<std::uint32_t>(bytes, 100), 0U) << "variable length records";
    EXPECT_EQ(at<std::uint8_t>(bytes, 104), 0) << "point format";
    const std::size_t begin = at<std::uint32_t>(bytes, 96);
    const std::size_t length = at<std::uint16_t>(bytes, 105);
    EXPECT_EQ(length, 20U);
    const std::size_t count = at<std::uint32_t>(bytes, 107);
    EXPECT_EQ(at<std::uint32_t>(bytes, 111), count) << "first returns";
    EXPECT_EQ(bytes.size(), begin + count * length);
    scale = at<double>(bytes, 131);
    EXPECT_EQ(at<double>(bytes, 139), scale);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t place = begin + i * length;
      points.push_back({at<std::int32_t>(bytes, place) * scale + at<double>(bytes, 155),
                        at<std::int32_t>(bytes, place + 4) * scale + at<double>(bytes, 163)});
      EXPECT_EQ(at<std::int32_t>(bytes, place + 8), 0);
      EXPECT_EQ(at<std::uint8_t>(bytes, place + 14), 9) << "the first of one return";
      sources.push_back(at<std::uint16_t>(bytes, place + 18));
    }
    bounds = {{at<double>(bytes, 187), at<double>(bytes, 203)},
              {at<double>(bytes, 179), at<double>(bytes, 195)}};
  }

  double scale = 0;
  std::vector<Point> points;
  std::vector<std::uint16_t> sources;
  Box bounds;
};

TEST_F(PointsCommandTest, FilesHoldThePointsOfARun) {
  // Drawn one by one, drawn at once, changed afterwards.
  for (const std::string name :
       {"ca", "star-3~outliers:10~noise:1~quantised:0.5", kDataset, "hi~airborne:4"}) {
    const std::vector<Point> expected = make_point_set(name, false, 500, 7).points;
    for (const char* file : {"a.csv", "a.txt", "a.xyz", "a.npy"}) {
      EXPECT_EQ(polylidar::tool::read_points(written(name, "500", file)), expected) << name << " as " << file;
    }
  }
}

TEST_F(PointsCommandTest, LasHoldsThemUpToItsScale) {
  const std::vector<Point> expected = make_point_set(kDataset, false, 500, 7).points;
  const ReadLas las(read_text(written(kDataset, "500", "a.LAS")));
  ASSERT_EQ(las.points.size(), expected.size());
  const Box box = polylidar::bounding_box(expected);
  const double side = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  EXPECT_LT(las.scale, side / 4e8);
  EXPECT_GT(las.scale, side / 5e9);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    // Half a step, and the rounding of the reader's sum.
    EXPECT_NEAR(las.points[i].x, expected[i].x, 0.50001 * las.scale) << i;
    EXPECT_NEAR(las.points[i].y, expected[i].y, 0.50001 * las.scale) << i;
  }
  const Box read = polylidar::bounding_box(las.points);
  EXPECT_EQ(las.bounds.min, read.min);
  EXPECT_EQ(las.bounds.max, read.max);
}

TEST_F(PointsCommandTest, HolesSeedAndOwnPoints) {
  succeeded(points({"ca", "--n", "300", "--holes", "--out", path("holed.npy")}));
  EXPECT_EQ(polylidar::tool::read_points(path("holed.npy")), make_point_set("ca", true, 300, 1).points);
  succeeded(points({"floor-2", "--seed", "5", "--out", path("floor.npy")}));
  EXPECT_EQ(polylidar::tool::read_points(path("floor.npy")), make_point_set("floor-2", false, 0, 5).points);
}

TEST_F(PointsCommandTest, AFamilyIsAllItsShapesWithLabels) {
  constexpr std::size_t kCells = 48;
  constexpr std::size_t kEach = 120;
  const std::string family = "cell~transcripts:5";
  std::vector<Point> expected;
  for (std::size_t cell = 1; cell <= kCells; ++cell) {
    const std::string name = "cell-" + std::to_string(cell) + "~transcripts:5";
    const std::vector<Point> own = make_point_set(name, false, kEach, 7).points;
    expected.insert(expected.end(), own.begin(), own.end());
  }
  const std::string csv = written(family, std::to_string(kEach), "cells.csv");
  EXPECT_TRUE(read_text(csv).starts_with("x,y,label\n"));
  EXPECT_EQ(polylidar::tool::read_points(csv), expected);
  const ReadLas las(read_text(written(family, std::to_string(kEach), "cells.las")));
  ASSERT_EQ(las.sources.size(), expected.size());
  for (std::size_t i = 0; i < las.sources.size(); ++i) EXPECT_EQ(las.sources[i], 1 + i / kEach);
  EXPECT_EQ(las.bounds.min, polylidar::bounding_box(las.points).min);

  const Outcome hulls = succeeded(run_program({HULLBENCH, "hull", csv, "--by", "label"}));
  const json features = json::parse(hulls.out)["features"];
  ASSERT_EQ(features.size(), kCells);
  EXPECT_EQ(features[47]["properties"]["label"], 48);
  EXPECT_EQ(features[47]["properties"]["points"], kEach);

  succeeded(points({"lowfloor", "--format", "npy"}));
  expect_refusal(points({"cell", "--n", "100000000", "--format", "las"}), 2, "at most 4294967295 points");
  expect_refusal(points({"cell~nothing:5", "--n", "10"}), 2, "cell-1~nothing:5");
}

TEST_F(PointsCommandTest, StandardOutputGetsCsvOrWhatIsAsked) {
  const std::string csv = read_text(written("ca", "50", "a.csv"));
  EXPECT_TRUE(csv.starts_with("x,y\n"));
  EXPECT_EQ(points({"ca", "--n", "50", "--seed", "7"}).out, csv);
  EXPECT_EQ(points({"ca", "--n", "50", "--seed", "7", "--out", "-"}).out, csv);
  EXPECT_EQ(points({"ca", "--n", "50", "--seed", "7", "--format", "npy"}).out,
            read_text(written("ca", "50", "a.npy")));
  EXPECT_EQ(points({"ca", "--n", "50", "--seed", "7", "--format", "npy", "--out", path("b.csv")}).code, 0);
  EXPECT_EQ(read_text(path("b.csv")), read_text(path("a.npy")));
}

TEST_F(PointsCommandTest, UniformPointsTakeNoMemory) {
  // Six million doubles are 48 MB, the program and its libraries are below that limit without them.
  succeeded(in_shell("ulimit -v 100000;", "'ca~outliers:5~noise:0.5' --n 3000000 --format npy > /dev/null"));
  EXPECT_NE(in_shell("ulimit -v 100000;", "ca~gradient:16 --n 3000000 --format npy > /dev/null").code, 0);
}

TEST_F(PointsCommandTest, RefusesWhatCannotBe) {
  expect_refusal(points({"ca~lattice:0", "--n", "1000000000000"}), 1, "drawn all at once; ask for fewer");
  expect_refusal(points({"ca", "--n", "5000000000", "--format", "las"}), 2, "at most 4294967295 points");
  expect_refusal(points({"ca"}), 2, "ask for a number of them");
  expect_refusal(points({"floor-1", "--n", "10"}), 2, "ask for no number of them");
  expect_refusal(points({"nowhere", "--n", "10"}), 2, "there is no data set 'nowhere'");
  expect_refusal(points({"country-1", "--n", "10", "--holes"}), 2, "no variant with holes");
  expect_refusal(points({"ca", "--n", "10", "--out", path("a.shp")}), 2, "names no format");
  expect_refusal(points({"ca", "--n", "10", "--format", "shp"}), 2, "--format");
  expect_refusal(points({"ca", "--n", "-1"}), 2, "--n");
  expect_refusal(points({"ca", "--n", "10", "--seed", "-1"}), 2, "--seed");
}

TEST_F(PointsCommandTest, AFileIsWrittenWholeOrNotAtAll) {
  const std::string npy = written("ca", "50", "a.npy");
  const std::string before = read_text(npy);
  // A limit on the size of files stands for a full disk.
  expect_refusal(in_shell("ulimit -f 40;", "ca --n 100000 --out '" + npy + "'"), 1, "cannot write " + npy);
  EXPECT_EQ(read_text(npy), before);
  EXPECT_EQ(leftovers(), "");
  expect_refusal(points({"ca", "--n", "10", "--out", "/dev/full", "--format", "csv"}), 1, "No space left");
  expect_refusal(points({"ca", "--n", "10", "--out", "/nowhere/a.csv"}), 1, "cannot write /nowhere/a.csv");
}

TEST_F(PointsCommandTest, CtrlCLeavesNothingBehind) {
  Program program({HULLBENCH, "points", "ca", "--n", "4000000000", "--out", path("a.npy")});
  ASSERT_TRUE(wait_until([&] { return !leftovers().empty(); }));
  program.send_signal(SIGINT);
  expect_end(program.wait(), 130, "interrupted");
  EXPECT_EQ(leftovers(), "");
  EXPECT_FALSE(fs::exists(path("a.npy")));
}

TEST(PointEncoder, PutsLabelsIntoEveryFormat) {
  const std::vector<Point> points = {{0.5, -1}, {1e-5, 3}};
  const polylidar::tool::PointFileFacts facts{
      .count = 2, .has_labels = true, .bounds = polylidar::bounding_box(points)};
  const auto text = [&](polylidar::tool::PointOutput format) {
    const polylidar::tool::PointEncoder encoder(format, facts);
    std::string bytes = encoder.header();
    encoder.append(points[0], 7, bytes);
    encoder.append(points[1], 65535, bytes);
    return bytes;
  };
  EXPECT_EQ(text(polylidar::tool::PointOutput::kCsv), "x,y,label\n0.5,-1,7\n1e-05,3,65535\n");
  EXPECT_EQ(text(polylidar::tool::PointOutput::kXyz), "0.5 -1 7\n1e-05 3 65535\n");
  const std::string npy = text(polylidar::tool::PointOutput::kNpy);
  expect_says(npy, "'shape': (2, 3)");
  EXPECT_EQ(at<double>(npy, npy.size() - 8), 65535);
  EXPECT_EQ(ReadLas(text(polylidar::tool::PointOutput::kLas)).sources,
            (std::vector<std::uint16_t>{7, 65535}));
  std::string unused;
  EXPECT_THROW(polylidar::tool::PointEncoder(polylidar::tool::PointOutput::kLas, facts)
                   .append(points[0], 65536, unused),
               std::invalid_argument);
}

TEST(LasGrid, ReachesAllCoordinates) {
  for (const Box& box : {Box{{-1, 0}, {1, 5}}, Box{{1e9, 1e9}, {1e9 + 1e-3, 1e9}},
                         Box{{-1e300, 0}, {1e300, 1}}, Box{{1e-200, 0}, {3e-200, 0}}}) {
    const polylidar::tool::LasGrid grid(box);
    for (const Point& corner : {box.min, box.max}) {
      const Point again = grid.place(grid.column(corner.x), grid.row(corner.y));
      EXPECT_NEAR(again.x, corner.x, grid.scale()) << box.max.x;
      EXPECT_NEAR(again.y, corner.y, grid.scale()) << box.max.x;
    }
  }
  const polylidar::tool::LasGrid one({{3.7, -2}, {3.7, -2}});
  EXPECT_EQ(one.place(one.column(3.7), one.row(-2)), (Point{3.7, -2}));
}

}  // namespace
}  // namespace hullbench::testing
