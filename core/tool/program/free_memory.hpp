// How much memory the system has left.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace polylidar::tool {

/// Bytes of memory that are free or can be freed, as far as the control groups of this process allow (those
/// of a container or a job); none when the system does not say. `root`: where proc and sys are.
std::optional<std::size_t> free_memory(const std::filesystem::path& root = "/");

}  // namespace polylidar::tool
