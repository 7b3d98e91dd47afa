#include "tool/program/free_memory.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace polylidar::tool {
namespace {

namespace fs = std::filesystem;

/// The number that a file consists of; nothing where it is another word, such as "max", or there is no file.
std::optional<std::size_t> number_in(const fs::path& file) {
  std::ifstream in(file);
  std::size_t number = 0;
  return in >> number ? std::optional(number) : std::nullopt;
}

/// The number behind a name, in a file of names and numbers.
std::optional<std::size_t> number_of(const fs::path& file, const std::string& wanted) {
  std::ifstream lines(file);
  std::string name;
  std::size_t number = 0;
  std::string rest;
  while (lines >> name >> number && std::getline(lines, rest)) {
    if (name == wanted) return number;
  }
  return std::nullopt;
}

/// Where a version of control groups tells its limits, and how it calls them.
struct GroupFiles {
  const char* root;
  const char* limit;
  const char* used;
  const char*
      cached;  ///< of what is used the part that the system gives back if it is needed, in memory.stat
};
constexpr GroupFiles kVersion2 = {"sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};
constexpr GroupFiles kVersion1 = {"sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes",
                                  "total_inactive_file"};

/// What a group and those above it leave of their limits; `most` where there is none.
std::size_t left_by_group(const fs::path& root, const GroupFiles& files, const fs::path& group,
                          std::size_t most) {
  for (fs::path path = group;; path = path.parent_path()) {
    const fs::path folder = root / files.root / path.relative_path();
    const std::optional<std::size_t> limit = number_in(folder / files.limit);
    const std::optional<std::size_t> used = number_in(folder / files.used);
    if (limit && used) {
      const std::size_t cached = number_of(folder / "memory.stat", files.cached).value_or(0);
      const std::size_t needed = *used - std::min(*used, cached);
      most = std::min(most, *limit - std::min(*limit, needed));
    }
    if (path == path.parent_path()) return most;
  }
}

}  // namespace

std::optional<std::size_t> free_memory(const fs::path& root) {
  const std::optional<std::size_t> kibibytes = number_of(root / "proc/meminfo", "MemAvailable:");
  if (!kibibytes) return std::nullopt;
  std::size_t least = *kibibytes << 10U;
  // Such as 0::/user.slice/job of version 2, and 4:memory:/job of version 1.
  std::ifstream groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t path = line.find(":/");
    if (path == std::string::npos) continue;
    const bool is_version_2 = line.starts_with("0:");
    if (!is_version_2 && !line.substr(0, path).ends_with(":memory")) continue;
    least = left_by_group(root, is_version_2 ? kVersion2 : kVersion1, line.substr(path + 1), least);
  }
  return least;
}

}  // namespace polylidar::tool
