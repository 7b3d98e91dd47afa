// The concave hull by its invariants and known shapes. Needs nothing but the core.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/checked_hull.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/infinity.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::area_tolerance;
using testing::canonical;
using testing::convex_corners;
using testing::hole_count;
using testing::kUnitCells;
using testing::lattice;
using testing::PointSet;
using testing::strict_corners;

using hullbench::testing::kInfinity;

MultiPolygon hull(const std::vector<Point>& points, const Options& options = testing::kConvexHull) {
  return testing::checked_hull(points, options);
}

std::vector<Point> without(std::vector<Point> points, const std::vector<Point>& removed) {
  std::erase_if(
      points, [&](const Point& p) { return std::find(removed.begin(), removed.end(), p) != removed.end(); });
  return points;
}

void expect_the_shape_of_its_triangles(const std::vector<Point>& points) {
  testing::expect_the_shapes_of_their_triangles(points, testing::clear_options(points, delaunay(points)));
}

// any input

TEST(SignedArea, OfLargeCoordinatesIsRightWhereItIsANumber) {
  const double far = 0x1p515;
  const Ring sliver = {{0, 0}, {far, far}, {far, far + 0x1p485}};
  EXPECT_EQ(signed_area(sliver), 0x1p999);
  EXPECT_EQ(signed_area(Ring(sliver.rbegin(), sliver.rend())), -0x1p999);
  EXPECT_EQ(signed_area(Ring{{0, 0}, {2e200, 1e200}, {1e200, 2e200}}), kNoLimit) << "no double is that large";
}

TEST(ConcaveHull, IsTheShapeOfItsTriangles) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    expect_the_shape_of_its_triangles(set.points);
  }
}

TEST(ConcaveHull, IsTheShapeOfItsTrianglesOnRandomPoints) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_the_shape_of_its_triangles(seed % 2 == 0 ? testing::uniform_points(20 + 2 * seed, seed)
                                                    : testing::integer_points(20 + 2 * seed, seed, 24));
  }
}

TEST(ConcaveHull, WithoutLimitsIsTheConvexHull) {
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const MultiPolygon shape = hull(set.points);
    if (shape.empty() || !testing::has_representable_area(set.points)) continue;
    ASSERT_EQ(shape.size(), 1U);
    EXPECT_TRUE(shape[0].holes.empty());
    EXPECT_EQ(canonical({{strict_corners(shape[0].shell), {}}}),
              canonical({{convex_corners(set.points), {}}}));
  }
}

TEST(ConcaveHull, OfNothingIsEmpty) {
  for (const PointSet& set : testing::flat_point_sets()) {
    SCOPED_TRACE(set.name);
    EXPECT_TRUE(hull(set.points).empty());
    EXPECT_TRUE(hull(set.points, kUnitCells).empty());
  }
}

TEST(ConcaveHull, OfThreePointsIsTheirTriangle) {
  const MultiPolygon triangle = {{{{0, 0}, {4, 0}, {0, 3}}, {}}};
  EXPECT_EQ(canonical(hull({{0, 0}, {4, 0}, {0, 3}})), triangle);
  EXPECT_EQ(canonical(hull({{0, 3}, {4, 0}, {0, 0}})), triangle) << "whatever the order";
}

// the limits

TEST(ConcaveHull, LimitsAreInclusive) {
  const std::vector<Point> points = {{0, 0}, {4, 0}, {0, 3}};  // circumradius 2.5, longest edge 5: both exact
  EXPECT_EQ(hull(points, {.alpha = 2.5}).size(), 1U);
  EXPECT_EQ(hull(points, {.alpha = std::nextafter(2.5, 0)}).size(), 0U);
  EXPECT_EQ(hull(points, {.max_edge_length = 5}).size(), 1U);
  EXPECT_EQ(hull(points, {.max_edge_length = std::nextafter(5, 0)}).size(), 0U);
  EXPECT_EQ(hull(points, {.max_perimeter = 12}).size(), 1U);
  EXPECT_EQ(hull(points, {.max_perimeter = std::nextafter(12, 0)}).size(), 0U);
  EXPECT_EQ(hull(points, {.alpha = 2.5, .max_edge_length = 4.9}).size(), 0U);
  EXPECT_EQ(hull(points, {.max_edge_length = 4.9, .max_perimeter = 12}).size(), 0U);
  EXPECT_EQ(hull(points, {.alpha = 2.4, .max_edge_length = 5}).size(), 0U);
}

