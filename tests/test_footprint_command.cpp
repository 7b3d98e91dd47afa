// `polylidar footprint`: an index of files as its users meet it.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <random>
#include <sstream>
#include <thread>

#include "benchmarks/base/names.hpp"
#include "tests/complaint.hpp"
#include "tests/las_file.hpp"
#include "tests/laz_file.hpp"
#include "tests/point_file_texts.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/commands/file_work.hpp"
#include "tool/program/interrupt.hpp"
#include "tool/program/status_line.hpp"

namespace hullbench::testing {
namespace {

/// Adds points of a tile of 100 m, everywhere but in its lake, until there are `count`.
void add_points(LasFile& file, std::size_t count, std::mt19937& random) {
  while (file.points.size() < count) {
    const auto x = static_cast<std::int32_t>(random() % 10000);
    const auto y = static_cast<std::int32_t>(random() % 10000);
    if (std::hypot(x - 5000, y - 5000) < 2000) continue;
    file.points.push_back({.x = x, .y = y, .classification = file.points.size() % 4 == 0 ? 6U : 2U});
  }
}

LasFile tile(int column) {
  LasFile file;
  file.minor = 4;
  file.format = 6;
  file.offset = {500000.0 + 100 * column, 5600000};
  std::mt19937 random(static_cast<unsigned>(column));
  add_points(file, 8000, random);
  file.records = {projected(25832)};
  return file;
}

class FootprintCommandTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    write_text(folder_.path() / name, text);
    return (folder_.path() / name).string();
  }
  static Outcome footprint(const std::vector<std::string>& arguments, const ProgramOptions& options = {}) {
    return run_program(joined({POLYLIDAR, "footprint"}, arguments), options);
  }
  /// Tiles side by side; all their points in `all_`.
  std::vector<std::string> tiles(int count) {
    std::vector<std::string> files;
    for (int column = 0; column < count; ++column) {
      const LasFile las = tile(column);
      for (const Point& p : las.places()) all_.push_back(p);
      files.push_back(file("tile_" + std::to_string(column) + ".las", las.text()));
    }
    return files;
  }

  TemporaryFolder folder_;
  Points all_;
};

TEST(FileWork, AnInterruptionEndsItBetweenTwoFiles) {
  namespace tool = polylidar::tool;
  std::ostringstream err;
  const tool::Surroundings surroundings{"polylidar", err, false};
  tool::StatusLine status(err, false, std::chrono::seconds(60));
  const std::vector<std::string> paths = {"a", "b", "c"};
  tool::FileWork files(paths, surroundings, status);
  int begun = 0;
  const auto work = [&](std::size_t, unsigned, tool::MemoryShare&) -> tool::Crs {
    ++begun;
    tool::set_interrupted(true);
    return {};
  };
  EXPECT_THROW(files.run(1, 1U << 20U, work), tool::Interrupted);
  tool::set_interrupted(false);
  EXPECT_EQ(begun, 1);
}

