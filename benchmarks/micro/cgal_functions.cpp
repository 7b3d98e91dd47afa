// CGAL's Delaunay triangulation and its alpha shape on top of that.
#include <CGAL/Alpha_shape_2.h>
#include <CGAL/Alpha_shape_face_base_2.h>
#include <CGAL/Alpha_shape_vertex_base_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <optional>
#include <vector>

#include "benchmarks/micro/measure.hpp"
#include "benchmarks/micro/measured_functions.hpp"

namespace hullbench::micro {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// The caller's points in CGAL's type: neither timed nor counted.
std::vector<Kernel::Point_2> kernel_points(const SpeedPointSet& set) {
  std::vector<Kernel::Point_2> points;
  points.reserve(set.points.size());
  for (const Point& p : set.points) points.emplace_back(p.x, p.y);
  return points;
}

void cgal_delaunay(benchmark::State& state, const SpeedPointSet& set) {
  const std::vector<Kernel::Point_2> points = kernel_points(set);
  std::optional<CGAL::Delaunay_triangulation_2<Kernel>> delaunay;
  const auto triangulate = [&] {
    delaunay.emplace().insert(points.begin(), points.end());
    return delaunay->number_of_faces();
  };
  measure(state, set, 0, Memory::kCounted, triangulate, [&] { delaunay.reset(); });
}

// What the adapter's `run` does. Polygons would come on top.
void cgal_alpha_shape(benchmark::State& state, const SpeedPointSet& set) {
  using VertexBase = CGAL::Alpha_shape_vertex_base_2<Kernel>;
  using FaceBase = CGAL::Alpha_shape_face_base_2<Kernel>;
  using Delaunay =
      CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
  using AlphaShape = CGAL::Alpha_shape_2<Delaunay>;
  const std::vector<Kernel::Point_2> points = kernel_points(set);
  std::optional<AlphaShape> shape;
  const auto make_shape = [&] {
    Delaunay delaunay;
    delaunay.insert(points.begin(), points.end());
    shape.emplace(delaunay, set.alpha * set.alpha, AlphaShape::GENERAL);  // takes the triangulation over
    return shape->number_of_faces();
  };
  measure(state, set, 0, Memory::kCounted, make_shape, [&] { shape.reset(); });
}

constexpr MeasuredFunction kFunctions[] = {{"cgal_delaunay", &cgal_delaunay, 1'000'000},
                                           {"cgal_alpha_shape", &cgal_alpha_shape, 64'000}};

}  // namespace

std::span<const MeasuredFunction> cgal_functions() {
  return kFunctions;
}

}  // namespace hullbench::micro
