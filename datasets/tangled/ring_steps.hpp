// What the tangled shapes share: turning and moving rings, round outlines, and cutting a length into pieces.
#pragma once

#include <cstddef>
#include <vector>

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// Turns `ring` or every ring of `shape` counter-clockwise round the origin by `turns` full turns.
void turn(polylidar::Ring& ring, double turns);
void turn(polylidar::MultiPolygon& shape, double turns);

/// Adds `offset` to every vertex.
void move(polylidar::Ring& ring, const polylidar::Point& offset);

/// Moves the middle of the bounding box of `ring`, which has a vertex, to the origin.
void centre_on_origin(polylidar::Ring& ring);

/// `ring` without the vertices that lie on a line with their neighbours or on one of them; exact.
polylidar::Ring without_straight_corners(polylidar::Ring ring);

/// Where 0 .. `total` is cut into `count` pieces of random lengths, none shorter than `least`: `count` + 1
/// ascending places, the first exactly 0 and the last exactly `total`. Needs `count` >= 1 and `total` >=
/// `count` * `least`.
std::vector<double> random_cuts(std::size_t count, double least, double total, Random& random);

/// The room in which an outline is drawn.
struct Disc {
  polylidar::Point centre;
  double radius = 0;  ///< length unit, > 0
};

/// A round outline with lobes; see round_outline.
struct RoundOutline {
  polylidar::Point centre;
  double radius = 0;      ///< of the circle it stays inside, length unit
  double depth = 0;       ///< it reaches at most so far in from that circle, in radii, 0 .. 1
  std::size_t lobes = 2;  ///< >= 2
};

/// A counter-clockwise ring of 60 vertices, equally spaced in angle as seen from the centre: star-shaped, and
/// clear of the circle of radius 0.998 * (1 - depth) * radius, because chords are nearer to the centre than
/// their ends by a factor of cos(3 degrees) at most.
polylidar::Ring round_outline(const RoundOutline& outline, Random& random);

}  // namespace hullbench
