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

 private:
  std::vector<std::vector<Index>> boundary_of_chunk_;  ///< of all chunks but the first
  std::vector<std::vector<Index>> filled_of_chunk_;    ///< triangles
};

}  // namespace polylidar::detail
