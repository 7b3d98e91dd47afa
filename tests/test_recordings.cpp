#include <gtest/gtest.h>
#include <png.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/rgbd/recordings.hpp"
#include "tests/complaint.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

json to_json(const Ring& ring) {
  json positions = json::array();
  for (const Point& point : ring) positions.push_back({point.x, point.y});
  positions.push_back(positions.front());
  return positions;
}

std::string to_geojson(const MultiPolygon& shape) {
  json polygons = json::array();
  for (const Polygon& polygon : shape) {
    json rings = json::array({to_json(polygon.shell)});
    for (const Ring& hole : polygon.holes) rings.push_back(to_json(hole));
    polygons.push_back(rings);
  }
  return json{{"type", "MultiPolygon"}, {"coordinates", polygons}}.dump();
}

std::string to_text(const Intrinsics& camera) {
  json text;
  text["width"] = camera.width;
  text["height"] = camera.height;
  text["fx"] = camera.fx;
  text["fy"] = camera.fy;
  text["ppx"] = camera.ppx;
  text["ppy"] = camera.ppy;
  text["depth_unit"] = camera.depth_unit;
  return text.dump();
}

void write_depth_png(const fs::path& path, const DepthImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.intrinsics.width);
  png.height = static_cast<png_uint_32>(image.intrinsics.height);
  png.format = PNG_FORMAT_LINEAR_Y;
  ASSERT_NE(png_image_write_to_file(&png, path.c_str(), 0, image.counts.data(), 0, nullptr), 0);
}

const MultiPolygon kTriangle{{.shell = {{0, 0}, {4, 0}, {0, 3}}, .holes = {}}};
constexpr const char* kCamera =
    R"({"width": 2, "height": 2, "fx": 2, "fy": 2, "ppx": 0.5, "ppy": 0.5, "depth_unit": 0.001})";

