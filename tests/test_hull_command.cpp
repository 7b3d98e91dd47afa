// `polylidar hull` as its users meet it: the same polygons in every format, options, exit codes,
// circumstances.
#include <geos_c.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>
#include <thread>

#include "adapters/wkb.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/validity.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/complaint.hpp"
#include "tests/las_file.hpp"
#include "tests/point_file_texts.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"
#include "tool/commands/commands.hpp"
#include "tool/points/point_file.hpp"
#include "tool/program/result_output.hpp"

namespace hullbench::testing {
namespace {

/// A square with a hole, and a few points far off.
Points ring_and_island() {
  Points points = square_without_a_disc(3000, 7);
  for (const Point& p : {Point{20, 0}, Point{20.2, 0}, Point{20, 0.2}, Point{20.21, 0.21}})
    points.push_back(p);
  return points;
}

class HullCommandTest : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    write_text(folder() / name, text);
    return (folder() / name).string();
  }
  std::string points_file() const { return file("points.npy", npy_of<double>(points_, "<f8")); }

  static Outcome hull(const std::vector<std::string>& arguments) {
    return run_program(joined({POLYLIDAR, "hull"}, arguments));
  }
  /// The same through the shell, after `before` and followed by `after`.
  static Outcome in_shell(const std::string& before, const std::string& arguments,
                          const std::string& after = "") {
    return run_program({"/bin/sh", "-c", before + " '" + POLYLIDAR + "' hull " + arguments + " " + after});
  }
  MultiPolygon shape(const std::vector<std::string>& options) const {
    return shape_of(hull(joined({points_file(), "--format", "wkb"}, options)));
  }
  static MultiPolygon shape_of(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return from_wkb({reinterpret_cast<const std::uint8_t*>(outcome.out.data()), outcome.out.size()});
  }
  MultiPolygon expected(double alpha, double max_edge = std::numeric_limits<double>::infinity()) const {
    polylidar::Options options;
    options.alpha = alpha;
    options.max_edge_length = max_edge;
    return to_coordinates(polylidar::concave_hull(points_, options), points_);
  }
  fs::path folder() const { return folder_.path(); }
  std::string make_pipe() const {
    std::string path = (folder() / "pipe").string();
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path;
  }

  Points points_ = ring_and_island();

 private:
  TemporaryFolder folder_;
};

std::string four_digits(double value) {
  std::ostringstream text;
  text << std::setprecision(4) << value;
  return text.str();
}

MultiPolygon from_geojson(const json& coordinates) {
  MultiPolygon shape;
  for (const json& polygon : coordinates) {
    std::vector<Ring> rings;
    for (const json& ring : polygon) {
      EXPECT_EQ(ring.front(), ring.back());
      rings.emplace_back();
      for (const json& position : ring)
        rings.back().push_back({position[0].get<double>(), position[1].get<double>()});
      rings.back().pop_back();
    }
    shape.push_back({rings.front(), {rings.begin() + 1, rings.end()}});
  }
  return shape;
}

TEST_F(HullCommandTest, OfOutlinesSaysThatTheyAreFilled) {
  points_.clear();
  constexpr int kCount = 500;
  for (int i = 0; i < kCount; ++i) {
    const double angle = 2 * 3.14159265 * i / kCount;
    points_.push_back({std::cos(angle) + 0.001 * (i % 3), std::sin(angle)});
  }
  const Outcome outcome = succeeded(hull({points_file()}));
  expect_says(outcome.err, "the points lie on outlines only");
  const json properties = json::parse(outcome.out)["properties"];
  EXPECT_FALSE(properties.contains("least_size"));
  EXPECT_NEAR(properties["area"].get<double>(), 3.14, 0.05);
}

TEST_F(HullCommandTest, TheCoresPolygonsInEveryFormat) {
  const MultiPolygon right = expected(0.3);
  ASSERT_EQ(right.size(), 2U);
  ASSERT_GE(right[0].holes.size() + right[1].holes.size(), 1U);
  EXPECT_EQ(shape({"--alpha", "0.3"}), right);
  EXPECT_EQ(shape({"--alpha", "0.3", "--threads", "3"}), right);
  EXPECT_EQ(shape({"--alpha", "0.3", "--max-edge-length", "0.4"}), expected(0.3, 0.4));
  EXPECT_EQ(shape({"--max-edge-length", "0.4"}), expected(std::numeric_limits<double>::infinity(), 0.4));

  const Outcome geojson = hull({points_file(), "--alpha", "0.3"});
  EXPECT_EQ(geojson.err, "");
  const json feature = json::parse(geojson.out);
  EXPECT_EQ(feature["type"], "Feature");
  EXPECT_EQ(feature["geometry"]["type"], "MultiPolygon");
  EXPECT_EQ(from_geojson(feature["geometry"]["coordinates"]), right);
  for (const auto& polygon : right) {
    EXPECT_GT(signed_area(polygon.shell), 0);
    for (const Ring& hole : polygon.holes) EXPECT_LT(signed_area(hole), 0);
  }
  EXPECT_EQ(feature["properties"], (json{{"points", points_.size()},
                                         {"alpha", 0.3},
                                         {"parts", 2},
                                         {"holes", right[0].holes.size() + right[1].holes.size()},
                                         {"area", area(right)}}));

  const Outcome wkt = hull({points_file(), "--alpha", "0.3", "--format", "wkt"});
  GEOSContextHandle_t geos = GEOS_init_r();
  GEOSWKTReader* reader = GEOSWKTReader_create_r(geos);
  GEOSGeometry* geometry = GEOSWKTReader_read_r(geos, reader, wkt.out.c_str());
  ASSERT_NE(geometry, nullptr);
  std::size_t size = 0;
  unsigned char* bytes = GEOSGeomToWKB_buf_r(geos, geometry, &size);
  EXPECT_EQ(from_wkb({bytes, size}), right);
  GEOSFree_r(geos, bytes);
  GEOSGeom_destroy_r(geos, geometry);
  GEOSWKTReader_destroy_r(geos, reader);
  GEOS_finish_r(geos);
}

TEST_F(HullCommandTest, SvgHasPathsDotsAndATitle) {
  const std::string svg = hull({points_file(), "--alpha", "0.3", "--format", "svg"}).out;
  for (const char* word : {"<svg xmlns=", "viewBox=\"0 0 1040.00 ",
                           "<title>2 polygons round 3004 points</title>", "evenodd", "<circle "}) {
    EXPECT_NE(svg.find(word), std::string::npos) << word;
  }
  // The lowest point is at the bottom: 20 from the side, and the lower of the two.
  const std::string corner =
      hull({file("three.csv", "0,0\n10,0\n0,5\n"), "--alpha", "100", "--format", "svg"}).out;
  expect_says(corner, R"(cx="20.00" cy="520.00")");
  expect_says(corner, R"(cx="20.00" cy="20.00")");
}

TEST_F(HullCommandTest, EveryInputFormatGivesTheSameBytes) {
  // GeoJSON, and columns of that name, are longitudes and latitudes.
  const std::string first = hull({points_file(), "--crs", "none"}).out;
  for (const auto& form : all_forms(points_)) {
    const std::string path = file(form.name, form.text);
    EXPECT_EQ(hull({path, "--crs", "none"}).out, first) << form.name;
    EXPECT_EQ(in_shell("", "- --crs none < '" + path + "'").out, first)
        << form.name << " from a file as standard input";
    EXPECT_EQ(in_shell("cat '" + path + "' |", "- --crs none").out, first) << form.name << " from a pipe";
  }
}

TEST_F(HullCommandTest, ChoosesALimitAndSaysIt) {
  const Outcome outcome = hull({points_file()});
  const json properties = json::parse(outcome.out)["properties"];
  const double least = properties["least_size"];
  const double most = properties["most_size"];
  EXPECT_LE(least, properties["median_size"]);
  EXPECT_LE(properties["median_size"], most);
  EXPECT_FALSE(properties.contains("alpha") || properties.contains("max_edge_length") ||
               properties.contains("max_perimeter"));
  for (const std::string& words :
       {four_digits(least), four_digits(most), std::string("chosen from the points")}) {
    expect_says(outcome.err, words);
  }
  EXPECT_EQ(from_geojson(json::parse(outcome.out)["geometry"]["coordinates"]),
            to_coordinates(polylidar::concave_hull(points_), points_));
  EXPECT_EQ(hull({points_file(), "--max-perimeter", "1"}).err, "");
}

TEST_F(HullCommandTest, DetailScalesTheChosenSize) {
  const auto median_size = [&](const char* detail) -> double {
    return json::parse(hull({points_file(), "--detail", detail}).out)["properties"]["median_size"];
  };
  EXPECT_DOUBLE_EQ(median_size("2"), median_size("1") / 2);
  EXPECT_EQ(hull({points_file(), "--detail", "0"}).code, 2);
}

