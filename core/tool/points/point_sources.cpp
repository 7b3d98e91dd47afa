#include "tool/points/point_sources.hpp"

namespace polylidar::tool {

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
