// `polylidar footprint`: an index of files as its users meet it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/las_file.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::expect_refusal;
using testing::LasFile;
using testing::Outcome;
using testing::write_text;

/// A tile of 100 m with points everywhere but in its lake.
LasFile tile(int column) {
  LasFile file;
  file.minor = 4;
  file.format = 6;
  file.offset = {500000.0 + 100 * column, 5600000};
  std::mt19937 random(static_cast<unsigned>(column));
  while (file.points.size() < 8000) {
    const auto x = static_cast<std::int32_t>(random() % 10000);
    const auto y = static_cast<std::int32_t>(random() % 10000);
    if (std::hypot(x - 5000, y - 5000) < 2000) continue;
    file.points.push_back({.x = x, .y = y, .classification = file.points.size() % 4 == 0 ? 6U : 2U});
  }
  file.records = {testing::projected(25832)};
  return file;
}

class FootprintCommandTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    write_text(folder_.path() / name, text);
    return (folder_.path() / name).string();
  }
  static Outcome footprint(std::vector<std::string> arguments, const testing::ProgramOptions& options = {}) {
    arguments.insert(arguments.begin(), {POLYLIDAR, "footprint"});
    return testing::run_program(arguments, options);
  }

  testing::TemporaryFolder folder_;
};

TEST_F(FootprintCommandTest, AFeatureForEveryFile) {
  std::vector<std::string> files;
  files.reserve(5);
  for (int column = 0; column < 5; ++column) {
    files.push_back(file("tile_" + std::to_string(column) + ".las", tile(column).text()));
  }
  const std::string out = (folder_.path() / "index.geojson").string();
  std::vector<std::string> arguments = files;
  arguments.insert(arguments.end(), {"-o", out});
  const Outcome outcome = footprint(arguments);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "polylidar: 5 of 5 files are in the index\n");
  EXPECT_EQ(outcome.out, "");
  const json index = json::parse(testing::read_text(out));
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
  arguments.insert(arguments.end(), {"--threads", "1"});
  const std::string first = testing::read_text(out);
  EXPECT_EQ(footprint(arguments).code, 0);
  EXPECT_EQ(testing::read_text(out), first);
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
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words << " in " << outcome.err;
  }
  const json index = json::parse(outcome.out);
  ASSERT_EQ(index["features"].size(), 1U);
  EXPECT_EQ("whole.las", index["features"][0]["properties"]["name"].get<std::string>());
}

TEST_F(FootprintCommandTest, OtherFormatsAndSystemsAndNothing) {
  LasFile degrees;
  degrees.scale = {1e-7, 1e-7};
  degrees.records = {testing::geographic(4326)};
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    degrees.points.push_back({.x = static_cast<std::int32_t>(100000000 + random() % 1000000),
                              .y = static_cast<std::int32_t>(600000000 + random() % 500000)});
  }
  const Outcome outcome = footprint(
      {file("degrees.las", degrees.text()), file("plane.las", tile(1).text()), file("one.csv", "1,2\n")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_NE(outcome.err.find("different coordinate systems"), std::string::npos) << outcome.err;
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

TEST_F(FootprintCommandTest, UsageErrors) {
  const std::string whole = file("whole.las", tile(0).text());
  expect_refusal(footprint({}), 2, "FILE is required");
  expect_refusal(footprint({whole, "--classes", "2,x"}), 2, "--classes '2,x' is no list of numbers");
  expect_refusal(footprint({whole, "--classes", "256"}), 2, "--classes");
  expect_refusal(footprint({whole, "--window", "1,2,3"}), 2, "--window '1,2,3' is no box");
  expect_refusal(footprint({whole, "--window", "3,0,1,9"}), 2, "--window");
  expect_refusal(footprint({whole, "--returns", "second"}), 2, "--returns");
  expect_refusal(footprint({whole, "--crs", "UTM"}), 2, "--crs 'UTM' names no coordinate system");
  expect_refusal(footprint({whole, "--out", "/nowhere/index.geojson"}), 1,
                 "cannot write /nowhere/index.geojson");
}

/// A program that unpacks LAZ as laszip does: here it turns back what the test did to a LAS file.
TEST_F(FootprintCommandTest, LazGoesThroughAProgramInThePath) {
  const LasFile las = tile(2);
  std::string packed = las.text();
  packed[104] = static_cast<char>(packed[104] | 0x80);
  const std::string laz = file("tile.laz", packed);
  file("unpacked.las", las.text());
  const fs::path tools = folder_.path() / "tools";
  fs::create_directory(tools);
  const auto with_program = [&](const std::string& script) {
    write_text(tools / "laszip", "#!/bin/sh\n" + script + "\n");
    fs::permissions(tools / "laszip", fs::perms::owner_all);
    testing::ProgramOptions options;
    options.environment["PATH"] = tools.string() + ":/usr/bin:/bin";
    return footprint({laz}, options);
  };
  const Outcome good = with_program(
      R"([ "$1" = -i ] && [ "$3" = -stdout ] && [ "$4" = -olas ] && cat "$(dirname "$2")/unpacked.las")");
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_EQ(json::parse(good.out)["features"][0]["properties"]["points"], 8000);
  for (const char* script :
       {"exit 1", R"(head -c 5000 "$2"; exit 1)", R"(cat "$(dirname "$2")/unpacked.las"; exit 3)"}) {
    const Outcome bad = with_program(script);
    EXPECT_EQ(bad.code, 4);
    EXPECT_NE(bad.err.find("laszip could not unpack it"), std::string::npos) << bad.err;
  }
}

}  // namespace
}  // namespace hullbench
