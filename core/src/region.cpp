#include "region.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

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

/// Says in words [begin, end) of `kept` which triangles are kept.
template <bool kLimitRadius, bool kLimitEdge>
void filter(const Mesh& mesh, const Point* vertices, const Limits& limits, std::size_t begin, std::size_t end,
            std::uint64_t* kept) {
  const auto is_kept = [&](Mesh::Index t) {
    const Mesh::Index e = Mesh::kStride * t;
    return !mesh.is_ghost(t) &&
           keeps<kLimitRadius, kLimitEdge>(limits, vertices[mesh.origin(e)], vertices[mesh.origin(e + 1)],
                                           vertices[mesh.origin(e + 2)]);
  };
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    const Mesh::Index count = std::min(Mesh::kWordBits, mesh.triangle_count() - first);
    std::uint64_t word = 0;
    for (Mesh::Index k = 0; k < count; ++k) word |= std::uint64_t{is_kept(first + k)} << k;
    kept[w] = word;
  }
}

/// Appends the half-edges of kept triangles on whose other side is a triangle in words [begin, end) of `kept`
/// that is not: every boundary edge has one, and these are few.
void collect_boundary(const Mesh& mesh, std::size_t begin, std::size_t end, const std::uint64_t* kept,
                      std::vector<Mesh::Index>& boundary) {
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    for (std::uint64_t dropped = ~kept[w]; dropped != 0; dropped &= dropped - 1) {
      const Mesh::Index t = first + static_cast<Mesh::Index>(std::countr_zero(dropped));
      if (t >= mesh.triangle_count()) break;
      if (mesh.is_unused(t)) continue;
      for (Mesh::Index k = 0; k < 3; ++k) {
        const Mesh::Index e = mesh.twin(Mesh::kStride * t + k);
        if (mesh.is_kept(Mesh::triangle_of(e))) boundary.push_back(e);
      }
    }
  }
}

}  // namespace

void RegionFilter::run(Mesh& mesh, const Point* vertices, double alpha, double max_edge_length,
                       ThreadPool& pool, std::vector<Index>& boundary) {
  const Limits limits{4 * alpha * alpha, max_edge_length * max_edge_length};
  const bool limit_radius = std::isfinite(alpha);
  const bool limit_edge = std::isfinite(max_edge_length);
  const auto filter_words = limit_radius ? (limit_edge ? &filter<true, true> : &filter<true, false>)
                                         : (limit_edge ? &filter<false, true> : &filter<false, false>);
  std::uint64_t* kept = mesh.reserve_kept();
  const Chunks chunks(pool, mesh.triangle_count());
  // Chunks of whole words, so that no two threads write to one.
  const auto for_each_chunk = [&](const auto& task) {
    pool.for_each(chunks.size(), [&](std::size_t c) {
      task(c, chunks.begin(c) / Mesh::kWordBits,
           c + 1 == chunks.size() ? mesh.word_count() : chunks.end(c) / Mesh::kWordBits);
    });
  };
  for_each_chunk([&](std::size_t, std::size_t begin, std::size_t end) {
    filter_words(mesh, vertices, limits, begin, end, kept);
  });
  boundary_of_chunk_.resize(std::max(boundary_of_chunk_.size(), chunks.size() - 1));
  for_each_chunk([&](std::size_t c, std::size_t begin, std::size_t end) {
    std::vector<Index>& own = c == 0 ? boundary : boundary_of_chunk_[c - 1];
    own.clear();
    collect_boundary(mesh, begin, end, kept, own);
  });
  for (std::size_t c = 1; c < chunks.size(); ++c) {
    const std::vector<Index>& part = boundary_of_chunk_[c - 1];
    boundary.insert(boundary.end(), part.begin(), part.end());
  }
}

}  // namespace polylidar::detail