/// Every file stands in `scene_`, the only sub-folder of `folder_`.
class Recordings : public ::testing::Test {
 protected:
  Recordings() { fs::create_directories(scene_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(scene_ / name, std::ios::binary) << text;
    return scene_ / name;
  }

  /// The scene of a points.txt.
  std::vector<Point> load_points(const std::string& text) const {
    write("gt.geojson", to_geojson(kTriangle));
    write("points.txt", text);
    return load_recording(scene_).points;
  }

  /// What loading says, with the scene's folder left out.
  std::string load_error() const {
    std::string message = complaint_of([&] { load_recording(scene_); });
    if (message == kNoComplaint) return message;
    const std::size_t at = message.find(scene_.string());
    EXPECT_NE(at, std::string::npos) << message;
    return at == std::string::npos ? message : message.erase(at, scene_.string().size());
  }

  std::string points_error(const std::string& text) const {
    write("gt.geojson", to_geojson(kTriangle));
    write("points.txt", text);
    return load_error();
  }

  std::string camera_error(const std::string& text) const {
    write("gt.geojson", to_geojson(kTriangle));
    write("depth.png", "");
    write("intrinsics.json", text);
    return load_error();
  }

  std::string png_error(const std::string& bytes) const {
    write("depth.png", bytes);
    write("intrinsics.json", kCamera);
    return load_error();
  }

  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
  const fs::path scene_ = folder_ / "a";
};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

DepthImage small_image() {
  return {.intrinsics = {2, 2, 2, 2, 0.5, 0.5, 0.001}, .counts = {0, 1, 256, 65535}};
}

TEST_F(Recordings, SimulatedSceneComesBackBitForBit) {
  for (const std::size_t index : {0U, 10U}) {
    const DepthImage image = simulate_depth(index, 5);
    const FloorScene scene = simulate_floor(index, 5);
    write_depth_png(scene_ / "depth.png", image);
    write("intrinsics.json", to_text(image.intrinsics));
    write("gt.geojson", to_geojson(scene.ground_truth));
    const FloorScene loaded = load_recording(scene_);
    EXPECT_EQ(loaded.points, scene.points);
    EXPECT_EQ(loaded.ground_truth, scene.ground_truth);
  }
}

TEST_F(Recordings, PngKeepsEveryCount) {
  DepthImage image{.intrinsics = {256, 256, 2, 2, 0.5, 0.5, 0.001}, .counts = {}};
  for (std::uint32_t count = 0; count < 65536; ++count) {
    image.counts.push_back(static_cast<std::uint16_t>(count));
  }
  write_depth_png(scene_ / "depth.png", image);
  EXPECT_EQ(read_depth_png(scene_ / "depth.png", image.intrinsics), image);
}

TEST_F(Recordings, PointsAreTwoOrThreeNumbersALine) {
  const std::vector<Point> expected{{1, 2}, {-0.5, 1e-3}, {3, 4}};
  EXPECT_EQ(load_points("1 2\n-0.5 0.001\n3 4\n"), expected);
  EXPECT_EQ(load_points("1,2\r\n-.5 , 1e-3\r\n3\t4"), expected);
  EXPECT_EQ(load_points("# x y z\n\n  1 2 0.01\n   # more\n-0.5, 0.001, -7\n \n3 4 0  \n"), expected);
  EXPECT_EQ(load_recording(scene_).ground_truth, kTriangle);
}

TEST_F(Recordings, PointsComeBeforeTheDepthImage) {
  write("depth.png", "not a PNG");
  EXPECT_EQ(load_points("1 2\n3 4\n5 7\n").size(), 3U);
}

TEST_F(Recordings, FaultyPointsAreNamedByLine) {
  const std::string not_a_point =
      "/points.txt, line 3, is not two or three numbers; write a point as x y or x y z";
  for (const std::string line : {"1", "1 2 3 4", "1 x", "x 1", "1 2x", "1,,2", "1 2,", ",1 2", "1.2.3", "1;2",
                                 "1 2 # a point", "1 1e999"}) {
    EXPECT_EQ(points_error("1 2\n\n" + line + "\n3 4\n"), not_a_point) << line;
  }
  for (const std::string line : {"nan 1", "1 inf", "1 2 -nan"}) {
    EXPECT_EQ(points_error("1 2\n# \n" + line + "\n3 4\n"),
              "/points.txt, line 3, has a number that is not finite; remove the point")
        << line;
  }
}

TEST_F(Recordings, FewerThanThreePointsAreRefused) {
  const std::string advice = " points; a hull needs at least 3: give a longer recording";
  EXPECT_EQ(points_error(""), " has 0" + advice);
  EXPECT_EQ(points_error("# nothing\n1 2\n3 4\n"), " has 2" + advice);
  EXPECT_EQ(points_error("1 2\n3 4\n5 7\n"), kNoComplaint);
}

TEST_F(Recordings, MissingFilesAreNamed) {
  const std::string advice = "; check that the file exists and may be read";
  EXPECT_EQ(load_error(), " has neither points.txt nor depth.png; add one, with gt.geojson beside it");
  write("points.txt", "1 2\n3 4\n5 7\n");
  EXPECT_EQ(load_error(), "cannot read /gt.geojson" + advice);
  fs::remove(scene_ / "points.txt");
  write("depth.png", "");
  EXPECT_EQ(load_error(), "cannot read /intrinsics.json" + advice);
  fs::create_directory(scene_ / "points.txt");
  EXPECT_EQ(load_error(), "cannot read /points.txt" + advice);
  EXPECT_EQ(complaint_of([&] { read_depth_png(folder_ / "absent.png", small_image().intrinsics); }),
            "cannot read " + (folder_ / "absent.png").string() + advice);
}

TEST_F(Recordings, FaultyGroundTruthIsRefused) {
  write("points.txt", "1 2\n3 4\n5 7\n");
  write("gt.geojson", R"({"type": "Polygon", "coordinates": []})");
  EXPECT_EQ(load_error(),
            "/gt.geojson is not a usable shape: polygon 0 has no rings; remove it or give it a shell");
}

TEST_F(Recordings, FaultyIntrinsicsAreRefused) {
  const std::string file = "/intrinsics.json is not a camera's intrinsics: ";
  expect_says(camera_error("{"), "/intrinsics.json is not valid JSON (");
  EXPECT_EQ(camera_error("[]"), file +
                                    "it is not a JSON object; give one with width, height, fx, fy, ppx, ppy "
                                    "and depth_unit");
  const auto error_with = [&](const char* member, const json& value) {
    json camera = json::parse(kCamera);
    if (value.is_null()) {
      camera.erase(member);
    } else {
      camera[member] = value;
    }
    return camera_error(camera.dump());
  };
  const auto faulty = [&](const std::string& member, const std::string& wanted) {
    return file + "\"" + member + "\" is missing or out of range; give " + wanted;
  };
  for (const json& value : {json(), json(0), json(65536), json(-3), json(2.5), json("2")}) {
    EXPECT_EQ(error_with("width", value), faulty("width", "the image's width in pixels, 1 to 65535"))
        << value;
    EXPECT_EQ(error_with("height", value), faulty("height", "the image's height in pixels, 1 to 65535"));
  }
  for (const json& value : {json(), json(0), json(-2), json("2")}) {
    const std::string focal = "the focal length in pixels, above 0";
    EXPECT_EQ(error_with("fx", value), faulty("fx", focal)) << value;
    EXPECT_EQ(error_with("fy", value), faulty("fy", focal)) << value;
    EXPECT_EQ(error_with("depth_unit", value), faulty("depth_unit", "the metres a count, above 0")) << value;
  }
  for (const json& value : {json(), json("2")}) {
    EXPECT_EQ(error_with("ppx", value), faulty("ppx", "a number")) << value;
    EXPECT_EQ(error_with("ppy", value), faulty("ppy", "a number")) << value;
  }
}

TEST_F(Recordings, FaultyPngsAreRefused) {
  const std::string file = "/depth.png is not a usable depth image: ";
  write_depth_png(scene_ / "depth.png", small_image());
  write("gt.geojson", to_geojson(kTriangle));
  const std::string whole = bytes_of(scene_ / "depth.png");
  EXPECT_EQ(png_error("not a PNG, but long enough"),
            file + "libpng refuses it (Not a PNG file); give a PNG that is whole");
  EXPECT_EQ(png_error(""), file + "libpng refuses it (it ends too early); give a PNG that is whole");
  for (const std::size_t length : {whole.size() / 2, whole.size() - 1}) {
    EXPECT_EQ(png_error(whole.substr(0, length)),
              file + "libpng refuses it (it ends too early); give a PNG that is whole");
  }
  DepthImage wide = small_image();
  wide.intrinsics.width = 4;
  wide.intrinsics.height = 1;
  write_depth_png(scene_ / "wide.png", wide);
  EXPECT_EQ(
      png_error(bytes_of(scene_ / "wide.png")),
      file + "it has 4 x 1 pixels and the intrinsics say 2 x 2 pixels; give the two of one camera mode");
  EXPECT_EQ(png_error(whole), kNoComplaint);
}

TEST_F(Recordings, NoDamagedByteOfAPngChangesACount) {
  const fs::path path = scene_ / "depth.png";
  write_depth_png(path, small_image());
  const std::string whole = bytes_of(path);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    write("depth.png", damaged);
    try {
      EXPECT_EQ(read_depth_png(path, small_image().intrinsics), small_image()) << i;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find("; give a PNG that is whole"), std::string::npos)
          << error.what();
      ++refused;
    }
  }
  // The signature, the header, the counts and the end: 8, 25, at least 12 and 12 bytes.
  EXPECT_GE(refused, 57U);
}

