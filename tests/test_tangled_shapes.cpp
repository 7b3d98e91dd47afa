#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/star_polygons.hpp"
#include "datasets/tangled_shapes.hpp"
#include "tests/boost_checks.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

using polylidar::testing::distance;

// Coordinates up to 200 are rounded to 2.8e-14, a few times over while a shape is laid out, moved and turned.
constexpr double kTangledRounding = 1e-12;

double distance_to_segment(const Point& point, const Point& start, const Point& end) {
  const Point along{end.x - start.x, end.y - start.y};
  const double projection = (point.x - start.x) * along.x + (point.y - start.y) * along.y;
  const double t = std::clamp(projection / (along.x * along.x + along.y * along.y), 0.0, 1.0);
  return distance(point, {start.x + t * along.x, start.y + t * along.y});
}

/// The least distance of vertices of `from` from the edges of `ring`. When both are one ring, an edge counts
/// only when the way to it along the ring is longer than `detour`; an edge that ends at the vertex never
/// does.
double clearance(const Ring& from, const Ring& ring, double detour) {
  const bool same = &from == &ring;
  const std::size_t size = ring.size();
  // travelled[i]: along the ring from vertex 0 to vertex i; one entry more for the way round.
  std::vector<double> travelled{0};
  for (std::size_t i = 0; i < size; ++i) {
    travelled.push_back(travelled.back() + distance(ring[i], ring[(i + 1) % size]));
  }
  const auto way = [&](std::size_t a, std::size_t b) {
    const double forward = std::abs(travelled[a] - travelled[b]);
    return std::min(forward, travelled.back() - forward);
  };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < from.size(); ++i) {
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t next = (k + 1) % size;
      if (same && (i == k || i == next || std::min(way(i, k), way(i, next)) <= detour)) continue;
      least = std::min(least, distance_to_segment(from[i], ring[k], ring[next]));
    }
  }
  return least;
}

double least_feature(const MultiPolygon& shape, double detour) {
  const std::vector<Ring> rings = rings_of(shape);
  double least = std::numeric_limits<double>::infinity();
  for (const Ring& from : rings) {
    for (const Ring& ring : rings) least = std::min(least, clearance(from, ring, detour));
  }
  return least;
}

/// The part of convex `region` to the left of the line from `start` to `end`.
Ring left_part(const Ring& region, const Point& start, const Point& end) {
  const auto side = [&](const Point& p) {
    return (end.x - start.x) * (p.y - start.y) - (end.y - start.y) * (p.x - start.x);
  };
  Ring left;
  for (std::size_t i = 0; i < region.size(); ++i) {
    const Point& a = region[i];
    const Point& b = region[(i + 1) % region.size()];
    const double side_a = side(a);
    const double side_b = side(b);
    if (side_a >= 0) left.push_back(a);
    if ((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) {
      const double t = side_a / (side_a - side_b);
      left.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  }
  return left;
}

/// The area of the points of a counter-clockwise `ring` that see all of it: what is to the left of every
/// edge.
double kernel_area(const Ring& ring) {
  Ring kernel{{-500, -500}, {500, -500}, {500, 500}, {-500, 500}};
  for (std::size_t i = 0; i < ring.size() && !kernel.empty(); ++i) {
    kernel = left_part(kernel, ring[i], ring[(i + 1) % ring.size()]);
  }
  return polylidar::signed_area(kernel);
}

TEST(KernelArea, TellsStarShapedRingsFromOthers) {
  EXPECT_EQ(kernel_area({{0, 0}, {10, 0}, {10, 10}, {0, 10}}), 100);
  // An L is star-shaped: the kernel is its corner. A U is not.
  EXPECT_EQ(kernel_area({{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 10}, {0, 10}}), 4);
  EXPECT_EQ(kernel_area({{0, 0}, {10, 0}, {10, 10}, {8, 10}, {8, 2}, {2, 2}, {2, 10}, {0, 10}}), 0);
  EXPECT_GT(kernel_area(star_polygon(48).front().shell), 0);
}

TEST(LeastFeature, SeesThinPartsAndNarrowGaps) {
  const auto u_shape = [](double wall, double gap) {
    const double width = 2 * wall + gap;
    return MultiPolygon{{.shell = {{0, 0},
                                   {width, 0},
                                   {width, 50},
                                   {width - wall, 50},
                                   {width - wall, 20},
                                   {wall, 20},
                                   {wall, 50},
                                   {0, 50}},
                         .holes = {}}};
  };
  EXPECT_EQ(least_feature(u_shape(10, 9), 0), 9);
  EXPECT_EQ(least_feature(u_shape(7, 9), 0), 7);
  // Both ends of the gap are farther apart along the ring.
  EXPECT_EQ(least_feature(u_shape(10, 6), 24), 6);
}

TEST(TangledKinds, HaveTheirNamesAndAThousandShapes) {
  std::vector<std::string> names;
  std::size_t shapes = 0;
  for (const TangledKind kind : kTangledKinds) {
    names.push_back(tangled_name(kind));
    shapes += tangled_count(kind);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"comb", "spiral", "partition", "walk", "nested", "parts"}));
  EXPECT_EQ(shapes, 1000U);
  EXPECT_EQ(tangled_count(TangledKind::kWalk), 167U);
  EXPECT_EQ(tangled_count(TangledKind::kNested), 166U);
}

