// A JSON file as a document, with errors a user can act on.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>

namespace hullbench {

/// "has the key 'n' twice in one object; leave one out"
class RepeatedKey : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The JSON in `text`. Throws nlohmann::json::exception when it is none, and RepeatedKey when an object has a
/// key twice: nlohmann::json::parse() takes the last value without a word.
nlohmann::json parse_json_text(const std::string& text);

/// Throws std::runtime_error naming `path` when it cannot be read, does not hold JSON or has a key twice.
nlohmann::json read_json_file(const std::filesystem::path& path);

}  // namespace hullbench
