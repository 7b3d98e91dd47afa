#include "adapters/private_postgres.hpp"

#include <fcntl.h>
#include <libpq-fe.h>
#include <spawn.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "adapters/adapter.hpp"
#include "adapters/postgres_supervisor.hpp"
#include "adapters/process_identity.hpp"
#include "adapters/server_folder.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;

// Where cmake/install-legacy.sh puts the paper's PostGIS, in the folder of caches of root or of the user.
constexpr const char* kLegacyBin = "hullbench/postgis-legacy/bin";

struct Pipe {
  int read_end;
  int write_end;
};

// Both ends close in every program that is started, and lie above the standard streams even where those are
// closed.
Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw std::system_error(errno, std::generic_category(), "make a pipe");
  for (int& end : ends) {
    if (end > 2) continue;
    const int moved = fcntl(end, F_DUPFD_CLOEXEC, 3);
    close(end);
    end = moved;
  }
  return {ends[0], ends[1]};
}

// Everything up to the end of the pipe, which is then closed.
std::string read_all(int pipe) {
  std::string text;
  std::array<char, 512> buffer{};
  for (;;) {
    const ssize_t size = read(pipe, buffer.data(), buffer.size());
    if (size > 0) text.append(buffer.data(), static_cast<std::size_t>(size));
    if (size == 0 || (size < 0 && errno != EINTR)) break;
  }
  close(pipe);
  return text;
}

// Whoever ignores SIGCHLD has no child to wait for: waitpid then returns when it has ended, with an error.
void wait_for(pid_t child) {
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

// The first line that `program argument` prints; empty when it cannot be run.
std::string first_line(const std::string& program, const std::string& argument) {
  std::array<std::string, 2> words = {program, argument};
  const std::array<char*, 3> command = {words[0].data(), words[1].data(), nullptr};
  const Pipe output = make_pipe();
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_addopen(&streams, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&streams, output.write_end, 1);
  posix_spawn_file_actions_addopen(&streams, 2, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const bool started = posix_spawnp(&child, command[0], &streams, nullptr, command.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&streams);
  close(output.write_end);
  const std::string text = read_all(output.read_end);
  if (started) wait_for(child);
  return text.substr(0, text.find('\n'));
}

// Empty when it is unset.
std::string environment_variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Root runs nothing that lies in a user's folder: HOME may be that of whoever called sudo.
std::vector<fs::path> cache_folders() {
  std::vector<fs::path> folders;
  const std::string cache = environment_variable("XDG_CACHE_HOME");
  const std::string home = environment_variable("HOME");
  if (geteuid() != 0 && !cache.empty()) {
    folders.emplace_back(cache);
  } else if (geteuid() != 0 && !home.empty()) {
    folders.push_back(fs::path(home) / ".cache");
  }
  folders.emplace_back("/var/cache");
  return folders;
}

bool can_run(const fs::path& program) {
  return access(program.c_str(), X_OK) == 0;
}

// "PostgreSQL 15.18 (Debian 15.18-0+deb12u1)" -> {15, 18}
std::pair<int, int> postgres_version(const fs::path& bin) {
  const std::string line = first_line((bin / "postgres").string(), "--version");
  const std::size_t digit = line.find_first_of("0123456789");
  std::istringstream numbers(digit == std::string::npos ? "" : line.substr(digit));
  std::pair<int, int> version{0, 0};
  char point = 0;
  numbers >> version.first >> point >> version.second;
  return version;
}

// TMPDIR, unless we are root (the server's user may have no way into root's TMPDIR), or the operating system
// would find the socket's path too long, or it has characters that mean something in a setting or a
// connection string.
fs::path base_folder(const std::string& owner) {
  std::error_code ignored;
  const fs::path wanted = fs::absolute(fs::temp_directory_path(ignored), ignored);
  const std::string socket = wanted / server_folder_template(owner) / ".s.PGSQL.5432";
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-";
  const bool plain = socket.find_first_not_of(kPlain) == std::string::npos;
  const bool fits = socket.size() < sizeof(sockaddr_un::sun_path);
  return geteuid() != 0 && !wanted.empty() && plain && fits ? wanted : fs::path("/tmp");
}

void create_extension(const std::string& dsn) {
  const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectdb(dsn.c_str()), &PQfinish);
  const std::unique_ptr<PGresult, decltype(&PQclear)> result(
      PQexec(connection.get(), "CREATE EXTENSION postgis"), &PQclear);
  if (PQresultStatus(result.get()) != PGRES_COMMAND_OK) {
    throw std::runtime_error(std::string("the private PostgreSQL server cannot load PostGIS: ") +
                             PQerrorMessage(connection.get()));
  }
}

}  // namespace