TEST_F(FootprintCommandTest, AFeatureForEveryFile) {
  const std::vector<std::string> files = tiles(5);
  const std::string out = (folder_.path() / "index.geojson").string();
  const std::vector<std::string> arguments = joined(files, {"-o", out});
  const Outcome outcome = succeeded(footprint(arguments));
  EXPECT_EQ(outcome.err, "polylidar: 5 of 5 files are in the index\n");
  EXPECT_EQ(outcome.out, "");
  const json index = json::parse(read_text(out));
  EXPECT_EQ("urn:ogc:def:crs:EPSG::25832", index["crs"]["properties"]["name"].get<std::string>());
  ASSERT_EQ(index["features"].size(), 5U);
  for (int column = 0; column < 5; ++column) {
    const json& feature = index["features"][static_cast<std::size_t>(column)];
    const json& properties = feature["properties"];
    EXPECT_EQ("tile_" + std::to_string(column) + ".las", properties["name"].get<std::string>());
    EXPECT_EQ(files[static_cast<std::size_t>(column)], properties["path"].get<std::string>());
    EXPECT_EQ(properties["points"], 8000);
    EXPECT_EQ(properties["classes"], (json{{"2", 6000}, {"6", 2000}}));
    EXPECT_EQ("EPSG:25832", properties["crs"].get<std::string>());
    EXPECT_EQ(properties["parts"], 1);
    EXPECT_EQ(properties["holes"], 1);
    const double true_area = 1e4 - 3.14159 * 400;
    EXPECT_NEAR(properties["area"].get<double>(), true_area, 0.03 * true_area);
    EXPECT_NEAR(properties["density"].get<double>(), 8000 / true_area, 0.03);
    const auto bounds = properties["bounds"].get<std::vector<double>>();
    EXPECT_NEAR(bounds[0], 500000 + 100 * column, 0.2);
    EXPECT_NEAR(bounds[3], 5600100, 0.2);
    EXPECT_EQ("MultiPolygon", feature["geometry"]["type"].get<std::string>());
  }
  // Whatever the threads.
  const std::string first = read_text(out);
  EXPECT_EQ(footprint(joined(arguments, {"--threads", "1"})).code, 0);
  EXPECT_EQ(read_text(out), first);
}

TEST_F(FootprintCommandTest, AStreamTellsOfPointsThatTheHeaderDoesNotCount) {
  LasFile las = tile(0);
  std::mt19937 random(6);
  add_points(las, 300'000, random);
  las.promised = 299'000;
  const std::string path = file("more.las", las.text());
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{}, {"--min-triangles", "1"}}) {
    const Outcome outcome = succeeded(footprint(joined(options, {path})));
    EXPECT_NE(outcome.err.find("there is room for 1000 more"), std::string::npos) << outcome.err;
  }
}

TEST_F(FootprintCommandTest, AStreamGivesWhatThePointsInMemoryGive) {
  // Above 8 MiB a LAS file is a stream, but where all triangles are asked for.
  LasFile las = tile(0);
  std::mt19937 random(5);
  add_points(las, 300'000, random);
  for (std::size_t i = 8000; i < las.points.size(); ++i) {
    las.points[i].classification = static_cast<unsigned>(random() % 5);
    las.points[i].withheld = random() % 50 == 0;
  }
  const std::string large = file("large.las", las.text());
  ASSERT_GT(fs::file_size(large), std::size_t{1} << 23U);
  las.records = {geographic(4326)};
  las.scale = {1e-7, 1e-7};
  las.offset = {10, 60};
  const std::string degrees = file("degrees.las", las.text());
  for (LasPoint& p : las.points) p.x = static_cast<std::int32_t>(1e-4 * p.x * p.x);
  for (std::size_t i = 0; i < las.points.size(); ++i) las.points[i].y = las.points[i / 10 * 10].y;
  las.records = {projected(25832)};
  const std::string uneven = file("uneven.las", las.text());
  for (const std::string& path : {large, degrees, uneven}) {
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{},
                                               {"--alpha", "1.5", "--max-parts", "1"},
                                               {"--detail", "0.8", "--simplify", "0.5", "--classes", "1,2,6"},
                                               {"--window", "500010,5600010,500090,5600070"}}) {
      const std::vector<std::string> arguments = joined(options, {path});
      const std::string in_memory = succeeded(footprint(joined(arguments, {"--min-triangles", "1"}))).out;
      for (const char* threads : {"1", "3"}) {
        EXPECT_EQ(succeeded(footprint(joined(arguments, {"--threads", threads}))).out, in_memory) << path;
      }
    }
  }
  // What the header says of the box may be right or wrong.
  las.scale = {0.01, 0.01};
  las.offset = {500000, 5600000};
  for (LasPoint& p : las.points) p.withheld = false;
  const polylidar::Box box = polylidar::bounding_box(las.places());
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{}, {"--alpha", "1.5"}}) {
    std::string without;
    for (const polylidar::Box& said : {polylidar::Box{}, box, polylidar::Box{box.min, {box.max.x, 5600050}},
                                       polylidar::Box{{box.min.x, 0}, box.max}}) {
      las.box = said;
      const std::string said_file = file("said.las", las.text());
      const std::vector<std::string> arguments = joined(options, {said_file, "--threads", "2"});
      const std::string out = succeeded(footprint(arguments)).out;
      if (without.empty()) without = out;
      EXPECT_EQ(out, without);
      const std::string united = succeeded(footprint(joined({"--union"}, arguments))).out;
      EXPECT_EQ(json::parse(united)["features"][0]["geometry"],
                json::parse(without)["features"][0]["geometry"]);
    }
  }
  const std::string cut = file("cut.las", las.text().substr(0, (std::size_t{1} << 23U) + 1000));
  const Outcome outcome = footprint({cut, "--threads", "2"});
  EXPECT_EQ(outcome.code, 2);
  expect_says(outcome.err, "cut.las: it ends before the 300000 points that its header promises");
}

