#include "adapters/server_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

namespace hullbench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "hullbench-postgres-";

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

// In doubt alive: a process of another namespace cannot be seen from here.
bool owner_is_alive(const fs::path& folder) {
  std::string name = folder.filename().string().substr(kPrefix.size());
  std::replace(name.begin(), name.end(), '-', ' ');
  std::istringstream parts(name);
  std::string space;
  pid_t pid = 0;
  std::string start;
  if (!(parts >> space >> pid >> start) || space != process_namespace()) return true;
  if (kill(pid, 0) != 0 && errno == ESRCH) return false;
  const std::optional<std::string> started = start_time(std::to_string(pid));
  return !started || *started == start;
}

// Kills every process whose working folder is inside `folder`: postgres and its children work in their data
// folder, initdb in the folder itself. True when there was one.
bool kill_processes_in(const fs::path& folder) {
  bool found = false;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string working_folder = fs::read_symlink(entry.path() / "cwd", ignored).string();
    if (!(working_folder + "/").starts_with(folder.string() + "/")) continue;
    found = kill(static_cast<pid_t>(std::stol(name)), SIGKILL) == 0 || found;
  }
  return found;
}

}  // namespace

std::string server_folder_owner() {
  const std::string pid = std::to_string(getpid());
  return process_namespace() + "-" + pid + "-" + start_time(pid).value_or("0");
}

std::string server_folder_template(const std::string& owner) {
  return std::string(kPrefix) + owner + "-XXXXXX";
}

fs::path make_server_folder(const fs::path& base, const std::string& owner) {
  std::string name = base / server_folder_template(owner);
  if (mkdtemp(name.data()) == nullptr) {
    throw std::system_error(errno, std::generic_category(), "make a folder in " + base.string());
  }
  return name;
}

void remove_server_folder(const fs::path& folder) {
  // A process that is being killed may start another one or write another file.
  for (int attempt = 0; attempt < 100; ++attempt) {
    const bool killed = kill_processes_in(folder);
    std::error_code error;
    fs::remove_all(folder, error);
    if (!killed && !error) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void remove_stale_server_folders(const fs::path& base) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(base, ignored)) {
    if (!entry.path().filename().string().starts_with(kPrefix)) continue;
    struct stat status {};
    if (lstat(entry.path().c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) continue;
    if (status.st_uid == geteuid() && !owner_is_alive(entry.path())) remove_server_folder(entry.path());
  }
}

}  // namespace hullbench
