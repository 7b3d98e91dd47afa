// LAS files of every version and point format: the points, which of them, how they are grouped, where they
// are; and files that lie.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <random>

#include "tests/complaint.hpp"
#include "tests/las_file.hpp"
#include "tests/point_reading_test.hpp"
#include "tool/points/kept_points.hpp"
#include "tool/points/point_file.hpp"
#include "tool/points/point_sources.hpp"

namespace polylidar::tool {
namespace {

using hullbench::testing::expect_complaint;
using hullbench::testing::geographic;
using hullbench::testing::LasFile;
using hullbench::testing::LasPoint;
using hullbench::testing::LasRecord;
using hullbench::testing::Points;
using hullbench::testing::projected;

/// Which versions may have the point format: 0 and 1 since 1.0, 2 and 3 since 1.2, 4 and 5 since 1.3, the
/// rest since 1.4.
unsigned first_version_of(unsigned format) {
  return format < 2 ? 0 : format < 4 ? 2 : format < 6 ? 3 : 4;
}

LasFile some_points(unsigned minor, unsigned format) {
  LasFile file;
  file.minor = minor;
  file.format = format;
  file.scale = {0.001, 0.01};
  file.offset = {500000, -4000000};
  std::mt19937 random(minor + 10 * format);
  for (int i = 0; i < 40000; ++i) {
    const unsigned returns = 1 + static_cast<unsigned>(random()) % 5;
    file.points.push_back({.x = static_cast<std::int32_t>(random()),
                           .y = static_cast<std::int32_t>(random()),
                           .number = 1 + static_cast<unsigned>(random()) % returns,
                           .returns = returns,
                           .classification = static_cast<unsigned>(random()) % 32,
                           .source = static_cast<unsigned>(random()) % 65536});
  }
  file.points[7].x = std::numeric_limits<std::int32_t>::min();
  file.points[8].y = std::numeric_limits<std::int32_t>::max();
  return file;
}

class LasPointsTest : public PointReadingTest {
 protected:
  PointFile read(const LasFile& las, const PointFileOptions& options = {}) const {
    return read_bytes(las.text(), options);
  }
  PointFile read_bytes(const std::string& bytes, const PointFileOptions& options = {}) const {
    return read_point_file(written(bytes), options);
  }
  /// The path of a file with these bytes.
  std::string written(const std::string& bytes) const { return file("points.las", bytes); }