TEST_F(HullCommandTest, FewPointsGiveTheEmptyGeometry) {
  for (const std::string text : {"1,2\n", "1,2\n3,4\n", "1,2\n1,2\n3,4\n1,2\n", "0,0\n1,1\n2,2\n"}) {
    const std::string path = file("few.csv", text);
    const Outcome geojson = hull({path});
    EXPECT_EQ(geojson.code, 0) << text;
    EXPECT_EQ(json::parse(geojson.out)["geometry"]["coordinates"], json::array());
    expect_says(geojson.err, "no three distinct points");
    EXPECT_EQ(hull({path, "--format", "wkt"}).out, "MULTIPOLYGON EMPTY\n");
    EXPECT_TRUE(shape_of(hull({path, "--format", "wkb", "--simplify", "1"})).empty());
    EXPECT_EQ(hull({path, "--format", "svg"}).code, 0);
  }
  const std::string none = file("none.csv", "x,y\n");
  EXPECT_EQ(hull({none, "--format", "wkt"}).out, "MULTIPOLYGON EMPTY\n");
  expect_end(hull({none}), 0, "none.csv: it has no points, so there is no shape");
  expect_end(hull({none, "--by", "x"}), 0, "none.csv: it has no points, so there is no shape");
  expect_end(hull({points_file(), "--window", "500,500,501,501"}), 0,
             "no point is left by --window, --classes and --returns");
  expect_end(hull({points_file(), "--alpha", "0"}), 0, "no triangle of the points is kept");
}

TEST_F(HullCommandTest, SmallPartsAreDropped) {
  const MultiPolygon whole = expected(0.3);
  EXPECT_EQ(shape({"--alpha", "0.3", "--min-area", "0.01"}).size(), 2U);
  const MultiPolygon large = shape({"--alpha", "0.3", "--min-area", "0.5"});
  ASSERT_EQ(large.size(), 1U);
  ASSERT_EQ(large[0].holes.size(), 1U) << "the disc";
  EXPECT_GT(-signed_area(large[0].holes[0]), 10);
  const MultiPolygon filled = shape({"--alpha", "0.3", "--min-area", "40"});
  ASSERT_EQ(filled.size(), 1U);
  EXPECT_TRUE(filled[0].holes.empty());
  EXPECT_TRUE(shape({"--alpha", "0.3", "--min-area", "1000"}).empty());
  expect_end(hull({points_file(), "--alpha", "0.3", "--min-area", "1000"}), 0,
             "no polygon is left by --min-area and --min-triangles");
  // The island has two triangles.
  EXPECT_EQ(shape({"--alpha", "0.3", "--min-triangles", "2"}), whole);
  EXPECT_EQ(shape({"--alpha", "0.3", "--min-triangles", "3"}).size(), 1U);
  EXPECT_TRUE(shape({"--alpha", "0.3", "--min-triangles", "100000"}).empty());
}

TEST_F(HullCommandTest, SimplifyLeavesOutVerticesAndKeepsTheTopology) {
  const MultiPolygon whole = expected(0.3);
  const MultiPolygon simple = shape({"--alpha", "0.3", "--simplify", "0.2"});
  EXPECT_LT(vertex_count(simple), vertex_count(whole) / 2);
  ASSERT_EQ(simple.size(), whole.size());
  for (std::size_t p = 0; p < whole.size(); ++p) EXPECT_EQ(simple[p].holes.size(), whole[p].holes.size());
  EXPECT_EQ(metrics::invalid_reason(simple), "");
  EXPECT_NEAR(area(simple), area(whole), 0.05 * area(whole));
  EXPECT_EQ(shape({"--alpha", "0.3", "--simplify", "0"}), whole);
}

TEST_F(HullCommandTest, OutIsWrittenWholeOrNotAtAll) {
  const std::string out = (folder() / "hull.geojson").string();
  const std::string printed = hull({points_file()}).out;
  const Outcome written = succeeded(hull({points_file(), "--out", out}));
  EXPECT_EQ(written.out, "");
  EXPECT_EQ(read_text(out), printed);
  expect_refusal(hull({file("bad.csv", "1,2\n3,x\n"), "--out", out}), 2, "line 2");
  EXPECT_EQ(read_text(out), printed);
  fs::create_symlink(out, folder() / "link");
  EXPECT_EQ(hull({points_file(), "--format", "wkt", "--out", (folder() / "link").string()}).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder() / "link"));
  EXPECT_TRUE(read_text(out).starts_with("MULTIPOLYGON"));
  for (const auto& entry : fs::directory_iterator(folder())) {
    EXPECT_EQ(entry.path().string().find("unfinished"), std::string::npos) << entry.path();
  }
}

TEST_F(HullCommandTest, AReplacedFileKeepsItsMode) {
  const std::string out = file("private.geojson", "old");
  fs::permissions(out, fs::perms::owner_read | fs::perms::owner_write);
  succeeded(hull({points_file(), "--out", out}));
  EXPECT_TRUE(read_text(out).starts_with("{"));
  EXPECT_EQ(fs::status(out).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  fs::permissions(out, fs::perms::owner_read);
  ProgramOptions options;
  options.obey_permissions = true;
  expect_refusal(run_program({POLYLIDAR, "hull", points_file(), "--out", out}, options), 1,
                 "cannot write " + out + ": Permission denied");
}

TEST_F(HullCommandTest, AResultWhoseModeCannotBeSetLeavesNothing) {
  namespace tool = polylidar::tool;
  // A file that can be written and has a mode of its own, as all have on a file system without modes.
  const fs::path without_modes = "/proc/self/comm";
  const fs::path target = file("result.geojson", "old");
  const fs::path unfinished = tool::unfinished_path(target);
  fs::create_symlink(without_modes, unfinished);
  fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write);
  expect_complaint([&] { const tool::ResultOutput output(target); }, "cannot write " + target.string());
  EXPECT_FALSE(fs::is_symlink(unfinished));
  EXPECT_EQ(read_text(target), "old");
  // Nothing has to be set if it is the right one.
  fs::create_symlink(without_modes, unfinished);
  fs::permissions(target, fs::status(without_modes).permissions());
  EXPECT_NO_THROW(const tool::ResultOutput output(target));
}

TEST_F(HullCommandTest, OutMayBeAPipeOrADescriptor) {
  const std::string points = "'" + points_file() + "'";
  const std::string printed = hull({points_file()}).out;
  EXPECT_EQ(in_shell("", points + " -o /dev/stdout", "| cat").out, printed);
  EXPECT_EQ(in_shell("", points + " -o /dev/fd/3", "3>&1 | cat").out, printed);
  const std::string log = file("all.geojson", "first\n");
  in_shell("", points + " -o /dev/stdout", ">> '" + log + "'");
  EXPECT_EQ(read_text(log), "first\n" + printed);
}

TEST_F(HullCommandTest, NamesMayBeAsLongAsTheSystemHasThem) {
  const std::string ending = ".geojson";
  const std::string longest = (folder() / (std::string(255 - ending.size(), 'a') + ending)).string();
  succeeded(hull({points_file(), "-o", longest}));
  EXPECT_EQ(read_text(longest), hull({points_file()}).out);
  const std::string longer = (folder() / (std::string(256, 'a') + ending)).string();
  expect_refusal(hull({file("bad.csv", "x"), "-o", longer}), 1, "File name too long");  // before it is read
}

TEST_F(HullCommandTest, TheFormatOfASlowPipeIsThatOfItsFirstRow) {
  const std::string wkt = file("points.wkt", "MULTIPOINT (0 0, 1 0, 0 1)\n");
  const std::string expected = hull({wkt}).out;
  EXPECT_EQ(in_shell("(echo '# a'; sleep 0.3; cat '" + wkt + "') |", "-").out, expected);
  EXPECT_EQ(in_shell("(printf MULTI; sleep 0.3; printf 'POINT (0 0, 1 0, 0 1)') |", "-").out, expected);
}

TEST_F(HullCommandTest, TheCoordinateSystemBehindThePointsOfALasFileIsReadFromAPipeToo) {
  LasFile las{.minor = 4, .format = 6};
  for (int i = 0; i < 1000; ++i) las.points.push_back({.x = i % 32, .y = i / 32});
  las.extended_records = {{"other", 1, std::string(3000, 'x')},
                          {"LASF_Projection", 2112, R"(PROJCS["a",AUTHORITY["EPSG","32633"]])"}};
  const std::string tile = file("tile.las", las.text());
  const std::string expected = hull({tile}).out;
  EXPECT_NE(expected.find("EPSG::32633"), std::string::npos);
  EXPECT_EQ(in_shell("cat '" + tile + "' |", "-").out, expected);
  EXPECT_EQ(in_shell("gzip '" + tile + "';", "'" + tile + ".gz'").out, expected);
}

