#include "benchmarks/metrics/triangle_outline.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace hullbench::metrics {
namespace {

using polylidar::kNone;
using polylidar::Triangulation;

std::uint32_t previous_in_triangle(std::uint32_t edge) {
  return edge % 3 == 0 ? edge + 2 : edge - 1;
}

class Outliner {
 public:
  Outliner(const Triangulation& mesh, std::span<const Point> points, const std::vector<bool>& kept)
      : mesh_(mesh),
        points_(points),
        kept_(kept),
        hull_edge_from_(points.size(), kNone),
        region_of_(kept.size(), kNone),
        is_traced_(mesh.triangles.size(), false) {
    for (std::uint32_t edge = 0; edge < mesh_.triangles.size(); ++edge) {
      if (mesh_.halfedges[edge] == kNone) hull_edge_from_[mesh_.triangles[edge]] = edge;
    }
  }

  MultiPolygon outline() {
    label_regions();
    for (std::uint32_t edge = 0; edge < mesh_.triangles.size(); ++edge) {
      if (is_boundary(edge) && !is_traced_[edge]) add_ring(region_of_[edge / 3], trace(edge));
    }
    return std::move(polygons_);
  }

 private:
  bool is_kept(std::uint32_t edge) const { return edge != kNone && kept_[edge / 3]; }
  bool is_boundary(std::uint32_t edge) const { return is_kept(edge) && !is_kept(mesh_.halfedges[edge]); }

  /// Gives the triangles of every edge-connected set the number of its polygon.
  void label_regions() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t first = 0; first < kept_.size(); ++first) {
      if (!kept_[first] || region_of_[first] != kNone) continue;
      const auto region = static_cast<std::uint32_t>(polygons_.size());
      polygons_.emplace_back();
      region_of_[first] = region;
      for (open.push_back(first); !open.empty();) {
        const std::uint32_t triangle = open.back();
        open.pop_back();
        for (std::uint32_t edge = 3 * triangle; edge < 3 * triangle + 3; ++edge) {
          const std::uint32_t twin = mesh_.halfedges[edge];
          if (!is_kept(twin) || region_of_[twin / 3] != kNone) continue;
          region_of_[twin / 3] = region;
          open.push_back(twin / 3);
        }
      }
    }
  }

  /// The boundary half-edge behind `edge`: the first one of its region met when turning at its end through
  /// everything else, the outside of the convex hull too. So a ring never passes a vertex twice.
  std::uint32_t next_on_boundary(std::uint32_t edge) const {
    const std::uint32_t region = region_of_[edge / 3];
    std::uint32_t outer = mesh_.halfedges[edge];  // starts at the end of `edge`, outside the region
    while (true) {
      if (outer == kNone) {
        const std::uint32_t end = mesh_.triangles[edge - edge % 3 + (edge + 1) % 3];
        outer = hull_edge_from_[end];
      } else {
        outer = mesh_.halfedges[previous_in_triangle(outer)];
        if (outer == kNone) continue;
      }
      if (region_of_[outer / 3] == region) return outer;
    }
  }

  Ring trace(std::uint32_t first) {
    Ring ring;
    std::uint32_t edge = first;
    do {
      is_traced_[edge] = true;
      ring.push_back(points_[mesh_.triangles[edge]]);
      edge = next_on_boundary(edge);
    } while (edge != first);
    return ring;
  }

  /// The shell encloses the most of a region's rings. Not the sign of the area tells it: that of a sliver's
  /// is one of rounding.
  void add_ring(std::uint32_t region, Ring ring) {
    Polygon& polygon = polygons_[region];
    if (std::abs(polylidar::signed_area(ring)) > std::abs(polylidar::signed_area(polygon.shell)) ||
        polygon.shell.empty()) {
      std::swap(polygon.shell, ring);
    }
    if (!ring.empty()) polygon.holes.push_back(std::move(ring));
  }

  const Triangulation& mesh_;
  std::span<const Point> points_;
  const std::vector<bool>& kept_;
  std::vector<std::uint32_t> hull_edge_from_;  ///< vertex -> the half-edge on the hull that starts there
  std::vector<std::uint32_t> region_of_;       ///< triangle -> its polygon; kNone when not kept
  std::vector<bool> is_traced_;                ///< half-edge -> whether it is on a ring already
  MultiPolygon polygons_;
};

}  // namespace

MultiPolygon triangle_outline(const Triangulation& mesh, std::span<const Point> points,
                              const std::vector<bool>& kept) {
  return Outliner(mesh, points, kept).outline();
}

}  // namespace hullbench::metrics
