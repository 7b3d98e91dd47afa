#include "region.hpp"

#include <algorithm>
#include <atomic>

#include "kept_words.hpp"

namespace polylidar::detail {

namespace {

/// The triangles that keep to all `rules`.
template <class... Rules>
void filter(const Mesh& mesh, const Point* vertices, std::size_t begin, std::size_t end, std::uint64_t* kept,
            const Rules&... rules) {
  fill_words(mesh, begin, end, kept, [&](Mesh::Index t) {
    return !mesh.is_ghost(t) && (rules.keeps(Triangle(mesh, vertices, t)) && ...);
  });
}

/// The triangles none of whose corners `is_tested`, and of the others those that keep to all `rules`. Returns
/// whether rounding decided nothing.
template <class... Rules>
bool filter_part(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested, std::size_t begin,
                 std::size_t end, std::uint64_t* kept, const Rules&... rules) {
  bool agree = true;
  fill_words(mesh, begin, end, kept, [&](Mesh::Index t) {
    if (mesh.is_ghost(t)) return false;
    if (!has_marked_corner(mesh, t, is_tested)) return true;
    const Answer answer = ask_from_all_corners(
        mesh, vertices, t, [&](const Triangle& triangle) { return (rules.keeps(triangle) && ...); });
    agree &= answer != Answer::kRoundingDecides;
    return answer != Answer::kNo;
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

}  // namespace

void RegionFilter::run(Mesh& mesh, const Point* vertices, const FilterRules& rules, bool fill_single,
                       ThreadPool& pool, std::vector<Index>& boundary) {
  std::uint64_t* kept = mesh.reserve_kept();
  for_each_word_chunk(mesh, Chunks(pool, mesh.triangle_count()), pool,
                      [&](std::size_t, std::size_t begin, std::size_t end) {
                        const auto filter_by = [&](const auto&... each) {
                          filter(mesh, vertices, begin, end, kept, each...);
                        };
                        std::apply([&](const auto&... choice) { std::visit(filter_by, choice...); }, rules);
                      });
  find_boundary(mesh, fill_single, pool, kept, boundary);
}

std::optional<Way> RegionFilter::run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                             const FilterRules& rules, bool fill_single, ThreadPool& pool,
                                             std::vector<Index>& boundary) {
  std::uint64_t* kept = mesh.reserve_kept();
  std::atomic<bool> agree = true;
  for_each_word_chunk(mesh, Chunks(pool, mesh.triangle_count()), pool,
                      [&](std::size_t, std::size_t begin, std::size_t end) {
                        const auto filter_by = [&](const auto&... each) {
                          if (!filter_part(mesh, vertices, is_tested, begin, end, kept, each...))
                            agree = false;
                        };
                        std::apply([&](const auto&... choice) { std::visit(filter_by, choice...); }, rules);
                      });
  if (!agree) return Way::kRoundingDecides;
  find_boundary(mesh, fill_single, pool, kept, boundary);
  return std::nullopt;
}

bool RegionFilter::run(Mesh& mesh, const Point* vertices, const SizeField& field, bool fill_single,
                       ThreadPool& pool, std::vector<Index>& boundary) {
  std::uint64_t* kept = mesh.reserve_kept();
  const bool by_outlines = field.outlines && outline_fill_.run(mesh, vertices, *field.outlines, kept);
  if (!by_outlines) size_filter_.run(mesh, vertices, field, pool, kept);
  find_boundary(mesh, fill_single, pool, kept, boundary);
  return by_outlines;
}

std::optional<Way> RegionFilter::run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                                             const SizeField& field, const SizeFilter::IsSure& is_sure,
                                             bool fill_single, ThreadPool& pool,
                                             std::vector<Index>& boundary) {
  std::uint64_t* kept = mesh.reserve_kept();
  const std::optional<Way> doubt =
      size_filter_.run_on_part(mesh, vertices, is_tested, field, is_sure, pool, kept);
  if (!doubt) find_boundary(mesh, fill_single, pool, kept, boundary);
  return doubt;
}

void RegionFilter::find_boundary(Mesh& mesh, bool fill_single, ThreadPool& pool, std::uint64_t* kept,
                                 std::vector<Index>& boundary) {
  const Chunks chunks(pool, mesh.triangle_count());
  boundary_of_chunk_.resize(std::max(boundary_of_chunk_.size(), chunks.size() - 1));
  filled_of_chunk_.resize(std::max(filled_of_chunk_.size(), chunks.size()));
  for (std::vector<Index>& part : boundary_of_chunk_) part.clear();
  for (std::vector<Index>& filled : filled_of_chunk_) filled.clear();
  boundary.clear();
  for_each_word_chunk(mesh, chunks, pool, [&](std::size_t c, std::size_t begin, std::size_t end) {
    const auto collect = fill_single ? &collect_boundary<true> : &collect_boundary<false>;
    collect(mesh, begin, end, kept, c == 0 ? boundary : boundary_of_chunk_[c - 1], filled_of_chunk_[c]);
  });
  // Not before all threads have read which triangles are kept.
  for (const std::vector<Index>& filled : filled_of_chunk_) {
    for (const Index t : filled) keep(kept, t);
  }
  for (const std::vector<Index>& part : boundary_of_chunk_) {
    boundary.insert(boundary.end(), part.begin(), part.end());
  }
}

}  // namespace polylidar::detail