TEST_F(FootprintCommandTest, ThePointsOfAFileTakeMemory) {
  using polylidar::tool::memory_to_triangulate;
  LasFile las = tile(0);
  las.promised = 1'000'000;
  std::string text = las.text();
  EXPECT_EQ(memory_to_triangulate(file("a.las", text)), 200'000'000U);
  text[104] = static_cast<char>(text[104] | 0x80);
  const std::string laz = file("a.laz", text);
  EXPECT_EQ(memory_to_triangulate(laz), 200'000'000U) << "which is small";
  EXPECT_EQ(polylidar::tool::unpacked_size(laz), 20'000'000U);
  EXPECT_EQ(polylidar::tool::memory_to_stream(laz), (1U << 24U) + 15'000'000U);
  las.minor = 2;
  las.format = 0;
  EXPECT_EQ(memory_to_triangulate(file("old.las", las.text())), 200'000'000U);
  EXPECT_EQ(memory_to_triangulate(file("a.csv", std::string(1000, '7'))), 8'000U);
  EXPECT_EQ(memory_to_triangulate(file("a.csv.gz", std::string(1000, '7'))), 64'000U);
  for (const std::string name : {"a.npy", "a.ply", "a.f64", "a.raw"})
    EXPECT_EQ(memory_to_triangulate(file(name, std::string(1000, '7'))), 25'000U) << name;
  EXPECT_EQ(memory_to_triangulate(file("short.las", "LASF")), 32U);
  EXPECT_EQ(memory_to_triangulate("/nowhere/a.las"), 0U);
  EXPECT_EQ(polylidar::tool::memory_to_stream(file("b.las", std::string(4000, '7'))), (1U << 24U) + 3000U);
}

TEST(MemoryShareTest, WaitsForWhatOthersHave) {
  polylidar::tool::MemoryGate gate(100);
  polylidar::tool::MemoryShare first(gate);
  first.take(1000);  // alone
  std::atomic<bool> has_taken = false;
  std::jthread other([&] {
    polylidar::tool::MemoryShare second(gate);
    second.take(50);
    has_taken = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_FALSE(has_taken);
  first.take(40);
  other.join();
  EXPECT_TRUE(has_taken);
}

TEST_F(FootprintCommandTest, ABrokenFileIsToldAndTheOthersAreDone) {
  const std::string text = tile(0).text();
  const std::vector<std::string> files = {file("short.las", text.substr(0, text.size() / 2)),
                                          file("whole.las", text), "/nowhere/tile.las",
                                          file("bad.csv", "1,2\n3,x\n")};
  const Outcome outcome = footprint(files);
  EXPECT_EQ(outcome.code, 4);
  for (const char* words : {"short.las: it ends before the 8000 points", "there is no file /nowhere/tile.las",
                            "bad.csv, line 2: 'x' is not a number",
                            "polylidar: 1 of 4 files are in the index, 3 could not be read"}) {
    expect_says(outcome.err, words);
  }
  const json index = json::parse(outcome.out);
  ASSERT_EQ(index["features"].size(), 1U);
  EXPECT_EQ("whole.las", index["features"][0]["properties"]["name"].get<std::string>());
}

TEST_F(FootprintCommandTest, WhereNoFileCanBeReadNothingIsWritten) {
  const std::string out = file("index.geojson", "an index from before");
  for (const char* option : {"--detail=1", "--union"}) {
    const Outcome outcome = footprint({"/nowhere/tile.las", folder_.path().string(), option, "-o", out});
    EXPECT_EQ(outcome.code, 2) << option;
    for (const char* words :
         {"there is no file /nowhere/tile.las", "it is a folder; give files, as in FOLDER/*.las",
          "none of the files could be read, so nothing is written"}) {
      expect_says(outcome.err, words);
    }
    EXPECT_EQ(read_text(out), "an index from before");
  }
}

TEST_F(FootprintCommandTest, TheIndexNeverReplacesATile) {
  const std::string text = tile(0).text();
  const std::vector<std::string> files = {file("a.las", text), file("b.las", text)};
  for (const char* option : {"--detail=1", "--union"}) {
    expect_refusal(footprint({files[0], files[1], option, "-o", files[1]}), 2,
                   "would replace the points that are read");
  }
  EXPECT_EQ(read_text(files[1]), text);
}

TEST_F(FootprintCommandTest, PlaneCoordinatesWithoutASystemAreTold) {
  const std::string plane = file("plane.csv", "x,y\n500000,5600000\n500010,5600000\n500000,5600010\n");
  for (const char* option : {"--detail=1", "--union"}) {
    const std::string words = "the points name no coordinate system";
    EXPECT_NE(footprint({plane, option}).err.find(words), std::string::npos) << option;
    EXPECT_EQ(footprint({plane, option, "--crs", "25832"}).err.find(words), std::string::npos) << option;
  }
}

TEST_F(FootprintCommandTest, OtherFormatsAndSystemsAndNothing) {
  LasFile degrees;
  degrees.scale = {1e-7, 1e-7};
  degrees.records = {geographic(4326)};
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    degrees.points.push_back({.x = static_cast<std::int32_t>(100000000 + random() % 1000000),
                              .y = static_cast<std::int32_t>(600000000 + random() % 500000)});
  }
  const Outcome outcome = succeeded(footprint(
      {file("degrees.las", degrees.text()), file("plane.las", tile(1).text()), file("one.csv", "1,2\n")}));
  for (const std::string& words :
       {"different coordinate systems: EPSG:4326 (" + file("degrees.las", degrees.text()) +
            "), EPSG:25832 (" + (folder_.path() / "plane.las").string() + "), none (" +
            (folder_.path() / "one.csv").string() + ")",
        (folder_.path() / "one.csv").string() + " has an empty shape"}) {
    expect_says(outcome.err, words);
  }
  const json index = json::parse(outcome.out);
  EXPECT_FALSE(index.contains("crs"));
  const json& first = index["features"][0]["properties"];
  EXPECT_EQ("EPSG:4326", first["crs"].get<std::string>());
  // 0.1 degrees of longitude at latitude 60 by 0.05 of latitude: both about 5.56 km.
  EXPECT_NEAR(first["area"].get<double>(), 5559.75 * 5559.75, 1e6);
  const json& last = index["features"][2]["properties"];
  EXPECT_TRUE(last["density"].is_null());
  EXPECT_TRUE(last["crs"].is_null());
  EXPECT_EQ(last["area"], 0);
}

TEST_F(FootprintCommandTest, FilesWithoutPointsAreNamed) {
  LasFile nothing = tile(0);
  nothing.points.clear();
  const std::string none = file("none.las", nothing.text());
  const std::string guessed = file("guessed.csv", "Breite,Hoehe\n1,2\n3,4\n3,5\n");
  for (const char* option : {"--threads=1", "--union"}) {
    const Outcome outcome =
        succeeded(footprint({none, file("whole.las", tile(0).text()), guessed, option, "--crs", "none"}));
    expect_says(outcome.err, "none.las has no points\n");
    const Outcome chosen =
        succeeded(footprint({file("whole.las", tile(0).text()), option, "--classes", "9"}));
    expect_says(chosen.err, "whole.las has no points left by --window, --classes and --returns\n");
    expect_says(outcome.err, "guessed.csv: the columns 'Breite' and 'Hoehe' are taken for x and y");
  }
}

TEST_F(FootprintCommandTest, UsageErrors) {
  const std::string whole = file("whole.las", tile(0).text());
  expect_refusal(footprint({}), 2, "FILE is required");
  expect_refusal(footprint({whole, folder_.path().string() + "/./whole.las"}), 2, "whole.las is given twice");
  expect_refusal(footprint({whole, "--union", whole}), 2, "whole.las is given twice");
  expect_refusal(footprint({whole, "-o", (folder_.path() / "index.csv").string()}), 2,
                 "index.csv has the ending of a file of points; name it .geojson, or say with --format");
  expect_refusal(footprint({whole, "-o", (folder_.path() / "index.topojson").string()}), 2,
                 "names no format; name it .geojson, or say with --format");
  expect_refusal(footprint({whole, "-o", (folder_.path() / "index.wkt").string()}), 2,
                 "a footprint has properties, which wkt has no place for");
  expect_refusal(footprint({whole, "--union", "-o", (folder_.path() / "union.svg").string()}), 2,
                 "which svg has no place for");
  expect_refusal(footprint({whole, "--alpha", "1", "--detail", "2"}), 2, "--alpha excludes --detail");
  expect_refusal(footprint({whole, "--cover", "--max-parts", "1"}), 2, "--cover excludes --max-parts");
  expect_refusal(footprint({whole, "--classes", "2,x"}), 2, "--classes '2,x' is no list of numbers");
  expect_refusal(footprint({whole, "--classes", "256"}), 2, "--classes");
  expect_refusal(footprint({whole, "--window", "1,2,3"}), 2, "--window '1,2,3' is no box");
  expect_refusal(footprint({whole, "--window", "3,0,1,9"}), 2, "--window");
  expect_refusal(footprint({whole, "--returns", "second"}), 2, "--returns");
  expect_refusal(footprint({whole, "--crs", "UTM"}), 2, "--crs 'UTM' names no coordinate system");
  expect_refusal(footprint({whole, "--out", "/nowhere/index.geojson"}), 1,
                 "cannot write /nowhere/index.geojson");
}

class FootprintUnionTest : public FootprintCommandTest {
 protected:
  static Outcome unite(const std::vector<std::string>& files, const std::vector<std::string>& options = {}) {
    return footprint(joined(joined(files, {"--union"}), options));
  }
  /// The one feature.
  static json feature_of(const Outcome& outcome) {
    const json index = json::parse(outcome.out);
    EXPECT_EQ(index["features"].size(), 1U);
    return index["features"][0];
  }
  /// What `polylidar hull` makes of all points as one file.
  json hull_of_all(const std::vector<std::string>& options) const {
    const std::string all = file("all.csv", rows(all_, ","));
    return json::parse(run_program(joined({POLYLIDAR, "hull", all}, options)).out);
  }
};

TEST_F(FootprintUnionTest, IsTheHullOfAllPoints) {
  // Few, which are put into memory, and many, which are not.
  for (const int count : {3, 10}) {
    all_.clear();
    const std::vector<std::string> files = tiles(count);
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"--max-perimeter", "9"},
                                               {"--alpha", "2", "--max-parts", "1", "--simplify", "1"},
                                               {"--max-perimeter", "5", "--min-area", "8"}}) {
      const Outcome outcome = succeeded(unite(files, options));
      const json feature = feature_of(outcome);
      const json expected = hull_of_all(options);
      EXPECT_EQ(feature["geometry"], expected["geometry"]);
      for (const char* name : {"points", "parts", "holes", "area"}) {
        EXPECT_EQ(feature["properties"][name], expected["properties"][name]) << name;
      }
    }
  }
}

TEST_F(FootprintUnionTest, TilesThatTouchAreOnePartWithoutALimitToo) {
  const Outcome outcome = succeeded(unite(tiles(10)));
  expect_says(outcome.err, "chosen from the points");
  expect_says(outcome.err, "polylidar: 10 of 10 files are in the union\n");
  EXPECT_EQ("urn:ogc:def:crs:EPSG::25832",
            json::parse(outcome.out)["crs"]["properties"]["name"].get<std::string>());
  const json properties = feature_of(outcome)["properties"];
  EXPECT_EQ(properties["files"], 10);
  EXPECT_EQ(properties["points"], 80000);
  EXPECT_EQ(properties["parts"], 1);
  EXPECT_EQ(properties["holes"], 10);
  EXPECT_EQ(properties["classes"], (json{{"2", 60000}, {"6", 20000}}));
  const double true_area = 10 * (1e4 - 3.14159 * 400);
  EXPECT_NEAR(properties["area"].get<double>(), true_area, 0.02 * true_area);
  EXPECT_NEAR(properties["density"].get<double>(), 80000 / true_area, 0.03);
  EXPECT_NEAR(properties["bounds"][2].get<double>(), 501000, 0.2);
  EXPECT_EQ("EPSG:25832", properties["crs"].get<std::string>());
  EXPECT_FALSE(properties.contains("name"));
}

TEST_F(FootprintUnionTest, ABrokenFileIsToldAndTheOthersAreOne) {
  std::vector<std::string> files = tiles(3);
  const std::string broken = tile(1).text();
  write_text(files[1], broken.substr(0, broken.size() - 100));
  files.push_back(file("bad.csv", "1,2\n3,x\n"));
  for (const std::vector<std::string>& options : {std::vector<std::string>{}, {"--max-perimeter", "9"}}) {
    const Outcome outcome = unite(files, options);
    EXPECT_EQ(outcome.code, 4);
    for (const char* words :
         {"tile_1.las: it ends before the 8000 points", "bad.csv, line 2: 'x' is not a number",
          "2 of 4 files are in the union, 2 could not be read"}) {
      expect_says(outcome.err, words);
    }
    const json properties = feature_of(outcome)["properties"];
    EXPECT_EQ(properties["files"], 2);
    EXPECT_EQ(properties["points"], 16000);
    EXPECT_EQ(properties["parts"], 2) << "the tile between them is missing";
  }
}

TEST_F(FootprintUnionTest, AFewPointsFarApartDoNotDecideForAll) {
  std::vector<std::string> files = tiles(4);
  files.push_back(file("few.csv", "500000,5600300\n500070,5600310\n500010,5600390\n500090,5600380\n"));
  const Outcome outcome = succeeded(unite(files, {"--crs", "25832"}));
  EXPECT_EQ(feature_of(outcome)["properties"]["holes"], 4);
  EXPECT_LT(feature_of(outcome)["properties"]["most_size"].get<double>(), 10) << outcome.err;
}

TEST_F(FootprintUnionTest, OneLimitForAllWhereAllPointsDoNotFitIntoMemory) {
  // Clusters, whose sizes only the triangulation of all points tells.
  const auto clusters = [](int column) {
    LasFile las = tile(column);
    for (std::size_t i = 0; i < las.points.size(); ++i) {
      las.points[i].x = las.points[i / 10 * 10].x + las.points[i].x / 300;
      las.points[i].y = las.points[i / 10 * 10].y + las.points[i].y / 300;
    }
    return las;
  };
  std::vector<std::string> files;
  std::vector<std::string> alike;
  for (int column = 0; column < 10; ++column) {
    files.push_back(file("clusters_" + std::to_string(column) + ".las", clusters(column).text()));
    // Nearly the same points elsewhere, without ties: the sizes of the files are the same in four digits.
    LasFile same = clusters(0);
    std::mt19937 random(7);
    for (LasPoint& p : same.points) {
      p.x = 1000 * p.x + static_cast<std::int32_t>(random() % 1000);
      p.y = 1000 * p.y + static_cast<std::int32_t>(random() % 1000);
    }
    same.offset.x += 100 * column;
    same.scale.x = same.scale.y = 1e-5 * (1 + 1e-8 * column);
    alike.push_back(file("alike_" + std::to_string(column) + ".las", same.text()));
  }
  const std::string few = file("few.csv", "500000,5600300\n500070,5600310\n500010,5600390\n500090,5600380\n");
  files.push_back(few);
  const json whole = feature_of(succeeded(unite(files, {"--crs", "25832"})))["properties"];
  EXPECT_TRUE(whole.contains("most_size"));
  const Outcome outcome = succeeded(unite(files, {"--crs", "25832", "--memory", "15"}));
  expect_says(outcome.err, "each file alone would get");
  const json properties = feature_of(outcome)["properties"];
  EXPECT_LT(properties["alpha"].get<double>(), 60) << "the few points do not decide";
  EXPECT_GT(properties["area"].get<double>(), 0);
  const std::string said = succeeded(unite(alike, {"--memory", "15"})).err;
  const std::size_t sizes = said.find("each file alone would get triangles of size ");
  ASSERT_NE(sizes, std::string::npos) << said;
  EXPECT_FALSE(contains(said.substr(sizes, said.find(')', sizes) - sizes), " to ")) << said;
  expect_end(unite(files, {"--crs", "25832", "--memory", "1"}), 2,
             "has 8000 points, too many for a limit to be chosen; give --alpha");
}

TEST_F(FootprintUnionTest, NoLimitIsChosenFromFilesWithoutTriangles) {
  // Each file is a line of points, and there are more than fit into the memory.
  std::vector<std::string> lines;
  for (const int y : {0, 1000, 2000, 3000}) {
    Points line;
    for (int x = 0; x < 5000; ++x) line.push_back({static_cast<double>(x), static_cast<double>(y)});
    for (int twice = 0; twice < 4; ++twice) {
      lines.push_back(file("line_" + std::to_string(y + twice) + ".csv", rows(line, ",")));
    }
  }
  expect_end(unite(lines, {"--crs", "25832", "--memory", "1"}), 2,
             "no file has a triangle of its own to choose a limit from; give --alpha");
}

TEST_F(FootprintUnionTest, DegreesAreMetresAndStayAsTheyAre) {
  std::vector<std::string> files;
  std::mt19937 random(3);
  for (int column = 0; column < 2; ++column) {
    LasFile degrees;
    degrees.scale = {1e-7, 1e-7};
    degrees.offset = {10 + 0.1 * column, 60};
    degrees.records = {geographic(4326)};
    for (int i = 0; i < 40000; ++i) {
      degrees.points.push_back({.x = static_cast<std::int32_t>(random() % 1000000),
                                .y = static_cast<std::int32_t>(random() % 500000)});
    }
    for (const Point& p : degrees.places()) all_.push_back(p);
    files.push_back(file("degrees_" + std::to_string(column) + ".las", degrees.text()));
  }
  const json feature = feature_of(unite(files, {"--max-edge-length", "150"}));
  const json expected = hull_of_all({"--max-edge-length", "150", "--crs", "EPSG:4326"});
  EXPECT_EQ(feature["geometry"], expected["geometry"]);
  EXPECT_EQ(feature["properties"]["area"], expected["properties"]["area"]);
  EXPECT_NEAR(feature["properties"]["area"].get<double>(), 2 * 5559.75 * 5559.75, 1e6);
}

TEST_F(FootprintUnionTest, FilesOfAnyFormat) {
  const std::vector<std::string> files = tiles(4);
  std::vector<std::string> others;
  const auto part = [&](std::size_t k) {
    return Points(all_.begin() + static_cast<std::ptrdiff_t>(k * 8000),
                  all_.begin() + static_cast<std::ptrdiff_t>((k + 1) * 8000));
  };
  others.push_back(file("0.csv", rows(part(0), ",")));
  others.push_back(file("1.geojson", geojson_multipoint(part(1))));
  others.push_back(file("2.npy", npy_of<double>(part(2), "<f8")));
  others.push_back(file("3.wkt", "MULTIPOINT (" + listed(part(3), "", " ", "") + ")"));
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{"--crs", "25832"}, {"--crs", "25832", "--max-perimeter", "9"}}) {
    EXPECT_EQ(feature_of(unite(others, options))["geometry"], feature_of(unite(files, options))["geometry"]);
  }
}

