// The private PostgreSQL server: what it offers, and that nothing of it is left however its owner ends.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/private_postgres.hpp"
#include "adapters/process_identity.hpp"
#include "tests/complaint.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

namespace fs = std::filesystem;

/// Process ids whose working folder is in `folder`.
std::vector<fs::path> processes_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator("/proc", ignored)) {
    const std::string target = fs::read_symlink(entry.path() / "cwd", ignored).string();
    if (target.starts_with(folder.string())) found.push_back(entry.path());
  }
  return found;
}

// Waits for something that takes as long as it takes; only a failing test waits to the end.
bool comes_true(const std::function<bool()>& condition) {
  for (int look = 0; look < 3000; ++look) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

bool is_gone(const fs::path& folder) {
  return !fs::exists(folder) && processes_in(folder).empty();
}

/// Another process that owns a server and waits; killed at the end of the test.
class OtherOwner {
 public:
  OtherOwner() {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error("pipe");
    pid_ = fork();
    if (pid_ == 0) {
      try {
        const PrivatePostgres server;
        const std::string line = server.folder().string() + " " + std::to_string(server.supervisor());
        if (write(ends[1], line.data(), line.size()) < 0) _exit(1);
        for (;;) pause();
      } catch (...) {
        _exit(1);
      }
    }
    close(ends[1]);
    std::array<char, 512> buffer{};
    const ssize_t size = read(ends[0], buffer.data(), buffer.size());
    close(ends[0]);
    std::istringstream line(std::string(buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0U));
    if (line >> folder_ >> supervisor_ && supervisor_ > 1) return;
    kill_owner();
    throw std::runtime_error("the other owner has no server");
  }
  ~OtherOwner() { kill_owner(); }
  OtherOwner(const OtherOwner&) = delete;
  OtherOwner& operator=(const OtherOwner&) = delete;

  void kill_owner() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    pid_ = -1;
  }

  const fs::path& folder() const { return folder_; }
  pid_t supervisor() const { return supervisor_; }

 private:
  pid_t pid_ = -1;
  fs::path folder_;
  pid_t supervisor_ = -1;
};

/// Inodes of the sockets on which somebody of this machine listens for TCP.
std::set<std::string> tcp_listeners() {
  std::set<std::string> inodes;
  for (const char* table : {"/proc/net/tcp", "/proc/net/tcp6"}) {
    std::ifstream file(table);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::istringstream columns(line);
      const std::vector<std::string> fields{std::istream_iterator<std::string>(columns), {}};
      if (fields.size() > 9 && fields[3] == "0A") inodes.insert("socket:[" + fields[9] + "]");
    }
  }
  return inodes;
}

void write_script(const fs::path& file, const std::string& text) {
  std::ofstream(file) << "#!/bin/sh\n" << text << "\n";
  fs::permissions(file, fs::perms::owner_all | fs::perms::group_exec | fs::perms::group_read |
                            fs::perms::others_exec | fs::perms::others_read);
}

/// A pg_config in `bin` that says where PostgreSQL was built to be.
void write_pg_config(const fs::path& bin, const fs::path& built_bin, const fs::path& built_share) {
  write_script(bin / "pg_config", "case $1 in --bindir) echo '" + built_bin.string() +
                                      "' ;; --sharedir) echo '" + built_share.string() + "' ;; esac");
}

/// A folder that looks like the programs of PostgreSQL `version`, with the PostGIS extension or without.
fs::path pretend_install(const fs::path& root, const std::string& version, bool postgis) {
  fs::path bin = root / version / "bin";
  const fs::path share = root / version / "share";
  fs::create_directories(bin);
  fs::create_directories(share / "extension");
  write_script(bin / "postgres", "echo 'postgres (PostgreSQL) " + version + " (pretended)'");
  write_script(bin / "initdb", "echo 'no space left, says the test' >&2; exit 1");
  write_pg_config(bin, bin, share);
  if (postgis) std::ofstream(share / "extension" / "postgis.control") << "default_version = '3.3.2'\n";
  return bin;
}

