#include "region.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <limits>

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

std::uint64_t bit_of(Mesh::Index t) {
  return std::uint64_t{1} << (t % Mesh::kWordBits);
}

/// Calls visit(t) for every triangle, ghosts included, in words [begin, end) of `kept` that is not kept.
template <class Visit>
void for_each_dropped(const Mesh& mesh, std::size_t begin, std::size_t end, const std::uint64_t* kept,
                      const Visit& visit) {
  for (std::size_t w = begin; w < end; ++w) {
    const auto first = static_cast<Mesh::Index>(Mesh::kWordBits * w);
    for (std::uint64_t dropped = ~kept[w]; dropped != 0; dropped &= dropped - 1) {
      const Mesh::Index t = first + static_cast<Mesh::Index>(std::countr_zero(dropped));
      if (t >= mesh.triangle_count()) break;
      if (!mesh.is_unused(t)) visit(t);
    }
  }
}

/// Triangles that were met on a walk.
class SeenTriangles {
 public:
  SeenTriangles(const Mesh& mesh, Scratch<std::uint64_t>& storage)
      : words_(storage.reserve(mesh.word_count())) {
    std::fill_n(words_, mesh.word_count(), 0);
  }
  bool contain(Mesh::Index t) const { return (words_[t / Mesh::kWordBits] & bit_of(t)) != 0; }
  /// Returns whether `t` is new.
  bool add(Mesh::Index t) {
    const bool is_new = !contain(t);
    words_[t / Mesh::kWordBits] |= bit_of(t);
    return is_new;
  }

 private:
  std::uint64_t* words_;
};

/// Appends to `boundary` the half-edges of kept triangles on whose other side is a triangle in words [begin,
/// end) of `kept` that is not: every boundary edge has one, and these are few. With `kFillSingle` the
/// triangles that are dropped while their neighbours are kept go to `filled` instead; no two of them are
/// neighbours, and a ghost, which has ghosts for neighbours, is none.
template <bool kFillSingle>
void collect_boundary(const Mesh& mesh, std::size_t begin, std::size_t end, const std::uint64_t* kept,
                      std::vector<Mesh::Index>& boundary, std::vector<Mesh::Index>& filled) {
  for_each_dropped(mesh, begin, end, kept, [&](Mesh::Index t) {
    [[maybe_unused]] const std::size_t before = kFillSingle ? boundary.size() : 0;
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index e = mesh.twin(Mesh::kStride * t + k);
      if (mesh.is_kept(Mesh::triangle_of(e))) boundary.push_back(e);
    }
    if constexpr (kFillSingle) {
      if (boundary.size() != before + 3) return;
      boundary.resize(before);
      filled.push_back(t);
    }
  });
}

/// Whether kept triangle `t` stands out of the shape at an acute angle: at least two of its neighbours are
/// dropped.
bool is_spike(const Mesh& mesh, const Point* vertices, Mesh::Index t) {
  Mesh::Index dropped = 0;
  Mesh::Index base = 0;  // the half-edge that is not on the border
  for (Mesh::Index k = 0; k < 3; ++k) {
    if (mesh.is_kept(Mesh::triangle_of(mesh.twin(Mesh::kStride * t + k)))) {
      base = Mesh::kStride * t + k;
    } else {
      ++dropped;
    }
  }
  if (dropped != 2) return dropped == 3;
  const Point& apex = vertices[mesh.origin(Mesh::previous(base))];
  const Vector to_start = vertices[mesh.origin(base)] - apex;
  const Vector to_end = vertices[mesh.origin(Mesh::next(base))] - apex;
  return dot(to_start, to_end) > 0;
}

/// Appends to `spikes` those of the kept triangles that have a dropped neighbour in words [begin, end); some
/// of them more than once.
void collect_spikes(const Mesh& mesh, const Point* vertices, const SizeField& field, std::size_t begin,
                    std::size_t end, const std::uint64_t* kept, std::vector<Mesh::Index>& spikes) {
  for_each_dropped(mesh, begin, end, kept, [&](Mesh::Index t) {
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index other = Mesh::triangle_of(mesh.twin(Mesh::kStride * t + k));
      if (mesh.is_kept(other) && is_spike(mesh, vertices, other) &&
          Triangle(mesh, vertices, other).size4() > field.spike_share * field.limit4[field.block_of(other)]) {
        spikes.push_back(other);
      }
    }
  });
}

}  // namespace

