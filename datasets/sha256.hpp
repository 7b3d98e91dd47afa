// SHA-256 (FIPS 180-4): how files, point sets and results are identified.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace hullbench {

/// Lower-case hex SHA-256 of `bytes`: 64 characters.
std::string sha256_hex(std::string_view bytes);

/// Lower-case hex SHA-256 of a file's content; throws std::runtime_error naming the file when it cannot be
/// read.
std::string sha256_file(const std::filesystem::path& path);

}  // namespace hullbench
