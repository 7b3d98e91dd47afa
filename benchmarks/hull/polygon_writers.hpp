// A shape as the formats in which `hullbench hull` answers.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "polylidar/concave_hull.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench::hull {

/// What is said beside the polygons.
struct HullFacts {
  std::size_t points = 0;
  std::optional<double> alpha;                  ///< in the unit of the points; nothing when it limits nothing
  std::optional<double> max_edge_length;        ///< likewise
  std::optional<double> max_perimeter;          ///< likewise
  std::optional<polylidar::ChosenSizes> sizes;  ///< that were chosen from the points, in their unit
};

/// The shortest text that is read as `value` again.
std::string shortest(double value);

/// A Feature with a MultiPolygon (RFC 7946: shells counter-clockwise, holes clockwise) and the properties
/// points, alpha, max_edge_length, max_perimeter, least_size, median_size, most_size, polygons, holes and
/// area; one line. Numbers are the
/// shortest that give the same double again.
std::string to_geojson(const polylidar::MultiPolygon& shape, const HullFacts& facts);

/// A MULTIPOLYGON (OGC 06-103r4, 7.2); one line, numbers likewise.
std::string to_wkt(const polylidar::MultiPolygon& shape);

/// A picture of at most 1000 x 1000 pixels without its margin, y upwards; `points` are drawn as faint dots
/// when they are at most 5000.
std::string to_svg(const polylidar::MultiPolygon& shape, std::span<const polylidar::Point> points);

}  // namespace hullbench::hull
