// LAZ files: what a LAS file has is read of the same file, compressed; and files that lie are refused. The
// files are of our own encoder, which report/laz.test.mjs checks with somebody else's decoder.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <random>

#include "tests/complaint.hpp"
#include "tests/las_file.hpp"
#include "tests/laz_file.hpp"
#include "tests/laz_samples.hpp"
#include "tests/point_reading_test.hpp"
#include "tool/points/point_file.hpp"
#include "tool/points/point_sources.hpp"

namespace polylidar::tool {
namespace {

using hullbench::testing::bytes_of;
using hullbench::testing::compressed;
using hullbench::testing::expect_complaint;
using hullbench::testing::las_sample;
using hullbench::testing::LasFile;
using hullbench::testing::LazOptions;
using hullbench::testing::LazSample;
using hullbench::testing::Points;

constexpr unsigned kFormats[] = {0, 1, 2, 3, 6, 7, 8};
constexpr LazSample kSamples[] = {LazSample::kScan, LazSample::kOneBeam, LazSample::kWild,
                                  LazSample::kExtremes, LazSample::kConstant};

class LazPointsTest : public PointReadingTest {
 protected:
  PointFile read(const std::string& bytes, const PointFileOptions& options = {}) const {
    return read_point_file(file("points.laz", bytes), options);
  }

