#include "tests/boost_checks.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <iterator>
#include <limits>

namespace hullbench::testing {

namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
/// Coordinates without rounding.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
/// Counter-clockwise shells, first vertex not repeated: as polylidar::Polygon.
template <typename Number>
using BoostMultiPolygon =
    bg::model::multi_polygon<bg::model::polygon<bg::model::d2::point_xy<Number>, false, false>>;

BoostPoint to_boost(const polylidar::Point& point) {
  return {point.x, point.y};
}

template <typename Number = double>
BoostMultiPolygon<Number> to_boost(const polylidar::MultiPolygon& shape) {
  const auto copy = [](const polylidar::Ring& from, auto& to) {
    for (const polylidar::Point& point : from) to.emplace_back(Number(point.x), Number(point.y));
  };
  BoostMultiPolygon<Number> result;
  result.resize(shape.size());
  for (std::size_t p = 0; p < shape.size(); ++p) {
    copy(shape[p].shell, result[p].outer());
    result[p].inners().resize(shape[p].holes.size());
    for (std::size_t h = 0; h < shape[p].holes.size(); ++h) copy(shape[p].holes[h], result[p].inners()[h]);
  }
  return result;
}

/// The area of what `a` has and `b` has not.
Rational difference_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b) {
  BoostMultiPolygon<Rational> difference;
  bg::difference(to_boost<Rational>(a), to_boost<Rational>(b), difference);
  return bg::area(difference);
}

}  // namespace

std::vector<polylidar::Ring> rings_of(const polylidar::MultiPolygon& shape) {
  std::vector<polylidar::Ring> rings;
  for (const polylidar::Polygon& polygon : shape) {
    rings.push_back(polygon.shell);
    rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
  }
  return rings;
}

std::string boost_fault(const polylidar::MultiPolygon& shape) {
  std::string reason;
  return bg::is_valid(to_boost(shape), reason) ? "" : reason;
}

std::string boost_fault_in_detail(const polylidar::MultiPolygon& shape) {
  const std::string fault = boost_fault(shape);
  return fault.empty() || bg::is_valid(to_boost<Rational>(shape)) ? "" : fault;
}

std::vector<polylidar::Point> boost_outside(const polylidar::MultiPolygon& shape,
                                            const std::vector<polylidar::Point>& points) {
  const BoostMultiPolygon<double> converted = to_boost(shape);
  std::vector<polylidar::Point> outside;
  std::ranges::copy_if(points, std::back_inserter(outside), [&](const polylidar::Point& point) {
    return !bg::within(to_boost(point), converted);
  });
  return outside;
}

double boost_distance(const polylidar::Point& point, const polylidar::Ring& ring) {
  bg::model::linestring<BoostPoint> line;
  for (const polylidar::Point& vertex : ring) line.push_back(to_boost(vertex));
  line.push_back(to_boost(ring.front()));
  return bg::distance(to_boost(point), line);
}

double boost_distance(const polylidar::Point& point, const polylidar::MultiPolygon& shape) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const polylidar::Ring& ring : rings_of(shape))
    nearest = std::min(nearest, boost_distance(point, ring));
  return nearest;
}

double boost_area(const polylidar::MultiPolygon& shape) {
  return bg::area(to_boost(shape));
}

double boost_perimeter(const polylidar::MultiPolygon& shape) {
  return static_cast<double>(bg::perimeter(to_boost(shape)));
}

double boost_common_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b) {
  BoostMultiPolygon<double> common;
  bg::intersection(to_boost(a), to_boost(b), common);
  return bg::area(common);
}

double boost_difference_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b) {
  return static_cast<double>(difference_area(a, b));
}

double boost_symmetric_difference_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b) {
  return static_cast<double>(difference_area(a, b) + difference_area(b, a));
}

}  // namespace hullbench::testing
