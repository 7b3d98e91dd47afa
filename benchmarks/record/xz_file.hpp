// Files compressed by xz, as reference runs keep their records.
#pragma once

#include <filesystem>
#include <string>

namespace hullbench::record {

/// What the file holds, decompressed. At most 1 GiB of it: a small file could else stand for any amount.
/// Throws std::runtime_error naming the file when it cannot be read, is damaged or cut short, or holds more.
std::string read_xz_file(const std::filesystem::path& path);

}  // namespace hullbench::record
