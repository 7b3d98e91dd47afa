// PCL's ConcaveHull in two dimensions: the alpha shape over Qhull's triangulation, in single precision.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon without
// a call of PCL, which fails on them.
//
// Some of its results are invalid, and that is PCL's doing: where its boundary touches itself at a vertex,
// its tracing can close a ring with a chord that is no edge of the alpha shape and crosses other rings. The
// rings cross as they come out of reconstruct(), before they are mapped and nested here (California, 32,000
// points).
#include <pcl/kdtree/kdtree_flann.h>
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
    if (!cloud_->empty()) tree_.setInputCloud(cloud_);
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
    // PCL could keep information (setKeepInformation), which its default and its tutorial do not: it would
    // build a tree of the points to find the one at each vertex. Only we need these points, so do_load()
    // builds the tree.
    hull.reconstruct(vertices_, polygons_);
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    // Vertices are what two rotations in single precision leave of the points.
    const std::vector<std::size_t> point_of = nearest_points();
    std::vector<Ring> rings;
    rings.reserve(polygons_.size());
    for (const pcl::Vertices& polygon : polygons_) {
      Ring& ring = rings.emplace_back();
      ring.reserve(polygon.vertices.size());
      for (const auto vertex : polygon.vertices) {
        ring.push_back(points_[point_of[static_cast<std::size_t>(vertex)]]);
      }
    }
    return nest_rings(std::move(rings));
  }

  void do_reset() override {
    polygons_.clear();
    vertices_.clear();
  }

  /// Vertex of the hull -> the nearest input point.
  std::vector<std::size_t> nearest_points() const {
    std::vector<std::size_t> nearest;
    nearest.reserve(vertices_.size());
    pcl::Indices found(1);
    std::vector<float> squared_distances(1);
    for (const pcl::PointXYZ& vertex : vertices_) {
      tree_.nearestKSearch(vertex, 1, found, squared_distances);
      nearest.push_back(static_cast<std::size_t>(found.front()));
    }
    return nearest;
  }

  std::vector<Point> points_;
  Cloud::Ptr cloud_;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree_;  // of cloud_
  Cloud vertices_;                        // of the hull
  std::vector<pcl::Vertices> polygons_;   // rings of indices into vertices_
};

}  // namespace

std::unique_ptr<Adapter> make_pcl_concave_hull() {
  return std::make_unique<PclConcaveHull>();
}

}  // namespace hullbench
