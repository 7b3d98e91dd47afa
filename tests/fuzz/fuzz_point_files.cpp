// Any bytes as a file of points in one format (point_format.hpp): they are read or refused in one sentence,
// and what was read becomes shapes and a document that is JSON.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/point_format.hpp"
#include "tool/hull/degrees.hpp"
#include "tool/hull/group_hulls.hpp"
#include "tool/points/point_file.hpp"
#include "tool/points/readers.hpp"
#include "tool/shapes/polygon_writers.hpp"

namespace {

using namespace polylidar;
using namespace polylidar::tool;
using fuzz::expect;

constexpr std::array<const char*, 6> kBy = {"", "3", "kind", "classification", "return", "point_source"};
constexpr std::array<const char*, 4> kColumns = {"", "1,2", "2,1", "b,a"};

void check(const PointFile& file, const PointFileOptions& options) {
  for (const Point& p : file.points) {
    expect(std::isfinite(p.x) && std::isfinite(p.y), "a coordinate is not finite");
    if (!options.window) continue;
    expect(p.x >= -1 && p.x <= 5 && p.y >= -2 && p.y <= 6, "a point is outside of the window");
  }
  expect(file.groups.size() == (options.by.empty() ? 0 : file.points.size()), "not every point has a group");
  for (const std::uint32_t group : file.groups) expect(group < file.labels.size(), "a group has no label");
  std::vector<std::string> labels = file.labels;
  std::sort(labels.begin(), labels.end());
  expect(std::adjacent_find(labels.begin(), labels.end()) == labels.end(), "two groups have one label");
}

/// Whether this is a LAZ file that promises more points than are worth the time: if all are equal, they take
/// less than a hundredth of a bit each.
bool is_laz_of_many_points(std::string_view bytes) {
  constexpr std::uint64_t kMany = 50'000;
  return point_files::is_laz(bytes) && point_files::promised_points_of_las(bytes).value_or(0) > kMany;
}

/// What can be read in parts has the same points then.
void check_parts(const std::string& path, const PointFile& file, PointFileOptions options) {
  if (!options.by.empty() || !is_read_in_parts(path, options)) return;
  std::vector<Point> points;
  options.take_points = [&](std::span<const Point> block) {
    points.insert(points.end(), block.begin(), block.end());
  };
  constexpr std::size_t kParts = 3;
  for (std::size_t part = 0; part < kParts; ++part) {
    options.part = {part, kParts};
    read_point_file(path, options);
  }
  expect(points == file.points, "the parts of a file have other points than the file");
  options.part = {};
  expected_points(path, options);
}

/// Shapes of a few points, as the tool makes them.
void make_shapes(const PointFile& file, std::uint8_t choice) {
  constexpr std::size_t kMany = 400;
  if (file.points.size() > kMany || file.labels.size() > kMany) return;
  HullOptions options;
  options.wanted.cover = (choice & 1U) != 0;
  options.wanted.one = (choice & 2U) != 0;
  if ((choice & 4U) != 0) options.simplify = 0.5;
  if ((choice & 8U) != 0) options.core.max_edge_length = 1;
  if ((choice & 16U) != 0) options.max_parts = 2;
  if (file.crs.is_geographic && !could_be_degrees(bounding_box(file.points))) return;  // they are refused
  const std::optional<double> latitude = middle_latitude(file.crs, file.points);
  const std::vector<Point> plane = latitude ? to_metres(file.points, *latitude) : file.points;
  std::vector<GroupHull> hulls;
  try {
    hulls = group_hulls(plane, file.groups, file.labels.size(), options, 2);
  } catch (const std::invalid_argument&) {
    return;  // the coordinates span more than the core takes
  }
  std::vector<std::string> features;
  for (std::size_t g = 0; g < hulls.size(); ++g) {
    expect(!options.wanted.one || hulls[g].shape.size() <= 1, "one polygon is several");
    Properties properties;
    if (!file.labels.empty()) properties.add("label", std::string_view(file.labels[g]));
    properties.add("area", hulls[g].area);
    features.push_back(geojson_feature(properties, to_coordinates(hulls[g].shape, file.points)));
  }
  const std::string text = geojson_collection(features, geojson_crs(file.crs));
  expect(nlohmann::json::accept(text), "what is written is no JSON");
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kChoices = 3;
  if (size < kChoices) return 0;
  PointFileOptions options;
  options.format = *point_format_of(fuzz::kFuzzedFormat);
  options.by = kBy[data[0] % kBy.size()];
  options.columns = kColumns[data[1] % kColumns.size()];
  if ((data[1] & 4U) != 0) options.window = Box{{-1, -2}, {5, 6}};
  if ((data[1] & 8U) != 0) options.returns = Returns::kFirst;
  if ((data[1] & 16U) != 0) options.returns = Returns::kLast;
  if ((data[1] & 32U) != 0) options.classes.emplace(0x44U);
  const std::string_view bytes(reinterpret_cast<const char*>(data) + kChoices, size - kChoices);
  if (is_laz_of_many_points(bytes)) return 0;
  const fuzz::MemoryFile input(bytes, (data[1] & 64U) != 0);
  try {
    const PointFile file = read_point_file(input.path(), options);
    check(file, options);
    check_parts(input.path(), file, options);
    make_shapes(file, data[2]);
  } catch (const PointFileError& error) {
    fuzz::check_refusal(error, input);
  }
  return 0;
}
