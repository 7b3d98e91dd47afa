// PostGIS's ST_ConcaveHull through libpq.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon
// (PostGIS answers with a point, a line or NULL). NULL for any other input is an error of the method.
#include "adapters/postgis.hpp"

#include <libpq-fe.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "adapters/point_checks.hpp"
#include "adapters/private_postgres.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

constexpr const char* kDsnVariable = "HULLBENCH_POSTGIS_DSN";
constexpr const char* kLegacyRemedy =
    "docker-compose up -d postgis-legacy, then set HULLBENCH_POSTGIS_DSN as docker-compose.yml shows";
constexpr const char* kCurrentRemedy =
    "unset HULLBENCH_POSTGIS_DSN for a private server, or docker-compose up -d postgis and set it as "
    "docker-compose.yml shows";

// From PostgreSQL's catalogue, where they are fixed: bytea, float8, bool.
constexpr Oid kBytea = 17;
constexpr Oid kFloat8 = 701;
constexpr Oid kBool = 16;
constexpr int kBinary = 1;
constexpr int kText = 0;

using Result = std::unique_ptr<PGresult, decltype(&PQclear)>;

/// The server ran out of memory, and says more than std::bad_alloc does.
class ServerOutOfMemory final : public std::bad_alloc {
 public:
  explicit ServerOutOfMemory(std::string what) : what_(std::move(what)) {}
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  std::string what_;
};

/// A parameter of a statement in PostgreSQL's binary format.
struct Binary {
  Oid type;
  std::vector<char> bytes;
};

Binary binary(std::vector<std::uint8_t>&& wkb) {
  return {kBytea, std::vector<char>(wkb.begin(), wkb.end())};
}

Binary binary(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  std::vector<char> bytes;
  for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(bits >> shift));
  return {kFloat8, bytes};
}

Binary binary(bool value) {
  return {kBool, {value ? '\1' : '\0'}};
}

// Seconds, unless the DSN says otherwise.
constexpr const char* kConnectTimeout = "4";

/// A connection with the settings that the measurements need.
class Session {
 public:
  explicit Session(const std::string& dsn) : connection_(connect(dsn), &PQfinish) {}

  /// Whether the server took the connection.
  bool is_open() const { return PQstatus(connection_.get()) == CONNECTION_OK; }

  /// Why the server refused, in its own words; empty when there was no answer. libpq's own words are left
  /// out, because they can quote a part of the DSN, and with it a password.
  std::string refusal() const {
    const std::string message = PQerrorMessage(connection_.get());
    constexpr std::string_view kMark = "FATAL:  ";
    const std::size_t start = message.find(kMark);
    if (start == std::string::npos) return "";
    return message.substr(start + kMark.size(), message.find('\n', start) - start - kMark.size());
  }

  Result execute(const char* sql, const std::vector<Binary>& parameters = {}) {
    const Arguments arguments(parameters);
    return checked(PQexecParams(connection_.get(), sql, arguments.count, arguments.types.data(),
                                arguments.values.data(), arguments.lengths.data(), arguments.formats.data(),
                                kText));
  }

  void prepare(const char* name, const char* sql, const std::vector<Oid>& types) {
    checked(PQprepare(connection_.get(), name, sql, static_cast<int>(types.size()), types.data()));
  }

  /// With the result in binary.
  Result execute_prepared(const char* name, const std::vector<Binary>& parameters) {
    const Arguments arguments(parameters);
    return checked(PQexecPrepared(connection_.get(), name, arguments.count, arguments.values.data(),
                                  arguments.lengths.data(), arguments.formats.data(), kBinary));
  }

 private:
  // libpq takes parameters as parallel arrays.
  struct Arguments {
    explicit Arguments(const std::vector<Binary>& parameters) : count(static_cast<int>(parameters.size())) {
      for (const Binary& parameter : parameters) {
        types.push_back(parameter.type);
        values.push_back(parameter.bytes.data());
        lengths.push_back(static_cast<int>(parameter.bytes.size()));
        formats.push_back(kBinary);
      }
    }
    int count;
    std::vector<Oid> types;
    std::vector<const char*> values;
    std::vector<int> lengths;
    std::vector<int> formats;
  };

  static PGconn* connect(const std::string& dsn) {
    // Later keywords, and so what the DSN says, replace earlier ones.
    const char* keywords[] = {"connect_timeout", "application_name", "dbname", nullptr};
    const char* values[] = {kConnectTimeout, "hullbench", dsn.c_str(), nullptr};
    PGconn* connection = PQconnectdbParams(keywords, values, 1);
    if (connection == nullptr) throw std::bad_alloc();
    PQsetNoticeProcessor(
        connection, [](void*, const char*) {}, nullptr);
    return connection;
  }