// The area of the triangles beyond the limit whose neighbours are all within it. A limit on edges leaves
// none: its long edge is a neighbour's too.
double area_of_single_triangles(const std::vector<Point>& points, double max_perimeter) {
  const Triangulation t = delaunay(points);
  const auto corner = [&](std::size_t e) { return points[t.triangles[e]]; };
  const auto is_kept = [&](std::size_t triangle) {
    double perimeter = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = corner(3 * triangle + k);
      const Point b = corner(3 * triangle + (k + 1) % 3);
      perimeter += std::hypot(a.x - b.x, a.y - b.y);
    }
    return perimeter <= max_perimeter;
  };
  double sum = 0;
  for (std::size_t e = 0; e < t.triangles.size(); e += 3) {
    const auto is_kept_beyond = [&](std::size_t k) {
      return t.halfedges[e + k] != kNone && is_kept(t.halfedges[e + k] / 3);
    };
    if (is_kept(e / 3) || !is_kept_beyond(0) || !is_kept_beyond(1) || !is_kept_beyond(2)) continue;
    sum += area({{{corner(e), corner(e + 1), corner(e + 2)}, {}}});
  }
  return sum;
}

TEST(ConcaveHull, FillsSingleTrianglesIfAsked) {
  double total = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<Point> points = testing::uniform_points(1000, seed);
    for (const double limit : {0.13, 0.16, 0.2}) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", limit " + std::to_string(limit));
      const double single = area_of_single_triangles(points, limit);
      const double without = area(hull(points, {.max_perimeter = limit}));
      const double with = area(hull(points, {.max_perimeter = limit, .fill_single_triangles = true}));
      EXPECT_NEAR(with, without + single, area_tolerance(points));
      total += single;
    }
  }
  EXPECT_GT(total, 0) << "there was something to fill";
}

TEST(ConcaveHull, OfZeroLimitsIsEmpty) {
  const std::vector<Point> points = testing::uniform_points(100, 1);
  EXPECT_TRUE(hull(points, {.alpha = 0}).empty());
  EXPECT_TRUE(hull(points, {.max_edge_length = 0}).empty());
  EXPECT_TRUE(hull(points, {.max_perimeter = 0}).empty());
  EXPECT_TRUE(hull(points, {.alpha = 5e-324}).empty());
}

