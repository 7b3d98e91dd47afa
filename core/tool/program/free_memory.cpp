#include "tool/program/free_memory.hpp"

#include <fstream>
#include <string>

namespace polylidar::tool {

std::optional<std::size_t> free_memory() {
  std::ifstream lines("/proc/meminfo");
  std::string name;
  std::size_t kibibytes = 0;
  std::string unit;
  while (lines >> name >> kibibytes && std::getline(lines, unit)) {
    if (name == "MemAvailable:") return kibibytes << 10U;
  }
  return std::nullopt;
}

}  // namespace polylidar::tool
