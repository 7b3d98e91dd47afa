#include <algorithm>
#include <cmath>
#include <vector>

#include "tool/points/numbers.hpp"
#include "tool/points/readers.hpp"

namespace polylidar::tool::point_files {

void read_raw(BlockReader& reader, PointFile& file) {
  constexpr std::size_t kSize = 2 * sizeof(double);
  const auto fail_size = [&] {
    reader.fail(
        "its size is no multiple of 16 bytes, so that it is no file of raw points; give one of little-endian "
        "doubles x, y, x, y, ..., or name its format with --input");
  };
  const PointFileOptions& options = reader.options();
  if (const std::optional<std::uint64_t> size = reader.remaining()) {
    if (*size % kSize != 0) fail_size();
    if (!options.take_points) reserve_points(file.points, static_cast<std::size_t>(*size / kSize));
  }
  std::uint64_t number = 0;
  std::vector<char> bytes;
  while (!reader.ahead().empty()) {
    // What is at hand may end within a point.
    bytes.resize(std::max(reader.ahead().size() / kSize, std::size_t{1}) * kSize);
    if (!reader.read(bytes.data(), bytes.size())) fail_size();
    for (const char* at = bytes.data(); at < bytes.data() + bytes.size(); at += kSize) {
      const Point point = {load(at, Scalar()), load(at + kSize / 2, Scalar())};
      ++number;
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
        reader.fail("point " + std::to_string(number) +
                    " has a coordinate that is not finite; remove such points before writing them");
      }
      if (options.window && !is_inside(point, *options.window)) continue;
      file.points.push_back(point);
    }
    hand_on(file, options);
  }
}

}  // namespace polylidar::tool::point_files