TEST_F(Recordings, DepthWithoutAFloorIsRefused) {
  DepthImage image = small_image();
  image.counts[1] = 0;
  write_depth_png(scene_ / "depth.png", image);
  EXPECT_EQ(
      png_error(bytes_of(scene_ / "depth.png")),
      "/depth.png shows no floor: the depth image has fewer than 3 pixels with depth; take one that shows "
      "a floor");
}

TEST_F(Recordings, PngsOfOtherKindsAreRefused) {
  const std::vector<std::uint8_t> pixels(16, 7);
  for (const png_uint_32 format :
       {png_uint_32{PNG_FORMAT_GRAY}, png_uint_32{PNG_FORMAT_RGB}, png_uint_32{PNG_FORMAT_RGBA}}) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 2;
    image.format = format;
    ASSERT_NE(png_image_write_to_file(&image, (scene_ / "other.png").c_str(), 0, pixels.data(), 0, nullptr),
              0);
    EXPECT_EQ(
        png_error(bytes_of(scene_ / "other.png")),
        "/depth.png is not a usable depth image: it is not 16-bit grey; save the counts as 16-bit grey");
  }
}

TEST_F(Recordings, AreListedByName) {
  const auto error_of = [](const fs::path& folder) { return complaint_of([&] { list_recordings(folder); }); };
  EXPECT_EQ(error_of(folder_), folder_.string() +
                                   " has no recording; put each into a sub-folder with gt.geojson and "
                                   "points.txt, or depth.png and intrinsics.json");
  EXPECT_EQ(error_of(folder_ / "absent"),
            (folder_ / "absent").string() + " is not a folder; give the one that holds the recordings");
  write("points.txt", "1 2\n");
  fs::create_directory(folder_ / "Z");
  std::ofstream(folder_ / "Z" / "depth.png") << "x";
  fs::create_directory(folder_ / "notes");
  std::ofstream(folder_ / "readme.txt") << "x";
  EXPECT_EQ(list_recordings(folder_), (std::vector<std::string>{"Z", "a"}));
}

}  // namespace
}  // namespace hullbench::testing
