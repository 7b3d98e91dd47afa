// SpatiaLite's ST_ConcaveHull on an in-memory SQLite database.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon. For
// any other NULL, `run` throws: SpatiaLite answers NULL both when it fails and when no triangle is
// short-edged enough to be kept.
// clang-format off
#include <sqlite3.h>  // spatialite.h does not include what it uses
#include <spatialite.h>
// clang-format on

#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/point_checks.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

// SQLite's own words, with what was being done; SQLITE_NOMEM as what it is.
[[noreturn]] void throw_sqlite(sqlite3* database, const std::string& task) {
  if (database == nullptr || sqlite3_errcode(database) == SQLITE_NOMEM) throw std::bad_alloc();
  throw std::runtime_error("SQLite cannot " + task + ": " + sqlite3_errmsg(database));
}

class Statement {
 public:
  Statement(sqlite3* database, const char* sql) : database_(database) {
    sqlite3_stmt* prepared = nullptr;
    if (sqlite3_prepare_v2(database, sql, -1, &prepared, nullptr) != SQLITE_OK) {
      throw_sqlite(database, std::string("prepare '") + sql + "'");
    }
    statement_.reset(prepared);
  }

  void bind(int place, double value) { check(sqlite3_bind_double(statement_.get(), place, value)); }
  void bind(int place, int value) { check(sqlite3_bind_int(statement_.get(), place, value)); }
  /// The bytes are not copied and must outlive the next `reset`.
  void bind(int place, std::span<const std::uint8_t> bytes) {
    check(sqlite3_bind_blob64(statement_.get(), place, bytes.data(), bytes.size(), SQLITE_STATIC));
  }

  /// Whether there is a row.
  bool step() {
    const int code = sqlite3_step(statement_.get());
    if (code != SQLITE_ROW && code != SQLITE_DONE) {
      reset();
      throw_sqlite(database_, "run a statement");
    }
    return code == SQLITE_ROW;
  }

  void reset() { sqlite3_reset(statement_.get()); }

  bool is_null(int column) { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }

  /// Empty for NULL.
  std::string text(int column) {
    const unsigned char* bytes = sqlite3_column_text(statement_.get(), column);
    return bytes == nullptr ? "" : std::string(bytes, bytes + sqlite3_column_bytes(statement_.get(), column));
  }

  std::vector<std::uint8_t> blob(int column) {
    const auto* bytes = static_cast<const std::uint8_t*>(sqlite3_column_blob(statement_.get(), column));
    if (bytes == nullptr) return {};
    return {bytes, bytes + sqlite3_column_bytes(statement_.get(), column)};
  }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  void check(int code) {
    if (code != SQLITE_OK) throw_sqlite(database_, "bind a parameter");
  }

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// An in-memory database with SpatiaLite's functions and one table, which holds the point set as one
/// MultiPoint.
class Database {
 public:
  // SpatiaLite keeps its state beside the connection and wants it freed after the connection is closed.
  Database() : cache_(spatialite_alloc_connection()) {
    sqlite3* opened = nullptr;
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
    const int code = sqlite3_open_v2(":memory:", &opened, flags, nullptr);
    database_.reset(opened);
    if (code != SQLITE_OK) throw_sqlite(opened, "open an in-memory database");
    const int verbose = 0;
    spatialite_init_ex(opened, cache_.get(), verbose);
    Statement(opened, "CREATE TABLE point_set (geom BLOB NOT NULL)").step();
  }

  sqlite3* get() { return database_.get(); }

 private:
  struct FreeCache {
    void operator()(void* cache) const { spatialite_cleanup_ex(cache); }
  };
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };

  std::unique_ptr<void, FreeCache> cache_;
  std::unique_ptr<sqlite3, Close> database_;
};

std::string library_version(sqlite3* database) {
  Statement query(database, "SELECT spatialite_version(), geos_version()");
  query.step();
  // GEOS adds the version of its C interface after a dash: 3.11.1-CAPI-1.17.1.
  const std::string geos = query.text(1);
  return query.text(0) + " (GEOS " + geos.substr(0, geos.find('-')) + ")";
}

MethodInfo describe(sqlite3* database) {
  MethodInfo info;
  info.name = "spatialite";
  info.title = "SpatiaLite";
  info.version = library_version(database);
  info.licence = "MPL-1.1 OR GPL-2.0-or-later OR LGPL-2.1-or-later";
  info.citation = "SpatiaLite, SQL function ST_ConcaveHull, https://www.gaia-gis.it/fossil/libspatialite";
  info.native_output = "WKB of a polygon or multipolygon";
  info.parameters = {
      {"c", "1",
       "The paper's C: a Delaunay triangle is kept when each of its edges is shorter than c standard "
       "deviations of the triangles' edge lengths.",
       0, std::numeric_limits<double>::infinity(), 3},
      {"allow_holes", "switch", "Whether holes are kept (1) or filled (0).", 0, 1, 0},
  };
  info.capabilities = {true, true};
  return info;
}

class Spatialite final : public Adapter {
 public:
  const MethodInfo& info() const override { return info_; }

  void load(std::span<const Point> points) override {
    require_finite(points);
    has_area_ = false;
    hull_wkb_.reset();
    clear_.step();
    clear_.reset();
    if (points.empty()) return;  // SpatiaLite has no geometry without points: the table stays empty
    const std::vector<std::uint8_t> wkb = to_wkb_multipoint(points);
    insert_.bind(1, std::span<const std::uint8_t>(wkb));
    insert_.step();
    insert_.reset();
    has_area_ = span_an_area(points);
  }

  void run(const Parameters& parameters, Steps& /*steps*/) override {
    hull_wkb_.reset();
    const Parameters values = complete_parameters(info_, parameters);
    hull_.bind(1, values.at("c"));
    hull_.bind(2, values.at("allow_holes") != 0 ? 1 : 0);
    if (hull_.step() && !hull_.is_null(0)) hull_wkb_ = hull_.blob(0);
    hull_.reset();
    if (!hull_wkb_ && has_area_) throw_null_hull();
  }

  MultiPolygon extract(Steps& /*steps*/) override {
    return hull_wkb_ ? from_wkb(*hull_wkb_) : MultiPolygon();
  }

 private:
  [[noreturn]] void throw_null_hull() {
    Statement query(database_.get(), "SELECT GEOS_GetLastErrorMsg()");
    query.step();
    const std::string reason = query.text(0);
    if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
    throw std::runtime_error(
        reason.empty()
            ? "SpatiaLite's ST_ConcaveHull answered NULL and gave no reason; it does so when no triangle "
              "has all its edges shorter than c standard deviations"
            : "SpatiaLite's ST_ConcaveHull answered NULL: " + reason);
  }

  Database database_;
  MethodInfo info_ = describe(database_.get());
  Statement clear_{database_.get(), "DELETE FROM point_set"};
  Statement insert_{database_.get(), "INSERT INTO point_set SELECT ST_GeomFromWKB(?)"};
  Statement hull_{database_.get(), "SELECT ST_AsBinary(ST_ConcaveHull(geom, ?, ?)) FROM point_set"};
  bool has_area_ = false;
  std::optional<std::vector<std::uint8_t>> hull_wkb_;  ///< none: SpatiaLite answered NULL, or nothing has run
};

}  // namespace

std::unique_ptr<Adapter> make_spatialite() {
  return std::make_unique<Spatialite>();
}

}  // namespace hullbench
