#include "datasets/point_bytes.hpp"

#include <bit>
#include <cstdint>

namespace hullbench {

std::string point_bytes(std::span<const polylidar::Point> points) {
  std::string bytes;
  bytes.reserve(points.size() * 16);
  for (const polylidar::Point& point : points) {
    for (const double value : {point.x, point.y}) {
      const auto bits = std::bit_cast<std::uint64_t>(value);
      for (unsigned shift = 0; shift < 64; shift += 8) bytes += static_cast<char>((bits >> shift) & 0xFFU);
    }
  }
  return bytes;
}

}  // namespace hullbench