  void expect_refusal(const std::string& bytes, const std::string& words,
                      const PointFileOptions& options = {}) const {
    expect_complaint<PointFileError>([&] { read_bytes(bytes, options); }, words);
  }
};

TEST_F(LasPointsTest, EveryVersionAndFormat) {
  for (unsigned format = 0; format <= 10; ++format) {
    for (unsigned minor = first_version_of(format); minor <= 4; ++minor) {
      LasFile file = some_points(minor, format);
      EXPECT_EQ(read(file).points, file.places()) << "1." << minor << ", format " << format;
      file.extra_bytes = 5;
      file.records = {{"somebody", 3, std::string(1000, 'x')}, projected(25832)};
      const PointFile more = read(file);
      EXPECT_EQ(more.points, file.places()) << "1." << minor << ", format " << format << " with more bytes";
      EXPECT_EQ(more.crs, (Crs{25832, false, true}));
    }
  }
}

TEST_F(LasPointsTest, TheCountIsTheLongOneWhereThereIsOne) {
  LasFile file = some_points(4, 6);
  file.has_legacy_count = false;
  EXPECT_EQ(read(file).points, file.places());
  file.has_legacy_count = true;
  EXPECT_EQ(read(file).points, file.places());
  // Only the legacy count is there.
  std::string text = file.text();
  text.replace(247, 8, 8, '\0');
  EXPECT_EQ(read_bytes(text).points, file.places());
}

TEST_F(LasPointsTest, PointsThatTheHeaderDoesNotCountAreTold) {
  const LasFile file = some_points(2, 1);
  std::string text = file.text();
  EXPECT_EQ(read_bytes(text).note, "");
  const std::uint32_t counted = 39000;
  text.replace(107, 4, reinterpret_cast<const char*>(&counted), 4);
  const PointFile fewer = read_bytes(text);
  EXPECT_EQ(fewer.points.size(), counted);
  EXPECT_EQ(
      fewer.note,
      "its header counts 39000 points, and there is room for 1000 more behind them, which are left out");
}

TEST_F(LasPointsTest, ChoosesByReturnClassWindowAndLeavesOutTheWithheld) {
  for (const unsigned format : {1U, 7U}) {
    LasFile file = some_points(4, format);
    for (std::size_t i = 0; i < file.points.size(); i += 3) file.points[i].withheld = true;
    const auto expect = [&](const PointFileOptions& options, const auto& is_taken) {
      Points expected;
      std::uint64_t sixes = 0;
      for (const LasPoint& point : file.points) {
        if (point.withheld || !is_taken(point)) continue;
        expected.push_back(file.place(point));
        if (point.classification == 6) ++sixes;
      }
      EXPECT_GT(expected.size(), 100U);
      const PointFile got = read(file, options);
      EXPECT_EQ(got.points, expected);
      EXPECT_EQ(got.classes[6], sixes);
    };
    expect({}, [](const LasPoint&) { return true; });
    expect({.returns = Returns::kFirst}, [](const LasPoint& p) { return p.number == 1; });
    expect({.returns = Returns::kLast}, [](const LasPoint& p) { return p.number == p.returns; });
    std::bitset<256> classes;
    classes.set(2).set(6);
    expect({.classes = classes},
           [](const LasPoint& p) { return p.classification == 2 || p.classification == 6; });
    const Box window = {{-500000, -1e7}, {700000, 3e6}};
    expect({.window = window}, [&](const LasPoint& p) {
      const Point place = file.place(p);
      return place.x >= window.min.x && place.x <= window.max.x && place.y >= window.min.y &&
             place.y <= window.max.y;
    });
    expect({.returns = Returns::kFirst, .classes = classes}, [](const LasPoint& p) {
      return p.number == 1 && (p.classification == 2 || p.classification == 6);
    });
  }
}

TEST_F(LasPointsTest, TheHeaderSaysWhatToExpect) {
  LasFile file = some_points(4, 6);
  const auto expected = [&](const PointFileOptions& options = {}) {
    return expected_points(written(file.text()), options);
  };
  const Box box = bounding_box(file.places());
  // Not rounded to what the whole numbers of the file stand for.
  file.box = {{box.min.x - 0.0004, box.min.y + 0.004}, {box.max.x + 0.0004, box.max.y - 0.004}};
  ASSERT_TRUE(expected());
  EXPECT_EQ(expected()->count, file.points.size());
  EXPECT_EQ(expected()->box, box);
  file.box.max.x += 0.001;
  EXPECT_NE(expected()->box, box);
  // Where the options leave points out, the header says nothing of the others.
  EXPECT_FALSE(expected({.returns = Returns::kFirst}));
  EXPECT_FALSE(expected({.classes = std::bitset<256>(4)}));
  EXPECT_FALSE(expected({.window = box}));
  // A lie must be no more than that.
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double value : {kNan, kInfinity, -kInfinity, 1e300}) {
    file.box.min.x = value;
    EXPECT_TRUE(expected());
  }
  file.scale.x = 0;
  EXPECT_TRUE(expected());
  file.minor = 2;
  file.format = 1;
  EXPECT_TRUE(expected());
  const std::string cut = written(file.text().substr(0, 300));
  EXPECT_FALSE(expected_points(cut, {}));
  EXPECT_FALSE(expected_points(cut + ".missing", {}));
}

// Blocks with withheld points and others, in all ways to take the points.
TEST_F(LasPointsTest, WithheldPointsAreInSomeBlocksOnly) {
  for (const unsigned format : {1U, 7U}) {
    LasFile file = some_points(4, format);
    for (std::size_t i = 14'000; i < 20'000; ++i) file.points[i].withheld = i % 2 == 0;
    Points expected;
    std::array<std::uint64_t, 256> classes{};
    for (const LasPoint& point : file.points) {
      if (point.withheld) continue;
      expected.push_back(file.place(point));
      ++classes[point.classification];
    }
    const PointFile whole = read(file);
    EXPECT_EQ(whole.points, expected);
    EXPECT_EQ(whole.classes, classes);
    for (const std::size_t parts : {1U, 3U}) {
      const PointFile together = read_in_parts(written(file.text()), parts);
      EXPECT_EQ(together.points, expected);
      EXPECT_EQ(together.classes, classes);
    }
  }
}

// Many blocks, some with withheld points and some without, in three parts. When all were kept, the file is
// not needed again; what was too much to keep is read again.
TEST_F(LasPointsTest, ASourceKeepsItsPointsAndReadsTheFileOnce) {
  std::mt19937 random(7);
  LasFile file;
  file.format = 6;
  file.minor = 4;
  file.scale = {0.001, 0.01};
  file.offset = {1e6 / 3, -7};
  Points places;
  for (int i = 0; i < 60'000; ++i) {
    LasPoint point;
    point.x = static_cast<std::int32_t>(random());
    point.y = static_cast<std::int32_t>(random());
    point.classification = random() % 256;
    point.withheld = i > 20'000 && i < 45'000 && random() % 3 == 0;
    if (!point.withheld) places.push_back(file.place(point));
    file.points.push_back(point);
  }
  const std::string path = written(file.text());
  constexpr std::size_t kParts = 3;
  std::uint64_t told = 0;  // points, by their classes
  const auto on_read = [&](std::size_t, const PointFile& part) {
    for (const std::uint64_t count : part.classes) told += count;
  };
  const std::uint64_t enough = sizeof(point_files::LatticePoint) * file.points.size();
  const std::vector<PointSource> kept = point_sources(path, {}, kParts, enough, on_read);
  const std::vector<PointSource> not_kept =
      point_sources(path, {}, kParts, enough - sizeof(point_files::LatticePoint) * kParts, on_read);
  ASSERT_EQ(kept.size(), kParts);
  for (const auto* sources : {&kept, &not_kept}) {
    for (int pass = 0; pass < 3; ++pass) {
      told = 0;
      EXPECT_EQ(points_of(*sources), places);
      EXPECT_EQ(told, places.size());
    }
  }
  std::filesystem::remove(path);
  EXPECT_EQ(points_of(kept), places);
  EXPECT_THROW(points_of(not_kept), PointFileError);
}

// What a first reading that failed has kept is not taken for the file.
TEST_F(LasPointsTest, ASourceThatFailedIsReadFromItsBeginning) {
  const LasFile file = some_points(2, 1);
  const std::vector<PointSource> sources =
      point_sources(written(file.text()), {}, 1, 1U << 20U, [](std::size_t, const PointFile&) {});
  const auto fail = [](std::span<const Point>) { throw std::runtime_error("stop"); };
  EXPECT_THROW(sources[0](fail), std::runtime_error);
  EXPECT_EQ(points_of(sources), file.places());
  EXPECT_EQ(points_of(sources), file.places()) << "again";
}

TEST_F(LasPointsTest, PointsOfAnyLength) {
  LasFile file = some_points(2, 3);
  file.points.resize(100);
  file.extra_bytes = 65535 - 34;
  EXPECT_EQ(read(file).points, file.places());
  file.points.clear();
  EXPECT_TRUE(read(file).points.empty());
}

TEST_F(LasPointsTest, AnExtendedClassNeedsItsWholeByte) {
  LasFile file;
  file.minor = 4;
  file.format = 6;
  file.points = {{.x = 1, .classification = 200}, {.x = 2, .classification = 8}};
  std::bitset<256> classes;
  classes.set(200);
  EXPECT_EQ(read(file, {.classes = classes}).points, (Points{{0.01, 0}}));
}

TEST_F(LasPointsTest, GroupsBySmallNumbers) {
  LasFile file = some_points(4, 8);
  for (const auto& [by, value] :
       {std::pair{"classification", &LasPoint::classification}, std::pair{"return", &LasPoint::number},
        std::pair{"point_source", &LasPoint::source}}) {
    const PointFile got = read(file, {.by = by});
    ASSERT_EQ(got.groups.size(), file.points.size());
    for (std::size_t i = 0; i < got.groups.size(); i += 97) {
      EXPECT_EQ(got.labels[got.groups[i]], std::to_string(file.points[i].*value)) << by;
    }
    EXPECT_TRUE(std::is_sorted(got.labels.begin(), got.labels.end(),
                               [](const auto& a, const auto& b) { return std::stoi(a) < std::stoi(b); }));
  }
  expect_refusal(file.text(), "a LAS file has no column 'height' to group by", {.by = "height"});
}

TEST_F(LasPointsTest, TheCoordinateSystemOfGeoKeysAndText) {
  const auto crs_of = [&](const std::vector<LasRecord>& records,
                          const std::vector<LasRecord>& extended = {}) {
    LasFile file = some_points(4, 6);
    file.records = records;
    file.extended_records = extended;
    const PointFile got = read(file);
    EXPECT_EQ(got.points.size(), file.points.size());
    return got.crs;
  };
  const std::string utm =
      R"(PROJCS["a",GEOGCS["b",DATUM["d",SPHEROID["s",1,2,AUTHORITY["EPSG","7030"]]],AUTHORITY["EPSG","4326"]],)"
      R"(UNIT["m",1,AUTHORITY["EPSG","9001"]],AUTHORITY["EPSG","32633"]])";
  const LasRecord text = {"LASF_Projection", 2112, utm + std::string(9, '\0')};
  EXPECT_EQ(crs_of({}), Crs());
  EXPECT_EQ(crs_of({geographic(4258)}), (Crs{4258, true, true}));
  EXPECT_EQ(crs_of({projected(32767)}), (Crs{0, false, true})) << "user-defined";
  const LasRecord citations = {"LASF_Projection", 34737,
                               "WGS 84 / UTM zone 33N|WGS 84|" + std::string(3, '\0')};
  const auto cited = [](std::uint16_t model, std::uint16_t key, std::uint16_t at, std::uint16_t unit) {
    return LasRecord{
        "LASF_Projection", 34735,
        hullbench::testing::geokeys({1,   1,     0,  4,  1024, 0, 1, model, 3072, 0, 1, 32767,  //
                                     key, 34737, 22, at, 3076, 0, 1, unit})};
  };
  EXPECT_EQ(crs_of({cited(1, 3073, 0, 9001), citations}), (Crs{32633, false, true}));
  EXPECT_EQ(crs_of({citations, cited(1, 1026, 0, 9001)}), (Crs{32633, false, true})) << "in either order";
  EXPECT_EQ(crs_of({cited(2, 2049, 22, 9001), citations}), (Crs{4326, true, true}));
  EXPECT_EQ(crs_of({cited(1, 3073, 22, 9001), citations}), (Crs{0, false, true})) << "of another kind";
  EXPECT_EQ(crs_of({cited(1, 3073, 0, 9003), citations}), (Crs{0, false, true})) << "in feet";
  EXPECT_EQ(crs_of({cited(1, 3073, 40, 9001), citations}), (Crs{0, false, true})) << "beyond the texts";
  EXPECT_EQ(crs_of({cited(1, 3073, 0, 9001)}), (Crs{0, false, true})) << "without texts";
  EXPECT_EQ(crs_of({text}), (Crs{32633, false, true}));
  EXPECT_EQ(crs_of({projected(25832), text}), (Crs{32633, false, true})) << "text goes first";
  EXPECT_EQ(crs_of({text, projected(25832)}), (Crs{32633, false, true})) << "in either order";
  EXPECT_EQ(crs_of({}, {{"other", 1, "x"}, text}), (Crs{32633, false, true})) << "behind the points";
  EXPECT_EQ(crs_of({{"other", 2112, utm}}), Crs()) << "somebody else's record";
  EXPECT_EQ(crs_of({{"LASF_Projection", 2112, "\xFF[[[\"("}}), Crs());
  EXPECT_EQ(crs_of({{"LASF_Projection", 34735, "\1"}}), Crs());
}

TEST_F(LasPointsTest, TheSystemBesideIsThatOfAFileThatNamesNone) {
  file("points.prj", R"(PROJCS["a",AUTHORITY["EPSG","25833"]])");
  LasFile las = some_points(2, 1);
  EXPECT_EQ(read(las).crs, (Crs{25833, false, true}));
  las.records = {projected(25832)};
  EXPECT_EQ(read(las).crs, (Crs{25832, false, true}));
}

TEST_F(LasPointsTest, FilesThatLieAreRefused) {
  const LasFile whole = some_points(2, 1);
  const std::string text = whole.text();
  for (const std::size_t size : {5U, 100U, 226U, 227U, 500U, 60000U}) {
    const std::string words = size < 227 ? "its LAS header is not whole" : "it ends before the 40000 points";
    expect_refusal(text.substr(0, size), words);
  }
  expect_refusal("<html>404</html>", "it does not begin with LASF");
  const auto changed = [&](std::size_t place, const std::string& bytes) {
    std::string bad = text;
    return bad.replace(place, bytes.size(), bytes);
  };
  expect_refusal(changed(24, "\2"), "says version 2.2");
  expect_refusal(changed(25, "\5"), "says version 1.5");
  expect_refusal(changed(104, "\x0B"), "says point format 11");
  expect_refusal(changed(104, "\x03"), "says point format 3 with 28 bytes a point");
  expect_refusal(changed(105, std::string(2, '\0')), "with 0 bytes a point");
  expect_refusal(changed(94, std::string(2, '\0')), "says that it has 0 bytes");
  expect_refusal(changed(96, hullbench::testing::bytes_of(std::uint32_t{9})), "begin at byte 9");
  expect_refusal(changed(96, hullbench::testing::bytes_of(std::uint32_t{0xFFFFFFFFU})),
                 "it ends before the points");
  expect_refusal(changed(107, "\xFF\xFF\xFF\xFF"), "it ends before the 4294967295 points");
  for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN(), 1e308}) {
    expect_refusal(changed(131, hullbench::testing::bytes_of(bad)), "has a scale or an offset");
  }
  // The points are read whatever records say.
  EXPECT_EQ(read_bytes(changed(100, "\xFF\xFF\xFF\xFF")).points, whole.places());

  LasFile huge = some_points(4, 6);
  huge.promised = std::uint64_t{1} << 63U;
  expect_refusal(huge.text(), "it ends before the 9223372036854775808 points");
  huge.promised = {};
  huge.extended_records = {{"x", 1, "y"}};
  std::string far = huge.text();
  far.replace(235, 8, 8, '\xFF');
  EXPECT_EQ(read_bytes(far).points, huge.places());
}

}  // namespace
}  // namespace polylidar::tool