/// task(chunk, begin, end) for chunks of whole words, so that no two threads write to one.
template <class Task>
void RegionFilter::for_each_chunk(const Mesh& mesh, ThreadPool& pool, const Task& task) {
  const Chunks chunks(pool, mesh.triangle_count());
  boundary_of_chunk_.resize(std::max(boundary_of_chunk_.size(), chunks.size() - 1));
  found_of_chunk_.resize(std::max(found_of_chunk_.size(), chunks.size()));
  pool.for_each(chunks.size(), [&](std::size_t c) {
    task(c, chunks.begin(c) / Mesh::kWordBits,
         c + 1 == chunks.size() ? mesh.word_count() : chunks.end(c) / Mesh::kWordBits);
  });
}

void RegionFilter::run(Mesh& mesh, const Point* vertices, const FilterRules& rules, bool fill_single,
                       ThreadPool& pool, std::vector<Index>& boundary) {
  std::uint64_t* kept = mesh.reserve_kept();
  for_each_chunk(mesh, pool, [&](std::size_t, std::size_t begin, std::size_t end) {
    const auto filter_by = [&](const auto&... each) { filter(mesh, vertices, begin, end, kept, each...); };
    std::apply([&](const auto&... choice) { std::visit(filter_by, choice...); }, rules);
  });
  find_boundary(mesh, fill_single, pool, kept, boundary);
}

bool RegionFilter::run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                               const FilterRules& rules, bool fill_single, ThreadPool& pool,
                               std::vector<Index>& boundary) {
  std::uint64_t* kept = mesh.reserve_kept();
  std::atomic<bool> agree = true;
  for_each_chunk(mesh, pool, [&](std::size_t, std::size_t begin, std::size_t end) {
    const auto filter_by = [&](const auto&... each) {
      if (!filter_part(mesh, vertices, is_tested, begin, end, kept, each...)) agree = false;
    };
    std::apply([&](const auto&... choice) { std::visit(filter_by, choice...); }, rules);
  });
  find_boundary(mesh, fill_single, pool, kept, boundary);
  return agree;
}

void RegionFilter::run(Mesh& mesh, const Point* vertices, const SizeField& field, bool fill_single,
                       ThreadPool& pool, std::vector<Index>& boundary) {
  std::uint64_t* kept = mesh.reserve_kept();
  for_each_chunk(mesh, pool, [&](std::size_t, std::size_t begin, std::size_t end) {
    filter(mesh, vertices, begin, end, kept, SizeRule(field));
  });
  drop_spikes(mesh, vertices, field, pool, kept);
  if (field.least_part > 0) drop_small_parts(mesh, field.least_part, kept);
  if (field.least_hole > 0) fill_small_holes(mesh, vertices, field, kept);
  find_boundary(mesh, fill_single, pool, kept, boundary);
}

void RegionFilter::drop_spikes(Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
                               std::uint64_t* kept) {
  for (std::vector<Index>& found : found_of_chunk_) found.clear();
  for_each_chunk(mesh, pool, [&](std::size_t c, std::size_t begin, std::size_t end) {
    collect_spikes(mesh, vertices, field, begin, end, kept, found_of_chunk_[c]);
  });
  // Not before all threads have read which triangles are kept.
  for (const std::vector<Index>& found : found_of_chunk_) {
    for (const Index t : found) kept[t / Mesh::kWordBits] &= ~bit_of(t);
  }
}

