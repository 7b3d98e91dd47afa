// Exact geometric predicates.
#pragma once

#include "polylidar/geometry.hpp"

namespace polylidar {

/// On which side of the directed line a -> b point c lies: > 0 left (a, b, c counter-clockwise), < 0 right,
/// exactly 0 if the three are collinear. The sign is exact for finite coordinates whose magnitudes are zero
/// or between 2^-116 and 2^150; the magnitude means nothing. Antisymmetric: swapping two arguments negates
/// the sign.
double orient2d(const Point& a, const Point& b, const Point& c);

/// For a, b, c counter-clockwise: > 0 when d lies inside their circumcircle, < 0 outside, exactly 0 when the
/// four are cocircular. For a, b, c clockwise the sign is reversed; for collinear a, b, c the sign is that of
/// the determinant. Range and exactness as orient2d.
double incircle(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace polylidar
