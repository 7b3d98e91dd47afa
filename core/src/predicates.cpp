#include "polylidar/predicates.hpp"

#include "expansion.hpp"
#include "predicates_inline.hpp"

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

}  // namespace detail

double orient2d(const Point& a, const Point& b, const Point& c) {
  return detail::orient2d_fast(a, b, c);
}

double incircle(const Point& a, const Point& b, const Point& c, const Point& d) {
  return detail::incircle_fast(a, b, c, d);
}

}  // namespace polylidar
