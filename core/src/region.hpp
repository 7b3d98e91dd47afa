// Which triangles belong to the shape, and where the shape ends.
#pragma once

#include <vector>

#include "half_edge.hpp"

namespace polylidar::detail {

/// Keeps the finite triangles of `mesh` whose circumradius is at most `alpha` and whose longest edge is at
/// most `max_edge_length` (both in the unit of `vertices`, infinity for no limit), and collects in `boundary`
/// the half-edges of kept triangles whose twin is not kept. `dropped` is scratch. Can be called again with
/// other limits.
void extract_regions(Mesh& mesh, const Point* vertices, double alpha, double max_edge_length,
                     Scratch<Mesh::Index>& dropped, std::vector<Mesh::Index>& boundary);

}  // namespace polylidar::detail