  Result checked(PGresult* raw) {
    Result result(raw, &PQclear);
    const ExecStatusType status = PQresultStatus(raw);
    if (status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK) return result;
    const char* message = PQresultErrorField(raw, PG_DIAG_MESSAGE_PRIMARY);
    const std::string why = message != nullptr ? message : PQerrorMessage(connection_.get());
    const char* code = PQresultErrorField(raw, PG_DIAG_SQLSTATE);
    const bool out_of_memory = code != nullptr && std::string_view(code) == "53200";
    if (out_of_memory || why.find("bad_alloc") != std::string::npos) {
      throw ServerOutOfMemory("PostGIS ran out of memory: " + why);
    }
    throw std::runtime_error("PostGIS: " + why);
  }

  std::unique_ptr<PGconn, decltype(&PQfinish)> connection_;
};

/// What a server says about itself.
struct Server {
  std::string postgis;
  std::string geos;
  std::string postgresql;
  PostgisMethod method = PostgisMethod::kLengthRatio;
};

// Empty when the file cannot be read.
std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string text(const Result& result, int column) {
  return PQgetvalue(result.get(), 0, column);
}

// Whether PostGIS is there; brings its functions into reach wherever it is installed.
bool find_extension(Session& session) {
  const Result found = session.execute(
      "SELECT set_config('search_path', current_setting('search_path') || ', ' || quote_ident(nspname), "
      "false) "
      "FROM pg_extension JOIN pg_namespace ON pg_namespace.oid = extnamespace WHERE extname = 'postgis'");
  return PQntuples(found.get()) == 1;
}

// The method is told by the function's language: PL/pgSQL is the old one. Version numbers would not tell: the
// new one needs PostGIS 3.3, a build against GEOS 3.11 and the extension's SQL updated.
Server describe_server(Session& session) {
  const Result answer = session.execute(
      "SELECT postgis_lib_version(), split_part(postgis_geos_version(), '-', 1), "
      "split_part(current_setting('server_version'), ' ', 1), lanname "
      "FROM pg_proc JOIN pg_language ON pg_language.oid = prolang "
      "WHERE pg_proc.oid = 'ST_ConcaveHull(geometry, float8, boolean)'::regprocedure");
  return {text(answer, 0), text(answer, 1), text(answer, 2),
          text(answer, 3) == "plpgsql" ? PostgisMethod::kTargetPercent : PostgisMethod::kLengthRatio};
}

// One process, no compiler: what is timed is the method.
void make_single_threaded(Session& session) {
  session.execute(
      "SELECT set_config(name, value, false) FROM pg_settings JOIN (VALUES ('jit', 'off'), "
      "('max_parallel_workers_per_gather', '0'), ('statement_timeout', '0'), ('client_min_messages', "
      "'error')) "
      "AS wanted (name, value) USING (name)");
}

MethodInfo describe_method(const Server& server) {
  const bool legacy = server.method == PostgisMethod::kTargetPercent;
  MethodInfo info;
  info.name = legacy ? "postgis_legacy" : "postgis";
  info.title = legacy ? "PostGIS <= 3.2" : "PostGIS";
  info.version = server.postgis + " (GEOS " + server.geos + ", PostgreSQL " + server.postgresql + ")";
  info.licence = "GPL-2.0-or-later";
  info.citation =
      legacy ? "PostGIS 3.2 manual, ST_ConcaveHull, https://postgis.net/docs/manual-3.2/ST_ConcaveHull.html"
             : "PostGIS manual, ST_ConcaveHull, https://postgis.net/docs/ST_ConcaveHull.html";
  info.native_output = "WKB of a polygon";
  if (legacy) {
    // Zero is not reachable; the manual gives no smallest value.
    info.parameters.push_back(
        {"target_percent", "ratio",
         "Area of the hull as a share of the convex hull's area that PostGIS tries to reach.", 1e-6, 1,
         std::nullopt});
  } else {
    info.parameters.push_back(
        {"length_ratio", "ratio",
         "Longest edge allowed, between the shortest (0) and the longest (1) edge of the Delaunay "
         "triangulation.",
         0, 1, std::nullopt});
  }
  info.parameters.push_back({"allow_holes", "switch", "Whether holes are kept (1) or filled (0).", 0, 1, 0});
  info.capabilities = {true, false};
  return info;
}

[[noreturn]] void throw_other_method(const Server& server) {
  if (server.method == PostgisMethod::kLengthRatio) {
    throw NotInstalled(
        "the server runs PostGIS " + server.postgis +
            ", whose ST_ConcaveHull is GEOS's length-ratio hull; the paper's target-percent method ended "
            "with PostGIS 3.2",
        kLegacyRemedy);
  }
  throw NotInstalled(
      "the server runs PostGIS " + server.postgis + " on GEOS " + server.geos +
          ", whose ST_ConcaveHull is the target-percent method; the length-ratio hull needs PostGIS 3.3 "
          "and GEOS 3.11",
      kCurrentRemedy);
}

// What a private server would run, when PostGIS's files say so: its hull is a C function. Spares a start in
// vain.
std::optional<Server> installed_length_ratio_server(const std::filesystem::path& bin) {
  const std::filesystem::path folder = extension_folder(bin);
  const std::string control = content(folder / "postgis.control");
  constexpr std::string_view kKey = "default_version = '";
  const std::size_t key = control.find(kKey);
  if (key == std::string::npos) return std::nullopt;
  const std::size_t start = key + kKey.size();
  const std::string version = control.substr(start, control.find('\'', start) - start);
  const std::string script = content(folder / ("postgis--" + version + ".sql"));
  if (script.find("'ST_ConcaveHull'") == std::string::npos) return std::nullopt;
  return Server{version, "", "", PostgisMethod::kLengthRatio};
}

