#include "benchmarks/worker/stray_processes.hpp"

#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include "adapters/process_identity.hpp"

namespace hullbench::worker {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

using IsWanted = std::function<bool(const std::string& mark)>;

/// For who has something to clean up: a server that is asked to stop takes up to 4 s (postgres_supervisor).
constexpr auto kPatience = 6s;
/// Between two looks at the processes that are left.
constexpr auto kLook = 10ms;
/// A process that forks as fast as it is killed is given up on after so many rounds; each takes all that are
/// there.
constexpr int kKillRounds = 200;

/// The mark in a process's environment; none where it has none, has ended, or is not ours to read.
std::optional<std::string> mark_of(const std::filesystem::path& process) {
  std::ifstream environment(process / "environ", std::ios::binary);
  const std::string prefix = std::string(kMarkVariable) + "=";
  for (std::string variable; std::getline(environment, variable, '\0');) {
    if (variable.starts_with(prefix)) return variable.substr(prefix.size());
  }
  return std::nullopt;
}

/// The other processes whose mark `wanted` accepts.
std::vector<pid_t> marked_processes(const IsWanted& wanted) {
  std::vector<pid_t> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const auto pid = static_cast<pid_t>(std::stol(name));
    if (pid == ::getpid()) continue;
    const std::optional<std::string> mark = mark_of(entry.path());
    if (mark && wanted(*mark)) found.push_back(pid);
  }
  return found;
}

void kill_all(const IsWanted& wanted) {
  for (int round = 0; round < kKillRounds; ++round) {
    const std::vector<pid_t> left = marked_processes(wanted);
    if (left.empty()) return;
    // Stopped first, so that none forks while the others are killed.
    for (const int signal : {SIGSTOP, SIGKILL}) {
      for (const pid_t pid : left) ::kill(pid, signal);
    }
    std::this_thread::sleep_for(kLook);
  }
}

void end_all(const IsWanted& wanted) {
  for (const pid_t pid : marked_processes(wanted)) ::kill(pid, SIGTERM);
  const auto deadline = Clock::now() + kPatience;
  while (!marked_processes(wanted).empty()) {
    if (Clock::now() >= deadline) return kill_all(wanted);
    std::this_thread::sleep_for(kLook);
  }
}

}  // namespace

std::string new_worker_mark() {
  static std::atomic<unsigned> count = 0;
  return process_identity() + "." + std::to_string(++count);
}

void end_strays(const std::string& mark) {
  end_all([&](const std::string& other) { return other == mark; });
}

void end_strays_of_dead_harnesses() {
  end_all([](const std::string& mark) { return !is_process_alive(mark.substr(0, mark.rfind('.'))); });
}

}  // namespace hullbench::worker
