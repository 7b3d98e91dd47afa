// How each kind of tangled shape is drawn; combs are in comb.hpp.
#pragma once

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// Polygons two or three deep: a ring of about radius 100 round the origin whose hole has one to three
/// islands, or one ring more with islands in its own hole. Polygons with a hole come before what lies in it;
/// shells counter-clockwise, holes clockwise.
///
/// Valid because every outline lies between two circles round its centre, the outer one inside the inner one
/// of the outline around it with kLeastFeature or more between them.
polylidar::MultiPolygon draw_nested(Random& random);

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

/// 3 to 7 polygons without holes in the square from (-110, -110) to (110, 110): blobs with lobes, boxes and
/// combs by turns, each turned at random in a disc of its own. Valid because the discs are at least
/// kLeastFeature apart.
polylidar::MultiPolygon draw_parts(Random& random);

/// A counter-clockwise ring: a band between two Archimedean spirals of one pitch, 1.5 to 3 turns long, of
/// either hand, ending on the circle of radius 100 round the origin. The band takes 40 to 60 percent of the
/// pitch, the gap the rest.
///
/// Simple because all its vertices lie on 64 rays from the origin: between two neighbouring rays, the pieces
/// of the outline are chords that end in the same order of distance on both.
polylidar::Ring draw_spiral(Random& random);

/// A counter-clockwise ring with the middle of its bounding box on the origin: the outline of cells that form
/// a random tree in a grid of 8 to 12 rows and columns of random widths, 200 units across.
///
/// A cell is added only when it has one neighbour in the tree and touches none of the cells beyond, by an
/// edge or a corner. So the cells enclose no hole, the outline passes no place twice, and any two branches
/// have a whole row or column between them.
polylidar::Ring draw_walk(Random& random);

}  // namespace hullbench
