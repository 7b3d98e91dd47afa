#include "adapters/postgres_supervisor.hpp"

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "adapters/server_folder.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kLook{10};  // between two looks at something that gives no event
constexpr milliseconds kStartLimit{60'000};
constexpr milliseconds kFastStopLimit{2'000};
constexpr milliseconds kImmediateStopLimit{2'000};

/// The owner ended while the server was starting.
struct OwnerGone {};

[[noreturn]] void fail(const std::string& task) {
  throw std::system_error(errno, std::generic_category(), task);
}

void close_range_inclusive(unsigned first, unsigned last) {
  if (first <= last) close_range(first, last, 0);
}

void handle_signal(int number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(number, &action, nullptr);
}

// Leaves the owner's session (Ctrl-C is not for us), standard streams and every other descriptor.
void detach(int lifeline, int report) {
  setsid();
  prctl(PR_SET_NAME, "hullbench-pg");
  for (const int ignored : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) handle_signal(ignored, SIG_IGN);
  handle_signal(SIGCHLD, SIG_DFL);
  const int nothing = open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) dup2(nothing, stream);
  const auto low = static_cast<unsigned>(std::min(lifeline, report));
  const auto high = static_cast<unsigned>(std::max(lifeline, report));
  close_range_inclusive(3, low - 1);
  close_range_inclusive(low + 1, high - 1);
  close_range_inclusive(high + 1, ~0U);
  if (chdir("/") != 0) fail("go to /");
}

// PostgreSQL refuses to run as root. Done before anything is touched on disk: cleaning up folders that others
// can name is not work for root.
void drop_root() {
  if (geteuid() != 0) return;
  const passwd* user = getpwnam("postgres");
  if (user == nullptr) user = getpwnam("nobody");
  if (user == nullptr) throw std::runtime_error("there is no user 'postgres' or 'nobody' to be");
  if (setgroups(0, nullptr) != 0 || setresgid(user->pw_gid, user->pw_gid, user->pw_gid) != 0 ||
      setresuid(user->pw_uid, user->pw_uid, user->pw_uid) != 0) {
    fail("become the user '" + std::string(user->pw_name) + "'");
  }
}

// The environment without PostgreSQL's own variables (PGDATA and the like), in one language and time zone:
// initdb otherwise spends its time searching for the machine's.
std::vector<std::string> server_environment() {
  std::vector<std::string> environment = {"LC_ALL=C", "TZ=UTC"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const bool replaced = text.starts_with("PG") || text.starts_with("LC_ALL=") || text.starts_with("TZ=");
    if (!replaced) environment.emplace_back(text);
  }
  return environment;
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  result.reserve(strings.size() + 1);
  for (std::string& string : strings) result.push_back(string.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> initdb_command(const fs::path& bin, const fs::path& folder) {
  return {bin / "initdb",         "--pgdata=" + (folder / "data").string(),
          "--username=hullbench", "--auth-local=trust",
          "--auth-host=reject",   "--encoding=UTF8",
          "--no-locale",          "--no-sync"};
}

std::vector<std::string> server_command(const fs::path& bin, const fs::path& folder) {
  std::vector<std::string> command = {bin / "postgres", "-D", folder / "data"};
  for (const std::string& setting : {
           std::string("listen_addresses="),
           "unix_socket_directories=" + folder.string(),
           std::string("unix_socket_permissions=0700"),
           std::string("port=5432"),
           std::string("max_connections=10"),
           // Nothing here outlives the process: no care for crashes.
           std::string("fsync=off"),
           std::string("synchronous_commit=off"),
           std::string("full_page_writes=off"),
           std::string("wal_level=minimal"),
           std::string("max_wal_senders=0"),
           // No work beside the query that is timed.
           std::string("autovacuum=off"),
           std::string("jit=off"),
           std::string("max_parallel_workers_per_gather=0"),
           std::string("max_worker_processes=0"),
           std::string("shared_buffers=32MB"),
           // As files in the data folder, so that a killed server leaves no segments in /dev/shm.
           std::string("dynamic_shared_memory_type=mmap"),
           std::string("logging_collector=off"),
       }) {
    command.insert(command.end(), {"-c", setting});
  }
  return command;
}

class Supervisor {
 public:
  explicit Supervisor(const SupervisorPlan& plan) : plan_(plan) {}

  ~Supervisor() {
    if (server_) stop_server();
    if (!folder_.empty()) remove_server_folder(folder_);
  }

  void start() {
    folder_ = make_server_folder(plan_.base, plan_.owner);
    initialise();
    server_ = spawn(server_command(plan_.bin, folder_));
    wait_until("start", [this] { return server_is_ready(); });
  }

  const fs::path& folder() const { return folder_; }

  void wait_for_owner() {
    pollfd lifeline{plan_.lifeline, POLLIN, 0};
    while (poll(&lifeline, 1, -1) < 0 && errno == EINTR) {
    }
  }

 private:
  void initialise() {
    const pid_t initdb = spawn(initdb_command(plan_.bin, folder_));
    int status = 0;
    wait_until("initialise", [&] { return waitpid(initdb, &status, WNOHANG) != 0; });
    if (status != 0) throw std::runtime_error("initdb failed: " + end_of_log());
  }

  // Looks every few milliseconds until `done`; throws when the owner ends or it takes too long.
  template <typename Condition>
  void wait_until(const char* task, Condition done) {
    const auto deadline = Clock::now() + kStartLimit;
    while (!done()) {
      pollfd lifeline{plan_.lifeline, POLLIN, 0};
      if (poll(&lifeline, 1, static_cast<int>(kLook.count())) > 0) throw OwnerGone{};
      if (Clock::now() > deadline) {
        throw std::runtime_error(std::string("it did not ") + task + " within a minute: " + end_of_log());
      }
    }
  }

  // The last line of postmaster.pid is the server's state, the one that pg_ctl waits for.
  bool server_is_ready() {
    if (server_has_ended()) throw std::runtime_error("it ended at once: " + end_of_log());
    std::ifstream file(folder_ / "data" / "postmaster.pid");
    std::string line;
    for (int number = 0; number < 8; ++number) std::getline(file, line);
    return file && line.starts_with("ready");
  }

  bool server_has_ended() {
    if (server_ && waitpid(*server_, nullptr, WNOHANG) != 0) server_.reset();
    return !server_;
  }

  pid_t spawn(std::vector<std::string> command) {
    std::vector<std::string> environment = server_environment();
    const std::vector<char*> arguments = pointers(command);
    const std::vector<char*> variables = pointers(environment);
    const pid_t child = fork();
    if (child < 0) fail("start " + command[0]);
    if (child == 0) {
      prepare_child();
      execve(arguments[0], arguments.data(), variables.data());
      _exit(127);
    }
    return child;
  }

  // Undoes what the owner or `detach` did to signals, and leaves the program with the log as its only open
  // file.
  void prepare_child() {
    for (int number = 1; number < NSIG; ++number) handle_signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    const int log = open((folder_ / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
    dup2(log, 1);
    dup2(log, 2);
    close_range(3, ~0U, 0);
    if (chdir(folder_.c_str()) != 0) _exit(126);
  }

  std::string end_of_log() const {
    std::ifstream file(folder_ / "log");
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
      if (!line.empty()) lines.push_back(line);
    }
    std::string end;
    for (std::size_t index = lines.size() > 3 ? lines.size() - 3 : 0; index < lines.size(); ++index) {
      end += (end.empty() ? "" : " | ") + lines[index];
    }
    return end.empty() ? "its log is empty" : end;
  }

  // SIGINT: cancels queries and shuts down; SIGQUIT: ends without a checkpoint. A library that is deep in a
  // computation may hear neither; then remove_server_folder kills.
  void stop_server() {
    for (const auto& [number, limit] :
         {std::pair(SIGINT, kFastStopLimit), std::pair(SIGQUIT, kImmediateStopLimit)}) {
      kill(*server_, number);
      const auto deadline = Clock::now() + limit;
      while (Clock::now() < deadline) {
        if (server_has_ended()) return;
        std::this_thread::sleep_for(kLook);
      }
    }
  }

  const SupervisorPlan& plan_;
  fs::path folder_;
  std::optional<pid_t> server_;
};

void send_report(int report, const std::string& message) {
  std::string_view rest = message;
  while (!rest.empty()) {
    const ssize_t written = write(report, rest.data(), rest.size());
    if (written < 0 && errno != EINTR) break;
    if (written > 0) rest.remove_prefix(static_cast<std::size_t>(written));
  }
  close(report);
}

}  // namespace

void supervise(const SupervisorPlan& plan) {
  try {
    detach(plan.lifeline, plan.report);
    drop_root();
    remove_stale_server_folders(plan.base);
    Supervisor supervisor(plan);
    supervisor.start();
    send_report(plan.report, "ready " + supervisor.folder().string());
    supervisor.wait_for_owner();
  } catch (const OwnerGone&) {
    _exit(1);
  } catch (const std::exception& error) {
    send_report(plan.report, std::string("failed ") + error.what());
    _exit(1);
  }
  _exit(0);
}

}  // namespace hullbench
