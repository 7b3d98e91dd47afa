// PostGIS's ST_ConcaveHull through libpq.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon
// (PostGIS answers with a point, a line or NULL). NULL for any other input is an error of the method.
#include "adapters/postgis.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "adapters/point_checks.hpp"
#include "adapters/postgis_session.hpp"
#include "adapters/private_postgres.hpp"
#include "adapters/wkb.hpp"

namespace hullbench {
namespace {

constexpr const char* kLegacyRemedy =
    "docker-compose up -d postgis-legacy, then set HULLBENCH_POSTGIS_DSN as docker-compose.yml shows";
constexpr const char* kCurrentRemedy =
    "unset HULLBENCH_POSTGIS_DSN for a private server, or docker-compose up -d postgis and set it as "
    "docker-compose.yml shows";

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
         0, 1, std::nullopt});
  }
  info.parameters.push_back({"allow_holes", "switch", "Whether holes are kept (1) or filled (0).", 0, 1, 0});
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
      : connection_([method](const std::filesystem::path& bin) { refuse_other_method(bin, method); }) {
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
    fill_point_table(connection_.session(), points);
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
    return from_wkb(bytes(hull_, 0));
  }

 private:
  static constexpr const char* kHull = "hull";

  void prepare() {
    Session& session = connection_.session();
    create_point_table(session);
    session.prepare(kHull, "SELECT ST_AsBinary(ST_ConcaveHull(geom, $1, $2)) FROM pg_temp.hullbench_points",
                    {kFloat8, kBool});
  }

  PostgisConnection connection_;
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
