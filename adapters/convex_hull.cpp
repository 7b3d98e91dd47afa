// The convex hull, by Boost.Geometry: the floor that every concave hull must beat.
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>
#include <boost/version.hpp>
#include <memory>
#include <span>

#include "adapters/adapter.hpp"

namespace hullbench {
namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
// Counter-clockwise, first vertex not repeated: as polylidar::Ring.
using BoostRing = bg::model::ring<BoostPoint, false, false>;

MethodInfo describe() {
  MethodInfo info;
  info.name = "convex_hull";
  info.title = "Convex hull";
  // Boost.Geometry is headers only: what was compiled is what runs.
  info.version = BOOST_LIB_VERSION;
  std::replace(info.version.begin(), info.version.end(), '_', '.');
  info.licence = "BSL-1.0";
  info.citation =
      "A. M. Andrew, Another Efficient Algorithm for Convex Hulls in Two Dimensions, Information Processing "
      "Letters 9(5), 1979; Boost.Geometry, convex_hull";
  info.native_output = "ring";
  info.capabilities = {.holes = false, .several_polygons = false};
  return info;
}

class ConvexHull final : public Adapter {
 public:
  ConvexHull() { info_ = describe(); }

 private:
  void do_load(std::span<const Point> points) override {
    points_.clear();
    points_.reserve(points.size());
    for (const Point& point : points) points_.emplace_back(point.x, point.y);
  }

  void do_run(const Parameters& /*parameters*/, Steps& steps) override {
    steps.begin("shape");
    if (has_area()) bg::convex_hull(points_, hull_);
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    // Points that are nearly on a line are on it for Boost, which then answers with a line there and back.
    if (hull_.size() < 3) return {};
    Polygon polygon;
    polygon.shell.reserve(hull_.size());
    for (const BoostPoint& point : hull_) polygon.shell.push_back({point.x(), point.y()});
    return {std::move(polygon)};
  }

  void do_reset() override { hull_ = BoostRing(); }

  bg::model::multi_point<BoostPoint> points_;
  BoostRing hull_;
};

}  // namespace

std::unique_ptr<Adapter> make_convex_hull() {
  return std::make_unique<ConvexHull>();
}

}  // namespace hullbench
