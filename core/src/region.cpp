#include "region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

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

/// Marks the triangles [begin, end) as kept or not; returns how many are not, which `dropped` then lists.
template <bool kLimitRadius, bool kLimitEdge>
std::size_t filter(Mesh& mesh, const Point* vertices, const Limits& limits, Mesh::Index begin,
                   Mesh::Index end, Mesh::Index* dropped) {
  std::size_t count = 0;
  for (Mesh::Index t = begin; t < end; ++t) {
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

/// Appends the half-edges of kept triangles on whose other side is one of `dropped`.
void collect_boundary(const Mesh& mesh, std::span<const Mesh::Index> dropped,
                      std::vector<Mesh::Index>& boundary) {
  for (const Mesh::Index t : dropped) {
    if (mesh.is_unused(t)) continue;
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index e = mesh.twin(Mesh::kStride * t + k);
      if ((mesh.state(Mesh::triangle_of(e)) & Mesh::kKept) != 0) boundary.push_back(e);
    }
  }
}

}  // namespace

void RegionFilter::run(Mesh& mesh, const Point* vertices, double alpha, double max_edge_length,
                       ThreadPool& pool, std::vector<Index>& boundary) {
  const Limits limits{4 * alpha * alpha, max_edge_length * max_edge_length};
  const bool limit_radius = std::isfinite(alpha);
  const bool limit_edge = std::isfinite(max_edge_length);
  const auto filter_range = limit_radius ? (limit_edge ? &filter<true, true> : &filter<true, false>)
                                         : (limit_edge ? &filter<false, true> : &filter<false, false>);
  const Chunks chunks(pool, mesh.triangle_count());
  Index* dropped = dropped_.reserve(mesh.triangle_count());
  std::vector<std::size_t> dropped_of_chunk(chunks.size());
  pool.for_each(chunks.size(), [&](std::size_t c) {
    const std::size_t begin = chunks.begin(c);
    dropped_of_chunk[c] = filter_range(mesh, vertices, limits, static_cast<Index>(begin),
                                       static_cast<Index>(chunks.end(c)), dropped + begin);
  });

  // Every boundary edge has a dropped triangle on its other side, and these are few.
  boundary_of_chunk_.resize(std::max(boundary_of_chunk_.size(), chunks.size() - 1));
  pool.for_each(chunks.size(), [&](std::size_t c) {
    std::vector<Index>& own = c == 0 ? boundary : boundary_of_chunk_[c - 1];
    own.clear();
    collect_boundary(mesh, {dropped + chunks.begin(c), dropped_of_chunk[c]}, own);
  });
  for (std::size_t c = 1; c < chunks.size(); ++c) {
    const std::vector<Index>& part = boundary_of_chunk_[c - 1];
    boundary.insert(boundary.end(), part.begin(), part.end());
  }
}

}  // namespace polylidar::detail