TEST_F(HullCommandTest, ALinkToNothingBecomesTheLinkOfAFile) {
  fs::create_symlink("there.wkt", folder() / "link.wkt");
  succeeded(hull({points_file(), "--out", (folder() / "link.wkt").string()}));
  EXPECT_TRUE(fs::is_symlink(folder() / "link.wkt"));
  EXPECT_TRUE(read_text(folder() / "there.wkt").starts_with("MULTIPOLYGON"));
}

TEST_F(HullCommandTest, TheEndingSaysTheFormatOrNothing) {
  EXPECT_EQ(hull({points_file(), "--out", "-"}).out, hull({points_file()}).out);
  for (const std::string name : {"hull.geojson.gz", "hull.topojson"}) {
    const std::string out = (folder() / name).string();
    expect_refusal(hull({points_file(), "--stream", "--out", out}), 2,
                   "names no format; name it .geojson, .wkt or .wkb, or say with --format");
    expect_refusal(hull({points_file(), "--out", out}), 2,
                   "names no format; name it .geojson, .wkt, .wkb or .svg");
    EXPECT_EQ(hull({points_file(), "--format", "wkt", "--out", out}).code, 0);
  }
}

TEST_F(HullCommandTest, WhatGdalWritesIsNotStandardOutput) {
  for (const std::string out : {"-", "/dev/stdout"}) {
    expect_refusal(hull({points_file(), "--format", "gdal:GPKG", "--out", out}), 2,
                   "--format gdal:GPKG needs a file or a database; give it by --out");
  }
}

TEST_F(HullCommandTest, OutputThatCannotBeWritten) {
  expect_refusal(hull({points_file(), "--alpha", "1", "--out", "/nowhere/hull.json"}), 1,
                 "cannot write /nowhere/hull.json");
  expect_refusal(hull({points_file(), "--alpha", "1", "--out", folder().string()}), 1, "Is a directory");
  expect_refusal(hull({points_file(), "--alpha", "1", "--out", "/dev/full"}), 1, "No space left");
  EXPECT_EQ(hull({points_file(), "--alpha", "1", "--out", "/dev/null"}).code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_directory(folder() / "sealed");
  fs::permissions(folder() / "sealed", fs::perms::owner_read);
  const std::string sealed = (folder() / "sealed" / "hull.json").string();
  ProgramOptions options;
  options.obey_permissions = true;
  expect_refusal(run_program({POLYLIDAR, "hull", points_file(), "--alpha", "1", "--out", sealed}, options), 1,
                 "cannot write " + sealed + ": Permission denied");
  fs::permissions(folder() / "sealed", fs::perms::owner_all);
  expect_refusal(in_shell("", "'" + points_file() + "' --alpha 1", "> /dev/full"), 1,
                 "cannot write standard output: No space");
  // Nobody reads from the pipe any more when the result comes.
  const std::string pipe = "'" + make_pipe() + "'";
  expect_refusal(
      in_shell("exec 4<> " + pipe + " 3> " + pipe + " 4<&-;", "'" + points_file() + "' --alpha 1", ">&3"), 1,
      "Broken pipe");
}

TEST_F(HullCommandTest, HullbenchHullIsTheSameUnderItsOldName) {
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, {"--alpha", "0.3", "--simplify", "0.1"}, {"--alpha", "0"}, {"--help"}}) {
    std::vector<std::string> command = joined({HULLBENCH, "hull", points_file()}, options);
    const Outcome old = run_program(command);
    command[0] = POLYLIDAR;
    const Outcome current = run_program(command);
    EXPECT_EQ(old.code, current.code);
    if (options == std::vector<std::string>{"--help"}) {
      expect_says(old.out, "\nExample: hullbench hull ");
      expect_says(current.out, "\nExample: polylidar hull ");
      const auto options_of = [](const std::string& help) {
        const std::size_t begin = help.find("\nPositionals:");
        return help.substr(begin, help.find("\nExample:") - begin);
      };
      EXPECT_EQ(options_of(old.out), options_of(current.out));
      continue;
    }
    EXPECT_EQ(old.out, current.out);
    if (current.err.empty()) continue;
    EXPECT_EQ(old.err, "hullbench" + current.err.substr(std::string("polylidar").size()));
  }
}

TEST_F(HullCommandTest, UsageErrors) {
  const std::string points = points_file();
  expect_refusal(hull({}), 2, "FILE is required");
  expect_refusal(hull({}), 2, "'polylidar hull --help' shows what there is");
  expect_refusal(hull({points, "--specie", "kind"}), 2, "there is no option --specie;");
  expect_refusal(hull({points, "--max-edge=3"}), 2,
                 "there is no option --max-edge (did you mean --max-edge-length?)");
  expect_refusal(hull({points, "--detial", "2"}), 2, "there is no option --detial (did you mean --detail?)");
  expect_refusal(hull({points, points}), 2, "several files are one set of points with --stream only");
  expect_refusal(run_program({POLYLIDAR, "hul"}), 2, "there is no command 'hul' (did you mean hull?)");
  expect_refusal(run_program({POLYLIDAR, "points.csv"}), 2, "there is no command 'points.csv';");
  expect_refusal(hull({points, "--detail", "0"}), 2, "--detail: '0' is not a number above 0;");
  expect_refusal(hull({points, "--detail", "inf"}), 2, "--detail: 'inf' is not a number above 0;");
  for (const std::string text : {"0", "1.5", "-1", "1e3", "1,2", "many"}) {
    expect_refusal(hull({points, "--max-parts", text}), 2,
                   "--max-parts: '" + text + "' is not a whole number from 1 on;");
  }
  expect_refusal(hull({points, "--min-triangles", "1.5"}), 2,
                 "--min-triangles: '1.5' is not a whole number from 0 on;");
  expect_refusal(hull({points, "--alpha", "-1"}), 2, "--alpha: '-1' is not a number of 0 or more, or inf;");
  expect_refusal(hull({points, "--alpha", "nan"}), 2, "is not a number of 0 or more");
  expect_refusal(hull({points, "--max-edge-length=-inf"}), 2, "is not a number of 0 or more, or inf;");
  expect_refusal(hull({points, "--min-area", "inf"}), 2, "is not a number of 0 or more;");
  expect_refusal(hull({points, "--min-area", "large"}), 2, "is not a number of 0 or more");
  expect_refusal(hull({points, "--simplify", "-0.5"}), 2, "is not a number of 0 or more");
  expect_refusal(hull({points, "--threads", "0"}), 2, "--threads");
  expect_refusal(hull({points, "--input", "shp"}), 2, "--input");
  expect_refusal(hull({points, "--format", "shp"}), 2, "--format: 'shp' is none of auto,geojson,wkt,wkb,svg");
  expect_refusal(hull({points, "--columns", "1,2"}), 2, "--columns is for columns of text");
  for (const std::string cleaning : {"--max-parts", "--min-area", "--min-triangles", "--simplify"}) {
    expect_refusal(hull({points, cleaning, "1", "--cover"}), 2, "--cover excludes " + cleaning);
  }
  expect_refusal(hull({points, "--one", "--min-triangles", "9"}), 2, "--one excludes --min-triangles");
  expect_refusal(hull({points, "--memory", "9"}), 2, "--memory is for what --stream reads");
  for (const std::string option : {"--out", "--by", "--columns", "--crs", "--window"}) {
    expect_refusal(hull({points, option, ""}), 2, option + " is empty; give it a value, or leave it out");
  }
}

TEST_F(HullCommandTest, WhatWorksOnShapesNeedsUsualCoordinates) {
  const std::string huge = file("huge.csv", "0,0\n1e160,0\n0,1e160\n1e160,1e160\n3e159,4e159\n");
  expect_end(hull({huge}), 0, "chosen from the points");
  const std::string large = file("large.csv", "0,0\n1e46,0\n0,1e46\n1e46,1e46\n3e45,4e45\n");
  const std::string small = file("small.csv", "0,0\n1,0\n0,1e-36\n1,1\n");
  for (const std::string& points : {huge, large, small}) {
    for (const std::vector<std::string>& option :
         {std::vector<std::string>{"--keep-outliers"}, {"--simplify", "1"}}) {
      expect_refusal(hull(joined({points, "--crs", "none"}, option)), 2,
                     "coordinates as large or as small as these do not go with --simplify");
    }
    for (const std::string wanted : {"--one", "--cover"}) {
      const json feature =
          json::parse(succeeded(hull({points, "--crs", "none", wanted, "--alpha", "0"})).out);
      EXPECT_EQ(feature["geometry"]["coordinates"][0][0].size(), 5U) << "the square, as the core scales it";
    }
  }
  const std::string usual = file("usual.csv", "0,0\n1e45,0\n0,1e-34\n");
  EXPECT_EQ(hull({usual, "--crs", "none", "--keep-outliers", "--simplify", "1"}).code, 0);
}

