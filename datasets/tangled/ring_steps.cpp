#include "datasets/tangled/ring_steps.hpp"

#include <numeric>

#include "datasets/portable_math.hpp"
#include "polylidar/predicates.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

constexpr std::size_t kOutlineVertices = 60;

void turn_by(Ring& ring, const Point& direction) {
  for (Point& vertex : ring) vertex = turned(vertex, direction);
}

}  // namespace

void turn(Ring& ring, double turns) {
  turn_by(ring, unit_vector(turns));
}

void turn(MultiPolygon& shape, double turns) {
  const Point direction = unit_vector(turns);
  for (Polygon& polygon : shape) {
    turn_by(polygon.shell, direction);
    for (Ring& hole : polygon.holes) turn_by(hole, direction);
  }
}

void move(Ring& ring, const Point& offset) {
  for (Point& vertex : ring) vertex = {vertex.x + offset.x, vertex.y + offset.y};
}

void centre_on_origin(Ring& ring) {
  const Box box = polylidar::bounding_box(ring);
  move(ring, {-(box.min.x + box.max.x) / 2, -(box.min.y + box.max.y) / 2});
}

Ring without_straight_corners(Ring ring) {
  std::size_t i = 0;
  while (i < ring.size() && ring.size() > 2) {
    const Point& before = ring[(i + ring.size() - 1) % ring.size()];
    const Point& after = ring[(i + 1) % ring.size()];
    if (polylidar::orient2d(before, ring[i], after) != 0) {
      ++i;
      continue;
    }
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    // What was next to it has a new neighbour.
    i = 0;
  }
  return ring;
}

std::vector<double> random_cuts(std::size_t count, double least, double total, Random& random) {
  std::vector<double> weights(count);
  for (double& weight : weights) weight = random.between(0.05, 1);
  const double all_weights = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double spare = total - static_cast<double>(count) * least;
  std::vector<double> cuts{0};
  for (const double weight : weights) cuts.push_back(cuts.back() + least + spare * weight / all_weights);
  cuts.back() = total;
  return cuts;
}

Ring round_outline(const RoundOutline& outline, Random& random) {
  const auto lobes = static_cast<double>(outline.lobes);
  const double major = random.uniform();
  const double minor = random.uniform();
  Ring ring;
  ring.reserve(kOutlineVertices);
  for (std::size_t i = 0; i < kOutlineVertices; ++i) {
    const double turns = static_cast<double>(i) / kOutlineVertices;
    const double wave =
        0.7 * unit_vector(lobes * turns + major).x + 0.3 * unit_vector((lobes + 1) * turns + minor).x;
    const double radius = outline.radius * (1 - outline.depth * (1 + wave) / 2);
    const Point direction = unit_vector(turns);
    ring.push_back({outline.centre.x + radius * direction.x, outline.centre.y + radius * direction.y});
  }
  return ring;
}

}  // namespace hullbench