TEST(ConcaveHull, RefusesLimitsThatAreNoLengths) {
  const std::vector<Point> points = testing::uniform_points(10, 1);
  for (const double bad : {-1.0, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(concave_hull(points, {.alpha = bad}), std::invalid_argument) << bad;
    EXPECT_THROW(concave_hull(points, {.max_edge_length = bad}), std::invalid_argument) << bad;
    EXPECT_THROW(concave_hull(points, {.max_perimeter = bad}), std::invalid_argument) << bad;
    EXPECT_THROW(concave_hull({}, {.alpha = bad}), std::invalid_argument) << bad << " even for no points";
  }
}

TEST(ConcaveHull, NamesTheFirstCoordinateThatIsNotFinite) {
  std::vector<Point> points = testing::uniform_points(500, 2);
  points[499].x = kInfinity;
  points[317].y = std::numeric_limits<double>::quiet_NaN();
  hullbench::testing::expect_complaint<std::invalid_argument>([&] { concave_hull(points, kUnitCells); },
                                                              "317");
}

// rings that touch

TEST(ConcaveHull, TrianglesThatShareAVertexAreTwoPolygons) {
  const std::vector<Point> points = {{0, 0}, {-2, 1}, {-2, -1}, {2, 1}, {2, -1}};
  const MultiPolygon expected = {{{{-2, -1}, {0, 0}, {-2, 1}}, {}}, {{{0, 0}, {2, -1}, {2, 1}}, {}}};
  EXPECT_EQ(canonical(hull(points, {.max_edge_length = 2.5})), expected);
}

// A lattice point left out leaves a diamond of side sqrt(2) round its place.
TEST(ConcaveHull, AHoleIsARingOfItsOwn) {
  const MultiPolygon shape = hull(without(lattice(5, 5), {{2, 2}}), kUnitCells);
  ASSERT_EQ(shape.size(), 1U);
  EXPECT_EQ(shape[0].shell.size(), 16U);
  const MultiPolygon expected_hole = {{{{1, 2}, {2, 3}, {3, 2}, {2, 1}}, {}}};
  ASSERT_EQ(shape[0].holes.size(), 1U);
  EXPECT_EQ(canonical({{shape[0].holes[0], {}}}), expected_hole) << "clockwise";
}

TEST(ConcaveHull, AHoleThatTouchesTheShellStaysAHole) {
  const MultiPolygon shape = hull(without(lattice(5, 5), {{1, 2}}), kUnitCells);
  ASSERT_EQ(shape.size(), 1U);
  EXPECT_EQ(shape[0].shell.size(), 16U);
  ASSERT_EQ(shape[0].holes.size(), 1U);
  EXPECT_EQ(shape[0].holes[0].size(), 4U);
  EXPECT_EQ(area(shape), 14);
}

TEST(ConcaveHull, HolesThatTouchStayApart) {
  const MultiPolygon shape = hull(without(lattice(7, 5), {{2, 2}, {4, 2}}), kUnitCells);
  ASSERT_EQ(shape.size(), 1U);
  ASSERT_EQ(shape[0].holes.size(), 2U);
  EXPECT_EQ(shape[0].holes[0].size(), 4U);
  EXPECT_EQ(shape[0].holes[1].size(), 4U);
  EXPECT_EQ(area(shape), 20);
}

// Round the origin four wide triangles and four narrow ones take turns; the limit leaves the wide ones out.
TEST(ConcaveHull, FourHolesRoundAVertexStayApart) {
  std::vector<Point> points = {{0, 0}};
  for (const Point& p : {Point{9, 5}, {5, 9}, {16, 0}, {15, 6}, {11, 11}, {6, 15}}) {
    for (const Point& turned : {p, Point{-p.y, p.x}, {-p.x, -p.y}, {p.y, -p.x}}) points.push_back(turned);
  }
  const MultiPolygon shape = hull(points, {.max_perimeter = 28});
  ASSERT_EQ(shape.size(), 1U);
  EXPECT_EQ(shape[0].shell.size(), 16U);
  ASSERT_EQ(shape[0].holes.size(), 4U);
  for (const Ring& hole : shape[0].holes) {
    EXPECT_EQ(hole.size(), 3U);
    EXPECT_EQ(std::count(hole.begin(), hole.end(), Point{0, 0}), 1);
  }
  EXPECT_EQ(area(shape), 780 - 4 * 45);
}

TEST(ConcaveHull, HolesThatCutAcrossMakeTwoPolygons) {
  const MultiPolygon shape = hull(without(lattice(5, 5), {{1, 2}, {3, 2}}), kUnitCells);
  ASSERT_EQ(shape.size(), 2U);
  EXPECT_EQ(hole_count(shape), 0U);
  EXPECT_EQ(area(shape), 12);
}

TEST(ConcaveHull, ListsAShapeInOneWay) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Point> points = testing::uniform_points(600, seed);
    const IndexedMultiPolygon shape = concave_hull(points, {.alpha = 0.035});
    std::size_t begin = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> first_edges;
    for (const std::uint32_t end : shape.ring_ends) {
      const auto ring = shape.vertices.begin() + static_cast<std::ptrdiff_t>(begin);
      EXPECT_EQ(std::min_element(ring, shape.vertices.begin() + end), ring);
      first_edges.emplace_back(ring[0], ring[1]);
      begin = end;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> shells;
    std::size_t ring = 0;
    for (const std::uint32_t end : shape.polygon_ends) {
      shells.push_back(first_edges[ring]);
      EXPECT_TRUE(std::is_sorted(first_edges.begin() + static_cast<std::ptrdiff_t>(ring) + 1,
                                 first_edges.begin() + end));
      ring = end;
    }
    EXPECT_GT(shells.size(), 1U);
    EXPECT_TRUE(std::is_sorted(shells.begin(), shells.end()));
  }
}

