// Which triangles belong to the shape, and where the shape ends.
#pragma once

#include <vector>

#include "filter_rules.hpp"
#include "half_edge.hpp"
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

 private:
  template <class FilterWords>
  void select(Mesh& mesh, bool fill_single, ThreadPool& pool, std::vector<Index>& boundary,
              const FilterWords& filter_words);

  std::vector<std::vector<Index>> boundary_of_chunk_;  ///< of all chunks but the first
  std::vector<std::vector<Index>> filled_of_chunk_;    ///< triangles
};

}  // namespace polylidar::detail
