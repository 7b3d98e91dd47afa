#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "datasets/datasets.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/sha256.hpp"
#include "tests/complaint.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
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

TEST(Datasets, CatalogueListsTheStatesAndTheLetters) {
  std::vector<DatasetInfo> infos = datasets();
  ASSERT_GT(infos.size(), 28U);
  infos.resize(28);  // the families stand behind them
  EXPECT_EQ(infos[0].name, "ca");
  EXPECT_EQ(infos[0].title, "California");
  EXPECT_EQ(infos[1].name, "hi");
  EXPECT_EQ(infos[1].title, "Hawaii");
  for (std::size_t i = 2; i < infos.size(); ++i) {
    const auto offset = static_cast<char>(i - 2);
    EXPECT_EQ(infos[i].name, std::string("letter_") + static_cast<char>('a' + offset));
    EXPECT_EQ(infos[i].title, std::string(1, static_cast<char>('A' + offset)));
    EXPECT_EQ(infos[i].licence, "SIL Open Font License 1.1");
  }
  for (const DatasetInfo& info : infos) {
    EXPECT_EQ(info.has_holes_variant, info.name == "ca" || info.name == "hi") << info.name;
    EXPECT_FALSE(info.source.empty());
    EXPECT_FALSE(info.licence.empty());
    EXPECT_EQ(info.sha256.size(), 64U);
    EXPECT_NEAR(polylidar::area(make_ground_truth(info.name, false)), *info.area, 1e-6);  // 6 decimals
  }
}

// `tests/golden_hashes.py` prints the hashes below; it is written apart from this library and decides in
// whole numbers. They change only when a data set is meant to change.

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

struct GoldenLetter {
  std::string name;
  std::string shape_sha256;
  std::string sample_sha256;  ///< of 2000 points with the seed 1
};

