// An in-memory SQLite database with SpatiaLite's functions, and what the adapters that run on one share.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"

namespace hullbench {

/// A prepared SQL statement. Every function throws std::bad_alloc when SQLite has no memory left, and
/// std::runtime_error with SQLite's own words for any other failure.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& sql);

  /// Parameters are counted from 1.
  void bind(int place, double value);
  void bind(int place, int value);
  /// The bytes are not copied and must outlive the next `reset`.
  void bind(int place, std::span<const std::uint8_t> bytes);

  /// Whether there is a row.
  bool step();
  /// Ready for the next round; parameters keep their values.
  void reset();
  /// All steps at once, for a statement whose rows nobody reads; then `reset`.
  void execute();

  /// Columns of the row, counted from 0.
  bool is_null(int column);
  /// Empty for NULL.
  std::string text(int column);
  /// Empty for NULL.
  std::vector<std::uint8_t> blob(int column);

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
  };

  void check(int code);

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// The database, with one table `point_set (geom)`, which holds the loaded points as one MultiPoint.
class SpatialiteDatabase {
 public:
  SpatialiteDatabase();

  sqlite3* get() { return database_.get(); }

  /// Puts `points` in place of the ones loaded before. SpatiaLite has no geometry without points: for none,
  /// the table is empty.
  void load(std::span<const Point> points);

  /// Why SpatiaLite's last function failed; empty when it does not say. std::bad_alloc when it lacked memory.
  std::string last_failure();

 private:
  struct FreeCache {
    void operator()(void* cache) const;
  };
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };

  // SpatiaLite keeps its state beside the connection and wants it freed after the connection is closed.
  std::unique_ptr<void, FreeCache> cache_;
  std::unique_ptr<sqlite3, Close> database_;
};

/// What is true of every method that is SpatiaLite's concave hull: version, licence, parameters `c` and
/// `allow_holes`, capabilities. The caller adds name, title, citation and native output.
MethodInfo spatialite_method(SpatialiteDatabase& database);

}  // namespace hullbench
