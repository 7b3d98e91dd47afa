#include "adapters/ring_nesting.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "polylidar/predicates.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

constexpr std::size_t kNoRing = static_cast<std::size_t>(-1);

bool is_in_box(const Point& point, const Box& box) {
  return box.min.x <= point.x && point.x <= box.max.x && box.min.y <= point.y && point.y <= box.max.y;
}

// By counting the edges that a ray to the right crosses, each with its lower end and without its upper one.
bool is_inside(const Point& point, const Ring& ring) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& start = ring[i];
    const Point& end = ring[i + 1 == ring.size() ? 0 : i + 1];
    const bool upward = start.y <= point.y && point.y < end.y;
    const bool downward = end.y <= point.y && point.y < start.y;
    if (!upward && !downward) continue;
    const double side = polylidar::orient2d(start, end, point);
    if (upward ? side > 0 : side < 0) inside = !inside;
  }
  return inside;
}

// Ring -> the rings that it lies in.
std::vector<std::vector<std::size_t>> find_containers(const std::vector<Ring>& rings) {
  std::vector<Box> boxes;
  boxes.reserve(rings.size());
  for (const Ring& ring : rings) boxes.push_back(polylidar::bounding_box(ring));
  std::vector<std::vector<std::size_t>> containers(rings.size());
  for (std::size_t inner = 0; inner < rings.size(); ++inner) {
    const Point& point = rings[inner].front();
    for (std::size_t outer = 0; outer < rings.size(); ++outer) {
      if (outer != inner && is_in_box(point, boxes[outer]) && is_inside(point, rings[outer])) {
        containers[inner].push_back(outer);
      }
    }
  }
  return containers;
}

// Of the rings that `ring` lies in, the one that lies in all the others.
std::size_t innermost(const std::vector<std::vector<std::size_t>>& containers, std::size_t ring) {
  return *std::max_element(
      containers[ring].begin(), containers[ring].end(),
      [&](std::size_t a, std::size_t b) { return containers[a].size() < containers[b].size(); });
}

void turn(Ring& ring, bool counter_clockwise) {
  if ((polylidar::signed_area(ring) > 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
}

}  // namespace

MultiPolygon nest_rings(std::vector<Ring> rings) {
  std::erase_if(rings, [](const Ring& ring) { return ring.empty(); });
  const std::vector<std::vector<std::size_t>> containers = find_containers(rings);
  MultiPolygon shape;
  std::vector<std::size_t> polygon_of(rings.size(), kNoRing);  // shell -> its polygon; kNoRing for a hole
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    if (containers[ring].size() % 2 != 0) continue;
    polygon_of[ring] = shape.size();
    turn(rings[ring], true);
    shape.push_back(Polygon{std::move(rings[ring]), {}});
  }
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    if (polygon_of[ring] != kNoRing) continue;
    const std::size_t shell = polygon_of[innermost(containers, ring)];
    turn(rings[ring], false);
    // Only rings that cross can have a hole for their innermost container.
    if (shell == kNoRing) {
      shape.push_back(Polygon{std::move(rings[ring]), {}});
    } else {
      shape[shell].holes.push_back(std::move(rings[ring]));
    }
  }
  return shape;
}

}  // namespace hullbench
