#include "adapters/postgis_session.hpp"

#include <bit>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "adapters/adapter.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

constexpr int kBinary = 1;
constexpr int kText = 0;

// Seconds, unless the DSN says otherwise.
constexpr const char* kConnectTimeout = "4";

/// The server ran out of memory, and says more than std::bad_alloc does.
class ServerOutOfMemory final : public std::bad_alloc {
 public:
  explicit ServerOutOfMemory(std::string what) : what_(std::move(what)) {}
  const char* what() const noexcept override { return what_.c_str(); }

 private:
  std::string what_;
};

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

PGconn* connect(const std::string& dsn) {
  // Later keywords, and so what the DSN says, replace earlier ones.
  const char* keywords[] = {"connect_timeout", "application_name", "dbname", nullptr};
  const char* values[] = {kConnectTimeout, "hullbench", dsn.c_str(), nullptr};
  PGconn* connection = PQconnectdbParams(keywords, values, 1);
  if (connection == nullptr) throw std::bad_alloc();
  PQsetNoticeProcessor(
      connection, [](void*, const char*) {}, nullptr);
  return connection;
}

// Whether PostGIS is there; brings its functions into reach wherever it is installed.
bool find_extension(Session& session) {
  const Result found = session.execute(
      "SELECT set_config('search_path', current_setting('search_path') || ', ' || quote_ident(nspname), "
      "false) "
      "FROM pg_extension JOIN pg_namespace ON pg_namespace.oid = extnamespace WHERE extname = 'postgis'");
  return PQntuples(found.get()) == 1;
}

// One process, no compiler: what is timed is the method.
void make_single_threaded(Session& session) {
  session.execute(
      "SELECT set_config(name, value, false) FROM pg_settings JOIN (VALUES ('jit', 'off'), "
      "('max_parallel_workers_per_gather', '0'), ('statement_timeout', '0'), ('client_min_messages', "
      "'error'), "
      // Blocks of 8 kB: temporary tables stay in memory, as other methods' triangles do.
      "('temp_buffers', '131072')) "
      "AS wanted (name, value) USING (name)");
}

}  // namespace

std::string text(const Result& result, int column) {
  return PQgetvalue(result.get(), 0, column);
}

std::span<const std::uint8_t> bytes(const Result& result, int column) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(PQgetvalue(result.get(), 0, column));
  return {first, static_cast<std::size_t>(PQgetlength(result.get(), 0, column))};
}

double number(const Result& result, int column) {
  std::uint64_t bits = 0;
  for (const std::uint8_t byte : bytes(result, column)) bits = bits << 8U | byte;
  return std::bit_cast<double>(bits);
}

Binary binary(const std::vector<std::uint8_t>& wkb) {
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

Session::Session(const std::string& dsn) : connection_(connect(dsn), &PQfinish) {}

std::string Session::refusal() const {
  const std::string message = PQerrorMessage(connection_.get());
  constexpr std::string_view kMark = "FATAL:  ";
  const std::size_t start = message.find(kMark);
  if (start == std::string::npos) return "";
  return message.substr(start + kMark.size(), message.find('\n', start) - start - kMark.size());
}

Result Session::execute(const char* sql, const std::vector<Binary>& parameters) {
  const Arguments arguments(parameters);
  return checked(PQexecParams(connection_.get(), sql, arguments.count, arguments.types.data(),
                              arguments.values.data(), arguments.lengths.data(), arguments.formats.data(),
                              kText));
}

void Session::prepare(const char* name, const char* sql, const std::vector<Oid>& types) {
  checked(PQprepare(connection_.get(), name, sql, static_cast<int>(types.size()), types.data()));
}

Result Session::execute_prepared(const char* name, const std::vector<Binary>& parameters) {
  const Arguments arguments(parameters);
  return checked(PQexecPrepared(connection_.get(), name, arguments.count, arguments.values.data(),
                                arguments.lengths.data(), arguments.formats.data(), kBinary));
}

Result Session::checked(PGresult* raw) {
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

PostgisConnection::PostgisConnection(const PostgisServer& server,
                                     const std::function<void(const std::filesystem::path& bin)>& inspect)
    : server_(server) {
  const char* named = std::getenv(server_.dsn_variable);
  is_private_ = named == nullptr || *named == '\0';
  if (is_private_) {
    const std::filesystem::path bin = find_postgres(server_.bin_folders(), server_.install);
    if (inspect) inspect(bin);
    bin_ = bin;
    start_private_server();
  } else {
    dsn_ = named;
  }
  connect();
}

void PostgisConnection::start_private_server() {
  private_server_.emplace(bin_);
  dsn_ = private_server_->dsn();
}

bool PostgisConnection::reopen_if_lost() {
  if (session_->is_open()) return false;
  session_.emplace(dsn_);
  if (is_private_ && !session_->is_open()) {  // the whole server has died
    start_private_server();
    session_.emplace(dsn_);
  }
  check_session();
  return true;
}

void PostgisConnection::connect() {
  session_.emplace(dsn_);
  check_session();
}

void PostgisConnection::check_session() {
  if (!session_->is_open()) throw_no_connection();
  if (!find_extension(*session_)) {
    throw NotInstalled(
        "the database named by " + std::string(server_.dsn_variable) + " has no PostGIS extension",
        "run CREATE EXTENSION postgis in it");
  }
  make_single_threaded(*session_);
}

void PostgisConnection::throw_no_connection() const {
  const std::string refusal = session_->refusal();
  if (is_private_) throw std::runtime_error("the private PostgreSQL server does not answer " + refusal);
  const std::string variable = server_.dsn_variable;
  if (!refusal.empty()) {
    throw NotInstalled("the server named by " + variable + " refuses the connection: " + refusal,
                       "correct " + variable + ", or unset it for a private server");
  }
  throw NotInstalled("the server named by " + variable + " does not answer",
                     "start it or correct " + variable + ", or unset it for a private server");
}

std::string PostgisVersions::together() const {
  return postgis + " (GEOS " + geos + ", PostgreSQL " + postgresql + ")";
}

PostgisVersions postgis_versions(Session& session) {
  const Result answer = session.execute(
      "SELECT postgis_lib_version(), split_part(postgis_geos_version(), '-', 1), "
      "split_part(current_setting('server_version'), ' ', 1)");
  return {text(answer, 0), text(answer, 1), text(answer, 2)};
}

void create_point_table(Session& session) {
  session.execute("CREATE TEMP TABLE hullbench_points (geom geometry)");
  // Not compressed: unpacking would be timed with every run.
  session.execute("ALTER TABLE pg_temp.hullbench_points ALTER COLUMN geom SET STORAGE EXTERNAL");
}

void fill_point_table(Session& session, std::span<const polylidar::Point> points) {
  session.execute("TRUNCATE pg_temp.hullbench_points");
  session.execute("INSERT INTO pg_temp.hullbench_points SELECT ST_GeomFromWKB($1)",
                  {binary(to_wkb_multipoint(points))});
}

}  // namespace hullbench
