// Plane geometry shared by the core and everything around it: points, rings, polygons, areas.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// The core: concave hulls of point sets in the plane, and what they are made of.
namespace polylidar {

/// A point in the plane, in the caller's length unit.
struct Point {
  double x = 0;  ///< first coordinate
  double y = 0;  ///< second coordinate

  /// Coordinate by coordinate: -0 equals 0.
  friend bool operator==(const Point&, const Point&) = default;
};

/// A linear ring (OGC 06-103r4, 6.1.7): its vertices in order, the first one *not* repeated at the end.
using Ring = std::vector<Point>;

/// A polygon (OGC 06-103r4, 6.1.11): one shell and any number of holes inside it. The core and every adapter
/// give shells counter-clockwise and holes clockwise.
struct Polygon {
  Ring shell;               ///< the outer boundary
  std::vector<Ring> holes;  ///< the inner ones, in any order

  /// Vertex by vertex in the order they are listed, not as shapes.
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

/// Polygons whose interiors are disjoint; empty for an empty shape.
using MultiPolygon = std::vector<Polygon>;

/// An axis-parallel box; `min` > `max` in an empty one. A default Box is not empty: it is the point (0, 0).
struct Box {
  Point min;  ///< least x and least y
  Point max;  ///< greatest x and greatest y

  /// Coordinate by coordinate.
  friend bool operator==(const Box&, const Box&) = default;
};

/// The smallest box round `points`; for no points, min = +infinity and max = -infinity.
Box bounding_box(std::span<const Point> points);

/// The smallest box round two, either of which may be empty.
Box joined(const Box& a, const Box& b);

/// The area enclosed by `ring` in squared units, positive when it runs counter-clockwise. Rounded: not a
/// predicate. 0 for fewer than 3 vertices.
double signed_area(std::span<const Point> ring);

/// Shell areas minus hole areas, in squared units, whatever the orientation of the rings.
double area(const MultiPolygon& shape);

/// Vertices of all rings.
std::size_t vertex_count(const MultiPolygon& shape);

}  // namespace polylidar
