#include "datasets/json_file.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace hullbench {

nlohmann::json read_json_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  // A folder opens as a file does on Linux, and only reading it fails.
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read " + path.string() + "; check that the file exists and may be read");
  }
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path.string() + " is not valid JSON (" + error.what() +
                             "); correct it or restore it from the repository");
  }
}

}  // namespace hullbench
