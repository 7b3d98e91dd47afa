#include "adapters/process_identity.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>
#include <vector>

namespace hullbench {
namespace {

namespace fs = std::filesystem;

std::string process_namespace() {
  std::error_code ignored;
  const std::string link = fs::read_symlink("/proc/self/ns/pid", ignored).string();  // pid:[4026531836]
  std::string number;
  for (const char character : link) {
    if (character >= '0' && character <= '9') number += character;
  }
  return number.empty() ? "0" : number;
}

// The process's start in clock ticks since boot (field 22 of /proc/PID/stat). None when it cannot be read,
// which is not the same as an end: a system may hide the processes of other users. Empty for a process that
// has ended and waits for its parent.
std::optional<std::string> start_time(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/stat");
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(')');  // field 2, which may itself contain blanks and brackets
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream rest(line.substr(name_end + 1));
  const std::vector<std::string> fields{std::istream_iterator<std::string>(rest), {}};
  if (fields.size() < 20) return std::nullopt;
  return fields[0] == "Z" || fields[0] == "X" ? "" : fields[19];
}

}  // namespace

std::string process_identity() {
  const std::string pid = std::to_string(getpid());
  return process_namespace() + "-" + pid + "-" + start_time(pid).value_or("0");
}

bool is_process_alive(const std::string& identity) {
  std::string words = identity;
  std::replace(words.begin(), words.end(), '-', ' ');
  std::istringstream parts(words);
  std::string space;
  pid_t pid = 0;
  std::string start;
  if (!(parts >> space >> pid >> start) || space != process_namespace()) return true;
  if (kill(pid, 0) != 0 && errno == ESRCH) return false;
  const std::optional<std::string> started = start_time(std::to_string(pid));
  return !started || *started == start;
}

}  // namespace hullbench
