// Polylidar's rule on CGAL: CGAL::Delaunay_triangulation_2, its faces within the limits, and their regions as
// polygons. No more is worked out than the shape needs, where an alpha shape has the intervals of all alphas.
//
// The triangulation is built as CGAL's manual advises for speed: a range of points is inserted at once, which
// sorts it along a space-filling curve first, with predicates that are exact and constructions that are not.
// `run` ends with the faces labelled by region, `extract` traces the polygons.
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_2.h>
#include <CGAL/version_macros.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/cgal_regions.hpp"

namespace hullbench {
namespace {

using cgal::Kernel;
using VertexBase = CGAL::Triangulation_vertex_base_2<Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<cgal::FaceLabel, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

MethodInfo describe() {
  MethodInfo info;
  info.name = "cgal_delaunay";
  info.title = "CGAL Delaunay + filter";
  info.version = CGAL_VERSION_STR;
  info.licence = "GPL-3.0-or-later";
  info.citation =
      "M. Yvinec, 2D Triangulations, CGAL User and Reference Manual; the rule: J. Castagno, E. Atkins, "
      "Polylidar - Polygons from Triangular Meshes";
  info.native_output = "triangulation; its faces are filtered and their regions traced here";
  // In Polylidar's order: the first is what a search of one parameter is to search.
  info.parameters = {
      length_limit("max_perimeter", "Largest perimeter of a triangle inside the shape.", kNoLimit),
      length_limit("alpha", "Largest circumradius of a triangle inside the shape.", kNoLimit),
      length_limit("max_edge_length", "Longest edge of a triangle inside the shape.", kNoLimit)};
  info.capabilities = {.holes = true, .several_polygons = true};
  return info;
}

/// Polylidar's rule: limits are inclusive and all must hold. Compared squared and without division, as
/// Polylidar does: where lengths are between 1e-50 and 1e50 the two decide alike about every triangle that is
/// not at a limit up to rounding.
class Limits {
 public:
  explicit Limits(const Parameters& complete)
      : alpha_(complete.at("alpha")),
        max_edge_length_(complete.at("max_edge_length")),
        max_perimeter_(complete.at("max_perimeter")) {}

  bool keep(const Delaunay::Face& face) const {
    const Kernel::Point_2& a = face.vertex(0)->point();
    const Kernel::Point_2& b = face.vertex(1)->point();
    const Kernel::Point_2& c = face.vertex(2)->point();
    const double ab = squared_distance(a, b);
    const double bc = squared_distance(b, c);
    const double ca = squared_distance(c, a);
    const double longest = std::max({ab, bc, ca});
    if (longest > max_edge_length_ * max_edge_length_) return false;
    if (max_perimeter_ != kNoLimit && !is_perimeter_within(ab, bc, ca, longest)) return false;
    if (alpha_ == kNoLimit) return true;
    const double cross = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    return ab * bc * ca <= 4 * alpha_ * alpha_ * (cross * cross);
  }

 private:
  static double squared_distance(const Kernel::Point_2& a, const Kernel::Point_2& b) {
    const double dx = a.x() - b.x();
    const double dy = a.y() - b.y();
    return dx * dx + dy * dy;
  }

  /// Of squared edges. A perimeter is more than two and at most three longest edges, which decides for nearly
  /// all triangles without a root.
  bool is_perimeter_within(double ab, double bc, double ca, double longest) const {
    const double squared = max_perimeter_ * max_perimeter_;
    if (9 * longest <= squared) return true;
    if (4 * longest > squared) return false;
    return std::sqrt(ab) + std::sqrt(bc) + std::sqrt(ca) <= max_perimeter_;
  }

  double alpha_;
  double max_edge_length_;
  double max_perimeter_;
};

class CgalDelaunay final : public Adapter {
 public:
  CgalDelaunay() { info_ = describe(); }

 private:
  void do_load(std::span<const Point> points) override { points_ = cgal::kernel_points(points); }

  void do_run(const Parameters& parameters, Steps& steps) override {
    steps.begin("triangulation");
    triangulation_.insert(points_.begin(), points_.end());
    steps.begin("shape");
    if (triangulation_.dimension() < 2) return;
    const Limits limits(parameters);
    regions_ =
        cgal::label_regions(triangulation_, [&](Delaunay::Face_handle face) { return limits.keep(*face); });
  }

  MultiPolygon do_extract(Steps& steps) override {
    steps.begin("polygon");
    return cgal::trace_polygons(regions_);
  }

  void do_reset() override {
    regions_ = {};
    triangulation_.clear();
  }

  std::vector<Kernel::Point_2> points_;
  Delaunay triangulation_;
  cgal::Regions<Delaunay> regions_;  // with faces of triangulation_
};

}  // namespace

std::unique_ptr<Adapter> make_cgal_delaunay() {
  return std::make_unique<CgalDelaunay>();
}

}  // namespace hullbench