TEST_F(FootprintUnionTest, NothingAndWrongUsage) {
  const std::vector<std::string> files = tiles(2);
  const Outcome nothing = unite({file("one.csv", "1,2\n"), "/nowhere/tile.las"});
  EXPECT_EQ(nothing.code, 4);
  EXPECT_EQ(feature_of(nothing)["properties"]["points"], 1);
  EXPECT_EQ(feature_of(nothing)["properties"]["parts"], 0);
  EXPECT_TRUE(feature_of(unite({file("none.csv", "x,y\n")}))["properties"]["bounds"].is_null());
  expect_refusal(unite(files, {"--one"}), 2, "--union does not go with --one, --cover and --min-triangles");
  expect_refusal(unite({files[0], file("degrees.csv", "lon,lat\n1,2\n1,3\n2,2\n")}), 2,
                 "the files have different coordinate systems");
  const std::vector<std::string> many = tiles(10);
  expect_end(unite(many, {"--alpha", "1e-9"}), 2, "the union: the limit is too small");
  succeeded(unite(many, {"--alpha", "0.2"}));
  expect_end(unite(many, {"--alpha", "0.2", "--memory", "1"}), 2, "the union: the limit is too small");
  expect_refusal(unite({"-"}), 2, "--union does not go with standard input, which can be read once only");
  expect_refusal(unite(files, {"-o", "/nowhere/union.geojson"}), 1, "cannot write /nowhere/union.geojson");
}

