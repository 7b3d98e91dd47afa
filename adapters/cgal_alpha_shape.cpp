// CGAL's two-dimensional alpha shapes: CGAL::Alpha_shape_2 over a Delaunay triangulation.
#include <CGAL/Alpha_shape_2.h>
#include <CGAL/Alpha_shape_face_base_2.h>
#include <CGAL/Alpha_shape_vertex_base_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/version_macros.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"

namespace hullbench {
namespace {

// Where a face belongs, kept in the face itself so that neither regions nor rings need a map.
struct FaceLabel {
  std::uint32_t region = 0;                // kOutside, or the number of the face's region plus 1
  bool traced[3] = {false, false, false};  // edge i: whether a ring has already gone along it
};
constexpr std::uint32_t kOutside = 0;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Alpha_shape_vertex_base_2<Kernel>;
using FaceBase =
    CGAL::Alpha_shape_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<FaceLabel, Kernel>>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using AlphaShape = CGAL::Alpha_shape_2<Delaunay>;
using Face = AlphaShape::Face_handle;
// (face, i): the face's edge opposite its vertex i, from vertex ccw(i) to vertex cw(i), the face to its left.
using Edge = AlphaShape::Edge;

// Edge-connected regions of interior faces, each with the edges that bound it.
struct Regions {
  std::uint32_t count = 0;
  std::vector<Edge> boundary;  // seen from the face inside, so the region lies to the left; region by region
};

void clear_labels(const AlphaShape& shape) {
  for (Face face : shape.finite_face_handles()) face->info() = FaceLabel{};
}

// Labels every interior face with its region. Faces come labelled kOutside, infinite ones stay so.
Regions label_regions(const AlphaShape& shape) {
  Regions regions;
  std::vector<Face> stack;
  for (Face seed : shape.finite_face_handles()) {
    if (seed->info().region != kOutside || shape.classify(seed) != AlphaShape::INTERIOR) continue;
    const std::uint32_t label = ++regions.count;
    seed->info().region = label;
    stack.push_back(seed);
    while (!stack.empty()) {
      const Face face = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face neighbour = face->neighbor(i);
        if (neighbour->info().region == label) continue;
        if (shape.classify(neighbour) == AlphaShape::INTERIOR) {
          neighbour->info().region = label;
          stack.push_back(neighbour);
        } else {
          regions.boundary.emplace_back(face, i);
        }
      }
    }
  }
  return regions;
}

// The boundary edge that follows `edge` on its ring: turning counter-clockwise round the vertex where `edge`
// ends, through faces that are not in the region, it is the first edge with the region behind it. Infinite
// faces close the way round the convex hull. Where several parts of the outside meet in one vertex, each
// keeps to its own sector, so a ring never passes a vertex twice.
Edge next_on_ring(const Edge& edge) {
  const std::uint32_t label = edge.first->info().region;
  const auto pivot = edge.first->vertex(AlphaShape::cw(edge.second));
  Face face = edge.first->neighbor(edge.second);
  while (true) {
    const Face neighbour = face->neighbor(AlphaShape::ccw(face->index(pivot)));
    if (neighbour->info().region == label) return {neighbour, neighbour->index(face)};
    face = neighbour;
  }
}

struct TracedRing {
  Ring points;
  bool is_shell = false;
};

// The ring through `first`. It is a shell when it turns left at its lexicographically smallest vertex: at
// such a vertex a simple ring is strictly convex, so one exact predicate tells its orientation.
TracedRing trace_ring(const Edge& first) {
  TracedRing ring;
  std::size_t smallest = 0;
  Edge edge = first;
  do {
    edge.first->info().traced[edge.second] = true;
    const auto& start = edge.first->vertex(AlphaShape::ccw(edge.second))->point();
    const Point point{start.x(), start.y()};
    const Point& least = ring.points.empty() ? point : ring.points[smallest];
    if (point.x < least.x || (point.x == least.x && point.y < least.y)) smallest = ring.points.size();
    ring.points.push_back(point);
    edge = next_on_ring(edge);
  } while (edge != first);

  const std::size_t size = ring.points.size();
  const auto kernel_point = [&](std::size_t i) {
    return Kernel::Point_2(ring.points[i % size].x, ring.points[i % size].y);
  };
  ring.is_shell =
      CGAL::left_turn(kernel_point(smallest + size - 1), kernel_point(smallest), kernel_point(smallest + 1));
  return ring;
}

// One polygon a region: valid by construction, since rings of one region share at most vertices.
MultiPolygon assemble(const AlphaShape& shape) {
  const Regions regions = label_regions(shape);
  MultiPolygon result(regions.count);
  for (const Edge& edge : regions.boundary) {
    const FaceLabel& label = edge.first->info();
    if (label.traced[edge.second]) continue;
    Polygon& polygon = result[label.region - 1];
    TracedRing ring = trace_ring(edge);
    if (ring.is_shell) {
      polygon.shell = std::move(ring.points);
    } else {
      polygon.holes.push_back(std::move(ring.points));
    }
  }
  return result;
}

MethodInfo describe() {
  MethodInfo info;
  info.name = "cgal_alpha_shape";
  info.title = "CGAL alpha shape";
  info.version = CGAL_VERSION_STR;
  info.licence = "GPL-3.0-or-later";
  info.citation =
      "H. Edelsbrunner, D. Kirkpatrick, R. Seidel, On the Shape of a Set of Points in the Plane, IEEE "
      "Transactions on "
      "Information Theory 29(4), 1983; T. K. F. Da, 2D Alpha Shapes, CGAL User and Reference Manual";
  info.native_output = "unordered set of edges";
  info.parameters = {{.name = "alpha",
                      .unit = "length^2",
                      .description = "Largest squared circumradius of a triangle inside the shape.",
                      .minimum = 0,
                      .maximum = std::numeric_limits<double>::infinity(),
                      .default_value = std::nullopt}};
  info.capabilities = {.holes = true, .several_polygons = true};
  return info;
}

class CgalAlphaShape final : public Adapter {
 public:
  const MethodInfo& info() const override { return info_; }