TEST(PrivatePostgres, RunsForItsOwnerAloneAndGoesWithIt) {
  fs::path folder;
  {
    const PrivatePostgres server;
    folder = server.folder();
    struct stat status {};
    ASSERT_EQ(stat(folder.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0700U);
    EXPECT_NE(status.st_uid, 0U) << "PostgreSQL does not run as root";
    EXPECT_TRUE(geteuid() == 0 || status.st_uid == geteuid());
    EXPECT_TRUE(folder.filename().string().starts_with("hullbench-postgres-"));
    EXPECT_FALSE(processes_in(folder).empty());
  }
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_TRUE(processes_in(folder).empty());
}

TEST(PrivatePostgres, ListensOnNoTcpPort) {
  const PrivatePostgres server;
  const std::set<std::string> listeners = tcp_listeners();
  int sockets = 0;
  for (const fs::path& process : processes_in(server.folder())) {
    std::error_code ignored;
    for (const fs::directory_entry& file : fs::directory_iterator(process / "fd", ignored)) {
      const std::string target = fs::read_symlink(file.path(), ignored).string();
      if (target.starts_with("socket:")) ++sockets;
      EXPECT_FALSE(listeners.contains(target)) << process << " listens on TCP";
    }
  }
  EXPECT_GT(sockets, 0) << "the Unix socket must be among what was looked at";
}

TEST(PrivatePostgres, HoldsNoFileOfItsOwner) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const int high = fcntl(ends[1], F_DUPFD, 200);  // one below the server's own pipes, one far above
  const PrivatePostgres server;
  close(ends[1]);
  close(high);
  pollfd reader{ends[0], POLLIN, 0};
  EXPECT_EQ(poll(&reader, 1, 0), 1);
  EXPECT_NE(reader.revents & POLLHUP, 0) << "somebody still holds the pipe's write end";
  close(ends[0]);
}

TEST(PrivatePostgres, IsGoneAfterItsOwnerIsKilled) {
  OtherOwner other;
  ASSERT_FALSE(processes_in(other.folder()).empty());
  other.kill_owner();
  EXPECT_TRUE(comes_true([&] { return is_gone(other.folder()); })) << other.folder();
}

TEST(ProcessIdentity, TellsTheDeadFromTheLivingAndTheUnknown) {
  std::string own = process_identity();
  EXPECT_TRUE(is_process_alive(own));
  EXPECT_TRUE(is_process_alive("no identity"));
  EXPECT_TRUE(is_process_alive("1-999999999-1")) << "another namespace cannot be seen";
  own.back() = own.back() == '0' ? '1' : '0';
  EXPECT_FALSE(is_process_alive(own)) << "its number was given to another process";
}

TEST(PrivatePostgres, CleansUpAfterADeadOwnerAndLeavesALivingOneAlone) {
  OtherOwner living;
  OtherOwner dead;
  kill(dead.supervisor(), SIGKILL);
  dead.kill_owner();
  const PrivatePostgres server;
  EXPECT_TRUE(is_gone(dead.folder())) << dead.folder();
  EXPECT_FALSE(processes_in(living.folder()).empty()) << living.folder();
  EXPECT_TRUE(fs::exists(living.folder()));
}

