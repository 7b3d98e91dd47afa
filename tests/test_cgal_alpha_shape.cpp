// The CGAL adapter: its contract, its polygons against CGAL's own edges, and the core's shape against it.
#include <CGAL/Alpha_shape_2.h>
#include <CGAL/Alpha_shape_face_base_2.h>
#include <CGAL/Alpha_shape_vertex_base_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/validity.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "polylidar/point_locator.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/infinity.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

using polylidar::Options;
using polylidar::PointLocator;
using polylidar::testing::PointSet;

MultiPolygon run(const std::vector<Point>& points, double radius) {
  return hull_of(*make_cgal_alpha_shape(), points, {{"alpha", radius * radius}});
}

// Limits that no triangle is near to, so that both filters must come to the same.
std::vector<double> clear_radii(const std::vector<Point>& points) {
  std::vector<double> radii;
  for (const Options& options : polylidar::testing::clear_options(points, polylidar::delaunay(points))) {
    if (options.alpha && !options.max_edge_length && !options.max_perimeter) radii.push_back(*options.alpha);
  }
  return radii;
}

TEST(CgalAlphaShape, NamesTheFirstCoordinateThatIsNotFinite) {
  std::vector<Point> points = polylidar::testing::uniform_points(500, 1);
  points[317].y = kInfinity;
  points[400].x = std::nan("");
  expect_complaint<std::invalid_argument>([&] { make_cgal_alpha_shape()->load(points); }, "317");
}

TEST(CgalAlphaShape, OfNothingIsEmpty) {
  for (const PointSet& set : polylidar::testing::flat_point_sets()) {
    SCOPED_TRACE(set.name);
    EXPECT_TRUE(run(set.points, 1).empty());
    EXPECT_TRUE(run(set.points, kInfinity).empty());
    EXPECT_TRUE(run(set.points, 0).empty()) << "of no alpha given";
  }
  EXPECT_TRUE(run(polylidar::testing::uniform_points(100, 1), 1e-9).empty());
}

TEST(CgalAlphaShape, AlphaIsASquaredRadiusAndInclusive) {
  const std::vector<Point> points = {{0, 0}, {4, 0}, {0, 3}};  // circumradius 2.5, exact
  const MultiPolygon triangle = {{{{0, 0}, {4, 0}, {0, 3}}, {}}};
  EXPECT_EQ(canonical(run(points, 2.5)), triangle);
  EXPECT_TRUE(run(points, 2.499).empty());
}

// A shape that CGAL builds straight from the points, as a user of it does.
struct CgalsOwn {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Vertex = CGAL::Alpha_shape_vertex_base_2<Kernel>;
  using Face = CGAL::Alpha_shape_face_base_2<Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex, Face>>;
  using Shape = CGAL::Alpha_shape_2<Delaunay>;

  static std::vector<Kernel::Point_2> converted(const std::vector<Point>& points) {
    std::vector<Kernel::Point_2> result;
    result.reserve(points.size());
    for (const Point& point : points) result.emplace_back(point.x, point.y);
    return result;
  }
};

// What CGAL's manual promises of this alpha: one component, and every point a vertex of a triangle inside.
TEST(CgalAlphaShape, WithoutAlphaTakesCgalsOptimalOne) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Point> points = polylidar::testing::uniform_points(20 + 100 * seed, seed);
    std::erase_if(points, [](const Point& p) { return std::hypot(p.x - 0.4, p.y - 0.5) < 0.2; });
    const auto adapter = make_cgal_alpha_shape();
    const MultiPolygon shape = hull_of(*adapter, points, {});

    const auto converted = CgalsOwn::converted(points);
    CgalsOwn::Shape cgal(converted.begin(), converted.end());
    EXPECT_EQ(hull_of(*adapter, points, {{"alpha", *cgal.find_optimal_alpha(1)}}), shape);
    EXPECT_EQ(shape.size(), 1U);
    const PointLocator inside(shape);
    EXPECT_TRUE(std::ranges::all_of(points, [&](const Point& p) { return inside.contains(p); }));
    EXPECT_LT(polylidar::area(shape), polylidar::area(run(points, kInfinity))) << "the convex hull";
  }
}

// Edges as sorted end points, in order.
using EdgeEnds = std::array<double, 4>;

