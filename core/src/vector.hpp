// Vectors of the plane, and the two orders in which points are compared.
#pragma once

#include "polylidar/geometry.hpp"

namespace polylidar::detail {

/// From one point to another.
struct Vector {
  double x;
  double y;
};

// static: with inline alone GCC 12 needs half a percent more instructions for merging triangulations.
static inline Vector operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y};
}
static inline double squared_length(const Vector& v) {
  return v.x * v.x + v.y * v.y;
}
static inline double dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y;
}
/// Positive if `b` points to the left of `a`, apart from rounding.
static inline double cross(const Vector& a, const Vector& b) {
  return a.x * b.y - a.y * b.x;
}
/// The circumcentre of the triangle from a corner to `b` and `c`, seen from that corner. `twice_cross` is 2
/// cross(b, c); where it is 0, the triangle is flat and the result infinite or NaN.
static inline Vector circumcentre(const Vector& b, const Vector& c, double twice_cross) {
  return {(c.y * squared_length(b) - b.y * squared_length(c)) / twice_cross,
          (b.x * squared_length(c) - c.x * squared_length(b)) / twice_cross};
}

inline bool less_by_x(const Point& a, const Point& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}
inline bool less_by_y(const Point& a, const Point& b) {
  return a.y < b.y || (a.y == b.y && a.x < b.x);
}

}  // namespace polylidar::detail
