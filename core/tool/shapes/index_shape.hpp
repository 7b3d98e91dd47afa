// Polygons whose vertices are points by index, one by one, so that parts can be dropped and vertices left out
// before coordinates are written: they stay those of the input, bit by bit, whatever plane the work was in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "polylidar/concave_hull.hpp"
#include "polylidar/geometry.hpp"

namespace polylidar::tool {

/// Indices into the points, in order; the first one is not repeated.
using IndexRing = std::vector<std::uint32_t>;

/// The shell counter-clockwise, holes clockwise.
struct IndexPolygon {
  IndexRing shell;
  std::vector<IndexRing> holes;
};

/// Polygons whose interiors are disjoint.
using IndexShape = std::vector<IndexPolygon>;

/// The core's flat arrays, polygon by polygon.
IndexShape polygons_of(const IndexedMultiPolygon& shape);

/// `shape` with coordinates.
MultiPolygon to_coordinates(const IndexShape& shape, std::span<const Point> points);

/// The latitude of points that are metres of to_metres(); none of points in a plane.
using Latitude = std::optional<double>;

/// In squared units, with a latitude on the sphere; a ring's is positive when it runs counter-clockwise.
double signed_area(const IndexRing& ring, std::span<const Point> points, const Latitude& latitude = {});
double area(const IndexPolygon& polygon, std::span<const Point> points, const Latitude& latitude = {});
double area(const IndexShape& shape, std::span<const Point> points, const Latitude& latitude = {});
/// Whatever the orientation of the rings.
double area(const MultiPolygon& shape, const Latitude& latitude);

/// Holes of all polygons.
std::size_t hole_count(const IndexShape& shape);

/// Fills holes and drops polygons below `least`. What lies inside a hole is smaller than it, so that nothing
/// that stays is covered by a filled one.
void drop_small_areas(IndexShape& shape, std::span<const Point> points, double least,
                      const Latitude& latitude = {});

/// Keeps the `count` polygons of the largest areas, in their order; of equal ones the first.
void keep_largest(IndexShape& shape, std::span<const Point> points, std::size_t count,
                  const Latitude& latitude = {});

}  // namespace polylidar::tool
