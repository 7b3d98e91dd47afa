// Any bytes as a file of points: they are read or refused in one sentence, and what was read becomes shapes
// and a document that is JSON.
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tool/hull/degrees.hpp"
#include "tool/hull/group_hulls.hpp"
#include "tool/points/point_file.hpp"
#include "tool/shapes/point_locator.hpp"
#include "tool/shapes/polygon_writers.hpp"

namespace {

using namespace polylidar;
using namespace polylidar::tool;

constexpr std::array<const char*, 8> kFormats = {"auto", "csv", "xyz", "geojson", "wkt", "npy", "ply", "las"};
constexpr std::array<const char*, 6> kBy = {"", "3", "kind", "classification", "return", "point_source"};
constexpr std::array<const char*, 4> kColumns = {"", "1,2", "2,1", "b,a"};

void expect(bool holds, const char* what) {
  if (holds) return;
  std::cerr << "FAILED: " << what << std::endl;
  std::abort();
}

bool is_utf8(std::string_view text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

/// The bytes as a file, or as a pipe, whose length nobody knows, while they fit into one.
class Input {
 public:
  Input(std::string_view bytes, bool as_pipe) {
    std::array<int, 2> ends{};
    if (as_pipe && bytes.size() < 60000 && ::pipe(ends.data()) == 0) {
      file_ = ends[0];
      write_to(ends[1], bytes);
      ::close(ends[1]);
    } else {
      file_ = ::memfd_create("points", 0);
      write_to(file_, bytes);
    }
  }
  ~Input() { ::close(file_); }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  static void write_to(int file, std::string_view bytes) {
    expect(::write(file, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()),
           "no room for the input");
  }

  int file_ = -1;
};

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
}

/// Shapes of a few points, as the tool makes them.
void make_shapes(const PointFile& file, std::uint8_t choice) {
  constexpr std::size_t kMany = 400;
  if (file.points.size() > kMany || file.labels.size() > kMany) return;
  HullOptions options;
  options.cover = (choice & 1U) != 0;
  options.one = (choice & 2U) != 0;
  if ((choice & 4U) != 0) options.simplify = 0.5;
  if ((choice & 8U) != 0) options.core.max_edge_length = 1;
  if ((choice & 16U) != 0) options.max_parts = 2;
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
    expect(!options.one || hulls[g].shape.size() <= 1, "one polygon is several");
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
  // No program is to be started for what looks like LAZ.
  ::setenv("PATH", "", 1);
  PointFileOptions options;
  options.format = *point_format_of(kFormats[data[0] % kFormats.size()]);
  options.by = kBy[data[0] / kFormats.size() % kBy.size()];
  options.columns = kColumns[data[1] % kColumns.size()];
  if ((data[1] & 4U) != 0) options.window = Box{{-1, -2}, {5, 6}};
  if ((data[1] & 8U) != 0) options.returns = Returns::kFirst;
  if ((data[1] & 16U) != 0) options.returns = Returns::kLast;
  if ((data[1] & 32U) != 0) options.classes.emplace(0x44U);
  if ((data[1] & 128U) != 0) options.format = PointFormat::kRaw;
  const Input input({reinterpret_cast<const char*>(data) + kChoices, size - kChoices}, (data[1] & 64U) != 0);
  try {
    const PointFile file = read_point_file(input.path(), options);
    check(file, options);
    check_parts(input.path(), file, options);
    make_shapes(file, data[2]);
  } catch (const PointFileError& error) {
    const std::string_view what = error.what();
    expect(what.find(input.path()) != std::string_view::npos, "a refusal does not name the file");
    const auto is_shown = [](char c) { return static_cast<unsigned char>(c) >= ' ' && c != '\x7F'; };
    expect(std::all_of(what.begin(), what.end(), is_shown) && is_utf8(what),
           "a refusal is not one line of plain text");
  }
  return 0;
}
