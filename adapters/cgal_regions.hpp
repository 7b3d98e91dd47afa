// From faces of a CGAL triangulation that are inside or outside to polygons: what the methods on CGAL share.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::cgal {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Where a face belongs: the information of a triangulation's faces, so that neither regions nor rings need a
/// map.
struct FaceLabel {
  /// kOutside, kInside of a face whose region is not known yet, or kFirstRegion plus its region's number.
  std::uint32_t region = 0;
  bool traced[3] = {false, false, false};  ///< edge i: whether a ring has already gone along it
};
inline constexpr std::uint32_t kOutside = 0;
inline constexpr std::uint32_t kInside = 1;
inline constexpr std::uint32_t kFirstRegion = 2;

/// The edge-connected regions of the faces inside, with the edges that bound them.
template <typename Triangulation>
struct Regions {
  std::uint32_t count = 0;
  /// (face, i): the face's edge opposite its vertex i, from vertex ccw(i) to vertex cw(i). Seen from the face
  /// inside, so the region lies to the left; region by region.
  std::vector<typename Triangulation::Edge> boundary;
};

/// `points` as CGAL's.
inline std::vector<Kernel::Point_2> kernel_points(std::span<const polylidar::Point> points) {
  std::vector<Kernel::Point_2> result;
  result.reserve(points.size());
  for (const polylidar::Point& point : points) result.emplace_back(point.x, point.y);
  return result;
}

/// Asks `is_inside(face)` once of every finite face of a two-dimensional triangulation and labels each face
/// inside with its region. Labels of an earlier call are overwritten; infinite faces stay outside.
template <typename Triangulation, typename IsInside>
Regions<Triangulation> label_regions(const Triangulation& triangulation, const IsInside& is_inside) {
  using Face = typename Triangulation::Face_handle;
  for (Face face : triangulation.finite_face_handles()) {
    face->info() = FaceLabel{.region = is_inside(face) ? kInside : kOutside};
  }
  Regions<Triangulation> regions;
  std::vector<Face> stack;
  for (Face seed : triangulation.finite_face_handles()) {
    if (seed->info().region != kInside) continue;
    const std::uint32_t label = kFirstRegion + regions.count++;
    seed->info().region = label;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Face face = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face neighbour = face->neighbor(i);
        if (neighbour->info().region == label) continue;
        if (neighbour->info().region == kInside) {
          neighbour->info().region = label;
          stack.push_back(neighbour);
        } else {
          regions.boundary.emplace_back(face, i);
        }
      }
    }
  }
  return regions;
}

/// The boundary edge that follows `edge` on its ring: turning counter-clockwise round the vertex where `edge`
/// ends, through faces that are not in the region, it is the first edge with the region behind it. Infinite
/// faces close the way round the convex hull. Where several parts of the outside meet in one vertex, each
/// keeps to its own sector, so a ring never passes a vertex twice.
template <typename Triangulation>
typename Triangulation::Edge next_on_ring(const typename Triangulation::Edge& edge) {
  const std::uint32_t label = edge.first->info().region;
  const auto pivot = edge.first->vertex(Triangulation::cw(edge.second));
  auto face = edge.first->neighbor(edge.second);
  while (true) {
    const auto neighbour = face->neighbor(Triangulation::ccw(face->index(pivot)));
    if (neighbour->info().region == label) return {neighbour, neighbour->index(face)};
    face = neighbour;
  }
}

struct TracedRing {
  polylidar::Ring points;
  bool is_shell = false;
};

/// The ring through `first`. It is a shell when it turns left at its lexicographically smallest vertex: at
/// such a vertex a simple ring is strictly convex, so one exact predicate tells its orientation.
template <typename Triangulation>
TracedRing trace_ring(const typename Triangulation::Edge& first) {
  TracedRing ring;
  std::size_t smallest = 0;
  auto edge = first;
  do {
    edge.first->info().traced[edge.second] = true;
    const auto& start = edge.first->vertex(Triangulation::ccw(edge.second))->point();
    const polylidar::Point point{start.x(), start.y()};
    const polylidar::Point& least = ring.points.empty() ? point : ring.points[smallest];
    if (point.x < least.x || (point.x == least.x && point.y < least.y)) smallest = ring.points.size();
    ring.points.push_back(point);
    edge = next_on_ring<Triangulation>(edge);
  } while (edge != first);

  const std::size_t size = ring.points.size();
  const auto kernel_point = [&](std::size_t i) {
    return Kernel::Point_2(ring.points[i % size].x, ring.points[i % size].y);
  };
  ring.is_shell =
      CGAL::left_turn(kernel_point(smallest + size - 1), kernel_point(smallest), kernel_point(smallest + 1));
  return ring;
}

/// One polygon a region: valid by construction, since rings of one region share at most vertices. Can be
/// called again.
template <typename Triangulation>
polylidar::MultiPolygon trace_polygons(const Regions<Triangulation>& regions) {
  for (const auto& [face, i] : regions.boundary) face->info().traced[i] = false;
  polylidar::MultiPolygon result(regions.count);
  for (const auto& edge : regions.boundary) {
    const FaceLabel& label = edge.first->info();
    if (label.traced[edge.second]) continue;
    polylidar::Polygon& polygon = result[label.region - kFirstRegion];
    TracedRing ring = trace_ring<Triangulation>(edge);
    if (ring.is_shell) {
      polygon.shell = std::move(ring.points);
    } else {
      polygon.holes.push_back(std::move(ring.points));
    }
  }
  return result;
}

}  // namespace hullbench::cgal
