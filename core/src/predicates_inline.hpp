// The fast path of the predicates, to be inlined into kernels. The exact path is a function call, which is
// rarely needed.
#pragma once

#include <cmath>

#include "polylidar/predicates.hpp"

namespace polylidar::detail {

double orient2d_exact(const Point& a, const Point& b, const Point& c);
double incircle_exact(const Point& a, const Point& b, const Point& c, const Point& d);

/// incircle(a, b, c, d) > 0 for four different points. A tie (a sign of zero) is decided as if the paraboloid
/// were pushed down a little at the least of the four by x, then y. Lower points in this order are pushed
/// down more, so one surface decides all ties. The triangulation therefore depends on the points only, and
/// the least of several points on an empty circle is a corner of all their triangles. `is_tie`: the sign is
/// known to be zero.
bool is_in_circle_exact(const Point& a, const Point& b, const Point& c, const Point& d, bool is_tie);

// Half an ulp of 1: the relative rounding error of one operation.
inline constexpr double kEpsilon = 0x1p-53;
// Bounds of the rounding error relative to the sum of the magnitudes of the products, from Shewchuk (1997),
// the first stage of orient2d (section 4.2) and of incircle (section 4.3). They count one rounding an
// operation, which is why contraction is off, and no underflow, which the range of coordinates excludes.
inline constexpr double kOrientBound = (3.0 + 16.0 * kEpsilon) * kEpsilon;
inline constexpr double kIncircleBound = (10.0 + 96.0 * kEpsilon) * kEpsilon;

inline double orient2d_fast(const Point& a, const Point& b, const Point& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = kOrientBound * (std::abs(left) + std::abs(right));
  if (std::abs(determinant) > bound) [[likely]]
    return determinant;
  return orient2d_exact(a, b, c);
}

inline double incircle_fast(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double adx = a.x - d.x;
  const double ady = a.y - d.y;
  const double bdx = b.x - d.x;
  const double bdy = b.y - d.y;
  const double cdx = c.x - d.x;
  const double cdy = c.y - d.y;

  const double bdx_cdy = bdx * cdy;
  const double cdx_bdy = cdx * bdy;
  const double cdx_ady = cdx * ady;
  const double adx_cdy = adx * cdy;
  const double adx_bdy = adx * bdy;
  const double bdx_ady = bdx * ady;
  const double a_lift = adx * adx + ady * ady;
  const double b_lift = bdx * bdx + bdy * bdy;
  const double c_lift = cdx * cdx + cdy * cdy;

  const double determinant =
      a_lift * (bdx_cdy - cdx_bdy) + b_lift * (cdx_ady - adx_cdy) + c_lift * (adx_bdy - bdx_ady);
  const double permanent = a_lift * (std::abs(bdx_cdy) + std::abs(cdx_bdy)) +
                           b_lift * (std::abs(cdx_ady) + std::abs(adx_cdy)) +
                           c_lift * (std::abs(adx_bdy) + std::abs(bdx_ady));
  if (std::abs(determinant) > kIncircleBound * permanent) [[likely]]
    return determinant;
  return incircle_exact(a, b, c, d);
}

}  // namespace polylidar::detail