/// A server with PostGIS: the one that HULLBENCH_POSTGIS_DSN names, or a private one.
class Connection {
 public:
  explicit Connection(PostgisMethod method) {
    const char* named = std::getenv(kDsnVariable);
    is_private_ = named == nullptr || *named == '\0';
    if (is_private_) {
      const std::filesystem::path bin = find_postgres(postgres_bin_folders());
      const std::optional<Server> installed = installed_length_ratio_server(bin);
      if (installed && installed->method != method) throw_other_method(*installed);
      private_server_.emplace(bin);
    }
    dsn_ = is_private_ ? private_server_->dsn() : named;
    open();
  }

  Session& session() { return *session_; }

  /// A session that works: the same one, or a new one when the server has ended it (a backend that crashed,
  /// for example). True when it is new.
  bool reopen_if_lost() {
    if (session_->is_open()) return false;
    open();
    return true;
  }

 private:
  void open() {
    session_.emplace(dsn_);
    if (!session_->is_open()) throw_no_connection();
    if (!find_extension(*session_)) {
      throw NotInstalled("the database named by HULLBENCH_POSTGIS_DSN has no PostGIS extension",
                         "run CREATE EXTENSION postgis in it");
    }
    make_single_threaded(*session_);
  }

  [[noreturn]] void throw_no_connection() const {
    const std::string refusal = session_->refusal();
    if (is_private_) throw std::runtime_error("the private PostgreSQL server does not answer " + refusal);
    if (!refusal.empty()) {
      throw NotInstalled("the server named by HULLBENCH_POSTGIS_DSN refuses the connection: " + refusal,
                         "correct HULLBENCH_POSTGIS_DSN, or unset it for a private server");
    }
    throw NotInstalled("the server named by HULLBENCH_POSTGIS_DSN does not answer",
                       "start it or correct HULLBENCH_POSTGIS_DSN, or unset it for a private server");
  }

  bool is_private_ = false;
  std::string dsn_;
  std::optional<PrivatePostgres> private_server_;
  std::optional<Session> session_;
};

class Postgis final : public Adapter {
 public:
  explicit Postgis(PostgisMethod method) : connection_(method) {
    const Server server = describe_server(connection_.session());
    if (server.method != method) throw_other_method(server);
    info_ = describe_method(server);
    prepare();
  }

  const MethodInfo& info() const override { return info_; }

  void load(std::span<const Point> points) override {
    require_finite(points);
    hull_.reset();
    if (connection_.reopen_if_lost()) prepare();
    connection_.session().execute("TRUNCATE pg_temp.hullbench_points");
    connection_.session().execute("INSERT INTO pg_temp.hullbench_points SELECT ST_GeomFromWKB($1)",
                                  {binary(to_wkb_multipoint(points))});
    has_area_ = span_an_area(points);
  }

  void run(const Parameters& parameters, Steps& /*steps*/) override {
    hull_.reset();
    const Parameters values = complete_parameters(info_, parameters);
    hull_ = connection_.session().execute_prepared(
        kHull, {binary(values.at(info_.parameters[0].name)), binary(values.at("allow_holes") != 0)});
    if (PQntuples(hull_.get()) != 1) throw std::logic_error(info_.name + ": run before load");
    if (PQgetisnull(hull_.get(), 0, 0) != 0 && has_area_) {
      throw std::runtime_error("PostGIS's ST_ConcaveHull answered NULL and gave no reason");
    }
  }

  MultiPolygon extract(Steps& /*steps*/) override {
    if (!hull_ || PQgetisnull(hull_.get(), 0, 0) != 0) return {};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(PQgetvalue(hull_.get(), 0, 0));
    return from_wkb({bytes, static_cast<std::size_t>(PQgetlength(hull_.get(), 0, 0))});
  }

 private:
  static constexpr const char* kHull = "hull";

  void prepare() {
    Session& session = connection_.session();
    session.execute("CREATE TEMP TABLE hullbench_points (geom geometry)");
    // Not compressed: unpacking would be timed with every run.
    session.execute("ALTER TABLE pg_temp.hullbench_points ALTER COLUMN geom SET STORAGE EXTERNAL");
    session.prepare(kHull, "SELECT ST_AsBinary(ST_ConcaveHull(geom, $1, $2)) FROM pg_temp.hullbench_points",
                    {kFloat8, kBool});
  }

  Connection connection_;
  MethodInfo info_;
  bool has_area_ = false;
  Result hull_{nullptr, &PQclear};
};

}  // namespace

std::unique_ptr<Adapter> make_postgis_adapter(PostgisMethod method) {
  return std::make_unique<Postgis>(method);
}

std::unique_ptr<Adapter> make_postgis() {
  return make_postgis_adapter(PostgisMethod::kLengthRatio);
}

}  // namespace hullbench
