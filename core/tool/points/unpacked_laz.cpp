#include "tool/points/unpacked_laz.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>

extern char** environ;

namespace polylidar::tool::point_files {

std::optional<std::string> find_laz_program() {
  const char* path = std::getenv("PATH");
  for (const char* name : {"laszip", "las2las"}) {
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
      const std::string program = (folder.empty() ? "." : folder) + "/" + name;
      if (::access(program.c_str(), X_OK) == 0) return program;
    }
  }
  return {};
}

UnpackedLaz::UnpackedLaz(const std::string& program, const std::string& path) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe can be made: " + std::generic_category().message(errno));
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  // We ignore it; the program is to end when nobody reads from it any more.
  sigset_t reset;
  sigemptyset(&reset);
  sigaddset(&reset, SIGPIPE);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &reset);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  std::string words[] = {program, "-i", path, "-stdout", "-olas"};
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < 5; ++i) arguments[i] = words[i].data();
  const int error =
      ::posix_spawn(&process_, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(ends[1]);
  file_ = ends[0];
  if (error == 0) return;
  ::close(file_);
  throw std::runtime_error(program + " cannot be started: " + std::generic_category().message(error));
}

UnpackedLaz::~UnpackedLaz() {
  if (process_ <= 0) return;
  ::kill(process_, SIGTERM);
  // It gets a second to end.
  constexpr int kLooks = 100;
  constexpr std::chrono::milliseconds kBetween(10);
  for (int look = 0; look < kLooks; ++look) {
    if (::waitpid(process_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(kBetween);
  }
  ::kill(process_, SIGKILL);
  succeeded();
}

bool UnpackedLaz::succeeded() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGPIPE;
  return WEXITSTATUS(status) == 0;
}

}  // namespace polylidar::tool::point_files
