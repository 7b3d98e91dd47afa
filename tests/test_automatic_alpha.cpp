// The automatic alpha, and what the core tells about its triangulation for it and for --min-triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "benchmarks/hull/automatic_alpha.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench {
namespace {

using polylidar::Extractor;
using polylidar::kNone;
using polylidar::Options;
using polylidar::Point;
using polylidar::Triangulation;
using Points = std::vector<Point>;

Points uniform(std::size_t count, std::uint64_t seed, double scale = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(0, scale);
  Points points(count);
  for (Point& p : points) p = {coordinate(random), coordinate(random)};
  return points;
}

std::vector<double> sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<double> sampled(const Points& points, std::size_t most, unsigned threads = 1) {
  Extractor extractor;
  extractor.triangulate(points, threads);
  return extractor.sample_edge_lengths(most);
}

/// All edges, by way of the public triangulation.
std::vector<double> edge_lengths(const Points& points) {
  const Triangulation t = polylidar::delaunay(points);
  std::vector<double> lengths;
  for (std::uint32_t e = 0; e < t.triangles.size(); ++e) {
    if (t.halfedges[e] != kNone && t.halfedges[e] < e) continue;
    const Point& a = points[t.triangles[e]];
    const Point& b = points[t.triangles[e % 3 == 2 ? e - 2 : e + 1]];
    lengths.push_back(std::hypot(a.x - b.x, a.y - b.y));
  }
  return lengths;
}

TEST(SampleEdgeLengths, AllEdgesOnceWhereTheyAreFew) {
  for (const double scale : {1.0, 1e-90, 1e120}) {
    const Points points = uniform(1000, 1, scale);
    EXPECT_EQ(sorted(sampled(points, 1000000)), sorted(edge_lengths(points))) << scale;
  }
}

TEST(SampleEdgeLengths, AboutAsManyAsAskedForAndTheSameMedian) {
  const Points points = uniform(100000, 2);
  const std::vector<double> all = sorted(sampled(points, 10000000));
  const std::vector<double> few = sorted(sampled(points, 20000));
  EXPECT_GT(few.size(), 10000U);
  EXPECT_LT(few.size(), 30000U);
  // The standard error of the median of 20000 of these is 0.5 %.
  EXPECT_NEAR(few[few.size() / 2] / all[all.size() / 2], 1, 0.02);
  EXPECT_EQ(sampled(points, 20000), sampled(points, 20000, 3));
}

TEST(SampleEdgeLengths, FewDistinctPointsAmongMany) {
  Points points;
  for (int i = 0; i < 30000; ++i) points.push_back({i % 3 == 1 ? 3.0 : 0.0, i % 3 == 2 ? 4.0 : 0.0});
  EXPECT_EQ(sorted(sampled(points, 100)), (std::vector<double>{3, 4, 5}));
}

TEST(SampleEdgeLengths, NoTriangles) {
  EXPECT_TRUE(sampled({}, 10).empty());
  EXPECT_TRUE(sampled({{0, 0}, {1, 1}, {2, 2}}, 10).empty());
  EXPECT_THROW(sampled({}, 0), std::invalid_argument);
}

TEST(AutomaticAlpha, IsAMultipleOfTheMedian) {
  EXPECT_EQ(automatic_alpha({}), 0);
  EXPECT_DOUBLE_EQ(automatic_alpha({5, 1, 1000}), 9);
}

TEST(AutomaticAlpha, IsNearThePapersForUniformPoints) {
  const std::size_t n = 100000;
  const double alpha = automatic_alpha(sampled(uniform(n, 3), kAlphaSample));
  const double paper = 2 / std::sqrt(static_cast<double>(n));
  EXPECT_GT(alpha, 0.95 * paper);
  EXPECT_LT(alpha, paper);
}

TEST(AutomaticAlpha, FollowsTheUnit) {
  Points points = uniform(1000, 4);
  const double alpha = automatic_alpha(sampled(points, kAlphaSample));
  for (Point& p : points) p = {p.x * 1024, p.y * 1024};
  EXPECT_EQ(automatic_alpha(sampled(points, kAlphaSample)), alpha * 1024);
}

/// Sizes of the edge-connected regions of kept triangles, by way of the public triangulation, in ascending
/// order.
std::vector<std::size_t> region_sizes(const Points& points, double max_edge) {
  const Triangulation t = polylidar::delaunay(points);
  const std::size_t count = t.triangles.size() / 3;
  const auto kept = [&](std::size_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& a = points[t.triangles[3 * triangle + k]];
      const Point& b = points[t.triangles[3 * triangle + (k + 1) % 3]];
      if ((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) > max_edge * max_edge) return false;
    }
    return true;
  };
  std::vector<std::size_t> label(count);
  std::iota(label.begin(), label.end(), 0U);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t e = 0; e < t.triangles.size(); ++e) {
      if (t.halfedges[e] == kNone || !kept(e / 3) || !kept(t.halfedges[e] / 3)) continue;
      const std::size_t other = label[t.halfedges[e] / 3];
      if (other < label[e / 3]) {
        label[e / 3] = other;
        changed = true;
      }
    }
  }
  std::map<std::size_t, std::size_t> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    if (kept(i)) ++sizes[label[i]];
  }
  std::vector<std::size_t> values;
  for (const auto& [first, size] : sizes) values.push_back(size);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(CountTriangles, AgreesWithASlowCountOfTheRegions) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Points points = uniform(400, 100 + seed);
    for (const double max_edge : {0.04, 0.06, 0.07, 0.08, 0.1, 10.0}) {
      Options options;
      options.max_edge_length = max_edge;
      Extractor extractor;
      const std::size_t polygons = extractor.extract(points, options).polygon_count();
      std::vector<std::size_t> counts = extractor.count_triangles();
      EXPECT_EQ(counts.size(), polygons);
      std::sort(counts.begin(), counts.end());
      EXPECT_EQ(counts, region_sizes(points, max_edge)) << seed << " " << max_edge;
    }
  }
}

TEST(CountTriangles, GoesByThePolygonsOrder) {
  Points points;
  const auto add_grid = [&](double x, int side) {
    for (int i = 0; i < side * side; ++i) points.push_back({x + i % side, static_cast<double>(i / side)});
  };
  for (int side = 2; side < 9; ++side) add_grid(100.0 * side, side);
  Options options;
  options.alpha = 1;
  Extractor extractor;
  const polylidar::MultiPolygon shape = to_coordinates(extractor.extract(points, options), points);
  const std::vector<std::size_t> counts = extractor.count_triangles();
  ASSERT_EQ(shape.size(), 7U);
  ASSERT_EQ(counts.size(), 7U);
  // A square of the grid has the area 1 and two triangles.
  for (std::size_t p = 0; p < shape.size(); ++p)
    EXPECT_EQ(static_cast<double>(counts[p]), 2 * polylidar::area({shape[p]}));
}

}  // namespace
}  // namespace hullbench