EdgeEnds edge_ends(const Point& a, const Point& b) {
  const bool in_order = a.x < b.x || (a.x == b.x && a.y < b.y);
  return in_order ? EdgeEnds{a.x, a.y, b.x, b.y} : EdgeEnds{b.x, b.y, a.x, a.y};
}

std::vector<EdgeEnds> edges_of(const MultiPolygon& shape) {
  std::vector<EdgeEnds> edges;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges.push_back(edge_ends(ring[i], ring[(i + 1) % ring.size()]));
  };
  for (const Polygon& polygon : shape) {
    add(polygon.shell);
    for (const Ring& hole : polygon.holes) add(hole);
  }
  std::ranges::sort(edges);
  return edges;
}

// The regular edges, which the paper took.
std::vector<EdgeEnds> regular_edges(const std::vector<Point>& points, double radius) {
  const auto converted = CgalsOwn::converted(points);
  using AlphaShape = CgalsOwn::Shape;
  const AlphaShape shape(converted.begin(), converted.end(), radius * radius, AlphaShape::GENERAL);
  std::vector<EdgeEnds> edges;
  for (auto edge = shape.alpha_shape_edges_begin(); edge != shape.alpha_shape_edges_end(); ++edge) {
    if (shape.classify(*edge) != AlphaShape::REGULAR) continue;
    const auto segment = shape.segment(*edge);
    edges.push_back(edge_ends({segment.source().x(), segment.source().y()},
                              {segment.target().x(), segment.target().y()}));
  }
  std::ranges::sort(edges);
  return edges;
}

TEST(CgalAlphaShape, ItsRingsAreCgalsRegularEdges) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::uniform_points(10 + 20 * seed, seed);
    for (const double radius : clear_radii(points)) {
      SCOPED_TRACE("radius " + std::to_string(radius));
      EXPECT_EQ(edges_of(run(points, radius)), regular_edges(points, radius));
    }
  }
}

void expect_same_shape(const std::vector<Point>& points, double radius) {
  SCOPED_TRACE("radius " + std::to_string(radius));
  const MultiPolygon cgal = run(points, radius);
  const MultiPolygon core = core_hull(points, {.alpha = radius});
  EXPECT_EQ(metrics::invalid_reason(cgal), "");
  ASSERT_EQ(core.empty(), cgal.empty());
  if (cgal.empty()) return;
  const metrics::AreaScores scores = metrics::area_scores(core, cgal);
  EXPECT_LT(*scores.symmetric_difference_area, 1e-9 * scores.ground_truth_area);
  EXPECT_TRUE(canonical(core) == canonical(cgal)) << "rings differ";
}

TEST(CoreAgainstCgal, SameShapeOnRandomPoints) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::uniform_points(10 + 15 * seed, seed, 100);
    for (const double radius : clear_radii(points)) expect_same_shape(points, radius);
  }
}

// The paper's rule for alpha, on a sample like those measured.
TEST(CoreAgainstCgal, SameShapeWithThePapersAlpha) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<Point> points = polylidar::testing::uniform_points(20000, seed, 200);
    std::erase_if(points,
                  [](const Point& p) { return std::hypot(p.x - 80, p.y - 90) < 30 || p.x + p.y < 70; });
    expect_same_shape(points, 2 * std::sqrt(40000.0 / 20000));
  }
}

// Where points are cocircular the triangulations differ; triangles on one circle are kept or dropped
// together.
TEST(CoreAgainstCgal, SameShapeOnLatticesWithGaps) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::vector<Point> points = polylidar::testing::lattice_with_gaps(seed);
    expect_same_shape(points, 0.75);
    expect_same_shape(points, 1.05);
  }
}

TEST(CoreAgainstCgal, SameShapeOnNastyPointSets) {
  for (const PointSet& set : polylidar::testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const polylidar::Box box = polylidar::bounding_box(set.points);
    const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    // CGAL's squared radius is a quotient of sixth powers of lengths: outside this range it overflows or
    // underflows.
    if (set.points.empty() || extent > 1e50 || extent < 1e-50) continue;
    for (const double radius : clear_radii(set.points)) expect_same_shape(set.points, radius);
  }
}

}  // namespace
}  // namespace hullbench::testing