TEST(Datasets, GoldenLetters) {
  const std::vector<GoldenLetter> letters{
      {"letter_a", "270705f296b8f8dec7272ff405cf3dbf1a67e58197013b3b7669062060548099",
       "44e1060d32c72394e23bbbf3abae24da4c6b55e1a6379c8a666637e41a083411"},
      {"letter_b", "d125d160e9056a2c1b7c89b6f6fffb796f3b9796a53a49170918015f5099459b",
       "2f51b2b96da4f4d6461267e828bc96cd7e70742a612dee8112d7eae3dba5c831"},
      {"letter_c", "eee11b4a2cde03c73643eaaf12790b33656cdc371a584c985670a8ff26fe768e",
       "44f132b3002636957e6b0d9e431848c14b3e71932c2345914102e139455bd39d"},
      {"letter_d", "9d053f0bb574f3a3caf555fe4807ad72c52abe767c2f9160027d0abadc3bb2e9",
       "a143a8211ab4ff8d2eccc21e9bde3234a78606984675c2a4224a4afd0fb21065"},
      {"letter_e", "581c0f449f8893f70ac9042ad7d6b7f5943d1c9c863772ee5ddd9ba42e53c7c7",
       "f4479ca5614c7b9c706699f4e1221a7b35f121ff12ab099efdd840b0c07896db"},
      {"letter_f", "582d455b9e84c7185306093fbd38ef9fef2cf75c45fda4c5b072c47363e9d000",
       "c4c9455c7b2dcb0d409f0842277f2abe00b67aac53c7454c1b5119d87636bc24"},
      {"letter_g", "c992dee5f662aa578e4f6522aa7f4a1d2b6b7d08833afba6e7207b502e98e612",
       "4e4f7d90c97959e748741e2d400dfdb3080b901c3caf0ab88cbaf50283557037"},
      {"letter_h", "b5371575f8a2d777f687516f03b2f1d87e68c0146d53f3103b093568e50d6b4c",
       "526f04de400c513c9ee2ebe09c5f273dd049cdd3e04c1b9f14616b6373f33848"},
      {"letter_i", "a6704bf78503c79c2e2312076db4d3395819e2b17fef1a78c54e98684d94abc8",
       "2e79f2cd3a33208d1d7d5be96e22ed5927f4a4926225d21863d04d0a5f566dae"},
      {"letter_j", "525f5778961f3fde7bf1884c747a2c2bbb397f11f4daf03d9c8756442df03298",
       "1e8f9debca358ae4996c6ef713831e9e3fdd23c1905001e6bffb27e919e6b739"},
      {"letter_k", "661b943b72a03e6e4fa6432833f7beb0474709f3f0dc8b0debd312c97e0cd1bf",
       "fb820cac4508c79e5fce10b91b0ae2cb20f73a98b9e0b4fa61bf49aa348a5136"},
      {"letter_l", "c543b53c3570cba12aace6453adf594767f557445f6f4fa3b0effdba4fa24a7b",
       "1bfaea83b3fa5946ee41102f070ef2505e000c2716a1637786b416f04b095f56"},
      {"letter_m", "3a0f8046db46bab205ead28ff679a73ab224677878c06b07049c40afefc3d998",
       "a8aff4ab169733125436e0d8d4618335bd8986004533378644c13163a786db5f"},
      {"letter_n", "0da423350647e22a3bdf852f7f06b6821cc7f9c380d8c4c41f6ab1fa160dc474",
       "423cdee775e34415d2fe7989620a14d1497a2edd14847f5e4e3853e2e8b82e75"},
      {"letter_o", "bee0d1519b8444026929e720c17397e8479b917f9eacbfa0d1b55348da60714d",
       "bf84feae49491d7926b3ec643fa2b266e56be858395bade397abe5a48730c194"},
      {"letter_p", "f2022693f2be3d0b6d45977c76913ed214269fe267943deeeb80596376775aec",
       "0064e1ba011c3753490802146df1eb874f13504059b22e95f4824c15917bddd7"},
      {"letter_q", "73352667ef5379f72e592cf5a7f8a130d63b24aefe4a4a89d1187bf11e961351",
       "9cebeb05cda47ce138cae0cc19c5b344bc4a242fefc875dc446b5f182416d30b"},
      {"letter_r", "709586cea0c92497486797aa06af4531ea3f08161012079b3b16136d618938e2",
       "2151af759330dda374c60fb3d8883564a938076d9296adc5dbbcb4a38cfa027b"},
      {"letter_s", "f867ccd46a55c1e942db09dbd23d1e6e759759a47ca37808ea68428ec8da3616",
       "b00affe10d90b02036994d01741b70f86a37069a98e3a951de3294bbffdc6c2a"},
      {"letter_t", "a4c4e840ccfb4cb39b2744ad92105b824091ecb2724b44e68e3479e822eba289",
       "57df01722b7b2603254e8225f2dbe30b962153630e75c46a3ec5015e94def33f"},
      {"letter_u", "5d396b252476ae3f071a35154ccb0c37169edaaf9d9fb7f1fb5624e9fba4ea25",
       "2fe7ef04b4f6cd7bdf3f65c9c6af2fef2ce633a0606e73785cea6b517707ea18"},
      {"letter_v", "87125e0c83e8563f7690c9c114a38013d3632725e91da15a7a7a478b2775dd55",
       "45ea0faadb0e1ffbefbb4b97879dd249f2cd5c01c4cedcf429b2ee2dda86cb3a"},
      {"letter_w", "a720722deb8a0f0fcba13e2bd03973e905e3041b309670a71fcd3aa4dec25acd",
       "6c5be54e2009f469ef7cfadf27379533d97550e16d72b83af4284392f241514b"},
      {"letter_x", "bc69b85e1bc59c9c2e561054f9265ec6f49fd39d2abceafc62812ef4916d3895",
       "9f14655172811c401f0aa99ae9bdca9a2ca7d6acf7cd6f47a4915a3e396698b0"},
      {"letter_y", "52cc8414ddf36185e09af84bb779c9cf6d97a1710413928cd90b98ce5a2c49d4",
       "6cda77ca55e9c7478c3d77c40ceed8ec8be9817952dbc84c8228288ecf6284dd"},
      {"letter_z", "3477869bae89a82dd67046b5fa76e7245a370156cc4e1cf0f7ea8b19945ed355",
       "cf462f8dbbb9d68648f72c7385340edbb5491200e109171b1b7831facc10f777"},
  };
  for (const GoldenLetter& letter : letters) {
    const PointSet set = make_point_set(letter.name, false, 2000, 1);
    EXPECT_EQ(hash_of(set.ground_truth), letter.shape_sha256) << letter.name;
    EXPECT_EQ(set.sha256, letter.sample_sha256) << letter.name;
  }
}

