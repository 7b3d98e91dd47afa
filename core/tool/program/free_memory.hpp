// How much memory the system has left.
#pragma once

#include <cstddef>
#include <optional>

namespace polylidar::tool {

/// Bytes of memory that are free or can be freed; none when the system does not say.
std::optional<std::size_t> free_memory();

}  // namespace polylidar::tool
