#include "region.hpp"

#include <algorithm>
#include <cmath>

namespace polylidar::detail {

namespace {

constexpr std::uint32_t kKeptUnlabelled = kOutside - 1;

double squared_distance(const Point& a, const Point& b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  return dx * dx + dy * dy;
}

/// Keeps or drops one triangle at a time.
class Filter {
 public:
  Filter(double alpha, double max_edge_length)
      : limit_radius_(std::isfinite(alpha)),
        four_squared_alpha_(4 * alpha * alpha),
        squared_max_edge_(max_edge_length * max_edge_length) {}

  bool keeps(const Point& a, const Point& b, const Point& c) const {
    const double ab = squared_distance(a, b);
    const double bc = squared_distance(b, c);
    const double ca = squared_distance(c, a);
    // Not negated, so that a NaN would drop the triangle.
    if (!(std::max({ab, bc, ca}) <= squared_max_edge_)) return false;
    if (!limit_radius_) return true;
    // circumradius = |ab| |bc| |ca| / (2 cross), with cross twice the area: squared and without division a
    // triangle that is flat up to rounding compares as infinitely large.
    const double cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return ab * bc * ca <= four_squared_alpha_ * (cross * cross);
  }

 private:
  bool limit_radius_;
  double four_squared_alpha_;
  double squared_max_edge_;
};

void filter_triangles(Mesh& mesh, const Point* vertices, const Filter& filter) {
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    const Mesh::Index e = Mesh::kStride * t;
    const bool kept =
        !mesh.is_ghost(t) &&
        filter.keeps(vertices[mesh.origin(e)], vertices[mesh.origin(e + 1)], vertices[mesh.origin(e + 2)]);
    mesh.label(t) = kept ? kKeptUnlabelled : kOutside;
    mesh.taken(t) = 0;
  }
}

/// Labels the triangles connected to `seed` by edges and appends their boundary.
void flood(Mesh& mesh, Mesh::Index seed, std::uint32_t region, std::vector<Mesh::Index>& half_edges,
           std::vector<Mesh::Index>& stack) {
  mesh.label(seed) = region;
  stack.push_back(seed);
  while (!stack.empty()) {
    const Mesh::Index t = stack.back();
    stack.pop_back();
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index e = Mesh::kStride * t + k;
      const Mesh::Index neighbour = Mesh::triangle_of(mesh.twin(e));
      std::uint32_t& label = mesh.label(neighbour);
      if (label == kOutside) {
        half_edges.push_back(e);
      } else if (label == kKeptUnlabelled) {
        label = region;
        stack.push_back(neighbour);
      }
    }
  }
}

}  // namespace

void extract_regions(Mesh& mesh, const Point* vertices, double alpha, double max_edge_length,
                     RegionBoundaries& boundaries, std::vector<Mesh::Index>& stack) {
  boundaries.half_edges.clear();
  boundaries.ends.clear();
  filter_triangles(mesh, vertices, Filter(alpha, max_edge_length));
  std::uint32_t region = 0;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.label(t) != kKeptUnlabelled) continue;
    flood(mesh, t, region, boundaries.half_edges, stack);
    boundaries.ends.push_back(static_cast<std::uint32_t>(boundaries.half_edges.size()));
    ++region;
  }
}

}  // namespace polylidar::detail