TEST_F(HullCommandTest, TheResultNeverReplacesThePoints) {
  const std::string points = points_file();
  const std::string link = (folder() / "link.geojson").string();
  fs::create_symlink(points, link);
  const std::string from_points = "' < '" + points + "'";
  for (const std::string& out : {points, (folder() / "." / "points.npy").string(), link}) {
    expect_refusal(hull({points, "-o", out}), 2, "would replace the points that are read; give another file");
    expect_refusal(in_shell("", std::string("- -o '").append(out).append(from_points)), 2,
                   "would replace the points");
  }
  EXPECT_EQ(read_text(points), npy_of<double>(points_, "<f8"));
  EXPECT_EQ(hull({points, "-o", "/dev/null"}).code, 0);
}

TEST_F(HullCommandTest, PlaneCoordinatesWithoutASystemAreTold) {
  const std::string words = "the points name no coordinate system";
  const auto said = [&](const std::string& text, const std::vector<std::string>& options) {
    return contains(hull(joined({file("place.csv", text)}, options)).err, words);
  };
  const std::string plane = "x,y\n500000,5600000\n500010,5600000\n500000,5600010\n";
  EXPECT_TRUE(said(plane, {}));
  EXPECT_FALSE(said(plane, {"--crs", "25832"}));
  EXPECT_FALSE(said(plane, {"--crs", "none"}));
  EXPECT_TRUE(said(plane, {"--stream"}));
  EXPECT_FALSE(said(plane, {"--stream", "--crs", "25832"}));
  EXPECT_TRUE(said(plane, {"--stream", "--alpha", "20", "--shard", "1/2"}));
  EXPECT_FALSE(said(plane, {"--stream", "--alpha", "20", "--shard", "1/2", "--crs", "none"}));
  EXPECT_FALSE(said(plane, {"--format", "wkt"})) << "it has no place for a system";
  EXPECT_FALSE(said("x,y\n1,2\n3,2\n1,4\n", {})) << "these may be degrees";
  EXPECT_FALSE(said("x,y\n", {}));
}

TEST_F(HullCommandTest, WhatLooksLikeDegreesIsAskedAbout) {
  const std::string words = "polylidar: if the points are longitudes and latitudes, give --crs EPSG:4326\n";
  const auto said = [&](const std::string& text, const std::vector<std::string>& options) {
    return contains(hull(joined({file("place.csv", text), "--alpha", "1"}, options)).err, words);
  };
  const std::string berlin = "13.0884,52.3383\n13.7611,52.5123\n13.4123,52.6755\n";
  EXPECT_TRUE(said(berlin, {}));
  EXPECT_TRUE(said(berlin, {"--format", "wkt"}));
  EXPECT_TRUE(said(berlin, {"--stream"}));
  EXPECT_TRUE(said(berlin, {"--stream", "--shard", "1/2"}));
  EXPECT_TRUE(said("x,y\n" + berlin, {}));
  EXPECT_FALSE(said("lon,lat\n" + berlin, {}));
  EXPECT_FALSE(said(berlin, {"--crs", "EPSG:4326"}));
  EXPECT_FALSE(said(berlin, {"--crs", "none"}));
  EXPECT_FALSE(said("1.1234567,2.3\n3.4,2.1\n1.7654321,4.5\n", {}));
  for (const char* option : {"--detail=1", "--union"}) {
    const Outcome outcome = run_program({POLYLIDAR, "footprint", file("place.csv", berlin), option});
    EXPECT_NE(outcome.err.find(words), std::string::npos) << option;
  }
}

TEST_F(HullCommandTest, InputThatCannotBeRead) {
  expect_refusal(hull({"/nowhere/points.csv"}), 2, "there is no file /nowhere/points.csv");
  expect_refusal(hull({folder().string()}), 2, "it is a folder");
  expect_refusal(hull({file("empty.csv", "")}), 2, "it is empty");
  expect_refusal(in_shell("", "- < /dev/null"), 2, "standard input: it is empty");
  expect_refusal(in_shell("", "- < /"), 2, "standard input: it is a folder");
  expect_refusal(hull({file("bad.csv", "x,y\n1,2\n3,nan\n")}), 2,
                 "bad.csv, line 3: the coordinate 'nan' is not finite");
  expect_refusal(hull({file("text.npy", "x,y\n1,2\n")}), 2, "does not begin as a NumPy file");
  expect_refusal(hull({file("wide.csv", "1e-300,0\n1e300,1\n5,7\n")}), 2, "wide.csv: ");
  EXPECT_EQ(hull({"--input", "csv", file("text.npy", "x,y\n0,0\n1,0\n0,1\n")}).code, 0);
  EXPECT_EQ(hull({"--columns", "b,c", file("c.csv", "a,b,c\n9,0,0\n9,1,0\n9,0,1\n")}).code, 0);
}

TEST_F(HullCommandTest, OneFeatureAGroup) {
  std::string text = "kind;x;y\n";
  for (std::size_t i = 0; i < points_.size(); ++i) {
    text += (i % 3 == 0   ? R"("red; \deep")"
             : i % 3 == 1 ? "blue"
                          : "") +
            std::string(";") + number(points_[i].x) + ";" + number(points_[i].y) + "\n";
  }
  const std::string path = file("kinds.csv", text);
  for (const char* by : {"kind", "KIND", "1"}) {
    const Outcome outcome =
        by[0] == '1' ? hull({path, "--by", by, "--columns", "x,y"}) : hull({path, "--by", by});
    EXPECT_EQ(outcome.err, "polylidar: 3 groups\n");
    const json collection = json::parse(outcome.out);
    ASSERT_EQ(collection["features"].size(), 3U);
    const char* labels[] = {"", "blue", "red; \\deep"};
    for (std::size_t g = 0; g < 3; ++g) {
      const json& feature = collection["features"][g];
      Points members;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (i % 3 == 2 - g) members.push_back(points_[i]);
      }
      EXPECT_EQ(labels[g], feature["properties"]["label"].get<std::string>());
      EXPECT_EQ(feature["properties"]["points"], members.size());
      EXPECT_TRUE(feature["properties"].contains("median_size"));
      EXPECT_EQ(from_geojson(feature["geometry"]["coordinates"]),
                to_coordinates(polylidar::concave_hull(members), members));
    }
  }
  expect_refusal(hull({path, "--by", "colour"}), 2, "there is no column 'colour'");
  expect_refusal(hull({path, "--by", "0"}), 2, "--by '0' names no column");
  expect_refusal(hull({points_file(), "--by", "1"}), 2, "--by is for columns of text, GeoJSON and LAS");
  expect_refusal(hull({path, "--by", "kind", "--format", "wkt"}), 2, "--by gives one feature for each group");
  EXPECT_EQ(hull({path, "--by", "kind", "--format", "svg"}).code, 0);
}

TEST_F(HullCommandTest, LabelsThatAreNumbersAreNumbers) {
  const auto labels_of = [](const std::string& path, const std::string& by) {
    json found = json::array();
    const json collection = json::parse(hull({path, "--by", by}).out);
    for (const json& feature : collection["features"]) {
      found.push_back(feature["properties"]["label"]);
    }
    return found;
  };
  const auto labels = [&](const std::string& text) { return labels_of(file("n.csv", text), "3"); };
  EXPECT_EQ(labels("1,2,10\n1,2,9\n1,2,-0.5\n"), (json{-0.5, 9, 10}));
  EXPECT_EQ(labels("1,2,200000\n1,2,0.0001\n"), (json{0.0001, 200000}));
  EXPECT_EQ(labels("1,2,10\n1,2,007\n"), (json{"007", "10"}));
  EXPECT_EQ(labels("1,2,10\n1,2,1e5\n"), (json{"10", "1e5"}));
  EXPECT_EQ(labels("1,2,10\n1,2,nan\n1,2,9\n"), (json{"9", "10", "nan"}));
  EXPECT_EQ(labels("x,y,z\n"), json::array());
  const auto feature = [](const std::string& height) {
    return R"({"type":"Feature","properties":{"height":)" + height +
           R"(},"geometry":{"type":"Point","coordinates":[1,2]}})";
  };
  const std::string real = file("real.geojson", R"({"type":"FeatureCollection","features":[)" +
                                                    feature("100000.0") + "," + feature("1e-7") + "]}");
  EXPECT_EQ(labels_of(real, "height"), (json{1e-7, 100000}));
  expect_refusal(hull({file("odd.csv", "1,2,\xFF\n"), "--by", "3"}), 2,
                 "--by is not UTF-8; convert the file");
}

