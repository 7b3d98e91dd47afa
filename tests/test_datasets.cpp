#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "datasets/datasets.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/sha256.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench {
namespace {

using polylidar::MultiPolygon;
using polylidar::Point;

/// The hash of a shape's vertices in order: polygon by polygon, shell before holes.
std::string hash_of(const MultiPolygon& shape) {
  std::string bytes;
  for (const polylidar::Polygon& polygon : shape) {
    bytes += point_bytes(polygon.shell);
    for (const polylidar::Ring& hole : polygon.holes) bytes += point_bytes(hole);
  }
  return sha256_hex(bytes);
}

template <typename Function>
std::string invalid_argument_of(Function function) {
  try {
    function();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Datasets, CatalogueListsTheStates) {
  const std::vector<DatasetInfo> infos = datasets();
  ASSERT_EQ(infos.size(), 2U);
  EXPECT_EQ(infos[0].name, "ca");
  EXPECT_EQ(infos[0].title, "California");
  EXPECT_EQ(infos[1].name, "hi");
  EXPECT_EQ(infos[1].title, "Hawaii");
  for (const DatasetInfo& info : infos) {
    EXPECT_TRUE(info.has_holes_variant);
    EXPECT_FALSE(info.source.empty());
    EXPECT_FALSE(info.licence.empty());
    EXPECT_EQ(info.sha256.size(), 64U);
    EXPECT_NEAR(polylidar::area(make_ground_truth(info.name, false)), info.area, 1e-6);  // 6 decimals
  }
}

// The hashes below were also computed by a Python program written apart from this library (point in polygon
// in rational numbers). They change only when a data set is meant to change.

TEST(Datasets, GoldenShapes) {
  EXPECT_EQ(hash_of(make_ground_truth("ca", false)),
            "07148380fbb61e90fef038353a42859e26d81d22fed2ced909837bd57d5aef51");
  EXPECT_EQ(hash_of(make_ground_truth("ca", true)),
            "2ae88976d6c4d2dff9b3b3501cc29f481470b63394a87c0a84736b0d7b0efc85");
  EXPECT_EQ(hash_of(make_ground_truth("hi", false)),
            "bb23420a4293045b5fcbab82fad56df06a45e74cfec51d7cd1f3b38df9003c70");
  EXPECT_EQ(hash_of(make_ground_truth("hi", true)),
            "7373d0fd48c5f900eebfcbf5eecdf481fb53903a9c02b1f20781b9431fee1db1");
}

struct GoldenSample {
  std::string name;
  bool holes;
  std::size_t n;
  std::string sha256;
};

TEST(Datasets, GoldenSamples) {
  const std::vector<GoldenSample> samples{
      {"ca", false, 2000, "d571f5112ddef92c8d63bed8e2add45f77bf31d5ea3011ebccd0a1c22c74c371"},
      {"ca", false, 8000, "93a40d4d69eddb8ada2155943529e471583f8d7684e43a8790333ed7fab3c663"},
      {"ca", true, 2000, "9182403d79081ada810b03338a98efa9c68562ab176265fd5be6de728f2ca7c0"},
      {"ca", true, 8000, "6201cdf0568daa6e22910f492299c4693bc88d83b2e51df3033b7c9b00bd8989"},
      {"hi", false, 2000, "49cd3a5024f2ce6ad18b02e53d4bd66951492281ed12af6321a73e15b6c43e59"},
      {"hi", false, 8000, "aa0572e3fcb8f39dc462f4297eb2b2e190c48ba931dff751d71a9c055aa48470"},
      {"hi", true, 2000, "016d8a02677934ebd1170277a5d42cead1da7cda6f47a1ca7d0c4030d4cd13f7"},
      {"hi", true, 8000, "2e3d08e77d68a31be8a280b5432244ae97d87c503477b9268cf5f26c84c54559"},
  };
  for (const GoldenSample& sample : samples) {
    const PointSet set = make_point_set(sample.name, sample.holes, sample.n, 1);
    EXPECT_EQ(set.sha256, sample.sha256) << sample.name << " holes:" << sample.holes << " n:" << sample.n;
    EXPECT_EQ(set.sha256, sha256_hex(point_bytes(set.points)));
    EXPECT_EQ(set.points.size(), sample.n);
    EXPECT_EQ(set.ground_truth, make_ground_truth(sample.name, sample.holes));
    EXPECT_EQ(set.ground_truth_area, polylidar::area(set.ground_truth));
  }
}

TEST(Datasets, SeedChangesThePointsAndNotTheShape) {
  const PointSet one = make_point_set("hi", true, 100, 1);
  const PointSet two = make_point_set("hi", true, 100, 2);
  EXPECT_NE(one.points, two.points);
  EXPECT_EQ(one.ground_truth, two.ground_truth);
}

TEST(Datasets, SamplesOfDifferentSizesShareNoPoints) {
  const PointSet few = make_point_set("ca", false, 10, 1);
  const PointSet more = make_point_set("ca", false, 11, 1);
  EXPECT_NE(few.points.front(), more.points.front());
}

TEST(Datasets, PointBytesAreLittleEndianDoubles) {
  const std::vector<Point> points{{1.0, -2.5}};
  EXPECT_EQ(point_bytes(points), std::string("\0\0\0\0\0\0\xF0\x3F\0\0\0\0\0\0\x04\xC0", 16));
  EXPECT_EQ(point_bytes({}), "");
}

TEST(Datasets, UnknownNameIsRefusedWithTheKnownOnes) {
  EXPECT_EQ(invalid_argument_of([] { make_point_set("california", false, 10, 1); }),
            "there is no data set 'california'; choose one of: ca, hi");
  EXPECT_EQ(invalid_argument_of([] { make_ground_truth("", true); }),
            "there is no data set ''; choose one of: ca, hi");
}

TEST(Datasets, MissingHolesVariantIsRefused) {
  const testing::TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  const std::string triangle = R"({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [0, 3], [0, 0]]]})";
  std::ofstream(folder / "tri.geojson") << triangle;
  std::ofstream(folder / "manifest.json")
      << R"({"shapes": [{"name": "tri", "title": "Triangle", "file": "tri.geojson", "source": "made up",
             "licence": "CC0", "area": 6, "sha256": ")"
      << sha256_hex(triangle) << R"("}]})";
  EXPECT_FALSE(datasets(folder).front().has_holes_variant);
  EXPECT_EQ(make_point_set("tri", false, 10, 1, folder).ground_truth_area, 6);
  EXPECT_EQ(invalid_argument_of([&] { make_ground_truth("tri", true, folder); }),
            "the data set 'tri' has no variant with holes; choose one of: none");
}

}  // namespace
}  // namespace hullbench
