// The merge step of the divide and conquer: two triangulations on either side of a line become one.
#pragma once

#include "half_edge.hpp"

namespace polylidar::detail {

/// A vertex of a convex hull, and the record of the ghost over the hull edge that leaves it
/// counter-clockwise. Of a hull that is a single point: that point and kNone.
struct HullVertex {
  Mesh::Index vertex;
  Mesh::Index ghost;
};

/// A triangulated set of points, by the extreme vertices of its convex hull, from which merges start.
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

/// Which coordinate tells two halves apart; ties are broken by the other one.
enum class Axis : std::uint8_t { kX, kY };

/// Up to which size results of plain floating-point arithmetic are exact because all coordinates are
/// multiples of one power of two: sums of magnitudes below these limits lose nothing, so that a result of
/// zero is a zero. This spares lattices the exact arithmetic. Both are 0 where coordinates have no such unit
/// worth having.
struct ExactLimits {
  double orient2d = 0;  ///< 2^53 squared units
  double incircle = 0;  ///< 2^53 units to the fourth
};

/// The Delaunay triangulation of the points of `before` and `after` together, in `mesh`, where all of
/// `before` lie before all of `after` along `axis`. The two triangles that a merge adds get the records
/// `first_record` and the next one; all others stay where they are.
Hull merge_hulls(Mesh& mesh, const Point* points, const ExactLimits& limits, const Hull& before,
                 const Hull& after, Mesh::Index first_record, Axis axis);

/// The triangle (a, b, c), which runs counter-clockwise, and the ghosts over its edges, in four records from
/// `first_record` on.
Hull join_triangle(Mesh& mesh, const Point* points, Mesh::Index a, Mesh::Index b, Mesh::Index c,
                   Mesh::Index first_record);

}  // namespace polylidar::detail
