// The characteristic shape (chi shape) of Duckham, Kulik, Worboys and Galton (2008): the Delaunay
// triangulation loses its longest boundary edge, with the triangle behind it, for as long as that edge is
// longer than the limit and the boundary stays a simple polygon.
//
// Degenerate input: fewer than 3 distinct points, or points all on a line, give an empty multipolygon.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <queue>
#include <span>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench {
namespace {

using polylidar::kNone;
using polylidar::Triangulation;
using Index = std::uint32_t;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Index next_in_triangle(Index edge) {
  return edge % 3 == 2 ? edge - 2 : edge + 1;
}

// A boundary edge that is longer than the limit.
struct LongEdge {
  double squared_length;
  Index edge;  // the half-edge on the boundary, its triangle to the left

  // By length, and among equals by half-edge, so that the same points always give the same shape.
  friend bool operator<(const LongEdge& a, const LongEdge& b) {
    return a.squared_length != b.squared_length ? a.squared_length < b.squared_length : a.edge > b.edge;
  }
};

// The polygon that shrinks. Every vertex is on its boundary at most once: that is what "regular" means here.
class ShrinkingPolygon {
 public:
  ShrinkingPolygon(std::span<const Point> points, const Triangulation& triangulation, double max_edge_length)
      : points_(points),
        triangulation_(triangulation),
        squared_limit_(max_edge_length * max_edge_length),
        next_vertex_(points.size(), kNone) {
    std::vector<LongEdge> memory;
    memory.reserve(points.size());
    long_edges_ = std::priority_queue(std::less<>(), std::move(memory));
    for (Index edge = 0; edge < triangulation.triangles.size(); ++edge) {
      if (triangulation.halfedges[edge] == kNone) add(edge);
    }
  }

  // An edge that cannot go is dropped for good: the vertex behind it is on the boundary and stays there.
  void shrink() {
    while (!long_edges_.empty()) {
      const Index edge = long_edges_.top().edge;
      long_edges_.pop();
      const Index to_apex = next_in_triangle(edge);
      const Index from_apex = next_in_triangle(to_apex);
      if (next_vertex_[triangulation_.triangles[from_apex]] != kNone) continue;
      // The apex is inside, so both edges have a neighbour.
      add(triangulation_.halfedges[from_apex]);
      add(triangulation_.halfedges[to_apex]);
    }
  }

  // The boundary from its lowest-numbered vertex on; empty without triangles.
  Ring ring() const {
    const auto first =
        std::find_if(next_vertex_.begin(), next_vertex_.end(), [](Index v) { return v != kNone; });
    if (first == next_vertex_.end()) return {};
    const auto start = static_cast<Index>(first - next_vertex_.begin());
    Ring ring;
    Index vertex = start;
    do {
      ring.push_back(points_[vertex]);
      vertex = next_vertex_[vertex];
    } while (vertex != start);
    return ring;
  }

 private:
  void add(Index edge) {
    const Index start = triangulation_.triangles[edge];
    const Index end = triangulation_.triangles[next_in_triangle(edge)];
    next_vertex_[start] = end;
    const double dx = points_[end].x - points_[start].x;
    const double dy = points_[end].y - points_[start].y;
    const double squared_length = dx * dx + dy * dy;
    if (squared_length > squared_limit_) long_edges_.push({squared_length, edge});
  }

  std::span<const Point> points_;
  const Triangulation& triangulation_;
  double squared_limit_;
  // Vertex -> the next one counter-clockwise on the boundary; kNone when it is not on the boundary.
  std::vector<Index> next_vertex_;
  std::priority_queue<LongEdge, std::vector<LongEdge>, std::less<>> long_edges_;
};

MethodInfo describe() {
  MethodInfo info;
  info.name = "chi_shape";
  info.title = "Chi shape";
  info.version = HULLBENCH_VERSION;
  info.licence = "MIT";
  info.citation =
      "M. Duckham, L. Kulik, M. Worboys, A. Galton, Efficient generation of simple polygons for "
      "characterizing the shape of a set of points in the plane, Pattern Recognition 41(10), 2008";
  info.native_output = "ring";
  info.parameters = {length_limit(
      "max_edge_length", "Longest boundary edge that stays although it could be taken away.", kInfinity)};
  info.capabilities = {.holes = false, .several_polygons = false};
  return info;
}

class ChiShape final : public Adapter {
 public:
  ChiShape() { info_ = describe(); }

 private:
  void do_load(std::span<const Point> points) override { points_.assign(points.begin(), points.end()); }

  void do_run(const Parameters& parameters, Steps& steps) override {
    steps.begin("triangulation");
    triangulation_ = polylidar::delaunay(points_);
    steps.begin("shape");
    polygon_ = std::make_unique<ShrinkingPolygon>(points_, triangulation_, parameters.at("max_edge_length"));
    polygon_->shrink();
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    Ring shell = polygon_->ring();
    if (shell.empty()) return {};
    return {Polygon{std::move(shell), {}}};
  }

  void do_reset() override {
    polygon_.reset();
    triangulation_ = {};
  }

  std::vector<Point> points_;
  Triangulation triangulation_;
  std::unique_ptr<ShrinkingPolygon> polygon_;  // of triangulation_
};

}  // namespace

std::unique_ptr<Adapter> make_chi_shape() {
  return std::make_unique<ChiShape>();
}

}  // namespace hullbench
