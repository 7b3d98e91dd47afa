#include "tests/simple_hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "benchmarks/metrics/validity.hpp"
#include "polylidar/predicates.hpp"
#include "tests/boost_checks.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

/// Whether `point` lies inside the counter-clockwise or clockwise simple `ring` or on it, exactly: an edge
/// that a ray to the right crosses has its lower end at or below the ray and its upper end above.
bool is_covered(const Point& point, const Ring& ring) {
  bool is_inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % ring.size()];
    const double side = polylidar::orient2d(a, b, point);
    if (side == 0 && std::min(a.x, b.x) <= point.x && point.x <= std::max(a.x, b.x) &&
        std::min(a.y, b.y) <= point.y && point.y <= std::max(a.y, b.y)) {
      return true;
    }
    if ((a.y <= point.y) != (b.y <= point.y) && (a.y <= point.y) == (side > 0)) is_inside = !is_inside;
  }
  return is_inside;
}

/// Exact, where a rounded area may not tell: a simple ring is strictly convex at its lowest vertex.
bool runs_counter_clockwise(const Ring& ring) {
  const auto lowest = std::ranges::min_element(
      ring, [](const auto& a, const auto& b) { return a.y < b.y || (a.y == b.y && a.x < b.x); });
  const auto before = lowest == ring.begin() ? ring.end() - 1 : lowest - 1;
  const auto after = lowest + 1 == ring.end() ? ring.begin() : lowest + 1;
  return polylidar::orient2d(*before, *lowest, *after) > 0;
}

}  // namespace

void expect_one_simple_polygon_round(const std::vector<Point>& points, const MultiPolygon& hull) {
  ASSERT_EQ(hull.size(), 1U);
  EXPECT_TRUE(hull[0].holes.empty());
  const Ring& shell = hull[0].shell;
  for (const Point& vertex : shell) {
    EXPECT_NE(std::ranges::find(points, vertex), points.end())
        << vertex.x << " " << vertex.y << " is no point";
  }
  for (const Point& point : points) {
    ASSERT_TRUE(is_covered(point, shell)) << point.x << " " << point.y << " is outside";
  }
  const MultiPolygon scaled = {{polylidar::testing::near_one(shell), {}}};
  EXPECT_EQ(metrics::invalid_reason(scaled), "");
  EXPECT_EQ(boost_fault_in_detail(scaled), "");
  EXPECT_TRUE(runs_counter_clockwise(shell));
}

}  // namespace hullbench::testing
