#include "adapters/server_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <thread>

#include "adapters/process_identity.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "hullbench-postgres-";

bool owner_is_alive(const fs::path& folder) {
  const std::string name = folder.filename().string().substr(kPrefix.size());
  return is_process_alive(name.substr(0, name.rfind('-')));
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
