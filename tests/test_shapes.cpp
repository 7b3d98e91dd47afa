#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

#include "benchmarks/base/names.hpp"
#include "datasets/sha256.hpp"
#include "datasets/shapes.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/boost_checks.hpp"
#include "tests/complaint.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

class Shapes : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  MultiPolygon read(const std::string& text) const { return read_geojson(write("shape.geojson", text)); }

  /// The whole message of the error that reading `text` gives, without the file's name.
  std::string error_of(const std::string& text) const {
    const std::string path = write("shape.geojson", text).string();
    std::string message = complaint_of([&] { read_geojson(path); });
    if (message == kNoComplaint) return message;
    EXPECT_EQ(message.substr(0, path.size()), path);
    return message.substr(path.size());
  }

  std::string manifest_error(const std::string& text) const {
    write("manifest.json", text);
    return complaint_of([&] { read_manifest(folder_); });
  }

  TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

json manifest_entry() {
  return {{"name", "tri"},  {"title", "Triangle"}, {"file", "tri.geojson"},
          {"sha256", "00"}, {"source", "made up"}, {"licence", "CC0"},
          {"area", 6.0}};
}

std::string manifest_with(const json& entry) {
  return json{{"shapes", {entry}}}.dump();
}

constexpr const char* kTriangleText =
    R"({"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [0, 3], [0, 0]]]})";

TEST_F(Shapes, GeometryFeatureAndCollectionAreRead) {
  const MultiPolygon triangle{{.shell = {{0, 0}, {4, 0}, {0, 3}}, .holes = {}}};
  const std::string polygon = kTriangleText;
  EXPECT_EQ(read(polygon), triangle);
  const std::string feature = R"({"type": "Feature", "properties": null, "geometry": )" + polygon + "}";
  EXPECT_EQ(read(feature), triangle);
  const std::string collection =
      R"({"type": "FeatureCollection", "features": [)" + feature + "," + feature + "]}";
  EXPECT_EQ(read(collection), (MultiPolygon{triangle[0], triangle[0]}));
  const std::string multi = R"({"type": "MultiPolygon", "coordinates": [
      [[[0, 0], [4, 0], [0, 3], [0, 0]]], [[[9, 9], [10, 9], [9, 10], [9, 9]]]]})";
  EXPECT_EQ(read(multi), (MultiPolygon{triangle[0], {.shell = {{9, 9}, {10, 9}, {9, 10}}, .holes = {}}}));
}

TEST_F(Shapes, RingsAreTurnedAndAltitudesDropped) {
  const MultiPolygon shape = read(R"({"type": "Polygon", "coordinates": [
      [[0, 0, 7], [0, 9, 7], [9, 0, 7], [0, 0, 7]], [[1, 1], [2, 1], [1, 2], [1, 1]]]})");
  EXPECT_EQ(shape, (MultiPolygon{{.shell = {{9, 0}, {0, 9}, {0, 0}}, .holes = {{{1, 2}, {2, 1}, {1, 1}}}}}));
}

TEST_F(Shapes, MissingFileAndFolderAreNamed) {
  for (const fs::path& path : {folder_ / "absent.geojson", folder_}) {
    EXPECT_EQ(complaint_of([&] { read_geojson(path); }),
              "cannot read " + path.string() + "; check that the file exists and may be read");
  }
}

TEST_F(Shapes, TextThatIsNotJsonIsRefused) {
  expect_says(error_of("{"), " is not valid JSON (");
  expect_says(error_of(""), " is not valid JSON (");
}

TEST_F(Shapes, NumbersThatAreNotFiniteAreRefused) {
  const auto with_coordinate = [](const std::string& number) {
    return R"({"type": "Polygon", "coordinates": [[[0, 0], [)" + number + R"(, 0], [0, 3], [0, 0]]]})";
  };
  EXPECT_EQ(error_of(with_coordinate("4")), kNoComplaint);
  expect_says(error_of(with_coordinate("1e999")), "number overflow");
  expect_says(error_of(with_coordinate("NaN")), " is not valid JSON (");
  EXPECT_EQ(error_of(with_coordinate("null")),
            " is not a usable shape: polygon 0, ring 0 has a vertex that is not a pair of numbers; write "
            "each as [x, y]");
}

