#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tool/points/huge_pages.hpp"
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
  const auto check_finite = [&](const Point& point, std::uint64_t before) {
    if (std::isfinite(point.x) && std::isfinite(point.y)) return;
    reader.fail("point " + std::to_string(before + 1) +
                " has a coordinate that is not finite; remove such points before writing them");
  };
  const bool is_as_in_memory = std::endian::native == std::endian::little;
  std::vector<char> bytes;
  while (number < end && !reader.ahead().empty()) {
    // What is at hand may end within a point.
    const std::uint64_t at_hand = std::max<std::uint64_t>(reader.ahead().size() / kSize, 1);
    const auto count = static_cast<std::size_t>(std::min(at_hand, end - number));
    if (is_as_in_memory && !options.window) {
      file.points.resize(file.points.size() + count);
      const std::span<Point> read = std::span(file.points).last(count);
      if (!reader.read(reinterpret_cast<char*>(read.data()), read.size_bytes())) fail_size();
      if (!are_finite(read)) {
        for (std::size_t i = 0; i < count; ++i) check_finite(read[i], number + i);
      }
    } else {
      bytes.resize(count * kSize);
      if (!reader.read(bytes.data(), bytes.size())) fail_size();
      for (std::size_t i = 0; i < count; ++i) {
        const char* const at = &bytes[i * kSize];
        const Point point = {load(at, Scalar()), load(at + kSize / 2, Scalar())};
        check_finite(point, number + i);
        if (!options.window || is_inside(point, *options.window)) file.points.push_back(point);
      }
    }
    number += count;
    hand_on(file, options);
  }
}

}  // namespace polylidar::tool::point_files
