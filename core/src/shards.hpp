// What finding the shards of a stream and putting them together have in common.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "polylidar/stream.hpp"

namespace polylidar::detail {

/// Up to so many points are put into memory, all by the first shard.
inline constexpr std::uint64_t kFewPoints = std::uint64_t{1} << 16U;

/// Whether all points are on a line parallel to an axis, where a grid has no cells.
inline bool is_flat(const Box& box) {
  return box.min.x == box.max.x || box.min.y == box.max.y;
}

/// For messages.
inline std::string name_of(const Shard& shard) {
  return "shard " + std::to_string(shard.number) + " of " + std::to_string(shard.count);
}

inline std::invalid_argument too_much_outline() {
  return std::invalid_argument("more than 2^28 points are near the outline: give a larger limit");
}

}  // namespace polylidar::detail