#ifndef HAS_GDAL
TEST_F(FootprintCommandTest, ABuildWithoutGdalSaysHowToGetIt) {
  const std::string points = file("points.csv", "0,0\n2,0\n0,2\n");
  const auto hull = [](const std::vector<std::string>& arguments) {
    return run_program(joined({POLYLIDAR, "hull"}, arguments));
  };
  for (const std::string input : {"points.gpkg", "points.shp", "PG:dbname=gis"}) {
    expect_refusal(hull({input}), 2, input + ": it is read by GDAL, which this build is without");
  }
  expect_refusal(hull({points, "--input", "gdal"}), 2, "-DPOLYLIDAR_WITH_GDAL=ON");
  expect_refusal(hull({points, "-o", "out.gpkg"}), 2, "out.gpkg: it is written by GDAL");
  expect_refusal(hull({points, "-o", "out", "--format", "gdal:GPKG"}), 2, "-DPOLYLIDAR_WITH_GDAL=ON");
  expect_end(footprint({"points.gpkg", file("tile.las", tile(0).text())}), 4,
             "points.gpkg: it is read by GDAL");
}
#endif

TEST_F(FootprintCommandTest, LazIsAsLas) {
  const std::string las = tile(2).text();
  const std::string unpacked = file("tile.las", las);
  const std::string laz = file("tile.laz", compressed(las, {.chunk_size = 700}));
  const auto out = [](const std::string& command, const std::string& path,
                      const std::vector<std::string>& options) {
    std::string text = succeeded(run_program(joined({POLYLIDAR, command, path}, options))).out;
    for (std::size_t at = 0; (at = text.find("tile.laz", at)) != std::string::npos;) text[at + 7] = 's';
    return text;
  };
  const auto expect_same = [&](const std::string& command, const std::vector<std::string>& options) {
    EXPECT_EQ(out(command, laz, options), out(command, unpacked, options)) << command;
  };
  expect_same("footprint", {});
  expect_same("footprint", {"--union"});
  expect_same("hull", {});
  expect_same("hull", {"--by", "classification"});
  expect_same("hull", {"--stream", "--max-perimeter", "4"});
}

}  // namespace
}  // namespace hullbench::testing
