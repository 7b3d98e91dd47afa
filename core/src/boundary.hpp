// From the boundary half-edges of regions to rings and polygons.
#pragma once

#include "polylidar/concave_hull.hpp"
#include "region.hpp"

namespace polylidar::detail {

/// One polygon a region, by the caller's indices (`caller_index`: vertex of the mesh -> caller's point).
/// `vertices` are the mesh's positions. Marks the half-edges of `mesh` as taken, so that it can be called
/// once after each extract_regions. Linear in the number of boundary half-edges and of the triangles round
/// their vertices.
void trace_polygons(Mesh& mesh, const Point* vertices, const std::uint32_t* caller_index,
                    const RegionBoundaries& boundaries, IndexedMultiPolygon& shape);

}  // namespace polylidar::detail
