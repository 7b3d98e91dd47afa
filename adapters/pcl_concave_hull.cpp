// PCL's ConcaveHull in two dimensions: the alpha shape over Qhull's triangulation, in single precision.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon without
// a call of PCL, which fails on them.
//
// Some of its results are invalid, and that is PCL's doing: where its boundary touches itself at a vertex,
// its tracing can close a ring with a chord that is no edge of the alpha shape and crosses other rings. The
// rings cross as they come out of reconstruct(), before they are mapped and nested here (California, 32,000
// points).
#include <pcl/pcl_config.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/concave_hull.h>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/ring_nesting.hpp"

namespace hullbench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

MethodInfo describe() {
  MethodInfo info;
  info.name = "pcl_concave_hull";
  info.title = "PCL concave hull";
  // PCL has no function that says its version; its libraries' names carry it, so another one would not load.
  info.version = PCL_VERSION_PRETTY;
  info.licence = "BSD-3-Clause";
  info.citation =
      "R. B. Rusu, S. Cousins, 3D is here: Point Cloud Library (PCL), ICRA 2011; class pcl::ConcaveHull";
  info.native_output = "rings in no order, vertices in single precision, mapped to the nearest input points";
  info.parameters = {
      length_limit("alpha", "Largest circumradius of a triangle inside the shape.", std::nullopt)};
  info.capabilities = {.holes = true, .several_polygons = true};
  return info;
}

class PclConcaveHull final : public Adapter {
 public:
  PclConcaveHull() { info_ = describe(); }

 private:
  void do_load(std::span<const Point> points) override {
    points_.assign(points.begin(), points.end());
    cloud_ = std::make_shared<Cloud>();
    cloud_->reserve(points.size());
    // PCL has single precision only, in which points far from the origin would fall together.
    const polylidar::Box box = polylidar::bounding_box(points);
    const Point middle = {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2};
    for (const Point& point : points) {
      cloud_->push_back(
          pcl::PointXYZ(static_cast<float>(point.x - middle.x), static_cast<float>(point.y - middle.y), 0));
    }
  }

  void do_run(const Parameters& parameters, Steps& steps) override {
    const double alpha = parameters.at("alpha");
    // PCL refuses alpha = 0, where no triangle is small enough.
    if (!has_area() || alpha == 0) return;
    if (points_.size() < 4) throw Unsupported("PCL's ConcaveHull needs at least 4 points");
    steps.begin("shape");
    pcl::ConcaveHull<pcl::PointXYZ> hull;
    hull.setInputCloud(cloud_);
    hull.setAlpha(alpha);
    hull.setDimension(2);
    // Without it the vertices are what two rotations in single precision leave of the points.
    hull.setKeepInformation(true);
    Cloud vertices;
    hull.reconstruct(vertices, polygons_);
    hull.getHullPointIndices(point_of_);
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    std::vector<Ring> rings;
    rings.reserve(polygons_.size());
    for (const pcl::Vertices& polygon : polygons_) {
      Ring& ring = rings.emplace_back();
      ring.reserve(polygon.vertices.size());
      for (const auto vertex : polygon.vertices) {
        ring.push_back(
            points_[static_cast<std::size_t>(point_of_.indices[static_cast<std::size_t>(vertex)])]);
      }
    }
    return nest_rings(std::move(rings));
  }

  void do_reset() override {
    polygons_.clear();
    point_of_.indices.clear();
  }

  std::vector<Point> points_;
  Cloud::Ptr cloud_;
  std::vector<pcl::Vertices> polygons_;  // rings of vertices of the hull
  pcl::PointIndices point_of_;           // vertex of the hull -> the nearest input point
};

}  // namespace

std::unique_ptr<Adapter> make_pcl_concave_hull() {
  return std::make_unique<PclConcaveHull>();
}

}  // namespace hullbench
