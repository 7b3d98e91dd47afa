// Shapes with circular holes cut out (PAPER: section V, state shapes with holes).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// A hole is a regular polygon with this many corners, all on the circle.
inline constexpr std::size_t kHoleCorners = 64;

/// How many centres are drawn for one hole before there is said to be no room for it.
inline constexpr std::size_t kMaxHoleTries = 1'000'000;

/// The unit vectors at 0, 1, ... 63 times 360/64 degrees, counter-clockwise from (1, 0), each coordinate
/// within 1e-15. Made from half-angle formulas with + - * / and square roots, which IEEE 754 rounds
/// correctly, so they are the same on every machine.
std::array<polylidar::Point, kHoleCorners> hole_directions();

/// The regular 64-gon whose corners are `radius` from `centre`, counter-clockwise.
polylidar::Ring circle_ring(const polylidar::Point& centre, double radius);

/// `shape` with `count` more holes: regular 64-gons of circumradius `radius`, clockwise, after the holes a
/// polygon already has. Centres are uniform over the places that are left: drawn one after another from the
/// bounding box and kept when they lie inside the shape and at least 2 * radius from every boundary, the
/// shell, the shape's own holes and the new holes so far. So a hole never touches anything: at least `radius`
/// is left around it.
///
/// Throws std::invalid_argument when `radius` is not positive and finite, std::runtime_error when
/// kMaxHoleTries centres in a row do not fit. With `count` 0 the shape is returned as it is.
polylidar::MultiPolygon with_circular_holes(const polylidar::MultiPolygon& shape, std::size_t count,
                                            double radius, std::uint64_t seed);

}  // namespace hullbench
