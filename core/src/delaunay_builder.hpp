// Delaunay triangulation by divide and conquer along a space-filling curve.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>

#include "coordinate_range.hpp"
#include "half_edge.hpp"
#include "hull_merge.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Throws std::invalid_argument if there are more than kMaxPoints points.
void check_point_count(std::size_t points);

/// Builds the mesh of one point set after another, keeping its memory.
///
/// Points are sorted along a Morton curve, whose cells are halved again and again by vertical and horizontal
/// lines; the triangulations of two halves are merged as Guibas and Stolfi (1985) do, on triangles with
/// ghosts instead of edges (Shewchuk 1996). A merge turns the ghosts between the halves into the triangles
/// that fill the gap. A range of points therefore always owns the same range of triangle records, and nothing
/// is allocated, freed or moved.
class DelaunayBuilder {
 public:
  /// Triangulates `points` on the threads of `pool`: the same mesh for any number of them. Throws
  /// std::invalid_argument as concave_hull does, and then leaves the mesh as it was.
  void build(std::span<const Point> points, ThreadPool& pool);
  /// The same for points whose range is known. There must be at least one point.
  void build(std::span<const Point> points, const CoordinateRange& range, ThreadPool& pool);

  const Mesh& mesh() const { return mesh_; }
  Mesh& mesh() { return mesh_; }
  /// Vertex of the mesh -> its position times 2^scale_exponent(). Vertices are numbered along the curve.
  const Point* vertices() const { return points_.data(); }
  std::size_t vertex_count() const { return vertex_count_; }
  /// Vertex of the mesh -> index of the caller's point.
  const std::uint32_t* caller_index() const { return order_.data(); }
  int scale_exponent() const { return scale_exponent_; }
  /// Vertex of the mesh -> its key on the curve. Vertices that share a key with many others have keys on a
  /// finer curve of their own. The higher the first bit in which neighbours differ, the larger the cells that
  /// separate them.
  const std::uint32_t* keys() const { return keys_.data(); }

 private:
  using Index = Mesh::Index;

  /// A subtree of the curve: a range of points that is triangulated by itself, or the two subtrees into which
  /// a line cuts it.
  struct Subtree {
    Subtree(Index points_begin, Index points_end, Subtree* whole)
        : begin(points_begin), end(points_end), parent(whole) {}
    Index begin;
    Index end;
    Subtree* parent;
    Subtree* first = nullptr;  ///< null: not cut
    Subtree* second = nullptr;
    Axis axis = Axis::kX;
    std::atomic<int> unfinished = 2;  ///< of the two
    Hull hull;
  };

  void sort_along_curve(std::span<const Point> points, CoordinateRange range, ThreadPool& pool);
  void build_subtrees(ThreadPool& pool);
  void cut(Subtree& subtree, Index largest, std::deque<Subtree>& subtrees);
  void finish(Subtree& subtree);
  void refine_curve(Index begin, Index end, const Box& box);
  void sort_small_cell(Index begin, Index end);

  Hull build_range(Index begin, Index end);
  bool build_triangle(Index first, Hull& hull);
  Hull build_cell(Index begin, Index end);
  Hull build_sorted(Index begin, Index end);
  Hull collapse(Index begin, Index end);

  /// Merges the two ranges that meet at point `middle`. Every place where ranges can meet owns two records.
  Hull merge(const Hull& left, const Hull& right, Index middle, Axis axis) {
    return merge_hulls(mesh_, points_.data(), exact_limits_, left, right, Mesh::kStride * (2 * middle - 2),
                       axis);
  }

  Scratch<Point> points_;
  Scratch<Index> order_;
  Scratch<std::uint32_t> keys_;
  Mesh mesh_;
  ExactLimits exact_limits_;
  std::size_t vertex_count_ = 0;
  int scale_exponent_ = 0;
};

}  // namespace polylidar::detail
