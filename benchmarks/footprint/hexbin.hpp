// The usual footprint of a point cloud: hexagons with enough points in them.
#pragma once

#include <cstdint>
#include <span>

#include "benchmarks/base/names.hpp"

namespace hullbench::footprint {

/// The union of the regular hexagons of a honeycomb, `height` > 0 from side to opposite side, that have at
/// least `least` >= 1 of `points` in them. Hexagons that share a side are one polygon. Shells
/// counter-clockwise, holes clockwise; no two rings touch. Empty for no points. Memory: 4 bytes a hexagon of
/// the points' box; throws std::invalid_argument where that has more than 2^31.
MultiPolygon hexbin(std::span<const Point> points, double height, std::uint32_t least);

/// The height that Hexer, which PDAL's filters.hexbin is made of, takes where none is given: `least` times
/// the mean distance of consecutive points, of the first 5000. 0 for fewer than two points.
double hexer_height(std::span<const Point> points, std::uint32_t least);

}  // namespace hullbench::footprint
