// Which triangles belong to the shape, and where the shape ends.
#pragma once

#include <vector>

#include "half_edge.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Selects triangles, keeping its memory between calls.
class RegionFilter {
 public:
  using Index = Mesh::Index;

  /// Keeps the finite triangles of `mesh` whose circumradius is at most `alpha` and whose longest edge is at
  /// most `max_edge_length` (both in the unit of `vertices`, infinity for no limit), and puts into `boundary`
  /// the half-edges of kept triangles whose twin is not kept, in the same order whatever the number of
  /// threads. Can be called again with other limits.
  void run(Mesh& mesh, const Point* vertices, double alpha, double max_edge_length, ThreadPool& pool,
           std::vector<Index>& boundary);

 private:
  std::vector<std::vector<Index>> boundary_of_chunk_;  ///< of all chunks but the first
};

}  // namespace polylidar::detail