std::vector<fs::path> postgres_bin_folders() {
  const std::string named = environment_variable("HULLBENCH_POSTGRES_BIN");
  if (!named.empty()) return {named};
  std::vector<fs::path> folders;
  const std::string configured = first_line("pg_config", "--bindir");
  if (!configured.empty()) folders.emplace_back(configured);
  std::error_code ignored;
  for (const fs::directory_entry& version : fs::directory_iterator("/usr/lib/postgresql", ignored)) {
    folders.push_back(version.path() / "bin");
  }
  return folders;
}

std::vector<fs::path> legacy_postgres_bin_folders() {
  const std::string named = environment_variable("HULLBENCH_POSTGRES_LEGACY_BIN");
  if (!named.empty()) return {named};
  for (const fs::path& cache : cache_folders()) {
    if (can_run(cache / kLegacyBin / "postgres")) return {cache / kLegacyBin};
  }
  return postgres_bin_folders();
}

fs::path extension_folder(const fs::path& bin) {
  const std::string program = (bin / "pg_config").string();
  const fs::path shared = first_line(program, "--sharedir");
  const fs::path built_for = first_line(program, "--bindir");
  if (shared.empty() || built_for.empty()) return {};
  std::error_code ignored;
  const fs::path from = fs::weakly_canonical(bin, ignored);
  return (from / shared.lexically_relative(built_for) / "extension").lexically_normal();
}

fs::path find_postgres(const std::vector<fs::path>& candidates, const char* install) {
  bool any_server = false;
  std::optional<std::pair<std::pair<int, int>, fs::path>> newest;
  for (const fs::path& bin : candidates) {
    if (!can_run(bin / "postgres") || !can_run(bin / "initdb")) continue;
    any_server = true;
    if (!fs::exists(extension_folder(bin) / "postgis.control")) continue;
    newest = std::max(newest, std::optional(std::pair(postgres_version(bin), bin)));
  }
  if (newest) return newest->second;
  throw NotInstalled(
      any_server ? "PostgreSQL is installed, but not its PostGIS extension" : "PostgreSQL is not installed",
      install);
}

PrivatePostgres::PrivatePostgres(const fs::path& bin) {
  start(bin);
  try {
    create_extension(dsn_);
  } catch (...) {
    stop();
    throw;
  }
}

void PrivatePostgres::start(const fs::path& bin) {
  const std::string owner = process_identity();
  const Pipe lifeline = make_pipe();
  const Pipe report = make_pipe();
  const SupervisorPlan plan{bin, base_folder(owner), owner, lifeline.read_end, report.write_end};
  supervisor_ = fork();
  if (supervisor_ == 0) supervise(plan);
  lifeline_ = lifeline.write_end;
  close(lifeline.read_end);
  close(report.write_end);
  const std::string message = read_all(report.read_end);

  constexpr std::string_view kReady = "ready ";
  constexpr std::string_view kFailed = "failed ";
  if (message.starts_with(kReady)) {
    folder_ = message.substr(kReady.size());
    dsn_ = "host=" + folder_.string() + " port=5432 user=hullbench dbname=postgres";
    return;
  }
  stop();
  throw std::runtime_error(
      "the private PostgreSQL server did not start: " +
      (message.starts_with(kFailed) ? message.substr(kFailed.size()) : std::string("its supervisor ended")));
}

PrivatePostgres::~PrivatePostgres() {
  stop();
}

// Returns when the server has stopped and its folder is gone.
void PrivatePostgres::stop() {
  close(lifeline_);
  if (supervisor_ < 0) return;  // there was no fork
  wait_for(supervisor_);
}

}  // namespace hullbench