TEST(ConcaveHull, AnIslandInAHoleIsAPolygon) {
  std::vector<Point> points = without(lattice(9, 9), lattice(5, 5, 1, {2, 2}));
  for (const Point& point : lattice(2, 2, 1, {4, 4})) points.push_back(point);
  const MultiPolygon shape = canonical(hull(points, kUnitCells));
  ASSERT_EQ(shape.size(), 2U);
  EXPECT_EQ(shape[0].shell.size(), 32U);
  ASSERT_EQ(shape[0].holes.size(), 1U);
  const MultiPolygon island = {{{{4, 4}, {5, 4}, {5, 5}, {4, 5}}, {}}};
  EXPECT_EQ(MultiPolygon{shape[1]}, island);
  EXPECT_EQ(area(shape), 64 - 34 + 1);
}

// lattices with points left out at random: the shape follows from the cells alone

// A cell has the number of its lower left lattice point. The outermost points are absent, so neighbours
// exist.
class CellShape {
 public:
  CellShape(std::size_t side, std::vector<bool> present)
      : side_(side), present_(std::move(present)), component_(present_.size()) {
    for (std::size_t cell = 0; cell < present_.size(); ++cell) {
      if (component_[cell] == 0 && corners(cell).size() >= 3) fill(cell, ++polygons_);
    }
  }

  std::size_t polygons() const { return polygons_; }

  // Twice the area: a cell with all corners is kept whole, one with three as a triangle.
  std::size_t twice_area() const {
    std::size_t sum = 0;
    for (std::size_t cell = 0; cell < present_.size(); ++cell) {
      if (component_[cell] != 0) sum += corners(cell).size() - 2;
    }
    return sum;
  }

  // A closed, connected region with h holes has vertices - edges + cells = 1 - h.
  std::size_t holes() const {
    std::set<std::pair<std::size_t, std::size_t>> vertices;  // with their component
    std::set<std::pair<std::size_t, std::size_t>> edges;
    std::size_t cells = 0;
    for (std::size_t cell = 0; cell < present_.size(); ++cell) {
      if (component_[cell] == 0) continue;
      ++cells;
      const std::vector<std::size_t> around = corners(cell);
      for (std::size_t i = 0; i < around.size(); ++i) {
        vertices.emplace(around[i], component_[cell]);
        edges.insert(std::minmax(around[i], around[(i + 1) % around.size()]));
      }
    }
    return polygons_ + edges.size() - vertices.size() - cells;
  }

 private:
  // The lattice points that a cell has, in order round it.
  std::vector<std::size_t> corners(std::size_t cell) const {
    std::vector<std::size_t> around;
    for (const std::size_t point : {cell, cell + 1, cell + side_ + 1, cell + side_}) {
      if (point < present_.size() && present_[point]) around.push_back(point);
    }
    return around;
  }

  // Whether the lattice edge between two neighbouring cells is there.
  bool joined(std::size_t cell, std::size_t other) const {
    const std::size_t low = std::max(cell, other);
    const std::size_t step = low - std::min(cell, other);
    return present_[low] && present_[low + (step == 1 ? side_ : 1)];
  }

  void fill(std::size_t start, std::size_t component) {
    std::vector<std::size_t> stack = {start};
    component_[start] = component;
    while (!stack.empty()) {
      const std::size_t cell = stack.back();
      stack.pop_back();
      for (const std::size_t other : {cell - 1, cell + 1, cell - side_, cell + side_}) {
        if (component_[other] != 0 || corners(other).size() < 3 || !joined(cell, other)) continue;
        component_[other] = component;
        stack.push_back(other);
      }
    }
  }

  std::size_t side_;
  std::vector<bool> present_;           // lattice point -> whether it is there
  std::vector<std::size_t> component_;  // cell -> number of its component from 1; 0 when not kept
  std::size_t polygons_ = 0;
};

