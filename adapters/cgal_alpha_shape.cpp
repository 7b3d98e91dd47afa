// CGAL's two-dimensional alpha shapes: CGAL::Alpha_shape_2 over a Delaunay triangulation.
//
// `run` ends where the alpha shape is there to be asked: the triangulation, the intervals of alpha of all its
// faces, edges and vertices, and alpha itself. The paper timed this and a list of the regular edges; the
// polygons need no such list, so none is made and CGAL is not charged for it.
#include <CGAL/Alpha_shape_2.h>
#include <CGAL/Alpha_shape_face_base_2.h>
#include <CGAL/Alpha_shape_vertex_base_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/version_macros.h>

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/cgal_regions.hpp"

namespace hullbench {
namespace {

using cgal::Kernel;
using VertexBase = CGAL::Alpha_shape_vertex_base_2<Kernel>;
using FaceBase =
    CGAL::Alpha_shape_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<cgal::FaceLabel, Kernel>>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;
using AlphaShape = CGAL::Alpha_shape_2<Delaunay>;

/// No triangle has a circumradius of 0, so that the number is free to mean this.
constexpr double kNotGiven = 0;

MethodInfo describe() {
  MethodInfo info;
  info.name = "cgal_alpha_shape";
  info.title = "CGAL alpha shape";
  info.version = CGAL_VERSION_STR;
  info.licence = "GPL-3.0-or-later";
  info.citation =
      "H. Edelsbrunner, D. Kirkpatrick, R. Seidel, On the Shape of a Set of Points in the Plane, IEEE "
      "Transactions on Information Theory 29(4), 1983; T. K. F. Da, 2D Alpha Shapes, CGAL User and Reference "
      "Manual";
  info.native_output = "unordered set of edges";
  info.parameters = {{.name = "alpha",
                      .unit = "length^2",
                      .description =
                          "Largest squared circumradius of a triangle inside the shape; 0: not given, CGAL's "
                          "find_optimal_alpha(1) chooses it.",
                      .minimum = 0,
                      .maximum = std::numeric_limits<double>::infinity(),
                      .default_value = kNotGiven}};
  info.capabilities = {.holes = true, .several_polygons = true};
  return info;
}

class CgalAlphaShape final : public Adapter {
 public:
  CgalAlphaShape() { info_ = describe(); }

 private:
  void do_load(std::span<const Point> points) override { points_ = cgal::kernel_points(points); }

  void do_run(const Parameters& parameters, Steps& steps) override {
    const double alpha = parameters.at("alpha");

    // What the constructor of Alpha_shape_2 from points does, in its two halves: the triangulation is swapped
    // in. GENERAL is its default and the paper's mode; it differs from REGULARIZED in edges without a face
    // inside only, which bound no polygon.
    steps.begin("triangulation");
    Delaunay triangulation;
    triangulation.insert(points_.begin(), points_.end());
    steps.begin("alpha_shape");
    shape_.emplace(triangulation, alpha, AlphaShape::GENERAL);
    // CGAL promises of this alpha that every point is a vertex of a face inside, and that these faces are
    // connected. Without any face it has no meaning.
    if (alpha == kNotGiven && shape_->dimension() == 2) shape_->set_alpha(*shape_->find_optimal_alpha(1));
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    if (shape_->dimension() < 2) return {};
    return cgal::trace_polygons(cgal::label_regions(*shape_, [&](AlphaShape::Face_handle face) {
      return shape_->classify(face) == AlphaShape::INTERIOR;
    }));
  }

  void do_reset() override { shape_.reset(); }

  std::vector<Kernel::Point_2> points_;
  std::optional<AlphaShape> shape_;
};

}  // namespace

std::unique_ptr<Adapter> make_cgal_alpha_shape() {
  return std::make_unique<CgalAlphaShape>();
}

}  // namespace hullbench
