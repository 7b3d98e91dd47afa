// SpatiaLite's ST_ConcaveHull on an in-memory SQLite database.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon. For
// any other NULL, `run` throws: SpatiaLite answers NULL both when it fails and when no triangle is
// short-edged enough to be kept.
//
// SpatiaLite has no limit of edges as a length. With max_edge_length its factor c is that length over the
// deviation of the edges of its own triangulation, which is measured when points are loaded, off the clock.
#include <cmath>
#include <cstdint>
#include <limits>
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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

MethodInfo describe(SpatialiteDatabase& database) {
  MethodInfo info = spatialite_method(database);
  info.name = "spatialite";
  info.title = "SpatiaLite";
  info.citation = "SpatiaLite, SQL function ST_ConcaveHull, https://www.gaia-gis.it/fossil/libspatialite";
  info.native_output = "WKB of a polygon or multipolygon";
  info.parameters.insert(
      info.parameters.begin(),
      length_limit(
          "max_edge_length",
          "A Delaunay triangle is kept when each of its edges is shorter than this; it is turned into "
          "c, which is not used when this is finite.",
          kInfinity));
  return info;
}

/// The standard deviation of the edges' lengths, by SpatiaLite's own rule: of every triangle its three edges,
/// divided by the count (spatialite_steps.cpp). 0 for no triangles.
double edge_deviation(const MultiPolygon& triangles) {
  std::vector<double> lengths;
  double sum = 0;
  for (const Polygon& triangle : triangles) {
    const Ring& ring = triangle.shell;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& a = ring[i];
      const Point& b = ring[(i + 1) % ring.size()];
      lengths.push_back(std::hypot(a.x - b.x, a.y - b.y));
      sum += lengths.back();
    }
  }
  if (lengths.empty()) return 0;
  const auto count = static_cast<double>(lengths.size());
  double squares = 0;
  for (const double length : lengths) squares += (length - sum / count) * (length - sum / count);
  return std::sqrt(squares / count);
}

class Spatialite final : public Adapter {
 public:
  Spatialite() { info_ = describe(database_); }

 private:
  void do_load(std::span<const Point> points) override {
    database_.load(points);
    deviation_ = 0;
    if (!has_area()) return;
    Statement triangulate(database_.get(),
                          "SELECT ST_AsBinary(ST_DelaunayTriangulation(geom)) FROM point_set");
    if (triangulate.step() && !triangulate.is_null(0))
      deviation_ = edge_deviation(from_wkb(triangulate.blob(0)));
  }

  void do_run(const Parameters& parameters, Steps& /*steps*/) override {
    hull_.bind(1, factor(parameters));
    hull_.bind(2, parameters.at("allow_holes") != 0 ? 1 : 0);
    if (hull_.step() && !hull_.is_null(0)) hull_wkb_ = hull_.blob(0);
    hull_.reset();
    if (!hull_wkb_ && has_area()) throw_null_hull();
  }

  MultiPolygon do_extract(Steps& /*steps*/) override {
    return hull_wkb_ ? from_wkb(*hull_wkb_) : MultiPolygon();
  }

  void do_reset() override { hull_wkb_.reset(); }

  /// SpatiaLite's c. If all edges are equally long, their deviation is 0, and SpatiaLite keeps no triangle.
  double factor(const Parameters& parameters) const {
    const double length = parameters.at("max_edge_length");
    return std::isfinite(length) && deviation_ > 0 ? length / deviation_ : parameters.at("c");
  }

  [[noreturn]] void throw_null_hull() {
    const std::string reason = database_.last_failure();
    throw std::runtime_error(
        reason.empty()
            ? "SpatiaLite's ST_ConcaveHull answered NULL and gave no reason; it does so when no triangle "
              "has all its edges shorter than c standard deviations"
            : "SpatiaLite's ST_ConcaveHull answered NULL: " + reason);
  }

  SpatialiteDatabase database_;
  Statement hull_{database_.get(), "SELECT ST_AsBinary(ST_ConcaveHull(geom, ?, ?)) FROM point_set"};
  double deviation_ = 0;  ///< of the edges of the triangulation of the loaded points
  std::optional<std::vector<std::uint8_t>> hull_wkb_;  ///< none: SpatiaLite answered NULL
};

}  // namespace

std::unique_ptr<Adapter> make_spatialite() {
  return std::make_unique<Spatialite>();
}

}  // namespace hullbench
