// Which triangles belong to the shape, and the edge-connected regions they form.
#pragma once

#include <cstdint>
#include <vector>

#include "half_edge.hpp"

namespace polylidar::detail {

/// Label of a triangle outside the shape, ghosts included. Regions are labelled 0, 1, 2, ...
inline constexpr std::uint32_t kOutside = kNone;

/// The boundary of every region: the half-edges of its triangles whose twin lies outside the shape.
struct RegionBoundaries {
  /// Half-edges, region after region.
  std::vector<Mesh::Index> half_edges;
  /// region r has half_edges[ends[r - 1] .. ends[r]), the first one starting at 0.
  std::vector<std::uint32_t> ends;
};

/// Keeps the triangles whose circumradius is at most `alpha` and whose longest edge is at most
/// `max_edge_length` (both in the unit of `vertices`, infinity for no limit), labels each triangle of `mesh`
/// with its region or kOutside, and writes the regions' boundaries. One pass to filter and one flood over all
/// regions together: time does not depend on how many there are. `stack` is scratch.
void extract_regions(Mesh& mesh, const Point* vertices, double alpha, double max_edge_length,
                     RegionBoundaries& boundaries, std::vector<Mesh::Index>& stack);

}  // namespace polylidar::detail
