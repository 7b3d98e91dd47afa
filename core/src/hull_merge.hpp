// The merge step of the divide and conquer: two triangulations on either side of a line become one.
#pragma once

#include "half_edge.hpp"

namespace polylidar::detail {

/// A vertex of a convex hull, and the record of the ghost over the hull edge that leaves it
/// counter-clockwise. For a hull of a single point: that point and kNone.
struct HullVertex {
  Mesh::Index vertex;
  Mesh::Index ghost;
};

/// A triangulated set of points, given by the extreme vertices of its convex hull, where merges start.
struct Hull {
  HullVertex left;    ///< least by x, then y
  HullVertex right;   ///< greatest by x, then y
  HullVertex bottom;  ///< least by y, then x
  HullVertex top;     ///< greatest by y, then x
  bool is_point() const { return left.ghost == kNone; }
  static Hull of_point(Mesh::Index vertex) {
    const HullVertex point{vertex, kNone};
    return {point, point, point, point};
  }
};

/// The coordinate that separates two halves; the other one breaks ties.
enum class Axis : std::uint8_t { kX, kY };

/// If all coordinates are multiples of one power of two, plain floating-point arithmetic is exact up to these
/// limits: sums of magnitudes below them lose nothing, so a result of zero is truly zero. Lattices then need
/// no exact arithmetic. Both are 0 if the coordinates have no such unit that helps.
struct ExactLimits {
  double orient2d = 0;  ///< 2^53 squared units
  double incircle = 0;  ///< 2^53 units to the fourth
};

/// Makes the Delaunay triangulation of the points of `before` and `after` together, in `mesh`. All of
/// `before` must lie before all of `after` along `axis`. The two triangles that a merge adds get the records
/// `first_record` and the next one; all others stay where they are.
Hull merge_hulls(Mesh& mesh, const Point* points, const ExactLimits& limits, const Hull& before,
                 const Hull& after, Mesh::Index first_record, Axis axis);

/// Writes the counter-clockwise triangle (a, b, c) and the ghosts over its edges into four records, beginning
/// with `first_record`.
Hull join_triangle(Mesh& mesh, const Point* points, Mesh::Index a, Mesh::Index b, Mesh::Index c,
                   Mesh::Index first_record);

}  // namespace polylidar::detail
