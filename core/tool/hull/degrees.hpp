// Longitude and latitude as a plane.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "polylidar/geometry.hpp"
#include "tool/points/crs.hpp"

namespace polylidar::tool {

/// Whether no coordinate is beyond 360 of longitude or 90 of latitude.
bool could_be_degrees(const Box& box);

/// Whether coordinates of which nothing is said look like longitudes and latitudes: they are within 180 and
/// 90, further from (0, 0) than 10 and than they reach, and have more than three decimals. Coordinates of a
/// sensor, a drawing or a test lie round their origin, or end at a thousandth of their unit. Nothing is
/// certain: this is enough for a hint.
bool look_like_degrees(const Box& box);

/// The middle latitude of points that are longitudes and latitudes, which could_be_degrees() is to be asked
/// of before; nothing where `crs` does not say so, or there are no points.
std::optional<double> middle_latitude(const Crs& crs, std::span<const Point> points);

/// Points in degrees as metres east and north: both axes are scaled by the metres of a degree of latitude on
/// the sphere with the area of the WGS 84 ellipsoid (radius 6371007.2 m), x by the cosine of `latitude` too.
/// At that latitude lengths are those of the sphere; at others those along x are too long or too short by the
/// ratio of the cosines: 2 % one degree north or south of latitude 50. Both axes stay straight, so what is a
/// valid polygon in metres is one in degrees; on a map with true areas it need not be. Points on both sides
/// of longitude 180 are taken as far apart.
std::vector<Point> to_metres(std::span<const Point> points, double latitude);

/// The area on that sphere of a ring of to_metres(points, latitude), in square metres: exact but for
/// rounding, at all latitudes, for edges that are straight in degrees. Positive when it runs
/// counter-clockwise.
double signed_area_on_sphere(const Ring& metres, double latitude);

/// The shape in degrees whose vertices are in metres. One that is a point of to_metres(points, latitude)
/// becomes that point of `points` again, to the last bit.
MultiPolygon to_degrees(MultiPolygon shape, std::span<const Point> points, double latitude);

}  // namespace polylidar::tool
