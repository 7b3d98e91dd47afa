// Boost.Geometry as the second opinion on what this project's own geometry says: it shares no code with GEOS
// or the core. Its headers take long to compile, so only boost_checks.cpp includes them.
#pragma once

#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench::testing {

/// The shell and then the holes of every polygon.
std::vector<polylidar::Ring> rings_of(const polylidar::MultiPolygon& shape);

/// Empty when `shape` is valid, else Boost.Geometry's reason.
std::string boost_fault(const polylidar::MultiPolygon& shape);

/// The same for shapes with fine detail. With doubles Boost.Geometry first rounds coordinates to a grid over
/// the whole shape and so sees crossings where there are none; a fault found that way counts only when exact
/// coordinates, which are far slower, show one too.
std::string boost_fault_in_detail(const polylidar::MultiPolygon& shape);

/// Those of `points` that do not lie strictly inside `shape`.
std::vector<polylidar::Point> boost_outside(const polylidar::MultiPolygon& shape,
                                            const std::vector<polylidar::Point>& points);

/// The distance from `point` to the nearest point of `ring` (a line, not the area it encloses).
double boost_distance(const polylidar::Point& point, const polylidar::Ring& ring);
/// To that of all rings of `shape`; infinity when there is none.
double boost_distance(const polylidar::Point& point, const polylidar::MultiPolygon& shape);

double boost_area(const polylidar::MultiPolygon& shape);
double boost_perimeter(const polylidar::MultiPolygon& shape);

/// The area that both shapes cover.
double boost_common_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b);

/// The area of what is in `a` and not in `b`, and of what is in one of them only. In exact coordinates: with
/// doubles Boost.Geometry rounds crossings to a grid and is off by some 1e-7 of the area.
double boost_difference_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b);
double boost_symmetric_difference_area(const polylidar::MultiPolygon& a, const polylidar::MultiPolygon& b);

}  // namespace hullbench::testing
