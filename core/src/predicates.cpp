#include "polylidar/predicates.hpp"

#include "expansion.hpp"
#include "predicates_inline.hpp"
#include "vector.hpp"

namespace polylidar {

namespace detail {

double orient2d_exact(const Point& a, const Point& b, const Point& c) {
  const auto acx = difference(a.x, c.x);
  const auto acy = difference(a.y, c.y);
  const auto bcx = difference(b.x, c.x);
  const auto bcy = difference(b.y, c.y);
  return sum(product(acx, bcy), negative(product(acy, bcx))).sign();
}

// The differences are exact as two doubles each, and one double where the subtraction did not round, as on
// lattices: the expansions then stay short and this costs little more than the fast path.
double incircle_exact(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto adx = difference(a.x, d.x);
  const auto ady = difference(a.y, d.y);
  const auto bdx = difference(b.x, d.x);
  const auto bdy = difference(b.y, d.y);
  const auto cdx = difference(c.x, d.x);
  const auto cdy = difference(c.y, d.y);

  const auto minor = [](const Expansion<2>& px, const Expansion<2>& py, const Expansion<2>& qx,
                        const Expansion<2>& qy) { return sum(product(px, qy), negative(product(qx, py))); };
  const auto lift = [](const Expansion<2>& x, const Expansion<2>& y) {
    return sum(product(x, x), product(y, y));
  };

  const auto a_part = product(lift(adx, ady), minor(bdx, bdy, cdx, cdy));
  const auto b_part = product(lift(bdx, bdy), minor(cdx, cdy, adx, ady));
  const auto c_part = product(lift(cdx, cdy), minor(adx, ady, bdx, bdy));
  return sum(sum(a_part, b_part), c_part).sign();
}

// The determinant is h(a) [bcd] - h(b) [acd] + h(c) [abd] - h(d) [abc], with h a point's height and [abc]
// orient2d(a, b, c): pushing a point down takes its term's factor away. No three points of a circle lie on a
// line, so that no factor is zero.
bool is_in_circle_exact(const Point& a, const Point& b, const Point& c, const Point& d, bool is_tie) {
  if (!is_tie) {
    const double sign = incircle_exact(a, b, c, d);
    if (sign != 0) return sign > 0;
  }
  const bool a_before_b = less_by_x(a, b);
  const bool c_before_d = less_by_x(c, d);
  if (less_by_x(a_before_b ? a : b, c_before_d ? c : d)) {
    return a_before_b ? orient2d_fast(b, c, d) < 0 : orient2d_fast(a, c, d) > 0;
  }
  return c_before_d ? orient2d_fast(a, b, d) < 0 : orient2d_fast(a, b, c) > 0;
}

}  // namespace detail

double orient2d(const Point& a, const Point& b, const Point& c) {
  return detail::orient2d_fast(a, b, c);
}

double incircle(const Point& a, const Point& b, const Point& c, const Point& d) {
  return detail::incircle_fast(a, b, c, d);
}

}  // namespace polylidar
