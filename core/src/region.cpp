#include "region.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace polylidar::detail {

namespace {

double squared_distance(const Point& a, const Point& b) {
  const double dx = a.x - b.x;
  const double dy = a.y - b.y;
  return dx * dx + dy * dy;
}

/// The limits as triangles are compared with them.
struct Bounds {
  double four_squared_alpha;
  double squared_max_edge;
  double max_perimeter;
  double squared_max_perimeter;
};

/// Of squared edges. A perimeter is more than two and at most three longest edges, which decides for nearly
/// all triangles without a root.
bool is_perimeter_within(const Bounds& bounds, double ab, double bc, double ca, double longest) {
  if (9 * longest <= bounds.squared_max_perimeter) return true;
  if (4 * longest > bounds.squared_max_perimeter) return false;
  return std::sqrt(ab) + std::sqrt(bc) + std::sqrt(ca) <= bounds.max_perimeter;
}

/// circumradius = |ab| |bc| |ca| / (2 cross), with cross twice the area: compared squared and without
/// division, so that a triangle that is flat up to rounding counts as infinitely large instead of giving NaN.
template <bool kLimitRadius, bool kLimitEdge, bool kLimitPerimeter>
bool keeps(const Bounds& bounds, const Point& a, const Point& b, const Point& c) {
  const double ab = squared_distance(a, b);
  const double bc = squared_distance(b, c);
  const double ca = squared_distance(c, a);
  bool kept = true;
  if constexpr (kLimitEdge) kept = std::max({ab, bc, ca}) <= bounds.squared_max_edge;
  if constexpr (kLimitPerimeter) {
    kept = kept && is_perimeter_within(bounds, ab, bc, ca, std::max({ab, bc, ca}));
  }
  if constexpr (kLimitRadius) {
    const double cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    kept = kept && ab * bc * ca <= bounds.four_squared_alpha * (cross * cross);
  }
  return kept;
}

/// Says in words [begin, end) of `kept` which triangles are kept.
template <bool kLimitRadius, bool kLimitEdge, bool kLimitPerimeter>
void filter(const Mesh& mesh, const Point* vertices, const Bounds& bounds, std::size_t begin, std::size_t end,
            std::uint64_t* kept) {
  const auto is_kept = [&](Mesh::Index t) {
    const Mesh::Index e = Mesh::kStride * t;
    return !mesh.is_ghost(t) &&
           keeps<kLimitRadius, kLimitEdge, kLimitPerimeter>(
               bounds, vertices[mesh.origin(e)], vertices[mesh.origin(e + 1)], vertices[mesh.origin(e + 2)]);
  };
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    const Mesh::Index count = std::min(Mesh::kWordBits, mesh.triangle_count() - first);
    std::uint64_t word = 0;
    for (Mesh::Index k = 0; k < count; ++k) word |= std::uint64_t{is_kept(first + k)} << k;
    kept[w] = word;
  }
}

/// The same where a perimeter is all that is limited and is known in single precision, which decides but for
/// words in which one is near the limit.
void filter_perimeters(const Mesh& mesh, const Point* vertices, const Bounds& bounds,
                       std::span<const float> perimeters, std::size_t begin, std::size_t end,
                       std::uint64_t* kept) {
  constexpr double kNear = 0x1p-20;  // a few roundings of 2^-24
  const auto surely = static_cast<float>(bounds.max_perimeter * (1 - kNear));
  const auto perhaps = static_cast<float>(bounds.max_perimeter * (1 + kNear));
  for (std::size_t w = begin; w < end; ++w) {
    const float* const perimeter = perimeters.data() + Mesh::kWordBits * w;
    const std::size_t count = std::min<std::size_t>(Mesh::kWordBits, perimeters.size() - Mesh::kWordBits * w);
    std::uint64_t word = 0;
    std::uint64_t near = 0;
    for (std::size_t k = count; k > 0; --k) {
      const std::uint64_t is_within = perimeter[k - 1] <= surely ? 1U : 0U;
      near += (perimeter[k - 1] <= perhaps ? 1U : 0U) - is_within;
      word = 2 * word + is_within;
    }
    kept[w] = word;
    if (near > 0) filter<false, false, true>(mesh, vertices, bounds, w, w + 1, kept);
  }
}