TEST_F(Shapes, FaultyRingsAreRefused) {
  const auto error_of_ring = [this](const std::string& ring) {
    return error_of(R"({"type": "MultiPolygon", "coordinates": [[[[0, 0], [9, 0], [0, 9], [0, 0]], )" + ring +
                    "]]}");
  };
  const std::string where = " is not a usable shape: polygon 0, ring 1 ";
  EXPECT_EQ(error_of_ring("[[1, 1], [2, 1], [1, 2]]"),
            where + "is not closed; repeat its first vertex at the end");
  EXPECT_EQ(error_of_ring("[]"), where + "is not closed; repeat its first vertex at the end");
  const std::string too_few = where + "has fewer than 3 distinct vertices; remove it or complete it";
  EXPECT_EQ(error_of_ring("[[1, 1]]"), too_few);
  EXPECT_EQ(error_of_ring("[[1, 1], [2, 1], [1, 1]]"), too_few);
  EXPECT_EQ(error_of_ring("[[1, 1], [2, 1], [2, 1], [1, 1], [1, 1]]"), too_few);
  EXPECT_EQ(error_of_ring("[[1, 1], [2, 1], [3, 1], [1, 1]]"),
            where + "encloses no area; remove it or correct its vertices");
  EXPECT_EQ(error_of_ring("[[1], [2, 1], [1, 2], [1]]"),
            where + "has a vertex that is not a pair of numbers; write each as [x, y]");
  EXPECT_EQ(error_of_ring("7"), where + "is not an array of vertices; write it as [[x, y], ...]");
}

TEST_F(Shapes, OtherDocumentsAreRefused) {
  const std::string advice = "; give a Polygon or MultiPolygon";
  EXPECT_EQ(error_of(R"({"type": "Point", "coordinates": [0, 0]})"),
            " is not a usable shape: it has a geometry of type Point" + advice);
  EXPECT_EQ(error_of("[]"), " is not a usable shape: it has an object without a GeoJSON type" + advice);
  EXPECT_EQ(error_of(R"({"type": "Feature", "geometry": null})"),
            " is not a usable shape: it has an object without a GeoJSON type" + advice);
  EXPECT_EQ(error_of(R"({"type": "MultiPolygon", "coordinates": []})"),
            " is not a usable shape: it has no polygon" + advice);
  EXPECT_EQ(error_of(R"({"type": "Polygon", "coordinates": []})"),
            " is not a usable shape: polygon 0 has no rings; remove it or give it a shell");
  expect_says(error_of(R"({"type": "Polygon"})"), " is not the GeoJSON of a shape (");
  expect_says(error_of(R"({"type": 3})"), " is not the GeoJSON of a shape (");
}

TEST_F(Shapes, FileThatDiffersFromTheManifestIsRefused) {
  const fs::path path = write("tri.geojson", kTriangleText);
  json entry = manifest_entry();
  entry["sha256"] = sha256_hex(kTriangleText);
  write("manifest.json", manifest_with(entry));
  const ShapeInfo info = read_manifest(folder_).front();
  EXPECT_EQ(load_shape(folder_, info).size(), 1U);
  const std::string changed = std::string(kTriangleText) + "\n";
  write("tri.geojson", changed);
  EXPECT_EQ(complaint_of([&] { load_shape(folder_, info); }),
            path.string() + " has SHA-256 " + sha256_hex(changed) + " but the manifest says " +
                sha256_hex(kTriangleText) +
                "; restore the file, or correct the manifest if the change was meant");
}

TEST_F(Shapes, ManifestEntryIsRead) {
  json entry = manifest_entry();
  write("manifest.json", manifest_with(entry));
  EXPECT_FALSE(read_manifest(folder_).front().holes);
  entry["holes"] = {{"count", 3}, {"radius", 0.5}, {"seed", 9}};
  write("manifest.json", manifest_with(entry));
  const ShapeInfo info = read_manifest(folder_).front();
  EXPECT_EQ(info.title, "Triangle");
  EXPECT_EQ(info.area, 6);
  ASSERT_TRUE(info.holes);
  EXPECT_EQ(info.holes->count, 3U);
  EXPECT_EQ(info.holes->radius, 0.5);
  EXPECT_EQ(info.holes->seed, 9U);
}

