// Readers of point files: every form gives the same points, every fault one sentence, and no bytes a crash.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>

#include "tests/complaint.hpp"
#include "tests/las_file.hpp"
#include "tests/point_file_texts.hpp"
#include "tests/point_reading_test.hpp"
#include "tool/points/point_file.hpp"

namespace polylidar::tool {
namespace {

using namespace hullbench::testing;

class PointFilesTest : public PointReadingTest {
 protected:
  Points read(const std::string& name, const std::string& text, const PointFileOptions& options = {}) const {
    return read_points(file(name, text), options);
  }

  Points read_columns(const std::string& text, const std::string& columns) const {
    PointFileOptions options;
    options.columns = columns;
    return read("columns.csv", text, options);
  }

  /// What the refusal says; a failure of the test when there is none.
  std::string refusal(const std::string& name, const std::string& text,
                      const PointFileOptions& options = {}) const {
    std::string said = complaint_of<PointFileError>([&] { read(name, text, options); });
    EXPECT_NE(said, kNoComplaint) << name << " was read\n" << text.substr(0, 200);
    return said;
  }
};

TEST_F(PointFilesTest, EveryFormGivesTheSamePoints) {
  const Points points = random_points(500, 1);
  for (const PointFileText& form : all_forms(points)) {
    EXPECT_EQ(read(form.name, form.text), points) << form.name;
    // Without an ending the content must tell.
    EXPECT_EQ(read("any_" + form.name.substr(0, form.name.find('.')), form.text), points) << form.name;
  }
}

TEST_F(PointFilesTest, FilesOfManyBlocks) {
  const Points points = random_points(150000, 2);
  for (const PointFileText& form : all_forms(points))
    EXPECT_EQ(read(form.name, form.text), points) << form.name;
}

TEST_F(PointFilesTest, TypesOfNumPyArrays) {
  const Points points = {{-3, 5}, {100, -128}, {0, 127}};
  for (const bool fortran : {false, true}) {
    for (const std::string order : {"<", ">"}) {
      EXPECT_EQ(read("f4.npy", npy_of<float>(points, order + "f4", fortran)), points);
      EXPECT_EQ(read("i8.npy", npy_of<std::int64_t>(points, order + "i8", fortran)), points);
      EXPECT_EQ(read("i4.npy", npy_of<std::int32_t>(points, order + "i4", fortran)), points);
      EXPECT_EQ(read("i2.npy", npy_of<std::int16_t>(points, order + "i2", fortran)), points);
    }
    EXPECT_EQ(read("i1.npy", npy_of<std::int8_t>(points, "|i1", fortran)), points);
  }
  EXPECT_EQ(read("u4.npy", npy_of<std::uint32_t>({{4294967295.0, 1}}, "<u4")), (Points{{4294967295.0, 1}}));
}

TEST_F(PointFilesTest, TypesOfPlyProperties) {
  const auto ply_of = [](const std::string& type, const std::string& data) {
    return "ply\r\nformat binary_little_endian 1.0\nelement vertex 1\nproperty " + type + " x\nproperty " +
           type + " y\nend_header\n" + data;
  };
  const auto pair = [](auto x, auto y) { return bytes_of(x) + bytes_of(y); };
  const Points points = {{-2, 3}};
  EXPECT_EQ(read("a.ply", ply_of("char", pair(std::int8_t{-2}, std::int8_t{3}))), points);
  EXPECT_EQ(read("a.ply", ply_of("int16", pair(std::int16_t{-2}, std::int16_t{3}))), points);
  EXPECT_EQ(read("a.ply", ply_of("int", pair(-2, 3))), points);
  EXPECT_EQ(read("a.ply", ply_of("float32", pair(-2.0F, 3.0F))), points);
  EXPECT_EQ(read("a.ply", ply_of("uchar", pair(std::uint8_t{200}, std::uint8_t{3}))), (Points{{200, 3}}));
  EXPECT_EQ(read("a.ply", ply_of("ushort", pair(std::uint16_t{65535}, std::uint16_t{3}))),
            (Points{{65535, 3}}));
}

TEST_F(PointFilesTest, ColumnsByNameAndByNumber) {
  const std::string text = "id,Lat,lon,X\n7,1,2,3\n8,4,5,6\n";
  EXPECT_EQ(read_columns(text, ""), (Points{{2, 1}, {5, 4}}));
  EXPECT_EQ(read_columns(text, "lon,lat"), (Points{{2, 1}, {5, 4}}));
  EXPECT_EQ(read_columns(text, " x , 2"), (Points{{3, 1}, {6, 4}}));
  EXPECT_EQ(read_columns(text, "4,1"), (Points{{3, 7}, {6, 8}}));
  EXPECT_EQ(read_columns("a,b\n1,2\n", ""), (Points{{1, 2}}));
  EXPECT_EQ(read_columns("house 1 2\n", "2,3"), (Points{{1, 2}}));
  EXPECT_EQ(read_columns("x,X\n1,2\n", "X,x"), (Points{{2, 1}}));
}

TEST_F(PointFilesTest, NamesOfColumnsMayBeNumbersOrHaveDelimitersInQuotes) {
  EXPECT_EQ(read_columns("site,lon,lat,2019,2020\na,7,50,1,2\n", ""), (Points{{7, 50}}));
  EXPECT_EQ(read_columns("x,y,\"species; group\"\n1,2,oak\n", ""), (Points{{1, 2}}));
  EXPECT_EQ(read_columns("\"a;b\";1;2\n", "2,3"), (Points{{1, 2}}));
}

// R's write.table names one column less than there are, decimal commas make two fields of one.
TEST_F(PointFilesTest, ARowWithMoreFieldsThanNamesIsRefusedUnlessColumnsAreNumbers) {
  for (const std::string text : {"\"x\" \"y\"\n\"1\" 0.5 0.7\n", "x,y\n1,5,2,5\n", "V1 V2\n\"1\" 0.5 0.7\n",
                                 "Rechts,Hoch\n1,5,2,5\n", "n,x,y\nHall 3, 5,1,9\n"}) {
    expect_says(refusal("a.csv", text), ", line 2: the line has ");
    EXPECT_NE(refusal("a.csv", text).find("as in 2,3"), std::string::npos);
  }
  EXPECT_EQ(read_columns("\"x\" \"y\"\n\"1\" 0.5 0.7\n", "2,3"), (Points{{0.5, 0.7}}));
  EXPECT_EQ(read_columns("x,y\n1,2,\n", ""), (Points{{1, 2}})) << "nothing is behind the last comma";
  expect_says(refusal("a.csv", "x,y\n1,2\n1,5,2,5\n"), ", line 3: the line has 4 fields");
  EXPECT_EQ(read_columns("x,y,n\n1,2,a\n3,4,\"b,c\"\n", ""), (Points{{1, 2}, {3, 4}})) << "quoted";
  EXPECT_EQ(read_columns("x y\n1 2\n3 4 wall\n", ""), (Points{{1, 2}, {3, 4}})) << "words behind";
  for (const std::string text : {"x,y\n1,2\n,\n", "x\ty\n1\t2\n\t\n"})
    expect_says(refusal("a.csv", text), ", line 3: ");
}

TEST_F(PointFilesTest, APtsFileBeginsWithTheNumberOfPoints) {
  EXPECT_EQ(read("a.pts", "2\n1 2 0 55 1 1 1\n3 4 0 55 1 1 1\n"), (Points{{1, 2}, {3, 4}}));
  EXPECT_TRUE(read("a.pts", "0\n").empty());
  expect_says(refusal("a.pts", "1\n1 2 0\n1\n3 4 0\n"), ", line 3: there is no column 2");
}

TEST_F(PointFilesTest, CommentsAreBeforeTheFirstRow) {
  EXPECT_EQ(read("a.csv", "# of the north\n  # x,y\n1,2\n"), (Points{{1, 2}}));
  EXPECT_EQ(read_columns("id,x,y\n#1,1,2\n#2,3,4\n", ""), (Points{{1, 2}, {3, 4}})) << "names of points";
}

TEST_F(PointFilesTest, TheDelimiterOfASpreadsheet) {
  EXPECT_EQ(read("a.csv", "sep=;\nx;y;z\n1;2;3\n"), (Points{{1, 2}}));
  EXPECT_EQ(read("a.csv", "sep=|\nx|y\n1|2\n"), (Points{{1, 2}}));
}

TEST_F(PointFilesTest, SpellingsOfNumbers) {
  EXPECT_EQ(read("a.csv", "+1,-2e+3\n.5,1E-2\n\"3\",\"4\"\n1e-400,-0\n"),
            (Points{{1, -2000}, {0.5, 0.01}, {3, 4}, {0, -0.0}}));
  EXPECT_EQ(read("a.csv", "0.1,0.30000000000000004\n")[0].y, 0.30000000000000004);
}

TEST_F(PointFilesTest, FilesWithoutPoints) {
  EXPECT_TRUE(read("a.csv", "x,y\n").empty());
  EXPECT_TRUE(read("a.csv", "# nothing\n").empty());
  EXPECT_TRUE(read("a.wkt", "MULTIPOINT EMPTY\n").empty());
  EXPECT_TRUE(read("a.geojson", R"({"type":"FeatureCollection","features":[]})").empty());
  EXPECT_TRUE(read("a.geojson", R"({"type":"MultiPoint","coordinates":[]})").empty());
  EXPECT_TRUE(read("a.npy", npy_of<double>({}, "<f8")).empty());
  EXPECT_TRUE(
      read("a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty int x\nproperty int y\nend_header\n")
          .empty());
}

TEST_F(PointFilesTest, TwoColumnsWithUnknownNamesAreTakenInTheirOrder) {
  const PointFile unknown = read_point_file(file("a.csv", "Breite,H\xC3\xB6he\n1,2\n"));
  EXPECT_EQ(unknown.points, (Points{{1, 2}}));
  EXPECT_EQ(unknown.note,
            "the columns 'Breite' and 'H\xC3\xB6he' are taken for x and y; --columns says which is which");
  for (const char* text : {"y,x\n2,1\n", "latitude,lon\n2,1\n", "Lat,LONG\n2,1\n", "1,2\n"}) {
    const PointFile known = read_point_file(file("a.csv", text));
    EXPECT_EQ(known.points, (Points{{1, 2}})) << text;
    EXPECT_EQ(known.note, "") << text;
    EXPECT_EQ(known.crs.is_geographic, text[0] == 'l' || text[0] == 'L') << text;
  }
}

TEST_F(PointFilesTest, AFirstRowThatCountsFromZeroMayBeAHeader) {
  for (const std::string row : {"0,1", "0;1;2", "0 1 2 3"}) {
    std::string next = row;
    std::replace(next.begin(), next.end(), '1', '5');
    const PointFile counted = read_point_file(file("a.csv", row + "\r\n" + next + "\n" + next + "\n"));
    EXPECT_EQ(counted.points, (Points{{0, 1}, {0, 5}, {0, 5}}));
    EXPECT_EQ(counted.note, "the first row '" + row + "' is taken for a point; remove it if it is a header");
  }
  for (const char* text : {"0,1\n", "1,2\n0,1\n", "0,2\n1,2\n", "0,1,3\n1,2,3\n", "0.0,1.0\n1,2\n",
                           "x,y\n0,1\n1,2\n", "00,1\n1,2\n"}) {
    EXPECT_EQ(read_point_file(file("a.csv", text)).note, "") << text;
  }
}

TEST_F(PointFilesTest, TheSystemBesideHasTheNameOfTheFile) {
  file("a.prj", R"(PROJCS["a",AUTHORITY["EPSG","25833"]])");
  const Crs beside = {25833, false, true};
  EXPECT_EQ(read_point_file(file("a.csv", "1,2\n")).crs, beside);
  EXPECT_EQ(read_point_file(file("a.csv.gz", "1,2\n")).crs, beside) << "be it compressed or not";
  EXPECT_EQ(read_point_file(file("a.npy", npy_of<double>({{1, 2}}, "<f8"))).crs, beside);
  file("c.prj", "\xEF\xBB\xBFPROJCS[\"a\",GEOGCS[\"b\"],AUTHORITY[\"EPSG\",\"25833\"]]");
  EXPECT_EQ(read_point_file(file("c.csv", "1,2\n")).crs, beside) << "behind a byte order mark";
  EXPECT_EQ(read_point_file(file("b.csv", "1,2\n")).crs, Crs());
  EXPECT_EQ(read_point_file(file("a.csv", "lon,lat\n1,2\n")).crs, (Crs{4326, true, true}));
  EXPECT_EQ(read_point_file(file("a.geojson", geojson_multipoint({{1, 2}}))).crs, (Crs{4326, true, true}));
}

TEST_F(PointFilesTest, ASystemOfGeoJsonThatHasNoKnownNameIsUnknown) {
  for (const char* crs : {R"({"type":"link","properties":{"href":"a"}})",
                          R"({"type":"EPSG","properties":{"code":25832}})", "null"}) {
    const std::string text = std::string(R"({"type":"Point","coordinates":[1,2],"crs":)") + crs + "}";
    EXPECT_FALSE(read_point_file(file("a.geojson", text)).crs.is_geographic) << crs;
  }
}

TEST_F(PointFilesTest, ThePartsOfAFileHaveItsPoints) {
  Points points;
  for (int i = 0; i < 100'000; ++i) points.push_back({0.5 * i, 0.25 * (i % 1000)});
  LasFile las;
  for (int i = 0; i < 100'000; ++i) las.points.push_back({.x = i, .y = i % 1000, .withheld = i % 7 == 0});
  const std::vector<std::string> paths = {file("a.npy", npy_of<double>(points, "<f8")),
                                          file("b.npy", npy_of<float>(points, "<f4")),
                                          file("c.f64", raw_of(points)), file("d.las", las.text())};
  for (const std::string& path : paths) {
    for (const bool has_window : {false, true}) {
      PointFileOptions options;
      if (has_window) options.window = Box{{100, 5}, {30'000, 200}};
      EXPECT_TRUE(is_read_in_parts(path, options)) << path;
      const Points whole = read_points(path, options);
      for (const std::size_t parts : {1U, 2U, 7U}) {
        EXPECT_EQ(read_in_parts(path, parts, options).points, whole) << path << ' ' << parts;
      }
    }
  }
  points[70'000].x = std::numeric_limits<double>::infinity();
  PointFileOptions second;
  second.take_points = [](std::span<const Point>) {};
  second.part = {1, 2};
  const std::string bad = file("e.npy", npy_of<double>(points, "<f8"));
  expect_complaint<PointFileError>([&] { read_point_file(bad, second); },
                                   "point 70001 has a coordinate that is not finite");
  for (const auto& [name, text] : std::vector<std::pair<const char*, std::string>>{
           {"a.csv", "1,2\n"}, {"fortran.npy", npy_of<double>({{1, 2}}, "<f8", true)}}) {
    EXPECT_FALSE(is_read_in_parts(file(name, text), {})) << name;
  }
}

TEST_F(PointFilesTest, SeveralFilesKeepAsManyPointsAsFitTogether) {
  LasFile las;
  las.points.resize(10);
  const std::string small = file("small.las", las.text());
  las.points.resize(300);
  const std::string large = file("large.las", las.text());
  const std::vector<std::string> paths = {small, file("a.csv", "1,2\n"), large, small};
  using Bytes = std::vector<std::uint64_t>;
  EXPECT_EQ(kept_bytes(paths, {}, 8 * 320), (Bytes{80, 0, 2400, 80}));
  EXPECT_EQ(kept_bytes(paths, {}, 8 * 319), (Bytes{80, 0, 2400, 0}));
  EXPECT_EQ(kept_bytes(paths, {}, 8 * 309), (Bytes{80, 0, 0, 80}));
  EXPECT_EQ(kept_bytes({&large, 1}, {}, 8), Bytes{8}) << "all of it, whatever the file is";
  for (const PointSource& source :
       point_sources(large, {}, 1, kept_bytes(paths, {})[2], [](std::size_t, const PointFile&) {})) {
    EXPECT_EQ(points_of({source}).size(), 300U);
    std::filesystem::remove(large);
    EXPECT_EQ(points_of({source}).size(), 300U) << "it is read once";
  }
}

TEST_F(PointFilesTest, QuotesInQuotedFieldsAreSingleAgain) {
  const std::string text = "x,y,kind\n1,2,\"say \"\"hi\"\"\"\n3,4,\"a, \"\"\"\n5,6,\"\"\n7,8,plain\n";
  const PointFile grouped = read_point_file(file("a.csv", text), {.by = "kind"});
  EXPECT_EQ(grouped.labels, (std::vector<std::string>{"", "a, \"", "plain", "say \"hi\""}));
  EXPECT_EQ(read_columns("\"x\"\"\",y\n1,2\n", "x\",y"), (Points{{1, 2}}));
}

TEST_F(PointFilesTest, GeoJsonIsGroupedByAProperty) {
  const auto feature = [](const std::string& value, const std::string& coordinates) {
    return R"({"type":"Feature","properties":{"kind":)" + value +
           R"(,"a":{"kind":9}},"geometry":{"type":"MultiPoint","coordinates":[)" + coordinates + "]}}";
  };
  const std::string text =
      R"({"type":"FeatureCollection","features":[)" + feature(R"("oak")", "[1,2],[3,4]") + "," +
      feature("7", "[5,6]") + "," + feature("-0.50", "[7,8]") + "," + feature("true", "[9,1]") + "," +
      feature("null", "[9,2]") + "," +
      // In another order, without the property, and without points.
      R"({"geometry":{"type":"Point","coordinates":[1,9]},"properties":{"kind":"oak"},"type":"Feature"},)"
      R"({"type":"Feature","properties":null,"geometry":{"type":"Point","coordinates":[2,9]}},)"
      R"({"type":"Feature","properties":{"kind":"ash"},"geometry":null}]})";
  const PointFile grouped = read_point_file(file("a.geojson", text), {.by = "kind"});
  EXPECT_EQ(grouped.points, (Points{{1, 2}, {3, 4}, {5, 6}, {7, 8}, {9, 1}, {9, 2}, {1, 9}, {2, 9}}));
  EXPECT_EQ(grouped.labels, (std::vector<std::string>{"-0.5", "7", "", "oak", "true"}));
  EXPECT_EQ(grouped.groups, (std::vector<std::uint32_t>{3, 3, 1, 0, 4, 2, 3, 2}));
  const PointFile inside =
      read_point_file(file("a.geojson", text), {.by = "kind", .window = Box{{2, 3}, {6, 6}}});
  EXPECT_EQ(inside.points, (Points{{3, 4}, {5, 6}}));
  EXPECT_EQ(inside.labels, (std::vector<std::string>{"7", "oak"}));
  EXPECT_EQ(inside.groups, (std::vector<std::uint32_t>{1, 0}));
  for (
      const auto& [document, words] : std::vector<std::pair<std::string, std::string>>{
          {feature("[1]", "[1,2]"), "the property 'kind' is a list or an object"},
          {feature("{}", "[1,2]"), "the property 'kind' is a list or an object"},
          {R"({"type":"Feature","properties":{"b":1,"a":2},"geometry":{"type":"Point","coordinates":[1,2]}})",
           "--by 'kind' names no property of its features; they have 'a', 'b'"},
          {geojson_multipoint({{1, 2}}), "they have none"}}) {
    expect_says(refusal("a.geojson", document, {.by = "kind"}), words);
  }
  expect_says(refusal("a.wkt", "POINT (1 2)", {.by = "kind"}), "--by is for columns of text");
}

struct Fault {
  const char* name;
  std::string text;
  std::string words;
};

TEST_F(PointFilesTest, FaultsInColumns) {
  const std::vector<Fault> faults = {
      {"a.csv", "", "it is empty"},
      {"a.csv", "x,y\n1,2\n3\n", ", line 3: there is no column 2"},
      {"a.csv", "id,a,b\n1,2,3\n", ", line 1: none of the columns 'id', 'a', 'b' is known to be x or y"},
      {"a.csv", "Dear reader,\nthis is none\n",
       ", line 2: there is no column 2, as the line has 1; the first row, which has no number, was taken for "
       "names"},
      {"a.csv", "n;H\xC3\xB6he;\xFF\xC3;\xC2\x9B\n1;2;3;4\n",
       "the columns 'n', 'H\xC3\xB6he', '?\?', '?\?' is"},
      {"a.csv", "#\n1,2\n\n3,\n", ", line 4: a coordinate is missing"},
      {"a.csv", "1,2\n# of the south\n", ", line 2: there is no column 2"},
      {"a.csv", "x,y\r1,2\r3,4\r", "line 1: lines end with a carriage return alone"},
      {"a.csv", "1,2\n3,abc\n", ", line 2: 'abc' is not a number"},
      {"a.csv", "1,abc\n", ", line 1: 'abc' is not a number"},
      {"a.csv", "1;2,5\n", "with a point and no comma"},
      {"a.csv", "x,y\n1,nan\n", ", line 2: the coordinate 'nan' is not finite"},
      {"a.csv", "-inf 1\n", ", line 1: the coordinate '-inf' is not finite"},
      {"a.csv", "1e999,1\n", "too large for a double"},
      {"a.csv", "1,\"2\n", "a quote is not closed"},
      {"a.csv", "1,\"2\"3\n", "text follows a closing quote"},
      {"a.csv", "1,0x10\n", "'0x10' is not a number"},
      {"a.csv", "+-1,2\n", "'+-1' is not a number"},
      {"a.csv", "1,\xF4\x8F\xBF\xBF\xED\x9F\xBF\n", "'\xF4\x8F\xBF\xBF\xED\x9F\xBF' is not a number"},
      {"a.csv", "1,\xE0\x9F\xBF\n", "'?\?\?' is not a number"},        // longer than needed
      {"a.csv", "1,\xF0\x8F\xBF\xBF\n", R"('????' is not a number)"},  // longer than needed
      {"a.csv", "1,\xED\xA0\x80\n", "'?\?\?' is not a number"},        // half of a pair
      {"a.csv", "1,\xF4\x90\x80\x80\n", R"('????' is not a number)"},  // beyond U+10FFFF
      {"a.csv", std::string("1,2\0\n", 5), "zero byte"},
      {"a.csv", std::string(2000000, '7'), ", line 1: the line is longer than"},
      {"a.xyz", "1,2\n3,4\n", ", line 1: columns of .xyz, .pts and .asc are separated by blanks"},
      {"a.pts", "2\n1;2\n3;4\n", ", line 2: columns of .xyz, .pts and .asc are separated by blanks"},
      {"a.csv", "LASF\1\2", "its LAS header is not whole"},
      {"a.csv", "\x1F\x8B\x08", "its gzip stream"},
      {"a.csv", "PK\x03\x04", "it is an archive"},
      {"a.csv", "\xFF\xFEx", "UTF-16"},
  };
  for (const Fault& fault : faults) {
    const std::string said = refusal(fault.name, fault.text);
    EXPECT_NE(said.find(fault.words), std::string::npos) << said << "\n" << fault.text.substr(0, 100);
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    expect_says(said, fault.name);
  }
}

TEST_F(PointFilesTest, FaultsInTheChoiceOfColumns) {
  for (const auto& [columns, words] : std::vector<std::pair<std::string, std::string>>{
           {"x", "does not name two columns"},
           {"1,1", "does not name two columns"},
           {"0,1", "does not name two columns"},
           {",", "does not name two columns"},
           {"a,b,", "there is no column 'b,'"},
           {"a,z", ", line 1: there is no column 'z'; the columns of this line are 'a', 'b'"},
           {"1,3", ", line 2: there is no column 3"}}) {
    PointFileOptions options;
    options.columns = columns;
    expect_says(refusal("a.csv", "a,b\n1,2\n", options), words);
    expect_says(refusal("a.wkt", "POINT (1 2)", options), "--columns is for");
  }
}

TEST_F(PointFilesTest, FaultsInGeoJson) {
  const std::vector<Fault> faults = {
      {"a.geojson", "[1,2]", "this is no GeoJSON object"},
      {"a.geojson", "7", "this is no GeoJSON object"},
      {"a.geojson", "{\"type\":\n\"Point\",\n\"coordinates\":[1,nan]}", ", line 3: this is not JSON"},
      {"a.geojson",
       R"({"type":"Point","coordinates":[1,2]})"
       "\n{",
       ", line 2: this is not JSON"},
      {"a.geojson", R"({"type":"Point","coordinates":[1,1e999]})", "number overflow"},
      {"a.geojson", R"({"type":"Point","coordinates":[1,null]})", "a coordinate is null"},
      {"a.geojson", R"({"type":"Point","coordinates":[1]})", "a position has no x and y"},
      {"a.geojson", R"({"type":"MultiPoint","coordinates":[[]]})", "a position has no x and y"},
      {"a.geojson", R"({"type":"MultiPoint","coordinates":[1,2]})", "does not have the form"},
      {"a.geojson", R"({"type":"Point","coordinates":[[1,2]]})", "does not have the form"},
      {"a.geojson", R"({"type":"MultiPoint","coordinates":[[1,2],[[3,4]]]})", "does not have the form"},
      {"a.geojson", R"({"type":"MultiPoint","coordinates":[[1,[2]]]})", "does not have the form"},
      {"a.geojson", R"({"type":"Point","coordinates":["1","2"]})", "does not have the form"},
      {"a.geojson", R"({"type":"Point","coordinates":{"x":1}})", "does not have the form"},
      {"a.geojson", R"({"type":"Point","coordinates":7})", "does not have the form"},
      {"a.geojson", R"({"type":7,"coordinates":[1,2]})", "does not have the form"},
      {"a.geojson", R"({"type":"FeatureCollection","features":[[]]})", "does not have the form"},
      {"a.geojson", R"({"type":"FeatureCollection","features":{}})", "does not have the form"},
      {"a.geojson", R"({"type":"Feature","geometry":[]})", "does not have the form"},
      {"a.geojson", R"({"coordinates":[1,2]})", "has no \"type\""},
      {"a.geojson", R"({"type":"Feature"})", "has not the members of its type"},
      {"a.geojson", R"({"type":"Point"})", "has not the members of its type"},
      {"a.geojson", R"({"coordinates":[[0,0],[1,1]],"type":"LineString"})",
       "of type 'LineString', which is no set"},
      {"a.geojson", R"({"type":"Polygon","coordinates":[[[0,0]]]})", "of type 'Polygon', which is no set"},
  };
  for (const Fault& fault : faults) {
    const std::string said = refusal(fault.name, fault.text);
    EXPECT_NE(said.find(fault.words), std::string::npos) << said << "\n" << fault.text;
    expect_says(said, ", line ");
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST_F(PointFilesTest, FaultsInWkt) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "GEOMETRYCOLLECTION(";
  const std::vector<Fault> faults = {
      {"a.wkt", "POINT (1 2)\nLINESTRING (0 0, 1 1)", ", line 2: 'LINESTRING' is no set of points"},
      {"a.wkt", "POINT (1 nan)", "'nan' is not finite"},
      {"a.wkt", "POINT (1\n)", "a coordinate is missing"},
      {"a.wkt", "POINT (1 2", "')' is missing before the end"},
      {"a.wkt", "POINT 1 2", "a bracket or EMPTY is missing"},
      {"a.wkt", "MULTIPOINT ((1 2) (3 4))", "')' is missing before '('"},
      {"a.wkt", "MULTIPOINT (1 2, EMPT)", "a point is missing"},
      {"a.wkt", "POINT (1 2 3 4 5)", "more than four coordinates"},
      {"a.wkt", "POINT (1 2 z)", "is not a number"},
      {"a.wkt", "(1 2)", "there is no geometry's name"},
      {"a.wkt", "POINT (" + std::string(1000, '1') + " 2)", "a word is too long"},
      {"a.wkt", deep, "collections nest too deeply"},
      {"a.wkt", "SRID=25832;POINT (1 2)\nSRID=4326;POINT (3 4)", "the SRID is 4326, and it was 25832 before"},
  };
  for (const Fault& fault : faults) {
    const std::string said = refusal(fault.name, fault.text);
    EXPECT_NE(said.find(fault.words), std::string::npos) << said << "\n" << fault.text.substr(0, 100);
    expect_says(said, ", line ");
  }
}

TEST_F(PointFilesTest, FaultsInBinaryFiles) {
  const Points points = random_points(3, 3);
  const std::string good = npy_of<double>(points, "<f8");
  const double infinite = std::numeric_limits<double>::infinity();
  const std::string head = "ply\nformat binary_little_endian 1.0\n";
  const std::string vertices = "element vertex 2\nproperty float x\nproperty float y\n";
  const std::vector<Fault> faults = {
      {"a.npy", "NUMPY", "does not begin as a NumPy file does"},
      {"a.npy", good.substr(0, 9), "header is cut short"},
      {"a.npy", good.substr(0, 50), "header is cut short"},
      {"a.npy", good.substr(0, good.size() - 1), "ends before the 3 points"},
      {"a.npy", good + "x", "more bytes follow the 3 points"},
      {"a.npy", npy_of<double>(points, "<f8", false, 4), "of version 4"},
      {"a.npy", npy_of<double>(points, "<c8"), "NumPy type '<c8' is no plain number"},
      {"a.npy", npy_of<double>(points, "<f2"), "is no plain number"},
      {"a.npy", npy("<f8", false, "(2, 3, 1)", std::string(48, '\0')), "and not (n, 2) or (n, 3)"},
      {"a.npy", npy("<f8", false, "(6,)", std::string(48, '\0')), "shape is '(6,)' and not"},
      {"a.npy", npy("<f8", false, "(99999999999999999, 2)", ""), "and not (n, 2)"},
      {"a.npy", npy("<f8", false, "(99999999999, 2)", ""), "ends before the 99999999999 points"},
      {"a.npy", npy_of<double>({{1, 2}, {3, infinite}}, "<f8"),
       "point 2 has a coordinate that is not finite"},
      {"a.npy", npy_of<float>({{1, 2}, {std::nan(""), 1}}, "<f4"),
       "point 2 has a coordinate that is not finite"},
      {"a.npy", npy_of<float>({{infinite, 2}, {3, 1}}, "<f4", true),
       "point 1 has a coordinate that is not finite"},
      {"a.ply", "plyx\n", "does not begin with the line 'ply'"},
      {"a.ply", "ply\nend_header\n", ", line 2: the PLY header has no format"},
      {"a.ply", "ply\nformat utf8 1.0\n", ", line 2: the format 'utf8' is not PLY's"},
      {"a.ply", head, "the PLY header does not end"},
      {"a.ply", head + "wings 2\n", ", line 3: 'wings' is no line of a PLY header"},
      {"a.ply", head + "element vertex\n", "has no number"},
      {"a.ply", head + "property float x\n", "has no name or no element"},
      {"a.ply", head + "element vertex 1\nproperty quad x\n", ", line 4: 'quad' is no type of PLY"},
      {"a.ply", head + "element vertex 1\nproperty list float int x\n", "length is no whole number"},
      {"a.ply", head + "element face 1\nend_header\n", "has no element 'vertex'"},
      {"a.ply", head + "element vertex 1\nproperty float x\nend_header\n", "have no property 'y'"},
      {"a.ply", head + vertices + "end_header\n" + std::string(15, '\0'), "ends before 'vertex' 2 of 2"},
      {"a.ply",
       head + vertices + "end_header\n" + bytes_of(1.F) + bytes_of(1.F) + bytes_of(1.F) +
           bytes_of(std::nanf("")),
       "vertex 2 has a coordinate that is not finite"},
      {"a.ply", head + "element e 1\nproperty list char int i\n" + vertices + "end_header\n\xFF",
       "negative length"},
      {"a.ply", "ply\nformat ascii 1.0\n" + vertices + "end_header\n1 2\n3\n",
       ", line 8: there are fewer numbers"},
      {"a.ply", "ply\nformat ascii 1.0\n" + vertices + "end_header\n1 2\n3 inf\n",
       ", line 8: the coordinate 'inf'"},
      {"a.ply", "ply\nformat ascii 1.0\n" + vertices + "end_header\n1 2\n", "ends before 'vertex' 2"},
  };
  for (const Fault& fault : faults) {
    const std::string said = refusal(fault.name, fault.text);
    EXPECT_NE(said.find(fault.words), std::string::npos) << said << "\n(wanted: " << fault.words << ")";
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST_F(PointFilesTest, NoFileAndAFolder) {
  EXPECT_THROW(read_points("/nowhere/points.csv"), PointFileError);
  expect_complaint<PointFileError>([] { read_points(::testing::TempDir()); }, "it is a folder");
}

TEST_F(PointFilesTest, ProgressTellsBytesAndCanEndTheReading) {
  const std::string text = rows(random_points(100000, 4), ",");
  PointFileOptions options;
  std::uint64_t last = 0;
  options.on_progress = [&](std::uint64_t bytes, std::optional<std::uint64_t> size) {
    EXPECT_GE(bytes, last);
    EXPECT_EQ(size, text.size());
    last = bytes;
  };
  EXPECT_EQ(read("a.csv", text, options).size(), 100000U);
  EXPECT_EQ(last, text.size());
  options.on_progress = [](std::uint64_t, std::optional<std::uint64_t>) { throw std::logic_error("enough"); };
  EXPECT_THROW(read("a.csv", text, options), std::logic_error);
}

/// Bytes at random places changed, cut out, repeated.
std::string mutated(std::string text, std::mt19937_64& random) {
  for (std::uint64_t change = 1 + random() % 4; change > 0 && !text.empty(); --change) {
    const std::size_t place = random() % text.size();
    const std::size_t length = 1 + random() % 8;
    switch (random() % 4) {
      case 0:
        text[place] = static_cast<char>(random());
        break;
      case 1:
        text.erase(place, length);
        break;
      case 2:
        text.insert(place, text.substr(random() % text.size(), length));
        break;
      default:
        text.resize(place);
    }
  }
  return text;
}

TEST_F(PointFilesTest, NoBytesDoMoreThanBeRefused) {
  std::mt19937_64 random(20240611);
  const std::vector<PointFileText> forms = all_forms(random_points(6, 5));
  int refused = 0;
  int read_well = 0;
  for (int round = 0; round < 150; ++round) {
    for (const PointFileText& form : forms) {
      std::string text = mutated(form.text, random);
      if (round % 30 == 0) {
        for (char& c : text) c = static_cast<char>(random());
      }
      PointFileOptions options;
      if (round % 10 == 0) options.format = static_cast<PointFormat>(random() % 9);
      try {
        for (const Point& p : read(form.name, text, options)) {
          EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << form.name;
        }
        ++read_well;
      } catch (const PointFileError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(read_well, 100);
}

}  // namespace
}  // namespace polylidar::tool
