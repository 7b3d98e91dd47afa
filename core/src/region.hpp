// Which triangles belong to the shape, and where the shape ends.
#pragma once

#include <span>
#include <vector>

#include "half_edge.hpp"
#include "polylidar/concave_hull.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Selects triangles, keeping its memory between calls.
class RegionFilter {
 public:
  using Index = Mesh::Index;

  /// Keeps the finite triangles of `mesh` that are within `limits` (in the unit of `vertices`) and, if
  /// `fill_single` says so, those whose three neighbours are. Puts into `boundary` the half-edges of kept
  /// triangles whose twin is not kept, in the same order whatever the number of threads. Can be called again
  /// with other limits. `perimeters`: empty, or where a perimeter is all that `limits` has, every triangle's,
  /// of single precision, infinite where it is not finite; spares working most of them out.
  void run(Mesh& mesh, const Point* vertices, const Limits& limits, std::span<const float> perimeters,
           bool fill_single, ThreadPool& pool, std::vector<Index>& boundary);

 private:
  std::vector<std::vector<Index>> boundary_of_chunk_;  ///< of all chunks but the first
  std::vector<std::vector<Index>> filled_of_chunk_;    ///< triangles
};

}  // namespace polylidar::detail
