// PostGIS's ST_ConcaveHull through libpq.
//
// The length-ratio hull takes a length too, which ST_ConcaveHull does not: PostGIS measures the ratio from
// the shortest edge of its own Delaunay triangulation (0) to the longest (1), so load() has PostGIS
// triangulate and remembers these two, and run() turns the length into its ratio. One of both decides: as
// with GEOS's own hull both default to "no limit", the convex hull, and `length_ratio` must be left at 1 when
// `max_edge_length` is finite.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon
// (PostGIS answers with a point, a line or NULL). NULL for any other input is an error of the method.
#include "adapters/postgis.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "adapters/postgis_session.hpp"
#include "adapters/private_postgres.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

constexpr const char* kLegacyRemedy =
    "unset HULLBENCH_POSTGIS_LEGACY_DSN and run make deps-legacy, or docker-compose up -d postgis-legacy and "
    "set it as docker-compose.yml shows";
constexpr const char* kCurrentRemedy =
    "unset HULLBENCH_POSTGIS_DSN for a private server, or docker-compose up -d postgis and set it as "
    "docker-compose.yml shows";

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kConvexRatio = 1;

constexpr const char* kShortestAndLongestEdge =
    "SELECT min(length), max(length) FROM ("
    "  SELECT unnest(ARRAY[ST_Distance(a, b), ST_Distance(b, c), ST_Distance(c, a)]) AS length"
    "  FROM (SELECT ST_PointN(ring, 1) AS a, ST_PointN(ring, 2) AS b, ST_PointN(ring, 3) AS c"
    "        FROM (SELECT ST_ExteriorRing((ST_Dump(ST_DelaunayTriangles(geom))).geom) AS ring"
    "              FROM pg_temp.hullbench_points OFFSET 0) AS rings OFFSET 0) AS corners) AS edges";

/// The two edges of the triangulation between which PostGIS measures its ratio.
struct EdgeRange {
  double shortest;
  double longest;

  /// The length ratio that stands for `length`; below the shortest edge and above the longest the nearest
  /// one.
  double ratio_of(double length) const {
    if (length >= longest) return kConvexRatio;
    return std::max(0.0, (length - shortest) / (longest - shortest));
  }
};

/// What a server says about itself.
struct Server {
  PostgisVersions versions;
  PostgisMethod method = PostgisMethod::kLengthRatio;
};

// Empty when the file cannot be read.
std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The method is told by the function's language: PL/pgSQL is the old one. Version numbers would not tell: the
// new one needs PostGIS 3.3, a build against GEOS 3.11 and the extension's SQL updated.
Server describe_server(Session& session) {
  const Result answer = session.execute(
      "SELECT lanname FROM pg_proc JOIN pg_language ON pg_language.oid = prolang "
      "WHERE pg_proc.oid = 'ST_ConcaveHull(geometry, float8, boolean)'::regprocedure");
  return {postgis_versions(session),
          text(answer, 0) == "plpgsql" ? PostgisMethod::kTargetPercent : PostgisMethod::kLengthRatio};
}

MethodInfo describe_method(const Server& server) {
  const bool legacy = server.method == PostgisMethod::kTargetPercent;
  MethodInfo info;
  info.name = legacy ? "postgis_legacy" : "postgis";
  info.title = legacy ? "PostGIS <= 3.2" : "PostGIS";
  info.version = server.versions.together();
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
         0, 1, kConvexRatio});
    info.parameters.push_back(length_limit(
        "max_edge_length",
        "Longest edge allowed, as a length, which is turned into its ratio; when it is finite, length_ratio "
        "is left at 1.",
        kInfinity));
  }
  info.parameters.push_back(off_switch("allow_holes", "Whether holes are kept (1) or filled (0)."));
  info.capabilities = {.holes = true, .several_polygons = false, .in_server = true};
  return info;
}

