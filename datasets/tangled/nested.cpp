#include <algorithm>
#include <cstddef>

#include "datasets/portable_math.hpp"
#include "datasets/tangled/draws.hpp"
#include "datasets/tangled/ring_steps.hpp"
#include "datasets/tangled_shapes.hpp"

namespace hullbench {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Ring;

namespace {

constexpr double kOuterRadius = 100;
/// An outline of radius r leaves the circle of 0.85 r clear: 0.998 * (1 - kDepth) is 0.858.
constexpr double kDepth = 0.14;
constexpr double kClear = 0.85;
/// A ring of this radius still has room for an island: 0.85 * 36 less a band of kLeastFeature is 22.6 for the
/// hole, and 0.85 times that less a gap of at most 8 + 2.9 is 8.3 for the island.
constexpr double kLeastRingRadius = 36;

Ring draw_outline(const Disc& disc, Random& random) {
  return round_outline(
      {.centre = disc.centre, .radius = disc.radius, .depth = kDepth, .lobes = 2 + random.below(4)}, random);
}

/// Adds a polygon inside `disc` with a hole, and returns the disc inside the hole that is left for islands.
Disc add_ring(MultiPolygon& shape, const Disc& disc, Random& random) {
  const double inside = kClear * disc.radius;
  const double band = random.between(kLeastFeature, std::max(kLeastFeature, inside / 4));
  const double hole_radius = inside - band;
  Ring shell = draw_outline(disc, random);
  Ring hole = draw_outline({disc.centre, hole_radius}, random);
  std::reverse(hole.begin(), hole.end());
  shape.push_back({.shell = std::move(shell), .holes = {std::move(hole)}});
  const double gap = kLeastFeature + random.between(0, 0.15 * kClear * hole_radius);
  return {disc.centre, kClear * hole_radius - gap};
}

/// Adds 1 to 3 islands in `disc`, whose radius is at least 8.3; as many as there is room for, counting again
/// when there is not.
void add_islands(MultiPolygon& shape, const Disc& disc, Random& random) {
  const std::size_t count = 1 + random.below(3);
  double most = disc.radius;
  if (count > 1) {
    // Circles of one radius that touch the disc from inside and leave a gap between neighbours:
    // 2 * (disc.radius - most) * sine = 2 * most + gap.
    const double sine = unit_vector(0.5 / static_cast<double>(count)).y;
    most = (2 * sine * disc.radius - kLeastFeature) / (2 + 2 * sine);
  }
  // Below this an island is thinner than a feature may be.
  const double least = kLeastFeature / (2 * kClear);
  if (most < least) return add_islands(shape, disc, random);
  const double start = random.uniform();
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = random.between(std::max(least, 0.7 * most), most);
    const Point direction = unit_vector(start + static_cast<double>(i) / static_cast<double>(count));
    const double away = disc.radius - radius;
    const Disc island{{disc.centre.x + away * direction.x, disc.centre.y + away * direction.y}, radius};
    shape.push_back({.shell = draw_outline(island, random), .holes = {}});
  }
}

}  // namespace

MultiPolygon draw_nested(Random& random) {
  MultiPolygon shape;
  Disc room = add_ring(shape, {{0, 0}, kOuterRadius}, random);
  if (random.below(2) == 0) {
    const double radius = random.between(kLeastRingRadius, room.radius);
    const Point direction = unit_vector(random.uniform());
    const double away = room.radius - radius;
    room = add_ring(shape, {{away * direction.x, away * direction.y}, radius}, random);
  }
  add_islands(shape, room, random);
  return shape;
}

}  // namespace hullbench
