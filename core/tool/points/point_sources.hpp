// Files as the sources of a stream.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "polylidar/stream.hpp"
#include "tool/points/point_file.hpp"

namespace polylidar::tool {

/// Told each time that a part of a file was read, with all but its points; by the thread that read it.
using OnRead = std::function<void(std::size_t part, const PointFile& file)>;

/// The file as up to `most_parts` sources, one after the other; one source where it is not read in parts.
/// `options` are those of the file; `take_points` and `part` are set here. Reading throws as read_point_file.
std::vector<PointSource> point_sources(const std::string& path, const PointFileOptions& options,
                                       std::size_t most_parts, const OnRead& on_read);

}  // namespace polylidar::tool
