#include "tests/boost_checks.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <iterator>
#include <limits>

namespace hullbench::testing {

namespace {

namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
/// Counter-clockwise shells, first vertex not repeated: as polylidar::Polygon.
using BoostPolygon = bg::model::polygon<BoostPoint, false, false>;
using BoostMultiPolygon = bg::model::multi_polygon<BoostPolygon>;

BoostPoint to_boost(const polylidar::Point& point) {
  return {point.x, point.y};
}

BoostMultiPolygon to_boost(const polylidar::MultiPolygon& shape) {
  BoostMultiPolygon result;
  for (const polylidar::Polygon& polygon : shape) {
    BoostPolygon converted;
    for (const polylidar::Point& vertex : polygon.shell) converted.outer().push_back(to_boost(vertex));
    for (const polylidar::Ring& hole : polygon.holes) {
      auto& inner = converted.inners().emplace_back();
      for (const polylidar::Point& vertex : hole) inner.push_back(to_boost(vertex));
    }
    result.push_back(converted);
  }
  return result;
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

std::vector<polylidar::Point> boost_outside(const polylidar::MultiPolygon& shape,
                                            const std::vector<polylidar::Point>& points) {
  const BoostMultiPolygon converted = to_boost(shape);
  std::vector<polylidar::Point> outside;
  std::copy_if(points.begin(), points.end(), std::back_inserter(outside),
               [&](const polylidar::Point& point) { return !bg::within(to_boost(point), converted); });
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

double boost_common_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b) {
  BoostMultiPolygon common;
  bg::intersection(to_boost(a), to_boost(b), common);
  return bg::area(common);
}

}  // namespace hullbench::testing
