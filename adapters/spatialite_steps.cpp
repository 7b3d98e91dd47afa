// SpatiaLite's concave hull, one SQL statement after another, so that its steps can be timed: ST_ConcaveHull
// does them in one call and tells nothing.
//
// The rule, read from libspatialite's gg_voronoj.c (5.0): take the lengths of the three edges of every
// Delaunay triangle, so inner edges twice, with s their standard deviation (divided by the count, not the
// count less one); keep the triangles whose edges are all strictly shorter than c * s. The mean takes no part
// in the limit, and a limit that is not a number keeps every triangle. Then the kept triangles are united.
//
// Where this differs from ST_ConcaveHull:
// - The deviation comes from two passes of sums, not from a running update, so the limit may differ in its
//   last digits. The shape can differ only when an edge's length is as near to the limit as that.
// - Tables hold what ST_ConcaveHull passes on in memory: the triangulation as one geometry, its triangles
// with
//   their lengths, and the kept triangles as one geometry. Packing, unpacking and one row a triangle are
//   timed.
// - With allow_holes 0 the shells are taken from the united shape in a statement of their own, in `polygon`.
//
// ElementaryGeometries splits the triangulation in time linear in its size; ST_GeometryN unpacks all of it
// for every triangle. It only reads single rows, and only of tables that are registered as spatial, which is
// why some are.
//
// Degenerate input: as in spatialite.cpp.
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/spatialite_database.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

constexpr const char* kTriangulate =
    "INSERT OR IGNORE INTO triangulation (id, geom) SELECT 1, ST_DelaunayTriangulation(geom) FROM point_set";

// ST_Distance of two points is the length of the edge, bit for bit, and three times as fast as taking it from
// the coordinates, each of which would be a call.
constexpr const char* kMeasure =
    "INSERT INTO triangle (geom, ab, bc, ca) "
    "SELECT geometry, ST_Distance(a, b), ST_Distance(b, c), ST_Distance(c, a) "
    "FROM (SELECT geometry, ST_PointN(ring, 1) AS a, ST_PointN(ring, 2) AS b, ST_PointN(ring, 3) AS c "
    "      FROM (SELECT geometry, ST_ExteriorRing(geometry) AS ring "
    "            FROM ElementaryGeometries WHERE f_table_name = 'triangulation' AND origin_rowid = 1))";

constexpr const char* kFilter =
    "WITH average (length) AS (SELECT avg(ab + bc + ca) / 3 FROM triangle), "
    "     deviation (length) AS ("
    "       SELECT sqrt(avg((ab - average.length) * (ab - average.length) + "
    "                       (bc - average.length) * (bc - average.length) + "
    "                       (ca - average.length) * (ca - average.length)) / 3) "
    "       FROM triangle, average) "
    "INSERT INTO kept (geom) SELECT ST_Collect(geom) FROM triangle, deviation "
    "WHERE (max(ab, bc, ca) >= ?1 * deviation.length) IS NOT TRUE";

constexpr const char* kUnite =
    "INSERT OR IGNORE INTO hull (id, geom) SELECT 1, ST_UnaryUnion(geom) FROM kept";

constexpr const char* kWithHoles = "SELECT ST_AsBinary(geom) FROM hull";

constexpr const char* kFilled =
    "SELECT ST_AsBinary(ST_Collect(MakePolygon(ST_ExteriorRing(geometry)))) "
    "FROM ElementaryGeometries WHERE f_table_name = 'hull' AND origin_rowid = 1";

MethodInfo describe(SpatialiteDatabase& database) {
  MethodInfo info = spatialite_method(database);
  info.name = "spatialite_steps";
  info.title = "SpatiaLite, step by step";
  info.citation =
      "SpatiaLite, SQL functions ST_DelaunayTriangulation, ST_Distance, ST_Collect and ST_UnaryUnion in "
      "place of ST_ConcaveHull, https://www.gaia-gis.it/fossil/libspatialite";
  info.native_output = "WKB of a polygon or multipolygon";
  return info;
}

/// The database with the tables between the steps.
class StepsDatabase : public SpatialiteDatabase {
 public:
  StepsDatabase() {
    // In one transaction, and no spatial reference systems but the undefined ones.
    execute("SELECT InitSpatialMetaData(1, 'NONE')");
    execute("CREATE TABLE triangle (geom BLOB NOT NULL, ab REAL, bc REAL, ca REAL)");
    execute("CREATE TABLE kept (geom BLOB)");
    // NOT NULL, and NULL is left out, because ElementaryGeometries (5.0.1) crashes on it.
    for (const std::string name : {"triangulation", "hull"}) {
      execute("CREATE TABLE " + name + " (id INTEGER PRIMARY KEY)");
      execute("SELECT AddGeometryColumn('" + name + "', 'geom', 0, 'GEOMETRY', 'XY', 1)");
    }
  }

  void clear() {
    for (const std::string name : {"triangulation", "triangle", "kept", "hull"})
      execute("DELETE FROM " + name);
  }

  bool has_triangles() {
    Statement query(get(), "SELECT id FROM triangulation");
    return query.step();
  }

 private:
  void execute(const std::string& sql) { Statement(get(), sql).execute(); }
};

class SpatialiteSteps final : public Adapter {
 public:
  SpatialiteSteps() { info_ = describe(database_); }

 private:
  void do_load(std::span<const Point> points) override { database_.load(points); }

  void do_run(const Parameters& parameters, Steps& steps) override {
    is_empty_ = false;
    steps.begin("triangulation");
    triangulate_.execute();
    steps.begin("shape");
    measure_.execute();
    filter_.bind(1, parameters.at("c"));
    filter_.execute();
    steps.begin("polygon");
    unite_.execute();
    hull_wkb_ = fetch(parameters.at("allow_holes") != 0 ? with_holes_ : filled_);
    if (!hull_wkb_ && has_area()) throw_null_hull();
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    return hull_wkb_ ? from_wkb(*hull_wkb_) : MultiPolygon();
  }

  void do_reset() override {
    hull_wkb_.reset();
    if (is_empty_) return;
    database_.clear();
    is_empty_ = true;
  }

  static std::optional<std::vector<std::uint8_t>> fetch(Statement& query) {
    std::optional<std::vector<std::uint8_t>> wkb;
    if (query.step() && !query.is_null(0)) wkb = query.blob(0);
    query.reset();
    return wkb;
  }

  [[noreturn]] void throw_null_hull() {
    const std::string reason = database_.last_failure();
    if (!reason.empty()) throw std::runtime_error("SpatiaLite answered NULL: " + reason);
    if (!database_.has_triangles()) {
      throw std::runtime_error("SpatiaLite's ST_DelaunayTriangulation answered NULL and gave no reason");
    }
    throw std::runtime_error("no triangle has all its edges shorter than c standard deviations");
  }

  StepsDatabase database_;
  Statement triangulate_{database_.get(), kTriangulate};
  Statement measure_{database_.get(), kMeasure};
  Statement filter_{database_.get(), kFilter};
  Statement unite_{database_.get(), kUnite};
  Statement with_holes_{database_.get(), kWithHoles};
  Statement filled_{database_.get(), kFilled};
  std::optional<std::vector<std::uint8_t>> hull_wkb_;  ///< none: nothing was kept
  bool is_empty_ = true;                               ///< whether the tables between the steps are
};

}  // namespace

std::unique_ptr<Adapter> make_spatialite_steps() {
  return std::make_unique<SpatialiteSteps>();
}

}  // namespace hullbench
