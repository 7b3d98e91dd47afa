// How large a triangle of the shape may be when nobody says it: a rule that sees the points alone.
#pragma once

#include <cstddef>
#include <span>

#include "half_edge.hpp"
#include "scratch.hpp"

namespace polylidar::detail {

/// Chooses a limit for the perimeter of triangles from the triangulation, keeping its memory between calls.
///
/// Let A(p) be the area of the triangles whose perimeter is at most p, and m the median perimeter. While p is
/// of the order of m, A grows quickly, by the triangles that chance made larger than others. Once p reaches
/// the width of the shape's holes, notches and gaps, A grows quickly again, by what is not of the shape.
/// Between the two it hardly grows: what is added are the slivers along the outline. The rule takes p where A
/// is stable, not far from where that usually is:
///
///   p = argmin  log(s(p) + 0.003) + 2 log^2(p / (1.6 m))   over 1.1 m <= p <= 6 m,
///   s(p) = d log A / d log p as a difference from ten values below p to two above it,
///
/// on a grid of 16 values to the octave. A perimeter and not a circumradius, because a sliver along the
/// outline has a large circle however short its edges: on this project's shapes the best circumradius that
/// can be chosen with the ground truth in hand leaves more error than this rule does without it.
///
/// m, s and the grid scale with the points, so the limit does. It does not depend on where they lie, on their
/// order or on repeats, but for rounding, and for which triangles are looked at where they are more than
/// kSample. Some triangle is always within it: half of those looked at are within m.
///
/// Source: this project. The constants were fitted on the training side of its shapes, as `hullbench tune`
/// divides them with seed 1.
class AutomaticLimit {
 public:
  /// About so many triangles are looked at, at least two thirds and at most twice as many, spread evenly over
  /// the mesh; all of fewer.
  static constexpr std::size_t kSample = 1900;

  /// The limit in the unit of `vertices`, inclusive; infinity when there is no triangle. O(n), and O(kSample)
  /// unless most points repeat others. The same for the same mesh, on any number of threads.
  double choose(const Mesh& mesh, const Point* vertices);

  /// After choose: triangle -> its perimeter in the same unit, infinity for a ghost and an unused record;
  /// empty where only a part was looked at or no triangle is finite. The filter need not work them out
  /// again, which pays for a part of choosing. Valid until the next call.
  std::span<const double> perimeters() const {
    return {perimeters_.data(), is_complete_ ? count_ : std::size_t{0}};
  }

 private:
  void look_at(const Mesh& mesh, const Point* vertices, std::size_t step);

  // Indexed by what is looked at, from 0 to count_.
  Scratch<double> perimeters_;   ///< infinity where not finite
  Scratch<double> twice_areas_;  ///< 0 where not finite
  Scratch<double> finite_;       ///< the finite perimeters, finite_count_ of them, in any order
  std::size_t count_ = 0;
  std::size_t finite_count_ = 0;
  bool is_complete_ = false;  ///< all records are looked at, in their order
};

}  // namespace polylidar::detail
