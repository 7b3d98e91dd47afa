// Points and their truth, triangulated and measured once, so that any choice of triangles is scored in a
// blink.
#pragma once

#include <span>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "core/src/automatic_limit.hpp"
#include "core/src/delaunay_builder.hpp"
#include "core/src/region.hpp"
#include "core/src/thread_pool.hpp"

namespace hullbench::tune {

/// A case of the automatic limit's fit. An error is l2, the area of the symmetric difference as a share of
/// the truth's. Of kept triangles t with areas a(t), of which w(t) lie in the truth of area A, it is
/// 1 + sum(a(t) - 2 w(t)) / A, without any overlay. Runs the core's own code. Not for use from several
/// threads at once.
class LimitCase {
 public:
  /// Throws as polylidar::concave_hull for the points and areas_within for the truth.
  LimitCase(std::span<const Point> points, const MultiPolygon& truth);

  /// Of the core's default with these constants.
  double error(const polylidar::detail::AutomaticConstants& constants);
  /// The same with the usual sizes of blocks, however many points there are.
  double error_by_blocks(const polylidar::detail::AutomaticConstants& constants);
  /// What the last error() found the usual sizes by.
  polylidar::detail::SizesBy sizes_by() const { return limit_.sizes_by(); }
  /// Of the largest perimeter that is best for this very case, found with the truth in hand.
  double best_error_of_one_limit() const;
  /// The default of earlier versions: the largest perimeter of a triangle, one for all places, in the unit of
  /// the points. Triangles between three that keep to it stayed, too.
  double former_limit() const;
  double error_of_former_default();
  /// Of kept_by_vertex_spacing().
  double error_of_vertex_spacing() const;

 private:
  struct Sized {
    double perimeter = 0;
    double area = 0;
    double change = 0;
  };

  double error_of_chosen();
  double error_of_kept() const;

  polylidar::detail::ThreadPool pool_;  // of one thread
  polylidar::detail::DelaunayBuilder builder_;
  polylidar::detail::AutomaticLimit limit_;
  polylidar::detail::RegionFilter filter_;
  std::vector<polylidar::detail::Mesh::Index> boundary_;
  std::vector<double> change_;       ///< triangle of the mesh -> its part of the error; 0 of a ghost
  std::vector<Sized> by_perimeter_;  ///< the finite ones, ascending
};

}  // namespace hullbench::tune
