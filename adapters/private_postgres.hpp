// A PostgreSQL server of our own: made for one process, gone with it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hullbench {

/// The command that installs a current PostgreSQL with PostGIS.
inline constexpr const char* kInstallPostgis = "sudo apt-get install postgresql-postgis";

/// Folders where programs of installed PostgreSQL servers may be: the one that HULLBENCH_POSTGRES_BIN names
/// and no other; where that is unset or empty, what `pg_config` says, then /usr/lib/postgresql/*/bin.
std::vector<std::filesystem::path> postgres_bin_folders();

/// The same for the paper's PostGIS: the folder that HULLBENCH_POSTGRES_LEGACY_BIN names and no other; where
/// that is unset or empty, the one that `make deps-legacy` makes for this user or for root; where that is not
/// there, postgres_bin_folders(), as an older system has the paper's PostGIS itself.
std::vector<std::filesystem::path> legacy_postgres_bin_folders();

/// Where the PostgreSQL in `bin` looks for the control files and scripts of its extensions; empty when its
/// pg_config does not say. PostgreSQL goes there from its own place by the way between the folders that it
/// was built for, so this holds too when it was moved.
std::filesystem::path extension_folder(const std::filesystem::path& bin);

/// The folder of `candidates` with the programs of the newest PostgreSQL for which the PostGIS extension is
/// installed. Throws NotInstalled with the remedy `install` when there is none, saying whether PostgreSQL or
/// PostGIS is missing.
std::filesystem::path find_postgres(const std::vector<std::filesystem::path>& candidates,
                                    const char* install = kInstallPostgis);

/// A running PostgreSQL server with the PostGIS extension, in a new temporary folder `hullbench-postgres-*`.
/// It listens on a Unix socket in that folder only, no TCP, and trusts whoever can reach the socket: the
/// folder is open to its owner alone. Started by root, the server runs as the user `postgres` where there is
/// one, else as `nobody`.
///
/// A supervisor, a child in a session of its own, stops the server and removes the folder when the object is
/// destroyed or its process ends in whatever way, SIGKILL included. Should the supervisor be killed too, the
/// next PrivatePostgres of the same user cleans up. Servers that were not started here are never touched.
///
/// The constructor forks and does not exec, so it belongs in a process with a single thread. It throws
/// NotInstalled as find_postgres does, and std::runtime_error with the end of the server's log when the
/// server does not start.
class PrivatePostgres {
 public:
  explicit PrivatePostgres(const std::filesystem::path& bin = find_postgres(postgres_bin_folders()));
  ~PrivatePostgres();
  PrivatePostgres(const PrivatePostgres&) = delete;
  PrivatePostgres& operator=(const PrivatePostgres&) = delete;

  /// A libpq connection string without secrets.
  const std::string& dsn() const { return dsn_; }
  /// Where the server's data, socket and log are.
  const std::filesystem::path& folder() const { return folder_; }
  /// The supervisor's process id, for tests.
  pid_t supervisor() const { return supervisor_; }

 private:
  void start(const std::filesystem::path& bin);
  void stop();

  int lifeline_ = -1;  ///< write end of a pipe: the supervisor sees it close when this process ends
  pid_t supervisor_ = -1;
  std::filesystem::path folder_;
  std::string dsn_;
};

}  // namespace hullbench
