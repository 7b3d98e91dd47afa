// floor_ground_truth of floor_scenes.hpp: the shadows that an eye's obstacles throw on the floor, and what is
// left of the floor.
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include "datasets/rgbd/floor_scenes.hpp"
#include "datasets/rgbd/stereo_camera.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
/// Counter-clockwise shells, first vertex not repeated: as polylidar::Polygon.
using BoostPolygon = bg::model::polygon<BoostPoint, false, false>;
using BoostMultiPolygon = bg::model::multi_polygon<BoostPolygon>;

/// Where the line from `eye` through `place`, which is lower, meets the floor.
BoostPoint on_floor(const Vector3& eye, const Vector3& place) {
  const double reach = eye.z / (eye.z - place.z);
  return {eye.x + reach * (place.x - eye.x), eye.y + reach * (place.y - eye.y)};
}

/// The floor that one imager's image covers: its four corners, counter-clockwise seen from above, and with a
/// lens the places between them that make its sides curves.
BoostPolygon covered_floor(const StereoCamera& camera, const Intrinsics& intrinsics, const Vector3& eye) {
  const double right = intrinsics.width - 0.5;
  const double bottom = intrinsics.height - 0.5;
  const std::array<Point, 4> corners = {{{-0.5, -0.5}, {-0.5, bottom}, {right, bottom}, {right, -0.5}}};
  const int pieces = camera.lens == 0 ? 1 : 64;
  BoostPolygon covered;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point& from = corners[i];
    const Point& to = corners[(i + 1) % corners.size()];
    for (int piece = 0; piece < pieces; ++piece) {
      const double part = static_cast<double>(piece) / pieces;
      const double u = from.x + part * (to.x - from.x);
      const double v = from.y + part * (to.y - from.y);
      covered.outer().push_back(on_floor(eye, eye + camera.direction(intrinsics, u, v)));
    }
  }
  return covered;
}

/// The floor of a low scene up to the camera's range, and far beyond its sides.
BoostPolygon floor_in_range(const FloorLayout& layout) {
  const double farthest = (kLowRange - layout.camera_height * layout.tilt_cosine) / layout.tilt_sine;
  constexpr double kAside = 100;
  BoostPolygon floor;
  for (const BoostPoint& corner : {BoostPoint(-kAside, -kAside), BoostPoint(kAside, -kAside),
                                   BoostPoint(kAside, farthest), BoostPoint(-kAside, farthest)}) {
    floor.outer().push_back(corner);
  }
  return floor;
}

/// The floor that `obstacle` takes from `eye`, its own footprint included: the convex hull of the footprint
/// and the shadow of its top.
BoostPolygon shadow(const ConvexPrism& obstacle, const Vector3& eye) {
  bg::model::multi_point<BoostPoint> corners;
  for (const Point& vertex : obstacle.footprint()) {
    corners.emplace_back(vertex.x, vertex.y);
    corners.push_back(on_floor(eye, {vertex.x, vertex.y, obstacle.height()}));
  }
  BoostPolygon hull;
  bg::convex_hull(corners, hull);
  return hull;
}

Ring to_ring(const bg::model::ring<BoostPoint, false, false>& ring) {
  Ring result;
  for (const BoostPoint& vertex : ring) result.push_back({vertex.x(), vertex.y()});
  return result;
}

MultiPolygon to_shape(const BoostMultiPolygon& shape) {
  MultiPolygon result;
  for (const BoostPolygon& polygon : shape) {
    Polygon& converted = result.emplace_back();
    converted.shell = to_ring(polygon.outer());
    for (const auto& hole : polygon.inners()) converted.holes.push_back(to_ring(hole));
  }
  return result;
}

}  // namespace

MultiPolygon floor_ground_truth(std::size_t index) {
  const FloorLayout layout = floor_layout(index);
  const StereoCamera camera = stereo_camera(layout);
  BoostMultiPolygon hidden;
  for (const ConvexPrism& obstacle : layout.obstacles) {
    for (const Vector3& eye : {camera.left_eye, camera.right_eye}) {
      BoostMultiPolygon joined;
      bg::union_(hidden, shadow(obstacle, eye), joined);
      hidden = joined;
    }
  }
  BoostMultiPolygon covered;
  const Intrinsics intrinsics = scene_camera(index);
  bg::intersection(covered_floor(camera, intrinsics, camera.left_eye),
                   covered_floor(camera, intrinsics, camera.right_eye), covered);
  if (layout.is_low) {
    BoostMultiPolygon in_range;
    bg::intersection(covered, floor_in_range(layout), in_range);
    covered = in_range;
  }
  BoostMultiPolygon seen;
  bg::difference(covered, hidden, seen);
  return to_shape(seen);
}

}  // namespace hullbench
