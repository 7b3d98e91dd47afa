#include "tool/points/point_sources.hpp"

#include <array>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "tool/points/readers.hpp"

namespace polylidar::tool {

bool is_read_in_parts(const std::string& path, const PointFileOptions& options) {
  if (options.format != PointFormat::kAuto && options.format != PointFormat::kLas) return false;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  std::array<char, point_files::kLasStart> start{};
  std::ifstream stream(path, std::ios::binary);
  stream.read(start.data(), start.size());
  return stream.good() && point_files::is_uncompressed_las({start.data(), start.size()});
}

std::vector<PointSource> point_sources(const std::string& path, const PointFileOptions& options,
                                       std::size_t most_parts, const OnRead& on_read) {
  const std::size_t count = most_parts > 1 && is_read_in_parts(path, options) ? most_parts : 1;
  std::vector<PointSource> sources;
  for (std::size_t number = 0; number < count; ++number) {
    sources.emplace_back([path, options, number, count, on_read](const TakePoints& take) {
      PointFileOptions of_part = options;
      of_part.take_points = take;
      of_part.part = {number, count};
      on_read(number, read_point_file(path, of_part));
    });
  }
  return sources;
}

}  // namespace polylidar::tool