TEST(TangledKinds, AnIndexBeyondTheLastIsAnError) {
  EXPECT_NO_THROW(tangled_shape(TangledKind::kComb, 166));
  EXPECT_EQ(complaint_of<std::invalid_argument>([] { tangled_shape(TangledKind::kNested, 166); }),
            "there is no shape 166 of kind 'nested'; the last one is 165");
}

class Tangled : public ::testing::TestWithParam<TangledKind> {
 protected:
  /// Calls `look(shape, index)` for every shape of the kind.
  template <typename Look>
  void for_all(Look look) {
    for (std::size_t index = 0; index < tangled_count(GetParam()); ++index) {
      look(tangled_shape(GetParam(), index), index);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Kinds, Tangled, ::testing::ValuesIn(kTangledKinds),
                         [](const auto& kind) { return tangled_name(kind.param); });

TEST_P(Tangled, ShapesAreValidWithRingsTheRightWayRound) {
  for_all([](const MultiPolygon& shape, std::size_t index) {
    EXPECT_EQ(boost_fault(shape), "") << index;
    for (const Polygon& polygon : shape) {
      EXPECT_GT(polylidar::signed_area(polygon.shell), 0) << index;
      for (const Ring& hole : polygon.holes) EXPECT_LT(polylidar::signed_area(hole), 0) << index;
    }
  });
}

TEST_P(Tangled, NoPointSeesAWholeShape) {
  for_all([](const MultiPolygon& shape, std::size_t index) {
    // Of several polygons, or round a hole, no point sees everything.
    if (shape.size() > 1 || !shape.front().holes.empty()) return;
    EXPECT_EQ(kernel_area(shape.front().shell), 0) << index;
  });
}

TEST_P(Tangled, NothingIsThinAndNoGapIsNarrow) {
  // On outlines that bend gently, an edge is near every vertex. There a feature is where the way round is
  // long: three times the least feature is more than half the circumference of a disc that wide, 12.6.
  const std::set<TangledKind> bent{TangledKind::kSpiral, TangledKind::kNested, TangledKind::kParts};
  const double detour = bent.contains(GetParam()) ? 3 * kLeastFeature : 0;
  double least = std::numeric_limits<double>::infinity();
  for_all([&](const MultiPolygon& shape, std::size_t index) {
    const double found = least_feature(shape, detour);
    EXPECT_GE(found, kLeastFeature - kTangledRounding) << index;
    least = std::min(least, found);
  });
  RecordProperty("least_feature", std::to_string(least));
}

TEST_P(Tangled, ShapesAreAsLargeAsDocumented) {
  for_all([](const MultiPolygon& shape, std::size_t index) {
    Ring vertices;
    for (const Polygon& polygon : shape) {
      vertices.insert(vertices.end(), polygon.shell.begin(), polygon.shell.end());
    }
    double across = 0;
    for (const Point& a : vertices) {
      for (const Point& b : vertices) across = std::max(across, distance(a, b));
    }
    EXPECT_LT(polylidar::area(shape), 24'000) << index;
    EXPECT_GE(across, 100) << index;
    EXPECT_LE(across, 311.2) << index;  // the diagonal of the square that parts are laid out in
  });
}

TEST_P(Tangled, IndicesGiveDifferentShapes) {
  std::set<double> areas;
  for_all([&](const MultiPolygon& shape, std::size_t) { areas.insert(polylidar::area(shape)); });
  EXPECT_EQ(areas.size(), tangled_count(GetParam()));
}

/// How often each number of something comes up among the shapes of `kind`.
template <typename Count>
std::map<std::size_t, std::size_t> tally(TangledKind kind, Count count) {
  std::map<std::size_t, std::size_t> found;
  for (std::size_t index = 0; index < tangled_count(kind); ++index) {
    ++found[count(tangled_shape(kind, index))];
  }
  return found;
}

std::size_t first_key(const std::map<std::size_t, std::size_t>& tally) {
  return tally.begin()->first;
}

std::size_t last_key(const std::map<std::size_t, std::size_t>& tally) {
  return tally.rbegin()->first;
}

TEST(Combs, HaveFourToNineTeeth) {
  // The bar has four corners and every tooth four more; where a tooth is flush with one of the bar's four
  // ends, a corner of each disappears.
  const auto corners =
      tally(TangledKind::kComb, [](const MultiPolygon& shape) { return shape.front().shell.size(); });
  EXPECT_GE(first_key(corners), 4 * 4 + 4 - 2 * 4U);
  EXPECT_LE(last_key(corners), 4 * 9 + 4U);
  EXPECT_GE(corners.size(), 8U);
}

TEST(Partitions, HaveThirtyToEightyVertices) {
  const auto vertices =
      tally(TangledKind::kPartition, [](const MultiPolygon& shape) { return shape.front().shell.size(); });
  EXPECT_GE(first_key(vertices), 30U);
  EXPECT_LE(last_key(vertices), 80U);
  EXPECT_GE(vertices.size(), 40U);
}

TEST(Walks, HaveOnlyCorners) {
  for (std::size_t index = 0; index < tangled_count(TangledKind::kWalk); ++index) {
    const Ring ring = tangled_shape(TangledKind::kWalk, index).front().shell;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point& before = ring[(i + ring.size() - 1) % ring.size()];
      const Point& after = ring[(i + 1) % ring.size()];
      const double dot =
          (ring[i].x - before.x) * (after.x - ring[i].x) + (ring[i].y - before.y) * (after.y - ring[i].y);
      // A right angle between edges up to 200 long, whose ends are rounded.
      EXPECT_NEAR(dot, 0, 400 * kTangledRounding) << index;
    }
  }
}

TEST(NestedRings, AreOneOrTwoRoundOneToThreeIslands) {
  const auto rings = tally(TangledKind::kNested, polylidar::testing::hole_count);
  EXPECT_EQ(first_key(rings), 1U);
  EXPECT_EQ(last_key(rings), 2U);
  const auto islands = tally(TangledKind::kNested, [](const MultiPolygon& shape) {
    return shape.size() - polylidar::testing::hole_count(shape);
  });
  EXPECT_EQ(first_key(islands), 1U);
  EXPECT_EQ(last_key(islands), 3U);
}

TEST(Parts, AreThreeToSevenWithoutHoles) {
  const auto parts = tally(TangledKind::kParts, [](const MultiPolygon& shape) { return shape.size(); });
  EXPECT_EQ(first_key(parts), 3U);
  EXPECT_EQ(last_key(parts), 7U);
  EXPECT_EQ(last_key(tally(TangledKind::kParts, polylidar::testing::hole_count)), 0U);
}

}  // namespace
}  // namespace hullbench::testing
