// polygons/: the results of a run as the methods gave them, to be scored again. A file each, named by its
// hash, so that the same result is there once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hullbench::record {

inline constexpr const char* kPolygonsFolder = "polygons";

/// SHA-256 of a result's WKB, as rows have it (output_sha256).
std::string hash_of(std::span<const std::uint8_t> wkb);

/// Writes `wkb` into the run's folder, unless it is there. Throws std::runtime_error naming the file when it
/// cannot be written.
void keep_polygons(const std::filesystem::path& run, std::span<const std::uint8_t> wkb);

/// The WKB with that hash in the run's folder; none when it was not kept. Throws std::runtime_error naming
/// the file when it cannot be read or is another one.
std::optional<std::vector<std::uint8_t>> kept_polygons(const std::filesystem::path& run,
                                                       const std::string& sha256);

}  // namespace hullbench::record
