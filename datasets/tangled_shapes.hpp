// Shapes that are not star-shaped, for what the paper's random polygons leave untested: narrow gaps, long
// ways round, nested rings and separate parts.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "polylidar/geometry.hpp"

namespace hullbench {

enum class TangledKind { kComb, kSpiral, kPartition, kWalk, kNested, kParts };

inline constexpr std::array kTangledKinds{TangledKind::kComb, TangledKind::kSpiral, TangledKind::kPartition,
                                          TangledKind::kWalk, TangledKind::kNested, TangledKind::kParts};

/// Nothing in a tangled shape is thinner than this, and no gap narrower. In the unit of the coordinates;
/// shapes are 100 to 311 across and cover less than 24,000 squared units. So with 8000 points the paper's
/// alpha, 2 * sqrt(area / n), stays below 3.5, while a triangle across a gap has a circumradius of at
/// least 4. Corners may be sharp all the same: near one, the two edges that meet there come as close as they
/// like.
inline constexpr double kLeastFeature = 8;

/// "comb", "spiral", "partition", "walk", "nested" or "parts".
std::string tangled_name(TangledKind kind);

/// How many shapes of `kind` there are: 167 of each of the first four kinds, 166 of the last two, so 1000.
std::size_t tangled_count(TangledKind kind);

/// Shape `index` of `kind`, the same bits on every machine: valid polygons with counter-clockwise shells and
/// clockwise holes, in any direction round the origin, with a different seed for each. What the kinds look
/// like stands with their draws in datasets/tangled. std::invalid_argument when `index` is not below
/// tangled_count(kind).
polylidar::MultiPolygon tangled_shape(TangledKind kind, std::size_t index);

}  // namespace hullbench
