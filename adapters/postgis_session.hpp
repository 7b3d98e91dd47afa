// Talking to a server with PostGIS through libpq: what the adapters that need one share.
#pragma once

#include <libpq-fe.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapters/private_postgres.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

// Types from PostgreSQL's catalogue, where they are fixed: bytea, float8, bool.
inline constexpr Oid kBytea = 17;
inline constexpr Oid kFloat8 = 701;
inline constexpr Oid kBool = 16;

/// The server's answer to a statement.
using Result = std::unique_ptr<PGresult, decltype(&PQclear)>;

/// A column of the first row, as text; empty for NULL.
std::string text(const Result& result, int column);

/// The bytes of a column of the first row of a binary result; they live as long as `result`.
std::span<const std::uint8_t> bytes(const Result& result, int column);

/// The float8 in a column of the first row of a binary result.
double number(const Result& result, int column);

/// A parameter of a statement in PostgreSQL's binary format.
struct Binary {
  Oid type;
  std::vector<char> bytes;
};

Binary binary(const std::vector<std::uint8_t>& wkb);
Binary binary(double value);
Binary binary(bool value);

/// A connection with the settings that the measurements need. A statement that fails throws: std::bad_alloc
/// when the server ran out of memory, else std::runtime_error with the server's words.
class Session {
 public:
  explicit Session(const std::string& dsn);

  /// Whether the server took the connection and has not ended it.
  bool is_open() const { return PQstatus(connection_.get()) == CONNECTION_OK; }

  /// Why the server refused, in its own words; empty when there was no answer. libpq's own words are left
  /// out, because they can quote a part of the DSN, and with it a password.
  std::string refusal() const;

  /// With the result as text.
  Result execute(const char* sql, const std::vector<Binary>& parameters = {});

  void prepare(const char* name, const char* sql, const std::vector<Oid>& types = {});

  /// With the result in binary.
  Result execute_prepared(const char* name, const std::vector<Binary>& parameters = {});

 private:
  Result checked(PGresult* raw);

  std::unique_ptr<PGconn, decltype(&PQfinish)> connection_;
};

/// Which server a method runs on: two PostGIS of different age are measured in one run, so each has its own.
struct PostgisServer {
  const char* dsn_variable;  ///< environment variable with the connection string of a server that runs
  std::vector<std::filesystem::path> (*bin_folders)();  ///< of a private server, when that is unset or empty
  const char* install;                                  ///< the command that installs one
};

inline constexpr PostgisServer kCurrentServer = {"HULLBENCH_POSTGIS_DSN", &postgres_bin_folders,
                                                 kInstallPostgis};
inline constexpr PostgisServer kLegacyServer = {"HULLBENCH_POSTGIS_LEGACY_DSN", &legacy_postgres_bin_folders,
                                                "make deps-legacy"};

/// A connection to `server`: to the one that its environment variable names, or to a private one.
class PostgisConnection {
 public:
  /// `inspect` sees the program folder of the server that would be started and throws when that would be in
  /// vain; it is not asked about a named server. Throws NotInstalled when there is no server or no PostGIS.
  explicit PostgisConnection(const PostgisServer& server,
                             const std::function<void(const std::filesystem::path& bin)>& inspect = {});

  Session& session() { return *session_; }

  /// A session that works: the same one, or a new one when the server has ended it (a backend that crashed,
  /// for example; a private server that has died is started again). True when it is new: temporary tables and
  /// prepared statements are then gone.
  bool reopen_if_lost();

 private:
  void connect();
  void check_session();
  void start_private_server();
  [[noreturn]] void throw_no_connection() const;

  PostgisServer server_;
  bool is_private_ = false;
  std::string dsn_;
  std::filesystem::path bin_;  ///< the programs of a private server
  std::optional<PrivatePostgres> private_server_;
  std::optional<Session> session_;
};

/// The versions that run: PostGIS, GEOS and PostgreSQL.
struct PostgisVersions {
  std::string postgis;
  std::string geos;
  std::string postgresql;

  /// "3.3.2 (GEOS 3.11.1, PostgreSQL 15.5)"
  std::string together() const;
};

PostgisVersions postgis_versions(Session& session);

/// Makes the temporary table hullbench_points (geom), which holds the loaded points as one MultiPoint.
void create_point_table(Session& session);

/// Puts `points` in place of the ones loaded before.
void fill_point_table(Session& session, std::span<const polylidar::Point> points);

}  // namespace hullbench
