// Boost.Geometry as the second opinion on what this project's own geometry says.
#pragma once

#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::testing {

/// The shell and then the holes of every polygon.
std::vector<polylidar::Ring> rings_of(const polylidar::MultiPolygon& shape);

/// Empty when `shape` is valid, else Boost.Geometry's reason.
std::string boost_fault(const polylidar::MultiPolygon& shape);

/// Those of `points` that do not lie strictly inside `shape`.
std::vector<polylidar::Point> boost_outside(const polylidar::MultiPolygon& shape,
                                            const std::vector<polylidar::Point>& points);

/// The distance from `point` to the nearest point of `ring` (a line, not the area it encloses).
double boost_distance(const polylidar::Point& point, const polylidar::Ring& ring);
/// To that of all rings of `shape`; infinity when there is none.
double boost_distance(const polylidar::Point& point, const polylidar::MultiPolygon& shape);

/// The area that both shapes cover.
double boost_common_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b);

}  // namespace hullbench::testing
