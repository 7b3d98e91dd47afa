// Fewer vertices for the same shape.
#pragma once

#include <span>

#include "tool/shapes/index_shape.hpp"

namespace polylidar::tool {

/// `shape` with vertices left out, none of them further than `tolerance` > 0 (in the unit of the points) from
/// the segment that takes its place: as many polygons and holes as before, none crossing another. `shape`
/// must be valid, with no vertex inside another's edge, as the core's shapes are, and within its range.
///
/// Vertices go one at a time, the least displacement first, after Visvalingam and Whyatt (Line generalisation
/// by repeated elimination of points, 1993) with distances in place of areas. A vertex b between a and c
/// stays where the closed triangle abc has another vertex: nothing can then lie between the old outline and
/// the new one, which keeps every ring on its side of every other (exact predicates decide). O(n log n) for
/// outlines whose vertices are spread evenly.
IndexShape simplify(const IndexShape& shape, std::span<const Point> points, double tolerance);

}  // namespace polylidar::tool
