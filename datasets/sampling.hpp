// Uniform random points in a shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// `n` points, independent and uniform in `shape` (holes left out), the same bits on every machine for the
/// same shape and seed; the first k points do not depend on n. Drawn from the bounding box, x before y, and
/// kept when the closed shape contains them: a point exactly on a ring counts as inside. O(m + n * box area /
/// shape area) for m edges.
///
/// Coordinates must be in the range of polylidar::orient2d. Throws std::invalid_argument when the shape
/// covers less than a millionth of its bounding box (or has no area at all): drawing would hardly end.
std::vector<polylidar::Point> sample_uniform(const polylidar::MultiPolygon& shape, std::size_t n,
                                             std::uint64_t seed);

}  // namespace hullbench