TEST(ConcaveHull, OfALatticeWithGapsFollowsFromItsCells) {
  constexpr std::size_t kSide = 16;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Random random(seed);
    const double density = random.between(0.3, 0.97);
    std::vector<bool> present(kSide * kSide);
    std::vector<Point> points;
    for (std::size_t row = 1; row + 1 < kSide; ++row) {
      for (std::size_t column = 1; column + 1 < kSide; ++column) {
        if (random.unit() > density) continue;
        present[row * kSide + column] = true;
        points.push_back({static_cast<double>(column), static_cast<double>(row)});
      }
    }
    const MultiPolygon shape = hull(testing::shuffled(points, seed), kUnitCells);
    const CellShape expected(kSide, present);
    EXPECT_EQ(2 * area(shape), static_cast<double>(expected.twice_area()));
    EXPECT_EQ(shape.size(), expected.polygons());
    EXPECT_EQ(hole_count(shape), expected.holes());
  }
}

// memory kept between calls

TEST(Extractor, GivesTheSameWhateverCameBefore) {
  Extractor extractor;
  for (int round = 0; round < 2; ++round) {
    for (const PointSet& set : testing::nasty_point_sets()) {
      SCOPED_TRACE(set.name);
      for (const Options& options : testing::clear_options(set.points, delaunay(set.points))) {
        SCOPED_TRACE(testing::describe(options));
        EXPECT_EQ(extractor.extract(set.points, options), concave_hull(set.points, options));
      }
    }
  }
}

TEST(Extractor, ItsStepsCanBeRepeated) {
  const std::vector<Point> points = testing::uniform_points(1000, 5);
  Extractor extractor;
  extractor.triangulate(points);
  for (const double alpha : {0.05, 0.02, 0.1, kInfinity, 0.05}) {
    extractor.extract_regions({.alpha = alpha});
    EXPECT_EQ(extractor.extract_polygons(), concave_hull(points, {.alpha = alpha})) << alpha;
    EXPECT_EQ(extractor.extract_polygons(), concave_hull(points, {.alpha = alpha})) << alpha << ", again";
  }
}

TEST(Extractor, WorksAfterAnError) {
  const std::vector<Point> points = testing::uniform_points(200, 6);
  const Options options{.alpha = 0.1};
  const IndexedMultiPolygon expected = concave_hull(points, options);
  Extractor extractor;
  extractor.extract(points, options);
  std::vector<Point> bad = points;
  bad[100].x = kInfinity;
  EXPECT_THROW(extractor.extract(bad, options), std::invalid_argument);
  EXPECT_EQ(extractor.extract(points, options), expected);
  EXPECT_THROW(extractor.extract(points, {.alpha = -1}), std::invalid_argument);
  EXPECT_EQ(extractor.extract(points, options), expected);
}

// Points that are refused for one of them, for their range, and options that are refused.
void expect_all_refused(Extractor& extractor) {
  std::vector<Point> points = testing::uniform_points(500, 8);
  for (const Options& bad : {Options{.alpha = -1}, Options{.max_edge_length = -1},
                             Options{.max_perimeter = -1}, Options{.threads = 0}}) {
    EXPECT_THROW(extractor.extract(points, bad), std::invalid_argument);
    EXPECT_THROW(extractor.extract_regions(bad), std::invalid_argument);
  }
  points[100].y = 1e-300;
  EXPECT_THROW(extractor.triangulate(points), std::invalid_argument);
  points[100].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(extractor.triangulate(points), std::invalid_argument);
  EXPECT_THROW(extractor.extract(points), std::invalid_argument);
}

TEST(Extractor, HasNoTrianglesOfPointsThatWereRefused) {
  Extractor extractor;
  expect_all_refused(extractor);
  EXPECT_FALSE(extractor.has_triangles());
}

