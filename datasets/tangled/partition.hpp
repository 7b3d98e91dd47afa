// A random polygon from a partition of a disc into triangles.
#pragma once

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// A counter-clockwise ring of 30 to 80 vertices within 100 of the origin, before the middle of its bounding
/// box is moved there. The points of a lattice of equilateral triangles are shifted at random; then a polygon
/// grows from one triangle: an edge, taken at random, is replaced by the two edges to the point across it,
/// when that point is not in the polygon yet.
///
/// Simple and nowhere thin: with shifts of at most half of what a triangle's height exceeds kLeastFeature by,
/// every height stays at least kLeastFeature, so no triangle turns over and the triangles still tile the
/// plane; the ring is the outline of some that hang together like a tree. From a vertex to any edge that
/// does not end there, the way leads across a triangle at that vertex, whose height is not more.
polylidar::Ring draw_partition(Random& random);

}  // namespace hullbench
