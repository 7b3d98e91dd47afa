// Boost.Geometry as the second opinion on shapes: it shares no code with GEOS or the core.
#pragma once

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <string>

#include "polylidar/geometry.hpp"

namespace polylidar::testing {

/// Coordinates without rounding.
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

/// Counter-clockwise shells and open rings, as in this project.
template <typename Number>
using BoostMultiPolygon = boost::geometry::model::multi_polygon<
    boost::geometry::model::polygon<boost::geometry::model::d2::point_xy<Number>, false, false>>;

template <typename Number = double>
BoostMultiPolygon<Number> to_boost(const MultiPolygon& shape) {
  const auto copy = [](const Ring& from, auto& to) {
    for (const Point& point : from) to.emplace_back(Number(point.x), Number(point.y));
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

/// Boost's reason why `shape` is not valid; empty when it is. With doubles Boost.Geometry first rounds
/// coordinates to a grid over the whole shape and so sees crossings in fine detail that has none; a fault
/// found that way counts only when exact coordinates, which are far slower, show one too.
inline std::string boost_invalid_reason(const MultiPolygon& shape) {
  std::string reason;
  if (boost::geometry::is_valid(to_boost<double>(shape), reason)) return {};
  if (boost::geometry::is_valid(to_boost<Rational>(shape), reason)) return {};
  return reason;
}

}  // namespace polylidar::testing