TEST_F(HullCommandTest, WhatIsLeftOutsideIsKept) {
  const json collection =
      json::parse(hull({points_file(), "--alpha", "0.3", "--max-parts", "1", "--keep-outliers"}).out);
  ASSERT_EQ(collection["features"].size(), 2U);
  EXPECT_EQ(collection["features"][0]["properties"]["parts"], 1);
  const json& outside = collection["features"][1];
  EXPECT_EQ(outside["properties"], (json{{"outside", 4}}));
  EXPECT_EQ(outside["geometry"],
            (json{{"type", "MultiPoint"},
                  {"coordinates", {{20.0, 0.0}, {20.2, 0.0}, {20.0, 0.2}, {20.21, 0.21}}}}));
  const json covered = json::parse(hull({points_file(), "--cover", "--keep-outliers"}).out);
  EXPECT_EQ(covered["features"].size(), 1U);
  expect_refusal(hull({points_file(), "--keep-outliers", "--format", "svg"}), 2, "only --format geojson has");
}

TEST_F(HullCommandTest, OneAndMaxParts) {
  EXPECT_EQ(shape({"--alpha", "0.3", "--one"}).size(), 1U);
  EXPECT_EQ(shape({"--alpha", "0.3", "--max-parts", "1"}), MultiPolygon{expected(0.3)[0]});
  EXPECT_EQ(json::parse(hull({points_file(), "--alpha", "0.3", "--one"}).out)["properties"]["parts"], 1);
  // If no triangle is kept, each point is a part.
  EXPECT_EQ(shape({"--alpha", "0.0001", "--one"}), shape({"--alpha", "0.0001", "--one", "--cover"}));
  EXPECT_EQ(shape({"--alpha", "0.0001", "--one"}).size(), 1U);
  const Outcome chosen = succeeded(hull({points_file(), "--detail", "30", "--one"}));
  EXPECT_EQ(json::parse(chosen.out)["properties"]["parts"], 1);
  expect_says(chosen.err, "chosen from the points and widened as far as --one needs");
  expect_says(hull({points_file(), "--one", "--cover"}).err, "widened as far as --one and --cover need");
}

TEST_F(HullCommandTest, DegreesAreTakenAsMetres) {
  Points degrees;
  for (const auto& p : points_) degrees.push_back({10 + p.x / 100, 60 + p.y / 200});
  const std::string geojson = file("degrees.geojson", geojson_multipoint(degrees));
  const std::string named = file(
      "degrees.csv", "lat,lon\n" + [&] {
        std::string text;
        for (const auto& p : degrees) text += number(p.y) + "," + number(p.x) + "\n";
        return text;
      }());
  const std::string plain = file("plain.csv", rows(degrees, ","));
  const Outcome outcome = hull({geojson, "--max-edge-length", "300"});
  expect_says(outcome.err, "longitude and latitude: lengths are in metres");
  const json feature = json::parse(outcome.out);
  EXPECT_FALSE(feature.contains("crs"));
  // 1 unit of points_ is 556 m in both directions at latitude 60.
  const double metres = 555.975;
  const double plane_area = polylidar::area(shape({"--max-edge-length", number(300 / metres)}));
  EXPECT_NEAR(feature["properties"]["area"].get<double>() / metres / metres, plane_area, 0.005 * plane_area);
  EXPECT_EQ(hull({named, "--max-edge-length", "300"}).out, outcome.out);
  EXPECT_EQ(hull({plain, "--max-edge-length", "300", "--crs", "EPSG:4326"}).out, outcome.out);
  const std::string plane = hull({plain, "--max-edge-length", "0.005"}).out;
  EXPECT_EQ(hull({geojson, "--max-edge-length", "0.005", "--crs", "none"}).out, plane);
  // No longitude is 500, and GeoJSON without a system is in degrees.
  expect_refusal(hull({file("far.geojson", geojson_multipoint({{500, 1}, {501, 1}, {500, 2}}))}), 2,
                 "the coordinate system is longitude and latitude, but x is from 500 to 501");
}

TEST_F(HullCommandTest, CoordinatesThatAreNoDegreesAreTold) {
  const std::string rows = "lon,lat\n10,50\n11,50\n10,51\n-9999,-9999\n";
  const std::string table = file("nodata.csv", rows);
  expect_refusal(hull({table}), 2, "but x is from -9999 to 11 and y from -9999 to 51; leave out");
  expect_refusal(hull({file("xy.csv", rows.substr(8)), "--crs", "EPSG:4326"}), 2,
                 "but x is from -9999 to 11");
  const Outcome left = succeeded(hull({table, "--window", "-180,-90,180,90"}));
  EXPECT_EQ(json::parse(left.out)["properties"]["points"], 3);
  expect_says(left.err, "longitude and latitude: lengths are in metres");
  EXPECT_EQ(json::parse(succeeded(hull({table, "--crs", "none"})).out)["properties"]["points"], 4);
}

TEST_F(HullCommandTest, GradsAreRefused) {
  const std::string paris = file("paris.csv", "0.01,54.27\n0.02,54.27\n0.01,54.28\n");
  const std::string words = "the coordinate system is longitude and latitude in grads";
  expect_refusal(hull({paris, "--crs", "EPSG:4807"}), 2, words);
  expect_end(run_program({POLYLIDAR, "footprint", paris, "--crs", "4807"}), 2, words);
  EXPECT_EQ(hull({paris, "--crs", "none"}).code, 0);
}

TEST_F(HullCommandTest, BothSidesOfTheDateLineAreTold) {
  const std::string words = "write western longitudes as 180 to 360";
  expect_says(hull({file("a.csv", "lon,lat\n179,1\n-179,1\n179,2\n")}).err, words);
  EXPECT_EQ(hull({file("b.csv", "lon,lat\n179,1\n181,1\n179,2\n")}).err.find(words), std::string::npos);
}

TEST_F(HullCommandTest, TheCoordinateSystemIsPassedOn) {
  const auto crs_of = [&](const std::vector<std::string>& arguments) {
    const json feature = json::parse(hull(arguments).out);
    return feature.contains("crs") ? feature["crs"]["properties"]["name"].get<std::string>() : std::string();
  };
  const std::string csv = file("utm.csv", "500000,5600000\n500001,5600000\n500000,5600001\n");
  EXPECT_EQ(crs_of({csv}), "");
  EXPECT_EQ(crs_of({csv, "--crs", "25833"}), "urn:ogc:def:crs:EPSG::25833");
  file("utm.prj", R"(PROJCS["a",GEOGCS["b"],AUTHORITY["EPSG","25832"]])");
  EXPECT_EQ(crs_of({csv}), "urn:ogc:def:crs:EPSG::25832");
  EXPECT_EQ(crs_of({csv, "--crs", "none"}), "");
  file("utm.prj", R"(PROJCS["Gauss_Kruger_somewhere",GEOGCS["GCS_Bessel"]])");
  EXPECT_EQ(crs_of({csv}), "");
  const std::string nameless_words = "the coordinate system has no EPSG number";
  const std::string part = (folder() / "part").string();
  succeeded(hull({csv, "--alpha", "9", "--stream", "--shard", "1/1", "--out", part}));
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"hull", csv}, {"hull", csv, "--stream"}, {"merge", part}}) {
    expect_says(run_program(joined({POLYLIDAR}, command)).err, nameless_words);
    const Outcome wkt = succeeded(run_program(joined(joined({POLYLIDAR}, command), {"--format", "wkt"})));
    EXPECT_FALSE(contains(wkt.err, nameless_words)) << "it has no place for a system";
  }
  EXPECT_EQ(crs_of({csv, "--crs", "EPSG:31467"}), "urn:ogc:def:crs:EPSG::31467");
  const std::string old = file(
      "old.geojson",
      R"({"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::3035"}},"type":"MultiPoint","coordinates":[[4e6,3e6],[4000001,3e6],[4e6,3000001]]})");
  EXPECT_EQ(crs_of({old}), "urn:ogc:def:crs:EPSG::3035");
  const Outcome nameless =
      hull({file("null.geojson", R"({"crs":null,"type":"MultiPoint","coordinates":[[4,3],[5,3],[4,4]]})")});
  EXPECT_EQ(nameless.err.find("metres"), std::string::npos) << nameless.err;
  EXPECT_EQ(crs_of({file("e.wkt", "SRID=25832;MULTIPOINT ((0 0), (1 0), (0 1))")}),
            "urn:ogc:def:crs:EPSG::25832");
  expect_refusal(hull({csv, "--crs", "here"}), 2, "--crs 'here' names no coordinate system");
}

