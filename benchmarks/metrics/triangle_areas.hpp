// How much of each triangle lies in a shape: with it the error of any union of these triangles is a sum.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::metrics {

/// Triangle -> area of what it has in common with the valid `shape`, in the squared unit of the points.
/// Corners run counter-clockwise. Only triangles that cross the outline cost an intersection. Throws
/// std::runtime_error when GEOS fails.
std::vector<double> areas_within(std::span<const std::array<Point, 3>> triangles, const MultiPolygon& shape);

}  // namespace hullbench::metrics
