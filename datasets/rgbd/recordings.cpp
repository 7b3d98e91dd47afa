#include "datasets/rgbd/recordings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "datasets/rgbd/depth_image.hpp"
#include "datasets/rgbd/floor_points.hpp"
#include "datasets/shapes.hpp"

namespace hullbench {

using polylidar::Point;

namespace {

constexpr const char* kPointsFile = "points.txt";
constexpr const char* kDepthFile = "depth.png";
constexpr std::string_view kBlanks = " \t\r";

bool is_scene(const std::filesystem::path& folder) {
  return std::filesystem::is_directory(folder) &&
         (std::filesystem::exists(folder / kPointsFile) || std::filesystem::exists(folder / kDepthFile));
}

void skip_blanks(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
}

/// The numbers of a line; none when anything else is in it.
std::optional<std::vector<double>> parse_numbers(std::string_view line) {
  std::vector<double> numbers;
  skip_blanks(line);
  while (!line.empty()) {
    double number = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
    if (error != std::errc{}) return std::nullopt;
    numbers.push_back(number);
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    const std::size_t before = line.size();
    skip_blanks(line);
    if (line.empty()) break;
    const bool has_comma = line.front() == ',';
    if (has_comma) {
      line.remove_prefix(1);
      skip_blanks(line);
    }
    // "1.2.3" must not pass as two numbers, nor "1,2," as two.
    if (line.empty() || (!has_comma && line.size() == before)) return std::nullopt;
  }
  return numbers;
}

Point parse_point(std::string_view line, const std::string& where) {
  const auto numbers = parse_numbers(line);
  if (!numbers || numbers->size() < 2 || numbers->size() > 3) {
    throw std::runtime_error(where + " is not two or three numbers; write a point as x y or x y z");
  }
  if (!std::all_of(numbers->begin(), numbers->end(), [](double number) { return std::isfinite(number); })) {
    throw std::runtime_error(where + " has a number that is not finite; remove the point");
  }
  return {(*numbers)[0], (*numbers)[1]};
}

std::vector<Point> read_points(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  // A folder opens as a file does on Linux, and only reading it fails.
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read " + path.string() + "; check that the file exists and may be read");
  }
  std::vector<Point> points;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    std::string_view text = line;
    skip_blanks(text);
    if (text.empty() || text.front() == '#') continue;
    points.push_back(parse_point(text, path.string() + ", line " + std::to_string(number) + ","));
  }
  return points;
}

std::vector<Point> points_of(const std::filesystem::path& scene) {
  if (std::filesystem::exists(scene / kPointsFile)) return read_points(scene / kPointsFile);
  const std::filesystem::path depth_file = scene / kDepthFile;
  if (!std::filesystem::exists(depth_file)) {
    throw std::runtime_error(scene.string() +
                             " has neither points.txt nor depth.png; add one, with gt.geojson beside it");
  }
  const DepthImage image = read_depth_png(depth_file, read_intrinsics(scene / "intrinsics.json"));
  try {
    return floor_points(image);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(depth_file.string() + " shows no floor: " + error.what());
  }
}

}  // namespace

std::vector<std::string> list_recordings(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(folder.string() + " is not a folder; give the one that holds the recordings");
  }
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (is_scene(entry.path())) names.push_back(entry.path().filename().string());
  }
  if (names.empty()) {
    throw std::runtime_error(
        folder.string() +
        " has no recording; put each into a sub-folder with gt.geojson and points.txt, or "
        "depth.png and intrinsics.json");
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<Point> recorded_points(const std::filesystem::path& scene) {
  std::vector<Point> points = points_of(scene);
  if (points.size() < 3) {
    throw std::runtime_error(scene.string() + " has " + std::to_string(points.size()) +
                             " points; a hull needs at least 3: give a longer recording");
  }
  return points;
}

FloorScene load_recording(const std::filesystem::path& scene) {
  std::vector<Point> points = recorded_points(scene);
  return {std::move(points), read_geojson(scene / "gt.geojson")};
}

}  // namespace hullbench
