// clang-format off
#include <sqlite3.h>  // spatialite.h does not include what it uses
#include <spatialite.h>
// clang-format on

#include "adapters/spatialite_database.hpp"

#include <limits>
#include <new>
#include <stdexcept>

#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

// SQLite's own words, with what was being done; SQLITE_NOMEM as what it is.
[[noreturn]] void throw_sqlite(sqlite3* database, const std::string& task) {
  if (database == nullptr || sqlite3_errcode(database) == SQLITE_NOMEM) throw std::bad_alloc();
  throw std::runtime_error("SQLite cannot " + task + ": " + sqlite3_errmsg(database));
}

std::string library_version(sqlite3* database) {
  Statement query(database, "SELECT spatialite_version(), geos_version()");
  query.step();
  // GEOS adds the version of its C interface after a dash: 3.11.1-CAPI-1.17.1.
  const std::string geos = query.text(1);
  return query.text(0) + " (GEOS " + geos.substr(0, geos.find('-')) + ")";
}

}  // namespace

Statement::Statement(sqlite3* database, const std::string& sql) : database_(database) {
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(database, sql.c_str(), -1, &prepared, nullptr) != SQLITE_OK) {
    throw_sqlite(database, "prepare '" + sql + "'");
  }
  statement_.reset(prepared);
}

void Statement::bind(int place, double value) {
  check(sqlite3_bind_double(statement_.get(), place, value));
}

void Statement::bind(int place, int value) {
  check(sqlite3_bind_int(statement_.get(), place, value));
}

void Statement::bind(int place, std::span<const std::uint8_t> bytes) {
  check(sqlite3_bind_blob64(statement_.get(), place, bytes.data(), bytes.size(), SQLITE_STATIC));
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) {
    reset();
    throw_sqlite(database_, "run a statement");
  }
  return code == SQLITE_ROW;
}

void Statement::reset() {
  sqlite3_reset(statement_.get());
}

void Statement::execute() {
  while (step()) {
  }
  reset();
}

bool Statement::is_null(int column) {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

std::string Statement::text(int column) {
  const unsigned char* bytes = sqlite3_column_text(statement_.get(), column);
  return bytes == nullptr ? "" : std::string(bytes, bytes + sqlite3_column_bytes(statement_.get(), column));
}

std::vector<std::uint8_t> Statement::blob(int column) {
  const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
  if (bytes == nullptr) return {};
  return {bytes, bytes + sqlite3_column_bytes(statement_.get(), column)};
}

void Statement::check(int code) {
  if (code != SQLITE_OK) throw_sqlite(database_, "bind a parameter");
}

void SpatialiteDatabase::FreeCache::operator()(void* cache) const {
  spatialite_cleanup_ex(cache);
}

SpatialiteDatabase::SpatialiteDatabase() : cache_(spatialite_alloc_connection()) {
  sqlite3* opened = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
  const int code = sqlite3_open_v2(":memory:", &opened, flags, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) throw_sqlite(opened, "open an in-memory database");
  const int verbose = 0;
  spatialite_init_ex(opened, cache_.get(), verbose);
  Statement(opened, "CREATE TABLE point_set (geom BLOB NOT NULL)").execute();
}

void SpatialiteDatabase::load(std::span<const Point> points) {
  Statement(get(), "DELETE FROM point_set").execute();
  if (points.empty()) return;
  const std::vector<std::uint8_t> wkb = to_wkb_multipoint(points);
  Statement insert(get(), "INSERT INTO point_set SELECT ST_GeomFromWKB(?)");
  insert.bind(1, std::span<const std::uint8_t>(wkb));
  insert.execute();
}

std::string SpatialiteDatabase::last_failure() {
  Statement query(get(), "SELECT GEOS_GetLastErrorMsg()");
  query.step();
  std::string reason = query.text(0);
  if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  return reason;
}

MethodInfo spatialite_method(SpatialiteDatabase& database) {
  MethodInfo info;
  info.version = library_version(database.get());
  info.licence = "MPL-1.1 OR GPL-2.0-or-later OR LGPL-2.1-or-later";
  info.parameters = {
      {"c", "1",
       "The paper's C: a Delaunay triangle is kept when each of its edges is shorter than c standard "
       "deviations of the triangles' edge lengths.",
       0, std::numeric_limits<double>::infinity(), 3},
      off_switch("allow_holes", "Whether holes are kept (1) or filled (0)."),
  };
  info.capabilities = {true, true};
  return info;
}

}  // namespace hullbench