TEST(Extractor, IsAsItWasAfterPointsOrOptionsAreRefused) {
  const std::vector<Point> points = testing::uniform_points(200, 6);
  const Options options{.alpha = 0.1};
  const IndexedMultiPolygon expected = concave_hull(points, options);
  Extractor extractor;
  extractor.extract(points, options);
  expect_all_refused(extractor);
  EXPECT_TRUE(extractor.has_triangles());
  EXPECT_EQ(extractor.limits(), Limits{.alpha = 0.1});
  EXPECT_EQ(extractor.extract_polygons(), expected);
  extractor.extract_regions(options);
  EXPECT_EQ(extractor.extract_polygons(), expected);
}

TEST(Extractor, CanBeMoved) {
  const std::vector<Point> points = testing::uniform_points(200, 7);
  Extractor first;
  first.triangulate(points);
  Extractor second = std::move(first);
  second.extract_regions({.alpha = 0.1});
  EXPECT_EQ(second.extract_polygons(), concave_hull(points, {.alpha = 0.1}));
}

// the checker itself

TEST(CheckPolygon, SeesEveryKindOfFault) {
  const std::vector<Point> points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 2},
                                     {2, 2}, {2, 1}, {9, 9}, {8, 2}, {0, 2}};
  const auto fault = [&](const IndexedMultiPolygon& shape) { return check_polygon(points, shape); };
  EXPECT_EQ(fault({}), "");
  EXPECT_EQ(fault({{0, 1, 2, 3}, {4}, {1}}), "");
  EXPECT_EQ(fault({{0, 1, 2, 3, 4, 5, 6, 7}, {4, 8}, {2}}), "") << "a hole";
  EXPECT_EQ(fault({{3, 2, 1, 0}, {4}, {1}}), "ring 0 runs the wrong way round");
  EXPECT_EQ(fault({{0, 1, 2, 3, 7, 6, 5, 4}, {4, 8}, {2}}), "ring 1 runs the wrong way round");
  EXPECT_EQ(fault({{0, 1, 3, 2}, {4}, {1}}), "rings 0 and 0 cross or overlap") << "a bow-tie";
  EXPECT_EQ(fault({{0, 1}, {2}, {1}}), "ring 0 has fewer than 3 vertices");
  EXPECT_EQ(fault({{0, 1, 99}, {3}, {1}}), "vertex 2 is no point");
  EXPECT_EQ(fault({{0, 1, 2, 0}, {4}, {1}}), "ring 0 visits a point twice");
  EXPECT_EQ(fault({{0, 1, 2, 3, 0, 1, 2}, {4, 7}, {1, 2}}), "rings 0 and 1 cross or overlap");
  EXPECT_EQ(fault({{0, 1, 2, 3, 7, 6, 5}, {4, 7}, {1, 2}}), "polygons 0 and 1 overlap") << "one inside";
  EXPECT_EQ(fault({{4, 7, 6, 5, 0, 3, 2, 1}, {4, 8}, {2}}), "hole 1 lies outside its shell") << "round it";
  EXPECT_EQ(fault({{0, 1, 2, 3, 0, 7, 6}, {4, 7}, {1, 2}}), "polygons 0 and 1 overlap") << "touching";
  EXPECT_EQ(fault({{0, 1, 2, 3, 10, 7, 6}, {4, 7}, {1, 2}}), "rings 0 and 1 cross or overlap")
      << "touching, but not in a vertex of both";
  EXPECT_EQ(fault({{0, 1, 2, 3}, {4}, {1, 1}}), "polygon 1 has no rings or too many");
  EXPECT_EQ(fault({{0, 1, 2, 3, 8}, {4}, {1}}), "vertices outside any polygon");
}

TEST(CheckPolygon, SeesAnInteriorThatIsCutApart) {
  const std::vector<Point> points = {{0, 0}, {4, 0}, {4, 2}, {4, 4}, {0, 4}, {0, 2}, {2, 3}, {2, 1}};
  EXPECT_EQ(check_polygon(points, {{0, 1, 2, 3, 4, 5, 5, 6, 2, 7}, {6, 10}, {2}}),
            "the interior of polygon 0 is not connected");
  EXPECT_EQ(check_polygon(points, {{0, 1, 2, 3, 4, 5, 5, 6, 7}, {6, 9}, {2}}), "")
      << "touching once is allowed";
}

}  // namespace
}  // namespace polylidar