TEST_F(HullCommandTest, AWindowChoosesPointsOfEveryFormat) {
  Points inside;
  for (const auto& p : points_) {
    if (p.x >= 1 && p.x <= 7 && p.y >= 0 && p.y <= 5.5) inside.push_back(p);
  }
  for (const auto& form :
       {PointFileText{"w.csv", rows(points_, ",")}, PointFileText{"w.npy", npy_of<double>(points_, "<f8")}}) {
    const json feature =
        json::parse(hull({file(form.name, form.text), "--alpha", "0.3", "--window", "1,0,7,5.5"}).out);
    EXPECT_EQ(feature["properties"]["points"], inside.size());
    EXPECT_EQ(from_geojson(feature["geometry"]["coordinates"]),
              to_coordinates(polylidar::concave_hull(inside, {.alpha = 0.3}), inside));
  }
  expect_refusal(hull({points_file(), "--classes", "2"}), 2, "--returns and --classes are for LAS");
}

TEST_F(HullCommandTest, WhatGzipCompressedIsUnpacked) {
  const std::string path = points_file();
  const std::string csv = file("points.csv", rows(points_, ","));
  const std::string expected_text = hull({csv}).out;
  if (hull({csv + ".gz"}).code == 0) FAIL() << "the test left a file behind";
  ASSERT_EQ(run_program({"gzip", "-k", csv, path}).code, 0);
  const Outcome unpacked = hull({csv + ".gz"});
  if (unpacked.err.find("without zlib") != std::string::npos) GTEST_SKIP() << "skipped: zlib is missing";
  EXPECT_EQ(unpacked.out, expected_text) << unpacked.err;
  EXPECT_EQ(hull({path + ".gz"}).out, expected_text);
  const std::string raw = file("points.f64", raw_of(points_));
  ASSERT_EQ(run_program({"gzip", raw}).code, 0);
  fs::rename(raw + ".gz", raw + ".GZ");
  EXPECT_EQ(hull({raw + ".GZ", "--input", "raw"}).out, expected_text);
  EXPECT_EQ(in_shell("", "- < '" + csv + ".gz'").out, expected_text);
  const std::string packed = read_text(csv + ".gz");
  EXPECT_EQ(hull({file("twice.csv.gz", packed + packed)}).code, 0);
  EXPECT_EQ(hull({file("padded.csv.gz", packed + std::string(100'000, '\0'))}).out, expected_text);
  const std::string once = file("once.csv", packed);
  ASSERT_EQ(run_program({"gzip", "-k", once}).code, 0);
  expect_refusal(hull({once + ".gz"}), 2, "it is packed by gzip twice");
  // No row begins in the bytes that are looked at for the format.
  const std::string zeros = file("zeros", std::string(2'000'000, '\0'));
  ASSERT_EQ(run_program({"gzip", "-k", zeros}).code, 0);
  expect_refusal(hull({zeros + ".gz"}), 2, "zeros.gz, line 1: the line is longer than");
  expect_refusal(hull({file("cut.csv.gz", packed.substr(0, packed.size() / 2))}), 2,
                 "its gzip stream is cut short");
  std::string damaged = packed;
  damaged[damaged.size() / 2] = static_cast<char>(~damaged[damaged.size() / 2]);
  expect_refusal(hull({file("bad.csv.gz", damaged)}), 2, "bad.csv.gz");
}

TEST_F(HullCommandTest, CtrlCWhileWaitingForInput) {
  // Opened for reading and writing, so that neither side waits for the other and no end comes.
  Program program({"/bin/sh", "-c", std::string("exec '") + POLYLIDAR + "' hull - <> '" + make_pipe() + "'"});
  ASSERT_TRUE(wait_until([&] {
    return read_text("/proc/" + std::to_string(program.pid()) + "/stat").find("(polylidar) S") !=
           std::string::npos;
  }));
  program.send_signal(SIGINT);
  expect_refusal(program.wait(), 130, "interrupted");
}

/// So many that they are not put into memory.
Points many_points() {
  return square_without_a_disc(90000, 11);
}

TEST_F(HullCommandTest, AStreamGivesTheSameFile) {
  const Points points = many_points();
  const std::string text = "# no point\nid,x,y\n" + [&] {
    std::string rows;
    for (const Point& p : points) rows += "1," + number(p.x) + "," + number(p.y) + "\n";
    return rows;
  }();
  const std::vector<std::vector<std::string>> inputs = {
      {file("double.npy", npy_of<double>(points, "<f8"))},
      {file("double.npy", npy_of<double>(points, "<f8")), "--window", "1,1,9,9.5"},
      {file("double.f64", raw_of(points))},
      {file("double.bin", raw_of(points)), "--input", "raw", "--window", "1,1,9,9.5"},
      {file("float.npy", npy_of<float>(points, "<f4"))},
      {file("columns.csv", text), "--columns", "x,y"}};
  for (const std::vector<std::string>& input : inputs) {
    for (const std::string format : {"geojson", "wkb", "wkt"}) {
      for (const std::string limit : {"--max-perimeter=0.5", "--detail=1.2"}) {
        const std::vector<std::string> arguments = joined(input, {limit, "--format", format});
        const Outcome kept = hull(arguments);
        const Outcome streamed = succeeded(hull(joined(arguments, {"--stream"})));
        EXPECT_EQ(streamed.out, kept.out) << input[0] << " " << format << " " << limit;
        expect_says(streamed.err, "points are near the outline");
      }
    }
  }
}

TEST_F(HullCommandTest, AnInfiniteLimitIsNone) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(shape({"--alpha", "inf"}), expected(kInfinity));
  EXPECT_EQ(shape({"--alpha", "inf", "--max-edge-length", "0.4"}), expected(kInfinity, 0.4));
  const json properties =
      json::parse(succeeded(hull({points_file(), "--max-perimeter", "inf"})).out)["properties"];
  EXPECT_TRUE(properties.at("max_perimeter").is_null());
  EXPECT_EQ(properties["parts"], 1);
  const json widened =
      json::parse(succeeded(hull({points_file(), "--max-edge-length", "0", "--cover"})).out)["properties"];
  EXPECT_TRUE(widened.at("max_edge_length").is_null());
  EXPECT_FALSE(widened.contains("alpha"));
  const std::vector<std::string> many = {file("many.npy", npy_of<double>(many_points(), "<f8")), "--alpha",
                                         "inf"};
  EXPECT_EQ(succeeded(hull(joined(many, {"--stream"}))).out, succeeded(hull(many)).out);
}

TEST_F(HullCommandTest, AStreamSaysWhatItCannotDo) {
  Points points = many_points();
  const std::string npy = file("many.npy", npy_of<double>(points, "<f8"));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& middle = points[i / 30 * 30];
    points[i] = {middle.x + 0.002 * points[i].x, middle.y + 0.002 * points[i].y};
  }
  const std::string clustered = file("clustered.npy", npy_of<double>(points, "<f8"));
  EXPECT_EQ(succeeded(hull({clustered, "--stream"})).out, hull({clustered}).out) << "put into memory";
  for (const auto& [arguments, sentence] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{clustered, "--memory", "1"}, "is found by a triangulation of them all, which needs more memory"},
           {{npy, "--alpha", "1", "--one"}, "--stream does not go with --one;"},
           {{npy, "--alpha", "1", "--by", "x"}, "--stream does not go with --by"},
           {{npy, "--alpha", "1", "--format", "svg"}, "--stream does not go with --format svg"},
           {{npy, "--alpha", "1", "--min-area", "1"}, "--stream does not go with --min-area"},
           {{"-", "--alpha", "1"}, "--stream does not go with standard input, which can be read once only"},
           {{make_pipe(), "--alpha", "1"}, "which can be read once only; give a file"},
           {{npy, "--alpha", "1e-9"}, "the limit is too small for the distances between the points"},
           {{npy, "--alpha", "1", "--crs", "EPSG:4326"}, "--stream takes a plane"},
           {{file("p.zip", "PK\x03\x04"), "--alpha", "1"}, "p.zip: it is an archive"},
           {{file("p.wkt", "POINT (1 2)"), "--alpha", "1"}, "leave --stream out"}}) {
    expect_refusal(hull(joined(arguments, {"--stream"})), 2, sentence);
  }
}

TEST_F(HullCommandTest, TheMapOfAStreamTakesNoMoreThanHalfOfTheMemoryThatIsGiven) {
  // Cells of 0.7 mm in a square of 10 m are some 28 MB.
  const std::vector<std::string> arguments = {file("many.npy", npy_of<double>(many_points(), "<f8")),
                                              "--alpha", "0.004", "--stream"};
  for (const std::vector<std::string>& part : std::vector<std::vector<std::string>>{{}, {"--shard", "1/2"}}) {
    const std::vector<std::string> in_part = joined(arguments, part);
    succeeded(hull(in_part));
    succeeded(hull(joined(in_part, {"--memory", "100"})));
    expect_refusal(hull(joined(in_part, {"--memory", "1"})), 2,
                   "the limit is too small for the distances between the points");
  }
}

TEST_F(HullCommandTest, AHeaderThatPromisesMoreThanTheFileHoldsMakesNoMap) {
  LasFile las;
  las.points = {{.x = 0, .y = 0}, {.x = 1000, .y = 0}, {.x = 0, .y = 1000}};
  las.promised = 1'000'000'000;
  const std::string lying = file("lying.las", las.text());
  EXPECT_FALSE(polylidar::tool::expected_points(lying, {}));
  expect_refusal(hull({lying, "--stream", "--alpha", "0.001"}), 2, "lying.las: ");
}

TEST_F(HullCommandTest, AStreamWithoutPointsSaysSo) {
  expect_end(hull({file("none.csv", "x,y\n"), "--stream"}), 0, "there are no points, so there is no shape");
}

TEST_F(HullCommandTest, RawDoublesAreRead) {
  const std::string first = hull({points_file(), "--alpha", "0.3"}).out;
  for (const char* name : {"points.f64", "points.raw", "POINTS.F64"}) {
    EXPECT_EQ(hull({file(name, raw_of(points_)), "--alpha", "0.3"}).out, first) << name;
  }
  const std::string path = file("points.bin", raw_of(points_));
  EXPECT_EQ(hull({path, "--input", "raw", "--alpha", "0.3"}).out, first);
  EXPECT_EQ(in_shell("cat '" + path + "' |", "- --input raw --alpha 0.3").out, first);
  const std::string boxed = hull({points_file(), "--alpha", "0.3", "--window", "1,0,7,5.5"}).out;
  EXPECT_EQ(hull({path, "--input", "raw", "--alpha", "0.3", "--window", "1,0,7,5.5"}).out, boxed);
  ASSERT_EQ(run_program({"gzip", "-k", file("packed.f64", raw_of(points_))}).code, 0);
  const Outcome unpacked = hull({(folder() / "packed.f64.gz").string(), "--alpha", "0.3"});
  if (unpacked.err.find("without zlib") == std::string::npos) {
    EXPECT_EQ(unpacked.out, first) << unpacked.err;
  }

  // Coordinates that begin as gzip, zip, LAS, UTF-8 and a comment do.
  for (const std::string start : {"\x1F\x8B", "PK\x03\x04", "LASF", "\xEF\xBB\xBF", "# point"}) {
    std::string bytes = raw_of({{1, 2}, {3, 4}, {1, 5}});
    bytes.replace(0, std::min<std::size_t>(start.size(), 6), start.substr(0, 6));
    const Outcome outcome = hull({file("odd.raw", bytes), "--alpha", "9"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out)["properties"]["points"], 3);
  }
  expect_refusal(hull({file("cut.f64", raw_of(points_) + "abc")}), 2,
                 "cut.f64: its size is no multiple of 16 bytes");
  expect_refusal(in_shell("head -c 1000 '" + path + "' |", "- --input raw"), 2,
                 "standard input: its size is no multiple of 16 bytes");
  expect_refusal(hull({file("nan.f64", raw_of({{1, 2}, {0.0 / 0.0, 1}}))}), 2,
                 "point 2 has a coordinate that is not finite");
}

/// A square lattice with holes, and copies of a tenth of it behind: ties everywhere.
Points lattice_with_copies() {
  Points points;
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 290; ++x) {
      if (std::hypot(x % 100 - 50, y % 90 - 40) > 17) points.push_back({x * 0.25 - 7, y * 0.25});
    }
  }
  points.insert(points.end(), points.begin(), points.begin() + 8000);
  return points;
}