/// The filter that tests the limits there are.
auto filter_for(const Limits& limits) {
  constexpr std::array kFilters{&filter<false, false, false>, &filter<true, false, false>,
                                &filter<false, true, false>,  &filter<true, true, false>,
                                &filter<false, false, true>,  &filter<true, false, true>,
                                &filter<false, true, true>,   &filter<true, true, true>};
  return kFilters[(limits.alpha == kNoLimit ? 0U : 1U) + (limits.max_edge_length == kNoLimit ? 0U : 2U) +
                  (limits.max_perimeter == kNoLimit ? 0U : 4U)];
}

/// Appends to `boundary` the half-edges of kept triangles on whose other side is a triangle in words [begin,
/// end) of `kept` that is not: every boundary edge has one, and these are few. With `kFillSingle` the
/// triangles that are dropped while their neighbours are kept go to `filled` instead; no two of them are
/// neighbours, and a ghost, which has ghosts for neighbours, is none.
template <bool kFillSingle>
void collect_boundary(const Mesh& mesh, std::size_t begin, std::size_t end, const std::uint64_t* kept,
                      std::vector<Mesh::Index>& boundary, std::vector<Mesh::Index>& filled) {
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    for (std::uint64_t dropped = ~kept[w]; dropped != 0; dropped &= dropped - 1) {
      const Mesh::Index t = first + static_cast<Mesh::Index>(std::countr_zero(dropped));
      if (t >= mesh.triangle_count()) break;
      if (mesh.is_unused(t)) continue;
      [[maybe_unused]] const std::size_t before = kFillSingle ? boundary.size() : 0;
      for (Mesh::Index k = 0; k < 3; ++k) {
        const Mesh::Index e = mesh.twin(Mesh::kStride * t + k);
        if (mesh.is_kept(Mesh::triangle_of(e))) boundary.push_back(e);
      }
      if constexpr (kFillSingle) {
        if (boundary.size() != before + 3) continue;
        boundary.resize(before);
        filled.push_back(t);
      }
    }
  }
}

}  // namespace

void RegionFilter::run(Mesh& mesh, const Point* vertices, const Limits& limits,
                       std::span<const float> perimeters, bool fill_single, ThreadPool& pool,
                       std::vector<Index>& boundary) {
  const Bounds bounds{4 * limits.alpha * limits.alpha, limits.max_edge_length * limits.max_edge_length,
                      limits.max_perimeter, limits.max_perimeter * limits.max_perimeter};
  const auto filter_words = filter_for(limits);
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
    if (perimeters.empty()) {
      filter_words(mesh, vertices, bounds, begin, end, kept);
    } else {
      filter_perimeters(mesh, vertices, bounds, perimeters, begin, end, kept);
    }
  });
  boundary_of_chunk_.resize(std::max(boundary_of_chunk_.size(), chunks.size() - 1));
  filled_of_chunk_.resize(std::max(filled_of_chunk_.size(), chunks.size()));
  for_each_chunk([&](std::size_t c, std::size_t begin, std::size_t end) {
    std::vector<Index>& own = c == 0 ? boundary : boundary_of_chunk_[c - 1];
    own.clear();
    filled_of_chunk_[c].clear();
    const auto collect = fill_single ? &collect_boundary<true> : &collect_boundary<false>;
    collect(mesh, begin, end, kept, own, filled_of_chunk_[c]);
  });
  // Not before all threads have read which triangles are kept.
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    for (const Index t : filled_of_chunk_[c]) {
      kept[t / Mesh::kWordBits] |= std::uint64_t{1} << (t % Mesh::kWordBits);
    }
  }
  for (std::size_t c = 1; c < chunks.size(); ++c) {
    const std::vector<Index>& part = boundary_of_chunk_[c - 1];
    boundary.insert(boundary.end(), part.begin(), part.end());
  }
}

}  // namespace polylidar::detail
