// Sine, cosine and logarithm with the same bits on every machine, which the C library's do not promise: built
// from + - * / alone, which IEEE 754 rounds correctly.
#pragma once

#include "polylidar/geometry.hpp"

namespace hullbench {

/// (cos, sin) of `turns` full turns, counter-clockwise from (1, 0); each coordinate within 1e-15 of the true
/// value, and exact at quarter turns. Turns and not radians, because whole and quarter turns are then taken
/// off without rounding, however many there are. std::invalid_argument when `turns` is not finite.
///
/// Taylor's series on an eighth of a turn either side of a quarter turn: the first term left out is below
/// 3e-18.
polylidar::Point unit_vector(double turns);

/// `point` turned counter-clockwise about the origin by the angle of the unit vector `direction`.
///
/// A sum in both coordinates: g++ 12 makes a difference in one and a sum in the other into one fused
/// instruction where the processor has it, -ffp-contract=off or not, and the last bits would depend on it.
inline polylidar::Point turned(const polylidar::Point& point, const polylidar::Point& direction) {
  const double minus_sine = -direction.y;
  return {point.x * direction.x + point.y * minus_sine, point.x * direction.y + point.y * direction.x};
}

/// The natural logarithm of `x`, within 2e-15 of the true value absolutely or relatively, whichever is the
/// more; exactly 0 for 1. std::invalid_argument when `x` is not positive and finite.
///
/// x = m * 2^e with m next to 1, and log m = 2 artanh((m - 1) / (m + 1)) by its series: the first term left
/// out is below 2e-18 of the sum.
double natural_log(double x);

}  // namespace hullbench
