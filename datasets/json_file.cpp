#include "datasets/json_file.hpp"

#include <cstddef>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace hullbench {

nlohmann::json parse_json_text(const std::string& text) {
  using nlohmann::json;
  std::vector<std::set<std::string>> keys;  // of the objects that are open, by depth
  const auto look = [&](int depth, json::parse_event_t event, const json& parsed) {
    const auto level = static_cast<std::size_t>(depth);
    if (event == json::parse_event_t::object_start) {
      keys.resize(level);
      keys.emplace_back();
    } else if (event == json::parse_event_t::key) {
      const auto key = parsed.get<std::string>();
      if (!keys[level - 1].insert(key).second)
        throw RepeatedKey("has the key '" + key + "' twice in one object; leave one out");
    }
    return false;
  };
  // A pass of its own, which keeps nothing: to keep long lists of objects the parser takes quadratic time
  // when it has a callback.
  [[maybe_unused]] const json nothing = json::parse(text, look);
  return json::parse(text);
}

nlohmann::json read_json_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  // A folder opens as a file does on Linux, and only reading it fails.
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read " + path.string() + "; check that the file exists and may be read");
  }
  try {
    return parse_json_text(std::string(std::istreambuf_iterator<char>(file), {}));
  } catch (const RepeatedKey& error) {
    throw std::runtime_error(path.string() + " " + error.what());
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path.string() + " is not valid JSON (" + error.what() +
                             "); correct it or restore it from the repository");
  }
}

}  // namespace hullbench