[[noreturn]] void throw_other_method(const Server& server) {
  if (server.method == PostgisMethod::kLengthRatio) {
    throw NotInstalled(
        "the server runs PostGIS " + server.versions.postgis +
            ", whose ST_ConcaveHull is GEOS's length-ratio hull; the paper's target-percent method ended "
            "with PostGIS 3.2",
        kLegacyRemedy);
  }
  throw NotInstalled(
      "the server runs PostGIS " + server.versions.postgis + " on GEOS " + server.versions.geos +
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
  return Server{{version, "", ""}, PostgisMethod::kLengthRatio};
}

void refuse_other_method(const std::filesystem::path& bin, PostgisMethod wanted) {
  const std::optional<Server> installed = installed_length_ratio_server(bin);
  if (installed && installed->method != wanted) throw_other_method(*installed);
}

class Postgis final : public Adapter {
 public:
  explicit Postgis(PostgisMethod method)
      : method_(method),
        connection_(method == PostgisMethod::kTargetPercent ? kLegacyServer : kCurrentServer,
                    [method](const std::filesystem::path& bin) { refuse_other_method(bin, method); }) {
    const Server server = describe_server(connection_.session());
    if (server.method != method) throw_other_method(server);
    info_ = describe_method(server);
    prepare();
  }

 private:
  void do_load(std::span<const Point> points) override {
    if (connection_.reopen_if_lost()) prepare();
    fill_point_table(connection_.session(), points);
    edges_.reset();
    if (is_by_length_ratio() && has_area()) edges_ = measure_edges();
  }

  void do_run(const Parameters& parameters, Steps& /*steps*/) override {
    const double share = is_by_length_ratio() ? length_ratio(parameters) : parameters.at("target_percent");
    hull_ = connection_.session().execute_prepared(
        kHull, {binary(share), binary(parameters.at("allow_holes") != 0)});
    if (PQntuples(hull_.get()) != 1) throw std::logic_error(info_.name + ": run before load");
    if (PQgetisnull(hull_.get(), 0, 0) != 0 && has_area()) {
      throw std::runtime_error("PostGIS's ST_ConcaveHull answered NULL and gave no reason");
    }
  }

  MultiPolygon do_extract(Steps& /*steps*/) override {
    if (PQgetisnull(hull_.get(), 0, 0) != 0) return {};
    return from_wkb(bytes(hull_, 0));
  }

  void do_reset() override { hull_.reset(); }

  static constexpr const char* kHull = "hull";
  static constexpr const char* kEdges = "edges";

  bool is_by_length_ratio() const { return method_ == PostgisMethod::kLengthRatio; }

  // None when PostGIS makes no triangle of the points, which are nearly on a line then.
  std::optional<EdgeRange> measure_edges() {
    const Result answer = connection_.session().execute_prepared(kEdges);
    if (PQgetisnull(answer.get(), 0, 0) != 0) return std::nullopt;
    return EdgeRange{number(answer, 0), number(answer, 1)};
  }

  double length_ratio(const Parameters& values) const {
    const double ratio = values.at("length_ratio");
    const double length = values.at("max_edge_length");
    if (!std::isfinite(length)) return ratio;
    if (ratio != kConvexRatio) {
      throw std::invalid_argument(
          "postgis takes 'length_ratio' or 'max_edge_length', not both: leave 'length_ratio' out when "
          "'max_edge_length' is finite");
    }
    if (!has_area()) return ratio;
    if (!edges_) throw std::runtime_error("PostGIS's ST_DelaunayTriangles gave no triangle and no reason");
    return edges_->ratio_of(length);
  }

  void prepare() {
    Session& session = connection_.session();
    create_point_table(session);
    session.prepare(kHull, "SELECT ST_AsBinary(ST_ConcaveHull(geom, $1, $2)) FROM pg_temp.hullbench_points",
                    {kFloat8, kBool});
    if (is_by_length_ratio()) session.prepare(kEdges, kShortestAndLongestEdge);
  }

  PostgisMethod method_;
  PostgisConnection connection_;
  std::optional<EdgeRange> edges_;  ///< of the loaded points; none without an area
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
