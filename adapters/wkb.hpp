// Well-known binary (OGC 06-103r4, 8.2) for polygons: how results travel between processes and databases.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// `shape` as a little-endian WKB MultiPolygon, rings closed by repeating their first vertex. Throws
/// std::length_error when a count does not fit into 32 bits.
std::vector<std::uint8_t> to_wkb(const polylidar::MultiPolygon& shape);

/// The polygons of a WKB or EWKB geometry of either byte order: Polygon, MultiPolygon or a
/// GeometryCollection. Z and M values and the SRID are dropped; points and lines, alone or in a collection,
/// are dropped, because they have no area (databases answer with them when the input is degenerate), and so
/// are empty polygons. Rings lose the repeated vertex and are turned: shells counter-clockwise, holes
/// clockwise. Throws std::invalid_argument when the bytes are not well-formed (cut short, unknown type,
/// absurd count, open ring or one of fewer than 4 points, a vertex that is not finite, trailing bytes).
polylidar::MultiPolygon from_wkb(std::span<const std::uint8_t> bytes);

/// Little-endian WKB MultiPoint of `points`: how point sets are handed to databases.
/// Throws std::length_error beyond 2^32 - 1 points.
std::vector<std::uint8_t> to_wkb_multipoint(std::span<const polylidar::Point> points);

}  // namespace hullbench