TEST(PrivatePostgres, StartsForAPlainUser) {
  const pid_t child = fork();
  if (child == 0) {
    const passwd* nobody = getpwnam("nobody");
    const bool plain =
        geteuid() != 0 || (nobody != nullptr && setgid(nobody->pw_gid) == 0 && setuid(nobody->pw_uid) == 0);
    try {
      const PrivatePostgres server;
      struct stat status {};
      _exit(plain && stat(server.folder().c_str(), &status) == 0 && status.st_uid == geteuid() ? 0 : 1);
    } catch (const std::exception&) {
      _exit(2);
    }
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

TEST(PrivatePostgres, SaysWhyItDidNotStart) {
  const TemporaryFolder root;
  const fs::path bin = pretend_install(root.path(), "15.3", true);
  expect_complaint([&] { const PrivatePostgres server(bin); }, "no space left, says the test");
}

TEST(FindPostgres, SaysWhatIsMissing) {
  const TemporaryFolder root;
  const auto complaint = [](const std::vector<fs::path>& candidates) {
    try {
      return "found " + find_postgres(candidates).string();
    } catch (const NotInstalled& error) {
      return std::string(error.what()) + ": " + error.remedy();
    }
  };
  const std::string remedy = "sudo apt-get install postgresql-postgis";
  EXPECT_EQ(complaint({}), "PostgreSQL is not installed: " + remedy);
  EXPECT_EQ(complaint({root.path() / "nothing"}), "PostgreSQL is not installed: " + remedy);
  EXPECT_EQ(complaint({pretend_install(root.path(), "15.3", false)}),
            "PostgreSQL is installed, but not its PostGIS extension: " + remedy);
}

// As PostgreSQL itself does: its pg_config may be told the folders that the package was built for.
TEST(FindPostgres, LooksForExtensionsFromTheProgramsOwnPlace) {
  const TemporaryFolder root;
  const fs::path bin = pretend_install(root.path(), "13.16", true);
  write_pg_config(bin, "/usr/lib/postgresql/13/bin", "/usr/lib/postgresql/13/share");
  EXPECT_EQ(extension_folder(bin), root.path() / "13.16" / "share" / "extension");
  EXPECT_EQ(find_postgres({bin}), bin);
  const fs::path link = root.path() / "bin";
  fs::create_directory_symlink(bin, link);
  EXPECT_EQ(extension_folder(link), root.path() / "13.16" / "share" / "extension");
  fs::remove(bin / "pg_config");
  EXPECT_EQ(extension_folder(bin), "");
}

/// An environment variable for as long as this lives; then it is as it was.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() {
    if (before_) {
      setenv(name_, before_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(FindPostgres, LooksForThePapersPostgisInAFolderOfItsOwn) {
  const TemporaryFolder root;
  const Variable cache("XDG_CACHE_HOME", root.path().string());
  const Variable current("HULLBENCH_POSTGRES_BIN", "/current");
  using Folders = std::vector<fs::path>;
  {
    const Variable legacy("HULLBENCH_POSTGRES_LEGACY_BIN", "/legacy");
    EXPECT_EQ(legacy_postgres_bin_folders(), Folders{"/legacy"});
    EXPECT_EQ(postgres_bin_folders(), Folders{"/current"});
  }
  const Variable unset("HULLBENCH_POSTGRES_LEGACY_BIN", "");
  const fs::path of_all = "/var/cache/hullbench/postgis-legacy/bin";
  const Folders without = {fs::exists(of_all / "postgres") ? of_all : fs::path("/current")};
  EXPECT_EQ(legacy_postgres_bin_folders(), without);
  const fs::path own = root.path() / "hullbench" / "postgis-legacy" / "bin";
  fs::create_directories(own);
  write_script(own / "postgres", "exit 0");
  EXPECT_EQ(legacy_postgres_bin_folders(), geteuid() == 0 ? without : Folders{own})
      << "root must run nothing of a user's";
}

TEST(FindPostgres, TakesTheNewestWithPostgis) {
  const TemporaryFolder root;
  const fs::path nine = pretend_install(root.path(), "9.6", true);
  const fs::path eleven = pretend_install(root.path(), "11.22", true);
  const fs::path seventeen = pretend_install(root.path(), "17.1", false);
  EXPECT_EQ(find_postgres({nine, eleven, seventeen}), eleven);
  EXPECT_EQ(find_postgres({seventeen, eleven, nine}), eleven);
}

}  // namespace
}  // namespace hullbench::testing
