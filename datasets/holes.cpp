#include "datasets/holes.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "datasets/random.hpp"
#include "polylidar/point_locator.hpp"

namespace hullbench {

using polylidar::Box;
using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::PointLocator;
using polylidar::Polygon;
using polylidar::Ring;

namespace {

double squared_distance_to_segment(const Point& point, const Point& start, const Point& end) {
  const double dx = end.x - start.x;
  const double dy = end.y - start.y;
  const double length2 = dx * dx + dy * dy;
  const double along = (point.x - start.x) * dx + (point.y - start.y) * dy;
  const double t = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  const double to_x = start.x + t * dx - point.x;
  const double to_y = start.y + t * dy - point.y;
  return to_x * to_x + to_y * to_y;
}

bool is_clear_of(const Ring& ring, const Point& centre, double distance) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& end = ring[(i + 1) % ring.size()];
    if (squared_distance_to_segment(centre, ring[i], end) < distance * distance) return false;
  }
  return true;
}

bool is_clear_of(const MultiPolygon& shape, const Point& centre, double distance) {
  return std::all_of(shape.begin(), shape.end(), [&](const Polygon& polygon) {
    return is_clear_of(polygon.shell, centre, distance) &&
           std::all_of(polygon.holes.begin(), polygon.holes.end(),
                       [&](const Ring& hole) { return is_clear_of(hole, centre, distance); });
  });
}

/// Draws centres until one fits, and cuts the hole out of the polygon it lies in. `locators`: one for each
/// polygon, without the new holes; a centre inside one of these is nearer than `radius` to its boundary
/// anyway.
void cut_hole(MultiPolygon& shape, const std::vector<PointLocator>& locators, const Box& box, double radius,
              Random& random) {
  for (std::size_t attempt = 0; attempt < kMaxHoleTries; ++attempt) {
    const double x = box.min.x + (box.max.x - box.min.x) * random.uniform();
    const double y = box.min.y + (box.max.y - box.min.y) * random.uniform();
    const Point centre{x, y};
    const auto home = std::find_if(locators.begin(), locators.end(),
                                   [&](const PointLocator& locator) { return locator.contains(centre); });
    if (home == locators.end() || !is_clear_of(shape, centre, 2 * radius)) continue;
    Ring hole = circle_ring(centre, radius);
    std::reverse(hole.begin(), hole.end());
    shape[static_cast<std::size_t>(home - locators.begin())].holes.push_back(std::move(hole));
    return;
  }
  std::ostringstream message;
  message << "no room for another hole of radius " << radius << " after " << kMaxHoleTries
          << " tries; ask for fewer or smaller holes, or another seed";
  throw std::runtime_error(message.str());
}

}  // namespace

std::array<Point, kHoleCorners> hole_directions() {
  constexpr std::size_t kQuarter = kHoleCorners / 4;
  // From 90 degrees halved down to the angle of one step.
  Point step{0, 1};
  for (std::size_t parts = 1; parts < kQuarter; parts *= 2) {
    const double cosine = std::sqrt((1 + step.x) / 2);
    step = {cosine, step.y / (2 * cosine)};
  }
  std::array<Point, kHoleCorners> directions{};
  directions[0] = {1, 0};
  for (std::size_t i = 1; i < kQuarter; ++i) {
    const Point& before = directions[i - 1];
    directions[i] = {before.x * step.x - before.y * step.y, before.x * step.y + before.y * step.x};
  }
  // A quarter turn is exact: no error is carried from one quarter to the next.
  for (std::size_t i = kQuarter; i < kHoleCorners; ++i) {
    const Point& quarter_before = directions[i - kQuarter];
    directions[i] = {-quarter_before.y, quarter_before.x};
  }
  return directions;
}

Ring circle_ring(const Point& centre, double radius) {
  static const std::array<Point, kHoleCorners> directions = hole_directions();
  Ring ring;
  for (const Point& direction : directions) {
    ring.push_back({centre.x + radius * direction.x, centre.y + radius * direction.y});
  }
  return ring;
}

MultiPolygon with_circular_holes(const MultiPolygon& shape, std::size_t count, double radius,
                                 std::uint64_t seed) {
  if (!(radius > 0) || !std::isfinite(radius)) {
    throw std::invalid_argument("the radius of a hole must be a positive, finite length");
  }
  std::vector<PointLocator> locators;
  for (const Polygon& polygon : shape) locators.emplace_back(MultiPolygon{polygon});
  const Box box = PointLocator(shape).bounds();
  MultiPolygon result = shape;
  Random random(seed);
  for (std::size_t i = 0; i < count; ++i) cut_hole(result, locators, box, radius, random);
  return result;
}

}  // namespace hullbench
