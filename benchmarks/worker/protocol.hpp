// The worker protocol, version 1: how the harness speaks with a method in another process.
// adapters/process/PROTOCOL.md describes it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/adapter.hpp"

namespace hullbench::worker {

inline constexpr int kProtocolVersion = 1;

/// The longest line either side may send, line feed included.
inline constexpr std::size_t kMaxLineBytes = std::size_t{1024} * 1024;

/// {name, title, version, licence, citation, native_output, parameters: [{name, unit, description, minimum,
/// maximum, default}], capabilities: {holes, several_polygons, in_server}}. An infinite limit or default is
/// null; a parameter that is required has no member "default".
nlohmann::json method_to_json(const MethodInfo& info);
/// Throws nlohmann::json::exception or std::invalid_argument when a member is missing or of the wrong type.
MethodInfo method_from_json(const nlohmann::json& source);

/// Writes `points` as `load` wants them. Throws std::runtime_error naming the file when it cannot be written.
void write_points_file(const std::filesystem::path& path, std::span<const Point> points);
/// Throws std::runtime_error naming the file when it cannot be read or does not hold exactly `n` points.
std::vector<Point> read_points_file(const std::filesystem::path& path, std::size_t n);

/// The bytes of a file, or the reason why they cannot be had as std::runtime_error. Only regular files of at
/// most `max_bytes`.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, std::size_t max_bytes);
/// Writes a file anew. Throws std::runtime_error naming the file and the system's reason.
void write_bytes(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

/// `text` as it can stand in a one-line message: control characters become spaces, bytes that are not ASCII
/// `?`, and of more than `max_size` characters the last ones are kept.
std::string printable(std::string_view text, std::size_t max_size);

}  // namespace hullbench::worker
