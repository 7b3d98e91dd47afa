// Which triangles belong to the shape, and where the shape ends.
#pragma once

#include <cstdint>
#include <vector>

#include "filter_rules.hpp"
#include "half_edge.hpp"
#include "size_field.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Selects triangles, keeping its memory between calls.
class RegionFilter {
 public:
  using Index = Mesh::Index;

  /// Keeps the finite triangles of `mesh` that keep to `rules` and, if `fill_single` says so, those whose
  /// three neighbours do. Puts into `boundary` the half-edges of kept triangles whose twin is not kept, in
  /// the same order whatever the number of threads. Can be called again with other rules.
  void run(Mesh& mesh, const Point* vertices, const FilterRules& rules, bool fill_single, ThreadPool& pool,
           std::vector<Index>& boundary);

  /// The same where only triangles with a tested corner are asked for the rules, and all others are kept.
  /// `is_tested`: vertex of the mesh -> whether. Returns false where rounding decides: where a rule would
  /// answer otherwise if a triangle's corners were given in another order; then nothing that came out of it
  /// is to be used.
  bool run_on_part(Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested, const FilterRules& rules,
                   bool fill_single, ThreadPool& pool, std::vector<Index>& boundary);

  /// As run with a limit that varies by place. Where a kept triangle stands out of the shape, with two
  /// edges on its border that meet at an acute angle, and is no smaller than a spike, it is dropped: outliers
  /// and noise make such triangles. One pass; then regions and holes that are too small go, before
  /// `fill_single`.
  void run(Mesh& mesh, const Point* vertices, const SizeField& field, bool fill_single, ThreadPool& pool,
           std::vector<Index>& boundary);

 private:
  template <class Task>
  void for_each_chunk(const Mesh& mesh, ThreadPool& pool, const Task& task);
  void drop_spikes(Mesh& mesh, const Point* vertices, const SizeField& field, ThreadPool& pool,
                   std::uint64_t* kept);
  void drop_small_parts(const Mesh& mesh, std::size_t least_part, std::uint64_t* kept);
  void fill_small_holes(const Mesh& mesh, const Point* vertices, const SizeField& field, std::uint64_t* kept);
  void find_boundary(Mesh& mesh, bool fill_single, ThreadPool& pool, std::uint64_t* kept,
                     std::vector<Index>& boundary);

  std::vector<std::vector<Index>> boundary_of_chunk_;  ///< of all chunks but the first
  std::vector<std::vector<Index>> found_of_chunk_;     ///< triangles to be changed
  Scratch<std::uint64_t> seen_;                        ///< as Mesh's words of kept triangles
  std::vector<Index> group_;                           ///< triangles that hang together
};

}  // namespace polylidar::detail