/// From every triangle on the border the region is walked through until it is large enough, meets triangles
/// that are known to be of a large one, or ends.
void RegionFilter::drop_small_parts(const Mesh& mesh, std::size_t least_part, std::uint64_t* kept) {
  SeenTriangles seen(mesh, seen_);
  std::vector<Index>& small = found_of_chunk_[0];
  small.clear();
  for_each_dropped(mesh, 0, mesh.word_count(), kept, [&](Index dropped) {
    for (Index k = 0; k < 3; ++k) {
      const Index start = Mesh::triangle_of(mesh.twin(Mesh::kStride * dropped + k));
      if (!mesh.is_kept(start) || !seen.add(start)) continue;
      group_.assign(1, start);
      bool is_large = false;
      for (std::size_t next = 0; next < group_.size() && !is_large; ++next) {
        for (Index j = 0; j < 3; ++j) {
          const Index other = Mesh::triangle_of(mesh.twin(Mesh::kStride * group_[next] + j));
          if (!mesh.is_kept(other)) continue;
          if (seen.add(other)) {
            group_.push_back(other);
          } else if (std::find(group_.begin(), group_.end(), other) == group_.end()) {
            is_large = true;
          }
        }
        is_large |= group_.size() >= least_part;
      }
      if (!is_large) small.insert(small.end(), group_.begin(), group_.end());
    }
  });
  // Where all parts are small there is nothing that they are small beside.
  std::size_t count = 0;
  for (std::size_t w = 0; w < mesh.word_count(); ++w)
    count += static_cast<std::size_t>(std::popcount(kept[w]));
  if (small.size() == count) return;
  for (const Index t : small) kept[t / Mesh::kWordBits] &= ~bit_of(t);
}

void RegionFilter::fill_small_holes(const Mesh& mesh, const Point* vertices, const SizeField& field,
                                    std::uint64_t* kept) {
  SeenTriangles seen(mesh, seen_);
  std::vector<Index>& small = found_of_chunk_[0];
  small.clear();
  for_each_dropped(mesh, 0, mesh.word_count(), kept, [&](Index start) {
    if (mesh.is_ghost(start) || !seen.add(start)) return;
    group_.assign(1, start);
    double twice_area = 0;
    double squared_sizes = 0;  // of the kept triangles along its border
    std::size_t border = 0;
    for (std::size_t next = 0; next < group_.size(); ++next) {
      const Index t = group_[next];
      twice_area += Triangle(mesh, vertices, t).twice_area();
      for (Index j = 0; j < 3; ++j) {
        const Index other = Mesh::triangle_of(mesh.twin(Mesh::kStride * t + j));
        if (mesh.is_kept(other)) {
          squared_sizes += std::sqrt(Triangle(mesh, vertices, other).size4());
          ++border;
        } else if (mesh.is_ghost(other)) {
          twice_area = std::numeric_limits<double>::infinity();
        } else if (seen.add(other)) {
          group_.push_back(other);
        }
      }
    }
    if (twice_area * static_cast<double>(border) < field.least_hole * squared_sizes) {
      small.insert(small.end(), group_.begin(), group_.end());
    }
  });
  for (const Index t : small) kept[t / Mesh::kWordBits] |= bit_of(t);
}

void RegionFilter::find_boundary(Mesh& mesh, bool fill_single, ThreadPool& pool, std::uint64_t* kept,
                                 std::vector<Index>& boundary) {
  for (std::vector<Index>& part : boundary_of_chunk_) part.clear();
  for (std::vector<Index>& found : found_of_chunk_) found.clear();
  boundary.clear();
  for_each_chunk(mesh, pool, [&](std::size_t c, std::size_t begin, std::size_t end) {
    const auto collect = fill_single ? &collect_boundary<true> : &collect_boundary<false>;
    collect(mesh, begin, end, kept, c == 0 ? boundary : boundary_of_chunk_[c - 1], found_of_chunk_[c]);
  });
  // Not before all threads have read which triangles are kept.
  for (const std::vector<Index>& found : found_of_chunk_) {
    for (const Index t : found) kept[t / Mesh::kWordBits] |= bit_of(t);
  }
  for (const std::vector<Index>& part : boundary_of_chunk_) {
    boundary.insert(boundary.end(), part.begin(), part.end());
  }
}

}  // namespace polylidar::detail
