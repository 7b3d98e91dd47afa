// SpatiaLite's ST_ConcaveHull on an in-memory SQLite database.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon. For
// any other NULL, `run` throws: SpatiaLite answers NULL both when it fails and when no triangle is
// short-edged enough to be kept.
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

MethodInfo describe(SpatialiteDatabase& database) {
  MethodInfo info = spatialite_method(database);
  info.name = "spatialite";
  info.title = "SpatiaLite";
  info.citation = "SpatiaLite, SQL function ST_ConcaveHull, https://www.gaia-gis.it/fossil/libspatialite";
  info.native_output = "WKB of a polygon or multipolygon";
  return info;
}

class Spatialite final : public Adapter {
 public:
  Spatialite() { info_ = describe(database_); }

 private:
  void do_load(std::span<const Point> points) override { database_.load(points); }

  void do_run(const Parameters& parameters, Steps& /*steps*/) override {
    hull_.bind(1, parameters.at("c"));
    hull_.bind(2, parameters.at("allow_holes") != 0 ? 1 : 0);
    if (hull_.step() && !hull_.is_null(0)) hull_wkb_ = hull_.blob(0);
    hull_.reset();
    if (!hull_wkb_ && has_area()) throw_null_hull();
  }

  MultiPolygon do_extract(Steps& /*steps*/) override {
    return hull_wkb_ ? from_wkb(*hull_wkb_) : MultiPolygon();
  }

  void do_reset() override { hull_wkb_.reset(); }

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
  std::optional<std::vector<std::uint8_t>> hull_wkb_;  ///< none: SpatiaLite answered NULL
};

}  // namespace

std::unique_ptr<Adapter> make_spatialite() {
  return std::make_unique<Spatialite>();
}

}  // namespace hullbench