  static PointFile read_from_pipe(const std::string& bytes) {
    EXPECT_LT(bytes.size(), 60'000U) << "more than a pipe holds";
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    EXPECT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
    ::close(ends[1]);
    PointFile file_of_pipe = read_point_file("/dev/fd/" + std::to_string(ends[0]));
    ::close(ends[0]);
    return file_of_pipe;
  }

  void expect_same(const std::string& las, const LazOptions& laz_options,
                   const PointFileOptions& options = {}) const {
    const PointFile expected = read_point_file(file("points.las", las), options);
    const PointFile got = read(compressed(las, laz_options), options);
    EXPECT_EQ(got.points, expected.points);
    EXPECT_EQ(got.classes, expected.classes);
    EXPECT_EQ(got.groups, expected.groups);
    EXPECT_EQ(got.labels, expected.labels);
    EXPECT_EQ(got.crs, expected.crs);
  }

  void expect_refusal(const std::string& bytes, const std::string& words) const {
    expect_complaint<PointFileError>([&] { read(bytes); }, words);
  }
};

/// Where the points of a file begin.
std::size_t points_at(const std::string& laz) {
  return static_cast<unsigned char>(laz[96]) + 256U * static_cast<unsigned char>(laz[97]);
}

TEST_F(LazPointsTest, EveryFormatOfAllKindsOfPoints) {
  for (const unsigned format : kFormats) {
    for (const LazSample sample : kSamples) {
      SCOPED_TRACE("format " + std::to_string(format) + ", sample " +
                   std::to_string(static_cast<int>(sample)));
      expect_same(las_sample(sample, format, format % 4, 20'000, format), {});
    }
  }
}

TEST_F(LazPointsTest, ChunksOfAllSizes) {
  for (const unsigned format : {1U, 7U}) {
    const std::string las = las_sample(LazSample::kScan, format, 2, 3000, 5);
    for (const std::uint32_t size : {1U, 2U, 999U, 1000U, 2999U, 3000U, 3001U, 0xFFFFFFFEU}) {
      SCOPED_TRACE("format " + std::to_string(format) + ", chunks of " + std::to_string(size));
      expect_same(las, {.chunk_size = size});
      expect_same(las, {.chunk_size = size, .has_table_place_at_end = true});
    }
    expect_same(las, {.chunks = {1, 1500, 2, 1400, 97}});
    expect_same(las, {.chunks = {3000}});
    expect_same(las_sample(LazSample::kScan, format, 2, 1, 5), {});
    expect_same(las_sample(LazSample::kScan, format, 2, 0, 5), {});
  }
}

TEST_F(LazPointsTest, OneChunkWithoutATable) {
  for (const unsigned format : {0U, 3U}) {
    expect_same(las_sample(LazSample::kScan, format, 1, 3000, 5), {.is_chunked = false});
  }
}

TEST_F(LazPointsTest, ChoosesAndGroups) {
  for (const unsigned format : {1U, 6U}) {
    for (const LazSample sample : {LazSample::kScan, LazSample::kWild}) {
      const std::string las = las_sample(sample, format, 0, 5000, 3);
      const LazOptions laz = {.chunk_size = 700};
      for (const char* by : {"classification", "return", "point_source"}) expect_same(las, laz, {.by = by});
      expect_same(las, laz, {.returns = Returns::kFirst});
      expect_same(las, laz, {.returns = Returns::kLast});
      expect_same(las, laz, {.by = "point_source", .classes = std::bitset<256>(0xFF)});
      expect_same(las, laz, {.window = Box{{-1e6, -1e6}, {1e6, 50}}});
    }
  }
}

TEST_F(LazPointsTest, RecordsInFrontOfThePointsAndBehindThem) {
  LasFile las;
  las.minor = 4;
  las.format = 6;
  las.points.resize(100);
  las.records = {hullbench::testing::projected(25832), {"somebody", 3, std::string(1000, 'x')}};
  expect_same(las.text(), {});
  las.records.clear();
  las.extended_records = {{"LASF_Projection", 2112, R"(PROJCS["a",AUTHORITY["EPSG","25833"]])"}};
  expect_same(las.text(), {});
  EXPECT_EQ(read(compressed(las.text())).crs.epsg, 25833);
  las.extended_records.insert(las.extended_records.begin(),
                              hullbench::testing::LasRecord{"somebody", 3, std::string(1000, 'x')});
  EXPECT_EQ(read_from_pipe(compressed(las.text())).crs.epsg, 25833);
  std::string cut = compressed(las.text());
  cut.resize(cut.size() - 1);
  EXPECT_EQ(read_from_pipe(cut).crs, Crs()) << "as of a file";
  EXPECT_EQ(read(cut).crs, Crs());
  las.points.clear();
  EXPECT_EQ(read_from_pipe(compressed(las.text())).crs.epsg, 25833);
}

// A pipe has no place to go back to, and its table of chunks is at the end.
TEST_F(LazPointsTest, FromAPipe) {
  for (const unsigned format : {1U, 8U}) {
    for (const bool at_end : {false, true}) {
      const std::string las = las_sample(LazSample::kScan, format, 1, 1500, 5);
      const std::string laz = compressed(las, {.chunk_size = 400, .has_table_place_at_end = at_end});
      EXPECT_EQ(read_from_pipe(laz).points, read_points(file("points.las", las)));
    }
  }
}

TEST_F(LazPointsTest, PartsAreChunksAndTogetherTheFile) {
  for (const unsigned format : {3U, 7U}) {
    const std::string las = las_sample(LazSample::kScan, format, 0, 5000, 9);
    const PointFile whole = read_point_file(file("points.las", las));
    for (const LazOptions& laz : {LazOptions{.chunk_size = 300}, LazOptions{.chunks = {10, 4000, 1, 1, 988}},
                                  LazOptions{.chunk_size = 5000, .is_chunked = format >= 6}}) {
      const std::string path = file("points.laz", compressed(las, laz));
      ASSERT_TRUE(is_read_in_parts(path, {}));
      for (const std::size_t parts : {1U, 2U, 7U, 40U}) {
        const PointFile together = read_in_parts(path, parts);
        EXPECT_EQ(together.points, whole.points);
        EXPECT_EQ(together.classes, whole.classes);
      }
    }
  }
}

TEST_F(LazPointsTest, ASourceKeepsItsPoints) {
  const std::string las = las_sample(LazSample::kScan, 1, 0, 5000, 9);
  const Points expected = read_points(file("points.las", las));
  const std::string path = file("points.laz", compressed(las, {.chunk_size = 300}));
  const auto sources = point_sources(path, {}, 3, 1U << 20U, [](std::size_t, const PointFile&) {});
  ASSERT_EQ(sources.size(), 3U);
  for (int pass = 0; pass < 2; ++pass) {
    EXPECT_EQ(points_of(sources), expected);
    std::filesystem::remove(path);
  }
}

TEST_F(LazPointsTest, WhatIsNotKnownSaysWhatToDo) {
  const std::string las = las_sample(LazSample::kScan, 1, 0, 100, 5);
  const std::string laz = compressed(las);
  const std::size_t record = laz.find("laszip encoded") - 2 + 54;
  const auto changed = [&](std::size_t place, const std::string& bytes) {
    std::string bad = laz;
    return bad.replace(place, bytes.size(), bytes);
  };
  const std::string convert = "convert it, as in 'pdal translate in.laz out.las'";
  expect_refusal(changed(record, bytes_of(std::uint16_t{4})), "compressor 4 and coder 0");
  expect_refusal(changed(record, bytes_of(std::uint16_t{0})), convert);
  expect_refusal(changed(record + 2, bytes_of(std::uint16_t{1})), "compressor 2 and coder 1");
  expect_refusal(changed(record + 38, bytes_of(std::uint16_t{1})), "with items of version 1, and 2 is known");
  expect_refusal(changed(record + 42, bytes_of(std::uint16_t{3})), "point format 1 with 28 bytes a point");
  expect_refusal(changed(record + 34, bytes_of(std::uint16_t{9})), "does not fit point format 1");
  expect_refusal(changed(record + 32, bytes_of(std::uint16_t{0xFFFF})), "does not fit point format 1");
  expect_refusal(changed(record - 54 + 2, "laszip decoded"), "no record \"laszip encoded\" says how");
  expect_refusal(changed(104, "\x84"), "says point format 4 with 28 bytes");
  // Either of the two top bits says that points are compressed.
  EXPECT_EQ(read(changed(104, "\x41")).points, read_points(file("points.las", las)));
  LasFile waves;
  waves.minor = 3;
  waves.format = 4;
  waves.records = {{"laszip encoded", 22204, std::string(34, '\0')}};
  std::string text = waves.text();
  text[104] = '\x84';
  expect_refusal(text, "with waveforms");
}

// LASzip takes chunks of 0 points for chunks that each have their own size.
TEST_F(LazPointsTest, ChunksOfNoSizeHaveTheirOwn) {
  const std::string las = las_sample(LazSample::kScan, 1, 0, 100, 5);
  std::string laz = compressed(las, {.chunks = {60, 40}});
  laz.replace(laz.find("laszip encoded") - 2 + 54 + 12, 4, bytes_of(std::uint32_t{0}));
  EXPECT_EQ(read(laz).points, read_points(file("points.las", las)));
}

// Nothing is read while a chunk is unpacked, which may be all of the file.
TEST_F(LazPointsTest, UnpackingAChunkTellsProgress) {
  const auto calls_for = [&](std::size_t points) {
    std::size_t calls = 0;
    PointFileOptions options;
    options.on_progress = [&](std::uint64_t, std::optional<std::uint64_t>) { ++calls; };
    read(compressed(las_sample(LazSample::kConstant, 6, 0, points, 1), {.chunk_size = 100'000}), options);
    return calls;
  };
  EXPECT_GT(calls_for(60'000), calls_for(20'000));
}

TEST_F(LazPointsTest, FilesThatLieAreRefused) {
  for (const unsigned format : {1U, 7U}) {
    const std::string las = las_sample(LazSample::kScan, format, 1, 3000, 5);
    const std::string laz = compressed(las, {.chunk_size = 1000});
    const std::size_t begin = points_at(laz);
    const auto changed = [&](std::size_t place, const std::string& bytes) {
      std::string bad = laz;
      return bad.replace(place, bytes.size(), bytes);
    };
    for (std::size_t size = begin; size < laz.size() - 4; size += 97) {
      expect_complaint<PointFileError>([&] { read(laz.substr(0, size)); }, "; ");
    }
    const std::string short_words = "it ends before the 3000 points that its header promises";
    expect_refusal(laz.substr(0, begin + 3), short_words);
    expect_refusal(changed(begin, bytes_of(std::uint64_t{1} << 40U)), short_words);
    expect_refusal(changed(begin, bytes_of(std::uint64_t{begin} + 7)), short_words);
    expect_refusal(changed(begin, bytes_of(std::uint64_t{begin})), "its writing was interrupted");
    expect_refusal(changed(begin, bytes_of(~std::uint64_t{0})), short_words);
    const auto table =
        static_cast<std::size_t>(laz.rfind(bytes_of(std::uint32_t{0}) + bytes_of(std::uint32_t{3})));
    ASSERT_NE(table, std::string::npos);
    expect_refusal(changed(table + 4, bytes_of(std::uint32_t{2})), short_words);
    expect_refusal(changed(table + 4, bytes_of(~std::uint32_t{0})), "the table of its compressed points");
    expect_refusal(changed(table, bytes_of(std::uint32_t{1})), "the table of its compressed points");
    expect_refusal(changed(table + 8, "\xFF\xFF\xFF\xFF"), "the table of its compressed points");
    // The first chunk has fewer points than are promised.
    const std::size_t record = laz.find("laszip encoded") - 2 + 54;
    expect_refusal(changed(record + 12, bytes_of(std::uint32_t{1'000'000})), "points 1 to 3000 are damaged");
  }
}

// Layers that nobody asked for are passed over, whatever they hold.
TEST_F(LazPointsTest, LayersThatEndTooEarlyAreRefused) {
  constexpr std::size_t kRecord = 30;
  constexpr std::size_t kLayers = 9;
  constexpr std::size_t kLeft = 50;
  const std::string laz = compressed(las_sample(LazSample::kScan, 6, 0, 3000, 5));
  const PointFileOptions by_source = {.by = "point_source"};
  const std::size_t sizes = points_at(laz) + 8 + kRecord + 4;
  std::size_t begin = sizes + 4 * kLayers;
  for (std::size_t layer = 0; layer < kLayers; ++layer) {
    std::uint32_t size = 0;
    std::uint64_t table_at = 0;
    std::memcpy(&size, &laz[sizes + 4 * layer], sizeof size);
    std::memcpy(&table_at, &laz[points_at(laz)], sizeof table_at);
    ASSERT_GT(size, kLeft);
    std::string bad = laz;
    bad.replace(sizes + 4 * layer, 4, bytes_of(std::uint32_t{kLeft}));
    bad.erase(begin + kLeft, size - kLeft);
    bad.insert(table_at - (size - kLeft), size - kLeft, '\0');
    begin += size;
    if (layer == 0 || layer == 2 || layer == 3) {
      expect_refusal(bad, "its compressed points 1 to 3000 are damaged");
    } else {
      EXPECT_EQ(read(bad).points, read(laz).points) << layer;
    }
    const auto with_source = [&] {
      EXPECT_EQ(read(bad, by_source).groups, read(laz, by_source).groups) << layer;
    };
    if (layer == 7) expect_complaint<PointFileError>(with_source, "are damaged");
    if (layer == 8) with_source();
  }
}

// Bytes that are any: points of any place are read, or the file is refused.
TEST_F(LazPointsTest, DamagedBytesAreReadOrRefused) {
  std::mt19937 random(1);
  std::size_t refused = 0;
  for (const unsigned format : {0U, 1U, 3U, 6U, 8U}) {
    const std::string laz = compressed(las_sample(LazSample::kScan, format, 1, 1000, 5), {.chunk_size = 400});
    const std::size_t begin = points_at(laz);
    for (int i = 0; i < 100; ++i) {
      std::string bad = laz;
      for (unsigned n = 1 + static_cast<unsigned>(random()) % 3; n > 0; --n) {
        bad[begin + random() % (bad.size() - begin)] = static_cast<char>(random());
      }
      try {
        EXPECT_LE(read(bad).points.size(), 1000U);
      } catch (const PointFileError& error) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 20U);
}

TEST_F(LazPointsTest, TheHeaderSaysWhatToExpect) {
  const std::string las = las_sample(LazSample::kScan, 6, 0, 5000, 5);
  const std::string path = file("points.laz", compressed(las));
  ASSERT_TRUE(expected_points(path, {}));
  EXPECT_EQ(expected_points(path, {})->count, 5000U);
  EXPECT_EQ(promised_points(path), 5000U);
  std::string lie = compressed(las);
  lie.replace(247, 8, bytes_of(std::uint64_t{1} << 40U));
  EXPECT_FALSE(expected_points(file("points.laz", lie), {}));
}

}  // namespace
}  // namespace polylidar::tool