  // CGAL's predicates have no meaning for coordinates that are not finite: insertion may not end.
  void load(std::span<const Point> points) override {
    reset();
    points_.clear();
    points_.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y)) {
        throw std::invalid_argument("point " + std::to_string(i) + " has a coordinate that is not finite");
      }
      points_.emplace_back(points[i].x, points[i].y);
    }
  }

  void run(const Parameters& parameters, Steps& steps) override {
    const double alpha = complete_parameters(info_, parameters).at("alpha");
    reset();

    // What the constructor of Alpha_shape_2 from points does, in its two halves: the triangulation is swapped
    // in.
    steps.begin("triangulation");
    Delaunay triangulation;
    triangulation.insert(points_.begin(), points_.end());
    steps.begin("alpha_shape");
    shape_.emplace(triangulation, alpha, AlphaShape::GENERAL);

    steps.begin("edges");
    for (auto edge = shape_->alpha_shape_edges_begin(); edge != shape_->alpha_shape_edges_end(); ++edge) {
      if (shape_->classify(*edge) == AlphaShape::REGULAR) edges_.push_back(*edge);
    }
  }

  MultiPolygon extract(Steps& steps) override {
    if (!shape_) throw std::logic_error("extract comes after run");
    steps.begin("polygon");
    if (shape_->dimension() < 2) return {};
    if (labelled_) clear_labels(*shape_);
    labelled_ = true;
    return assemble(*shape_);
  }

  void reset() override {
    shape_.reset();
    edges_.clear();
    labelled_ = false;
  }

 private:
  MethodInfo info_ = describe();
  std::vector<Kernel::Point_2> points_;
  std::optional<AlphaShape> shape_;
  bool labelled_ = false;    // whether an extract since the last run has left its labels in the faces
  std::vector<Edge> edges_;  // the regular ones: the paper's result
};

}  // namespace

std::unique_ptr<Adapter> make_cgal_alpha_shape() {
  return std::make_unique<CgalAlphaShape>();
}

}  // namespace hullbench