TEST_F(Shapes, FaultyManifestsAreRefused) {
  expect_says(manifest_error("nonsense"), "manifest.json is not valid JSON (");
  expect_says(manifest_error(R"({"shapes": [], "shapes": []})"),
              "manifest.json has the key 'shapes' twice in one object; leave one out");
  expect_says(manifest_error("{}"), "'shapes' not found");
  expect_says(manifest_error(R"({"shapes": null})"), "'shapes' is not an array");
  const json complete = manifest_entry();
  for (const auto& [field, value] : complete.items()) {
    json entry = complete;
    entry.erase(field);
    expect_says(manifest_error(manifest_with(entry)), "key '" + field + "' not found");
    entry[field] = json::array();
    EXPECT_NE(manifest_error(manifest_with(entry)).find("is not a shape manifest ("), std::string::npos)
        << field;
  }
  const json twice = {{"shapes", {manifest_entry(), manifest_entry()}}};
  expect_says(manifest_error(twice.dump()), "the name 'tri' stands twice");
  for (const char* holes :
       {R"({"count": 0, "radius": 1, "seed": 1})", R"({"count": 1.5, "radius": 1, "seed": 1})",
        R"({"count": 1, "radius": 0, "seed": 1})", R"({"count": 1, "radius": 1, "seed": -1})"}) {
    json entry = manifest_entry();
    entry["holes"] = json::parse(holes);
    EXPECT_NE(manifest_error(manifest_with(entry)).find("'holes' needs a whole 'count'"), std::string::npos)
        << holes;
  }
}

TEST_F(Shapes, MissingManifestIsNamed) {
  EXPECT_EQ(
      complaint_of([&] { read_manifest(folder_); }),
      "cannot read " + (folder_ / "manifest.json").string() + "; check that the file exists and may be read");
}

TEST(CommittedShapes, AreWhatTheManifestSays) {
  const fs::path folder = default_data_directory();
  const json manifest = json::parse(std::ifstream(folder / "manifest.json"));
  const std::vector<ShapeInfo> infos = read_manifest(folder);
  ASSERT_EQ(infos.size(), 28U);
  std::set<std::string> sets;
  for (const json& set : manifest["sets"]) sets.insert(set["name"]);
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const MultiPolygon shape = load_shape(folder, infos[i]);
    const json& entry = manifest["shapes"][i];
    EXPECT_EQ(shape.size(), entry["polygons"]);
    EXPECT_EQ(polylidar::vertex_count(shape), entry["vertices"]);
    // The manifest's area has 6 decimals.
    EXPECT_NEAR(polylidar::area(shape), infos[i].area, 1e-6);
    std::vector<Point> vertices;
    for (const Polygon& polygon : shape) {
      vertices.insert(vertices.end(), polygon.shell.begin(), polygon.shell.end());
    }
    const polylidar::Box box = polylidar::bounding_box(vertices);
    EXPECT_EQ((std::vector{box.min.x, box.min.y, box.max.x, box.max.y}),
              entry["bounding_box"].get<std::vector<double>>());
    EXPECT_EQ(box.min, (Point{0, 0}));
    EXPECT_EQ(boost_fault(shape), "") << infos[i].name;
    EXPECT_EQ(sets.count(entry["set"]), 1U) << infos[i].name;
    if (entry["set"] == "states") {
      EXPECT_EQ(std::max(box.max.x, box.max.y), 200);
    } else {
      // The manifest's convexity has 4 decimals.
      const double hull_area = polylidar::area(polylidar::to_coordinates(
          polylidar::concave_hull(vertices, {.alpha = polylidar::kNoLimit}), vertices));
      EXPECT_NEAR(infos[i].area / hull_area, entry["convexity"].get<double>(), 1e-4) << infos[i].name;
    }
  }
}

}  // namespace
}  // namespace hullbench::testing
