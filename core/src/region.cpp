#include "region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polylidar::detail {

namespace {

double squared_distance(const Point& a, const Point& b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  return dx * dx + dy * dy;
}

struct Limits {
  double four_squared_alpha;
  double squared_max_edge;
};

/// circumradius = |ab| |bc| |ca| / (2 cross), with cross twice the area: compared squared and without
/// division, so that a triangle that is flat up to rounding counts as infinitely large instead of giving NaN.
template <bool kLimitRadius, bool kLimitEdge>
bool keeps(const Limits& limits, const Point& a, const Point& b, const Point& c) {
  const double ab = squared_distance(a, b);
  const double bc = squared_distance(b, c);
  const double ca = squared_distance(c, a);
  bool kept = true;
  if constexpr (kLimitEdge) kept = std::max({ab, bc, ca}) <= limits.squared_max_edge;
  if constexpr (kLimitRadius) {
    const double cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    kept = kept && ab * bc * ca <= limits.four_squared_alpha * (cross * cross);
  }
  return kept;
}

/// Marks every triangle as kept or not; returns how many are not, which `dropped` then lists.
template <bool kLimitRadius, bool kLimitEdge>
std::size_t filter(Mesh& mesh, const Point* vertices, const Limits& limits, Mesh::Index* dropped) {
  std::size_t count = 0;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    const Mesh::Index e = Mesh::kStride * t;
    const bool kept = !mesh.is_ghost(t) && keeps<kLimitRadius, kLimitEdge>(limits, vertices[mesh.origin(e)],
                                                                           vertices[mesh.origin(e + 1)],
                                                                           vertices[mesh.origin(e + 2)]);
    mesh.state(t) = kept ? Mesh::kKept : 0;
    dropped[count] = t;  // overwritten by the next one if this one is kept: no branch to mispredict
    count += kept ? 0 : 1;
  }
  return count;
}

}  // namespace

void extract_regions(Mesh& mesh, const Point* vertices, double alpha, double max_edge_length,
                     Scratch<Mesh::Index>& dropped, std::vector<Mesh::Index>& boundary) {
  const Limits limits{4 * alpha * alpha, max_edge_length * max_edge_length};
  const bool limit_radius = std::isfinite(alpha);
  const bool limit_edge = std::isfinite(max_edge_length);
  const auto run = limit_radius ? (limit_edge ? &filter<true, true> : &filter<true, false>)
                                : (limit_edge ? &filter<false, true> : &filter<false, false>);
  Mesh::Index* list = dropped.reserve(mesh.triangle_count());
  const std::size_t count = run(mesh, vertices, limits, list);

  // Every boundary edge has a dropped triangle on its other side, and these are few.
  boundary.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const Mesh::Index t = list[i];
    if (mesh.is_unused(t)) continue;
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index e = mesh.twin(Mesh::kStride * t + k);
      if ((mesh.state(Mesh::triangle_of(e)) & Mesh::kKept) != 0) boundary.push_back(e);
    }
  }
}

}  // namespace polylidar::detail