// A counter is a hole: these letters have so many, every other one has none.
TEST(Datasets, LettersHaveTheirCounters) {
  const std::map<std::string, std::size_t> counters{{"letter_a", 1}, {"letter_b", 2}, {"letter_d", 1},
                                                    {"letter_o", 1}, {"letter_q", 1}, {"letter_r", 1}};
  for (const DatasetInfo& info : datasets()) {
    if (!info.name.starts_with("letter_")) continue;
    const MultiPolygon shape = make_ground_truth(info.name, false);
    ASSERT_EQ(shape.size(), 1U) << info.name;
    const auto expected = counters.find(info.name);
    EXPECT_EQ(shape[0].holes.size(), expected == counters.end() ? 0 : expected->second) << info.name;
  }
}

TEST(Datasets, MembersOfFamiliesAreNumberedFromOne) {
  EXPECT_EQ(split_member_name("star-17"), (std::pair<std::string, std::size_t>("star", 17)));
  for (const char* name : {"star", "star-", "star-0", "star-017", "star-x", "star-1x", "-", ""}) {
    EXPECT_EQ(split_member_name(name), std::nullopt) << name;
  }
  const std::vector<DatasetInfo> infos = datasets();
  ASSERT_NE(find_dataset(infos, "star-9800"), nullptr);
  EXPECT_EQ(find_dataset(infos, "star-9800")->members, 9800U);
  for (const char* name : {"star", "star-0", "star-9801", "ca-1"})
    EXPECT_EQ(find_dataset(infos, name), nullptr) << name;
}

TEST(Datasets, OnlyFloorsComeWithTheirPoints) {
  EXPECT_EQ(complaint_of<std::invalid_argument>([] { make_point_set("ca", false, 0, 1); }),
            "the data set 'ca' has no points of its own; ask for a number of them");
  EXPECT_EQ(complaint_of<std::invalid_argument>([] { make_point_set("floor-1", false, 100, 1); }),
            "the data set 'floor-1' comes with its points; ask for no number of them");
}

TEST(Datasets, EveryFloorHasItsOwnNoiseBySeed) {
  const PointSet one = make_point_set("floor-1", false, 0, 1);
  const PointSet again = make_point_set("floor-1", false, 0, 1);
  const PointSet other = make_point_set("floor-1", false, 0, 2);
  EXPECT_EQ(one.sha256, again.sha256);
  EXPECT_NE(one.sha256, other.sha256);
  EXPECT_EQ(one.ground_truth, other.ground_truth);
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
  std::string known;
  for (const DatasetInfo& info : datasets()) {
    known += (known.empty() ? "" : ", ") + info.name;
    if (info.members > 0) known += "-1 to -" + std::to_string(info.members);
  }
  EXPECT_TRUE(known.starts_with("ca, hi, letter_a, ")) << known;
  EXPECT_EQ(complaint_of<std::invalid_argument>([] { make_point_set("california", false, 10, 1); }),
            "there is no data set 'california'; choose one of: " + known);
  EXPECT_EQ(complaint_of<std::invalid_argument>([] { make_ground_truth("", true); }),
            "there is no data set ''; choose one of: " + known);
}

TEST(Datasets, MissingHolesVariantIsRefused) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  const std::string triangle = R"({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [0, 3], [0, 0]]]})";
  std::ofstream(folder / "tri.geojson") << triangle;
  std::ofstream(folder / "manifest.json")
      << R"({"shapes": [{"name": "tri", "title": "Triangle", "file": "tri.geojson", "source": "made up",
             "licence": "CC0", "area": 6, "sha256": ")"
      << sha256_hex(triangle) << R"("}]})";
  EXPECT_FALSE(datasets(folder).front().has_holes_variant);
  EXPECT_EQ(make_point_set("tri", false, 10, 1, folder).ground_truth_area, 6);
  EXPECT_EQ(complaint_of<std::invalid_argument>([] { make_ground_truth("letter_a", true); }),
            "the data set 'letter_a' has no variant with holes; choose one of: ca, hi, star-1 to -9800");
  EXPECT_EQ(complaint_of<std::invalid_argument>([&] { make_ground_truth("tri", true, folder); }),
            "the data set 'tri' has no variant with holes; choose one of: star-1 to -9800");
}

}  // namespace
}  // namespace hullbench::testing
