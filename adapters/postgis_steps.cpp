// Polylidar's three steps done with PostGIS's SQL functions, so that they can be timed beside Polylidar's
// own.
//
// PostGIS's ST_ConcaveHull cannot tell its steps: from 3.3 on it is one call of GEOS, before that one
// PL/pgSQL function. So this is another method: Delaunay triangulation, the triangles whose circumradius is
// at most alpha, their union, and the shape is Polylidar's up to rounding at the limit.
//
// Every step is one statement from the client, timed by the client. So the times include its round trip, and
// those of the first two steps include writing a temporary table: all triangles, then the kept ones. The
// result's way to the client is in the last step.
//
// The circumradius is compared as in the core, squared and without a division: with squared edge lengths
// l1, l2, l3 and twice the signed area, l1 * l2 * l3 <= 4 * alpha^2 * cross^2. PostgreSQL treats overflow and
// underflow of a double as an error, so edges longer than about 1e51 or shorter than about 1e-54, in whatever
// unit, fail the run.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon, as
// does an alpha that keeps no triangle.
#include <libpq-fe.h>

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "adapters/adapter.hpp"
#include "adapters/postgis_session.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

constexpr const char* kTriangulate =
    "INSERT INTO pg_temp.hullbench_triangles "
    "SELECT (ST_Dump(ST_DelaunayTriangles(geom))).geom FROM pg_temp.hullbench_points";

// $1 is 4 * alpha^2. Without OFFSET 0 the planner would merge the levels and take every ring and corner out
// of its triangle again wherever it is named.
constexpr const char* kFilter =
    "INSERT INTO pg_temp.hullbench_kept SELECT geom FROM ("
    "  SELECT geom, ST_X(b) - ST_X(a) AS abx, ST_Y(b) - ST_Y(a) AS aby, ST_X(c) - ST_X(b) AS bcx,"
    "         ST_Y(c) - ST_Y(b) AS bcy, ST_X(a) - ST_X(c) AS cax, ST_Y(a) - ST_Y(c) AS cay"
    "  FROM (SELECT geom, ST_PointN(ring, 1) AS a, ST_PointN(ring, 2) AS b, ST_PointN(ring, 3) AS c"
    "        FROM (SELECT geom, ST_ExteriorRing(geom) AS ring FROM pg_temp.hullbench_triangles OFFSET 0)"
    "             AS rings OFFSET 0) AS corners OFFSET 0) AS edges "
    "WHERE (abx * abx + aby * aby) * (bcx * bcx + bcy * bcy) * (cax * cax + cay * cay)"
    "      <= $1 * ((aby * cax - abx * cay) * (aby * cax - abx * cay))";

constexpr const char* kUnite = "SELECT ST_AsBinary(ST_Union(geom)) FROM pg_temp.hullbench_kept";

MethodInfo describe(Session& session) {
  MethodInfo info;
  info.name = "postgis_steps";
  info.title = "PostGIS, step by step";
  info.version = postgis_versions(session).together();
  info.licence = "GPL-2.0-or-later";
  info.citation =
      "PostGIS manual, ST_DelaunayTriangles and ST_Union, https://postgis.net/docs/reference.html; the rule "
      "is that of J. Castagno, E. Atkins, Polylidar - Polygons from Triangular Meshes";
  info.native_output = "WKB of a polygon or multipolygon";
  info.parameters = {
      length_limit("alpha", "Largest circumradius of a triangle inside the shape.", std::nullopt)};
  info.capabilities = {.holes = true, .several_polygons = true, .in_server = true};
  return info;
}

class PostgisSteps final : public Adapter {
 public:
  PostgisSteps() {
    info_ = describe(connection_.session());
    prepare();
  }

 private:
  void do_load(std::span<const Point> points) override {
    if (connection_.reopen_if_lost()) prepare();
    fill_point_table(connection_.session(), points);
  }

  void do_run(const Parameters& parameters, Steps& steps) override {
    const double alpha = parameters.at("alpha");
    Session& session = connection_.session();
    is_empty_ = false;
    steps.begin("triangulation");
    const Result triangles = session.execute_prepared("triangulate");
    if (has_area() && std::string_view(PQcmdTuples(triangles.get())) == "0") {
      throw std::runtime_error("PostGIS's ST_DelaunayTriangles gave no triangle and no reason");
    }
    steps.begin("shape");
    session.execute_prepared("filter", {binary(4 * alpha * alpha)});
    steps.begin("polygon");
    hull_ = session.execute_prepared("unite");
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    if (PQgetisnull(hull_.get(), 0, 0) != 0) return {};
    return from_wkb(bytes(hull_, 0));
  }

  void do_reset() override {
    hull_.reset();
    if (is_empty_ || !connection_.session().is_open()) return;
    connection_.session().execute("TRUNCATE pg_temp.hullbench_triangles, pg_temp.hullbench_kept");
    is_empty_ = true;
  }

  void prepare() {
    Session& session = connection_.session();
    create_point_table(session);
    session.execute("CREATE TEMP TABLE hullbench_triangles (geom geometry)");
    session.execute("CREATE TEMP TABLE hullbench_kept (geom geometry)");
    session.prepare("triangulate", kTriangulate);
    session.prepare("filter", kFilter, {kFloat8});
    session.prepare("unite", kUnite);
    is_empty_ = true;
  }

  PostgisConnection connection_{kCurrentServer};
  bool is_empty_ = true;  ///< whether the tables between the steps are
  Result hull_{nullptr, &PQclear};
};

}  // namespace

std::unique_ptr<Adapter> make_postgis_steps() {
  return std::make_unique<PostgisSteps>();
}

}  // namespace hullbench