class ShardTest : public HullCommandTest {
 protected:
  std::string part(std::size_t number, const std::string& of = "") const {
    return (folder() / ("part" + of + "-" + std::to_string(number))).string();
  }
  /// `hull` with these arguments in so many shards, whose parts are named.
  std::vector<std::string> parts(const std::vector<std::string>& arguments, std::size_t count,
                                 const std::string& name = "", const char* program = POLYLIDAR) const {
    std::vector<std::string> made;
    for (std::size_t number = 1; number <= count; ++number) {
      made.push_back(part(number, name));
      const std::string shard = std::to_string(number) + "/" + std::to_string(count);
      const std::vector<std::string> command = joined({program, "hull"}, arguments);
      const Outcome outcome =
          run_program(joined(command, {"--stream", "--shard", shard, "--out", made.back()}));
      EXPECT_EQ(outcome.code, 0) << outcome.err;
      EXPECT_EQ(outcome.out, "");
      expect_says(outcome.err, ": shard " + std::to_string(number) + " of ");
    }
    return made;
  }
  static Outcome merge(const std::vector<std::string>& arguments) {
    return run_program(joined({POLYLIDAR, "merge"}, arguments));
  }
  std::vector<std::string> names_in_folder() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder()))
      names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
  }
};

TEST_F(ShardTest, ShardsGiveTheBytesOfOneRun) {
  const Points uniform = many_points();
  const Points lattice = lattice_with_copies();
  LasFile las;
  for (const Point& p : uniform) {
    las.points.push_back(
        {.x = static_cast<std::int32_t>(p.x * 100), .y = static_cast<std::int32_t>(p.y * 100)});
  }
  const std::size_t half = lattice.size() / 2;
  const Points head(lattice.begin(), lattice.begin() + static_cast<std::ptrdiff_t>(half));
  const Points tail(lattice.begin() + static_cast<std::ptrdiff_t>(half), lattice.end());
  const std::vector<std::vector<std::string>> inputs = {
      {file("one.npy", npy_of<double>(uniform, "<f8")), "--max-perimeter", "0.3"},
      {file("one.f64", raw_of(uniform)), "--alpha", "0.09", "--window", "1,1,9,9.5"},
      {file("one.csv", rows(uniform, ",")), "--max-edge-length", "0.2", "--crs", "EPSG:25832"},
      {file("one.las", las.text()), "--max-perimeter", "0.3"},
      {file("head.csv", rows(head, " ")), file("tail.npy", npy_of<double>(tail, "<f8")), "--max-perimeter",
       "0.9"}};
  for (const std::vector<std::string>& input : inputs) {
    const Outcome whole = hull(joined(input, {"--stream"}));
    ASSERT_EQ(whole.code, 0) << whole.err;
    for (const std::size_t count : {1U, 2U, 3U, 7U}) {
      std::vector<std::string> made = parts(input, count, "", count == 2 ? HULLBENCH : POLYLIDAR);
      std::ranges::reverse(made);
      const Outcome merged = merge(made);
      EXPECT_EQ(merged.code, 0) << merged.err;
      EXPECT_EQ(merged.out, whole.out) << input[0] << " in " << count << " shards";
      EXPECT_EQ(merged.err, whole.err);
    }
  }
  const std::vector<std::string> made = parts(inputs[0], 3);
  for (const std::string format : {"wkt", "wkb"}) {
    const std::string out = (folder() / ("merged." + format)).string();
    EXPECT_EQ(merge(joined(made, {"--out", out, "--threads", "2"})).out, "");
    EXPECT_EQ(read_text(out), hull(joined(inputs[0], {"--stream", "--format", format})).out);
  }
}

TEST_F(ShardTest, SomeShardsAreEmpty) {
  Points flat = many_points();
  for (Point& p : flat) p.y *= 0.001;
  const std::vector<std::string> arguments = {file("flat.npy", npy_of<double>(flat, "<f8")), "--alpha",
                                              "0.006"};
  const std::vector<std::string> few = {file("few.csv", "0,0\n1,0\n0,1\n"), "--alpha", "9"};
  for (const auto& input : {arguments, few}) {
    EXPECT_EQ(merge(parts(input, 25)).out, hull(joined(input, {"--stream"})).out);
  }
}

