#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
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
  std::uint64_t number = 0;
  std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
  if (const std::optional<std::uint64_t> size = reader.remaining()) {
    if (*size % kSize != 0) fail_size();
    number = options.part.begin(*size / kSize);
    end = options.part.end(*size / kSize);
    if (!options.take_points) reserve_points(file.points, static_cast<std::size_t>(end - number));
    reader.skip(number * kSize);
  }
  std::vector<char> bytes;
  while (number < end && !reader.ahead().empty()) {
    // What is at hand may end within a point.
    const std::uint64_t at_hand = std::max<std::uint64_t>(reader.ahead().size() / kSize, 1);
    bytes.resize(static_cast<std::size_t>(std::min(at_hand, end - number)) * kSize);
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
