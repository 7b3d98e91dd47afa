// Files as the sources of a stream.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "polylidar/stream.hpp"
#include "tool/points/point_file.hpp"

namespace polylidar::tool {

/// What the points of all sources of a run may take, if the caller has no other reason.
inline constexpr std::uint64_t kMostKeptBytes = std::uint64_t{1} << 27U;

/// Into how many parts a file is divided for so many threads: more than these, so that one that is late
/// leaves some to the others.
inline std::size_t parts_for(std::size_t threads) {
  constexpr std::size_t kPartsForThread = 4;
  return threads == 1 ? 1 : kPartsForThread * threads;
}

/// What each of these files may keep, in bytes, as point_sources() takes it: of several, each LAS file gets
/// what its points need if there is room beside those before it, and the others nothing. All together have
/// `most`.
std::vector<std::uint64_t> kept_bytes(std::span<const std::string> paths, const PointFileOptions& options,
                                      std::uint64_t most = kMostKeptBytes);

/// Told each time that a source gave its part of a file, with all but its points; by the thread that took it.
using OnRead = std::function<void(std::size_t part, const PointFile& file)>;

/// The file as up to `most_parts` sources, one after the other; one source where it is not read in parts.
/// The points of a LAS file are kept, 8 bytes each, if they take no more than `most_kept_bytes`; it is read
/// once then. `options` are those of the file; `take_points`, `part` and `keep` are set here. Reading throws
/// as read_point_file.
std::vector<PointSource> point_sources(const std::string& path, const PointFileOptions& options,
                                       std::size_t most_parts, std::uint64_t most_kept_bytes,
                                       const OnRead& on_read);

}  // namespace polylidar::tool
