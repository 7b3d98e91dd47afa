// A JSON file as a document, with errors a user can act on.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace hullbench {

/// Throws std::runtime_error naming `path` when it cannot be read or does not hold JSON.
nlohmann::json read_json_file(const std::filesystem::path& path);

}  // namespace hullbench