TEST_F(ShardTest, WhatTakesMoreThanASecondIsShown) {
  namespace tool = polylidar::tool;
  const std::string rows = "0,0\n1,0\n0,1\n";
  const std::string part_of_rows = read_text(parts({file("few.csv", rows), "--alpha", "9"}, 1)[0]);
  const std::string pipe = make_pipe();
  // What `work` shows while its input stops for longer than it is quiet.
  const auto shown_by = [&](const std::string& text, const auto& work) {
    const std::jthread writer([&] {
      std::fstream file(pipe, std::ios::binary | std::ios::in | std::ios::out);
      file << text.substr(0, text.size() / 2) << std::flush;
      std::this_thread::sleep_for(std::chrono::milliseconds(1500));
      file << text.substr(text.size() / 2);
    });
    std::ostringstream err;
    EXPECT_EQ(work(tool::Surroundings{"polylidar", err, true}), 0);
    return err.str();
  };
  const std::string out = (folder() / "out.geojson").string();
  const auto expect_line = [](const std::string& err, const std::string& line) {
    expect_says(err, "\r\033[K" + line + "\r\033[K");
  };
  tool::HullCommand hull_command;
  hull_command.inputs = {pipe};
  hull_command.shape.out = out;
  expect_line(shown_by(rows, [&](const tool::Surroundings& s) { return tool::make_hull(hull_command, s); }),
              "reading: 0 MiB");
  tool::FootprintCommand footprint_command;
  footprint_command.inputs = {pipe};
  footprint_command.shape.out = out;
  expect_line(
      shown_by(rows,
               [&](const tool::Surroundings& s) { return tool::make_footprints(footprint_command, s); }),
      "0 of 1 files; pipe: reading: 0 MiB");
  tool::MergeCommand merge_command;
  merge_command.inputs = {pipe};
  merge_command.shape.out = out;
  expect_line(shown_by(part_of_rows,
                       [&](const tool::Surroundings& s) { return tool::merge_hulls(merge_command, s); }),
              "reading part 1 of 1");
}

TEST_F(ShardTest, ShardsSayWhatTheyCannotDo) {
  const std::string npy = file("many.npy", npy_of<double>(many_points(), "<f8"));
  const std::vector<std::string> before = names_in_folder();
  const std::string out = part(1);
  for (const auto& [arguments, sentence] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--alpha", "1", "--shard", "1/2"}, "--shard is for what --stream reads"},
           {{"--stream", "--shard", "1/2"}, "--shard needs a limit"},
           {{"--alpha", "1", "--stream", "--shard", "3/2"}, "--shard '3/2' is no shard"},
           {{"--alpha", "1", "--stream", "--shard", "0/2"}, "--shard '0/2' is no shard"},
           {{"--alpha", "1", "--stream", "--shard", "1"}, "--shard '1' is no shard"},
           {{"--alpha", "1", "--stream", "--shard", "1/99999999999"}, "is no shard"},
           {{"--alpha", "1", "--stream", "--shard", "1/2", "--format", "wkt"}, "are for 'polylidar merge'"},
           {{"--alpha", "1", "--stream", "--shard", "1/2", "--out-layer", "a"}, "are for 'polylidar merge'"},
           {{"--alpha", "1", "--stream", "--shard", "1/2", "--simplify", "1"}, "--stream does not go with"},
           {{"--alpha", "1e-9", "--stream", "--shard", "1/2"}, "the limit is too small for the distances"},
           {{npy, "--alpha", "1"}, "several files are one set of points with --stream only"}}) {
    expect_refusal(hull(joined({npy, "--out", out}, arguments)), 2, sentence);
  }
  for (const std::string name : {"part.geojson", "part.las"}) {
    expect_refusal(
        hull({npy, "--alpha", "1", "--stream", "--shard", "1/2", "--out", (folder() / name).string()}), 2,
        "--shard writes a part for 'polylidar merge', neither points nor polygons");
  }
  expect_refusal(
      hull({npy, "--alpha", "1", "--stream", "--shard", "1/2", "--out", (folder() / "a.gpkg").string()}), 2,
      "are for 'polylidar merge'");
  EXPECT_EQ(names_in_folder(), before);
  const std::string beside = file("west.prj", R"(PROJCS["a",GEOGCS["b"],AUTHORITY["EPSG","25832"]])");
  const std::string west = file("west.csv", "0,0\n");
  expect_refusal(hull({west, "--alpha", "1", "--stream", "--shard", "1/2", "--out", beside}), 2,
                 "west.prj, which is read with " + west);
  EXPECT_TRUE(read_text(beside).starts_with("PROJCS"));
  file("east.prj", R"(PROJCS["a",GEOGCS["b"],AUTHORITY["EPSG","25833"]])");
  const std::vector<std::string> tiles = {west, file("east.csv", "1,1\n"), "--alpha", "1", "--stream"};
  expect_refusal(hull(tiles), 2, "the files have different coordinate systems");
}

TEST_F(ShardTest, MergeSaysWhatDoesNotFitTogether) {
  Points points = many_points();
  const std::string npy = file("many.npy", npy_of<double>(points, "<f8"));
  const std::vector<std::string> made = parts({npy, "--alpha", "0.09"}, 3);
  const std::vector<std::string> wider = parts({npy, "--alpha", "0.1"}, 3, "-wider");
  const std::vector<std::string> halves = parts({npy, "--alpha", "0.09"}, 2, "-half");
  const std::vector<std::string> elsewhere =
      parts({npy, "--alpha", "0.09", "--crs", "EPSG:25832"}, 3, "-crs");
  points[500].x += 0.001;
  file("many.npy", npy_of<double>(points, "<f8"));
  const std::vector<std::string> changed = parts({npy, "--alpha", "0.09"}, 3, "-changed");
  const std::string bytes = read_text(made[2]);
  const std::string cut = file("cut", bytes.substr(0, bytes.size() / 2));
  std::string flipped = bytes;
  flipped[bytes.size() / 2] = static_cast<char>(~flipped[bytes.size() / 2]);
  std::string newer = bytes;
  newer[8] = 2;
  const std::vector<std::string> before = names_in_folder();
  const std::string out = (folder() / "merged.geojson").string();
  for (const auto& [arguments, sentence] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{made[0], made[2]}, "shard 2 of 3 is missing"},
           {{made[0], made[1], made[1]}, "shard 2 of 3 is there twice"},
           {{made[0], made[1], made[2], made[2]}, "shard 3 of 3 is there twice"},
           {{made[0], wider[1], made[2]}, "were made with different limits or options"},
           {{made[0], halves[1], made[2]}, "shard 1 of 3 and shard 2 of 2 do not belong together"},
           {{made[0], made[1], changed[2]},
            "are of different points, or of a source that changed in between"},
           {{made[0], made[1], elsewhere[2]}, "its coordinate system is not that of"},
           {{made[0], made[1], cut}, "cut: it is cut short"},
           {{made[0], made[1], file("flipped", flipped)}, "flipped: it is damaged"},
           {{made[0], made[1], file("newer", newer)}, "newer: it is a part of version 2"},
           {{made[0], made[1], npy}, "many.npy: it is no part of a hull"},
           {{made[0], made[1], (folder() / "nowhere").string()}, "nowhere"}}) {
    expect_refusal(merge(joined(arguments, {"--out", out})), 2, sentence);
  }
  expect_refusal(merge({made[0], "--format", "svg"}), 2, "'svg' is none of auto,geojson,wkt,wkb");
  expect_refusal(merge({made[0], "--out", (folder() / "a.svg").string()}), 2, "svg shows all points");
  expect_refusal(merge({made[0], "--out", (folder() / "a.las").string()}), 2,
                 "has the ending of a file of points; name it .geojson, .wkt or .wkb, or say with --format");
  expect_refusal(merge({}), 2, "PART is required");
  EXPECT_FALSE(fs::exists(out));
  EXPECT_EQ(names_in_folder().size(), before.size() + 2) << "the files of this table, and no other";
}

// 320 MB of points in less memory, in which they could not even be read.
TEST_F(HullCommandTest, AStreamNeedsLittleMemory) {
  const std::string npy = (folder() / "large.npy").string();
  succeeded(run_program({HULLBENCH, "points", "ca", "--n", "20000000", "--out", npy}));
#ifdef HAS_GDAL
  const std::string little = "ulimit -v 300000;";  // more than half of it for the libraries alone
#else
  const std::string little = "ulimit -v 200000;";
#endif
  for (const std::string limit : {" --max-perimeter 0.4", ""}) {
    const std::string arguments = std::string("'").append(npy).append("' --threads 1").append(limit);
    const Outcome streamed = succeeded(in_shell(little, arguments + " --stream"));
    EXPECT_EQ(json::parse(streamed.out)["properties"]["points"], 20000000);
    EXPECT_EQ(in_shell("", arguments).out, streamed.out);
    expect_refusal(in_shell(little, arguments), 1, "there is not enough memory for the points");
  }
}

}  // namespace
}  // namespace hullbench::testing
