// The polygons that some triangles of a triangulation form.
#pragma once

#include <span>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench::metrics {

/// The union of the triangles of `mesh`, a triangulation of `points`, that `kept` (one entry a triangle)
/// names: a polygon for every edge-connected set of them, valid in the sense of the OGC, shells
/// counter-clockwise and holes clockwise. Where a hole touches a shell or another hole each stays a ring of
/// its own.
MultiPolygon triangle_outline(const polylidar::Triangulation& mesh, std::span<const Point> points,
                              const std::vector<bool>& kept);

}  // namespace hullbench::metrics
