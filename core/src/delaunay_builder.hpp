// Delaunay triangulation by divide and conquer along a space-filling curve.
#pragma once

#include <cstdint>
#include <span>

#include "half_edge.hpp"

namespace polylidar::detail {

/// Builds the mesh of one point set after another, keeping its memory.
///
/// Points are sorted along a Morton curve, whose cells are halved again and again by vertical and horizontal
/// lines; the triangulations of two halves are merged as Guibas and Stolfi (1985) do, on triangles with
/// ghosts instead of edges (Shewchuk 1996). A merge turns the ghosts between the halves into the triangles
/// that fill the gap, so that a range of points always owns the same range of triangle records, and nothing
/// is allocated, freed or moved.
class DelaunayBuilder {
 public:
  /// Triangulates `points`. Throws std::invalid_argument as concave_hull does.
  void build(std::span<const Point> points);

  const Mesh& mesh() const { return mesh_; }
  Mesh& mesh() { return mesh_; }
  /// Vertex of the mesh -> its position times 2^scale_exponent(). Vertices are numbered along the curve.
  const Point* vertices() const { return points_.data(); }
  /// Vertex of the mesh -> index of the caller's point.
  const std::uint32_t* caller_index() const { return order_.data(); }
  int scale_exponent() const { return scale_exponent_; }

 private:
  using Index = Mesh::Index;

  /// A triangulated range: of several points, the half-edge of some ghost that leads from a hull vertex to
  /// infinity; of a single point, that point.
  struct Hull {
    Index vertex;
    Index to_infinity;  ///< kNone for a single point
    bool is_point() const { return to_infinity == kNone; }
  };
  enum class Axis : std::uint8_t { kX, kY };

  void sort_along_curve(std::span<const Point> points);
  void refine_curve(Index begin, Index end, const Box& box);
  void sort_small_cell(Index begin, Index end);

  Hull build_range(Index begin, Index end);
  Hull build_cell(Index begin, Index end);
  Hull build_sorted(Index begin, Index end);
  Hull collapse(Index begin, Index end);

  /// From vertex -> infinity to the same at the next hull vertex, counter-clockwise.
  Index next_on_hull(Index to_infinity) const { return mesh_.twin(Mesh::next(to_infinity)); }
  /// From vertex -> infinity to the same at the hull vertex before, clockwise.
  Index previous_on_hull(Index to_infinity) const { return Mesh::previous(mesh_.twin(to_infinity)); }
  void move_to_extreme(Hull& hull, Axis axis, bool greatest) const;
  void find_lower_tangent(Hull& left, Hull& right) const;
  Index find_left_candidate(Index left_ghost, Index l, Index r);
  Index find_right_candidate(Index right_ghost, Index l, Index r);
  Hull merge(Hull left, Hull right, Index middle, Axis axis);

  Scratch<Point> points_;
  Scratch<Index> order_;
  Scratch<std::uint32_t> keys_;
  Scratch<std::uint64_t> sorting_;
  Scratch<std::uint64_t> sorting_spare_;
  Mesh mesh_;
  int scale_exponent_ = 0;
};

}  // namespace polylidar::detail
