#include "region.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

namespace polylidar::detail {

namespace {

/// Says in words [begin, end) of `kept` which triangles `is_kept`.
template <class IsKept>
void fill_words(const Mesh& mesh, std::size_t begin, std::size_t end, std::uint64_t* kept,
                const IsKept& is_kept) {
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    const Mesh::Index count = std::min(Mesh::kWordBits, mesh.triangle_count() - first);
    std::uint64_t word = 0;
    for (Mesh::Index k = 0; k < count; ++k) word |= std::uint64_t{is_kept(first + k)} << k;
    kept[w] = word;
  }
}

/// The triangles that keep to all `rules`.
template <class... Rules>
void filter(const Mesh& mesh, const Point* vertices, std::size_t begin, std::size_t end, std::uint64_t* kept,
            const Rules&... rules) {
  fill_words(mesh, begin, end, kept, [&](Mesh::Index t) {
    return !mesh.is_ghost(t) && (rules.keeps(Triangle(mesh, vertices, t)) && ...);
  });
}

/// The triangles none of whose corners `is_tested`, and of the others those that keep to all `rules`. Returns
/// whether all of those do, or do not, from whichever corner the rules' arithmetic starts.
template <class... Rules>
bool filter_part(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested, std::size_t begin,
                 std::size_t end, std::uint64_t* kept, const Rules&... rules) {
  Mesh turned;  // one triangle
  turned.reset(2);
  bool agree = true;
  fill_words(mesh, begin, end, kept, [&](Mesh::Index t) {
    if (mesh.is_ghost(t)) return false;
    const Mesh::Index* corner = &mesh.memory()[Mesh::kStride * t];
    if ((is_tested[corner[0]] | is_tested[corner[1]] | is_tested[corner[2]]) == 0) return true;
    unsigned votes = 0;
    for (Mesh::Index first = 0; first < 3; ++first) {
      for (Mesh::Index k = 0; k < 3; ++k) turned.origin(k) = corner[(first + k) % 3];
      votes += (rules.keeps(Triangle(turned, vertices, 0)) && ...) ? 1U : 0U;
    }
    agree &= votes == 0 || votes == 3;
    return votes != 0;
  });
  return agree;
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

void RegionFilter::run(Mesh& mesh, const Point* vertices, const FilterRules& rules, bool fill_single,
                       ThreadPool& pool, std::vector<Index>& boundary) {
  select(mesh, fill_single, pool, boundary, [&](std::size_t begin, std::size_t end, std::uint64_t* kept) {
    const auto filter_by = [&](const auto&... each) { filter(mesh, vertices, begin, end, kept, each...); };
    std::apply([&](const auto&... choice) { std::visit(filter_by, choice...); }, rules);
  });
}

bool RegionFilter::run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                               const FilterRules& rules, bool fill_single, ThreadPool& pool,
                               std::vector<Index>& boundary) {
  std::atomic<bool> agree = true;
  select(mesh, fill_single, pool, boundary, [&](std::size_t begin, std::size_t end, std::uint64_t* kept) {
    const auto filter_by = [&](const auto&... each) {
      if (!filter_part(mesh, vertices, is_tested, begin, end, kept, each...)) agree = false;
    };
    std::apply([&](const auto&... choice) { std::visit(filter_by, choice...); }, rules);
  });
  return agree;
}

/// Lets `filter_words` say which triangles are kept and collects their boundary.
template <class FilterWords>
void RegionFilter::select(Mesh& mesh, bool fill_single, ThreadPool& pool, std::vector<Index>& boundary,
                          const FilterWords& filter_words) {
  std::uint64_t* kept = mesh.reserve_kept();
  const Chunks chunks(pool, mesh.triangle_count());
  // Chunks of whole words, so that no two threads write to one.
  const auto for_each_chunk = [&](const auto& task) {
    pool.for_each(chunks.size(), [&](std::size_t c) {
      task(c, chunks.begin(c) / Mesh::kWordBits,
           c + 1 == chunks.size() ? mesh.word_count() : chunks.end(c) / Mesh::kWordBits);
    });
  };
  for_each_chunk([&](std::size_t, std::size_t begin, std::size_t end) { filter_words(begin, end, kept); });
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
