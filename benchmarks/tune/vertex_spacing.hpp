// A rule with a spacing for each vertex instead of one for each block, which the core's automatic limit is
// compared with.
#pragma once

#include <vector>

#include "benchmarks/base/names.hpp"
#include "core/src/half_edge.hpp"

namespace hullbench::tune {

/// Triangle of the mesh -> whether it is kept. The rule, for n points with a triangle:
///
/// - A vertex's spacing is sqrt(area of its triangles / 3), or the median length of its edges if less
///   (of an even number the upper one); then the median of those at the vertex and its neighbours; then,
///   three times, their harmonic mean.
/// - From a vertex to a neighbour at most 4.5 of its spacings away, the spacing grows by at most 6.7 / sqrt n
///   (0.1 to 0.3) of the distance, which counts as at most 1.5 spacings; four rounds.
/// - A triangle with area A and second-longest edge e stays if the place that it spans would hold at most
///   max(log n, 6.5) points: 1.4 e sqrt(A) / s^2, with the least spacing s of its corners.
/// - Where the kept angles at a vertex add up to less than 80 degrees, its triangles with more than 3 points
///   go. So do parts of fewer than sqrt(n) / 3 triangles.
/// - A hole of area A is filled if 0.88 A / s^2 is below max(log n, 6.5) + 2, with the mean spacing s at the
///   corners of its triangles.
///
/// If nothing is left, the triangle that would hold the fewest points stays. Source: this project.
std::vector<bool> kept_by_vertex_spacing(const polylidar::detail::Mesh& mesh, const Point* vertices);

}  // namespace hullbench::tune
