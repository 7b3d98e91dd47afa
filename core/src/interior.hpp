// The concave hull without the triangulation of the interior: which points are enough.
//
// core/INTERIOR.md has the idea, the proof and what it costs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "boundary.hpp"
#include "certificate.hpp"
#include "coordinate_range.hpp"
#include "delaunay_builder.hpp"
#include "occupancy.hpp"
#include "polylidar/concave_hull.hpp"
#include "region.hpp"
#include "scratch.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// When leaving the interior out is tried, and when it is given up. The defaults are where it pays; tests set
/// others, so that every input takes it.
struct InteriorGuard {
  std::size_t least_points = 4096;
  /// Of the grid, for each point: beyond, most cells near a point are empty, or most of the box is.
  double most_cells_a_point = 46;
  /// Share of the points that are uncertain, as far as some hundred tell that are looked at before the
  /// others.
  double most_uncertain = 0.1;
  /// Share of the points that would have to be triangulated.
  double most_triangulated = 0.5;
};

/// The radius r below which every Delaunay triangle passes the filter, in exact arithmetic: of the limits the
/// one that allows the least circumradius. A triangle's edges are chords of its circle, and no triangle in a
/// circle of radius r has a greater perimeter than 3 sqrt(3) r. Infinite without limits.
double least_dropped_radius(const Limits& limits);

/// The certificate's radius is smaller than r by this share, and two points so much closer than r are too
/// close: INTERIOR.md derives both from the rounding of the filter's rules.
inline constexpr double kSafety = 0x1p-8;
inline constexpr double kTooClose = 0x1p-40;
/// The certificate's radius is smaller by this share, too. It is irrational: were the side of some cells a
/// multiple of the points' decimal unit, as limits and coordinates with few decimals make it, many points
/// would lie on the borders of cells.
inline constexpr double kUneven = 0.0006180339887498949;
/// A radius well beyond the spacing makes a wider part, not a smaller one: the greatest that is worth taking,
/// in multiples of the spacing that the points would have if they filled their box.
inline constexpr double kWidestInSpacings = 2.5;

/// How far away, in rows, a cell can be that mark_reach() marks: beyond it lie 2 r of rows in between, and as
/// much as rounding may move a point.
inline constexpr Grid::Cell kReachedRows = 2 * kRadius + 1;
/// Marks the cells that may hold a point within 2 r of one in `cell`.
void mark_reach(const Grid& grid, Grid::Cell cell, Bitmap& reached);

/// The points that decide on the shape, keeping its memory between calls.
///
/// With the points P and a radius r as in least_dropped_radius, all points are *uncertain* but those that are
/// certified (certificate.hpp) for a radius a little below r. The part is every point within 2 r of an
/// uncertain one. Its Delaunay triangulation has at the uncertain points the triangles of the whole one, and
/// a filter by given limits drops no triangle of the whole one that has a corner that is certain.
class InteriorPart {
 public:
  /// Chooses the part for a radius r > 0; returns why not where it does not pay, or where the claim cannot be
  /// made. `range` is that of `points`; `circumradii_matter`: whether the filter compares any with r.
  std::optional<Way> choose(std::span<const Point> points, const CoordinateRange& range, double radius,
                            bool circumradii_matter, const InteriorGuard& guard, ThreadPool& pool);

  /// After choose: makes the part larger, by points up to 2.7 r from uncertain ones.
  void reach_farther(std::span<const Point> points, ThreadPool& pool);

  /// After choose: whether a triangle of the part's triangulation is surely one of all points', whatever its
  /// corners: all points in the box of its circumcircle are in the part.
  bool is_surely_whole(const Triangle& triangle) const;

  /// After choose: the part, in the order of the caller's points, all copies of a point among them.
  std::span<const Point> points() const { return points_; }
  /// Point of the part -> the caller's.
  std::span<const std::uint32_t> caller_index() const { return caller_index_; }
  /// Point of the part -> whether it is uncertain.
  std::span<const std::uint8_t> is_uncertain() const { return is_uncertain_; }
  std::size_t uncertain_count() const { return uncertain_.size(); }

  // The steps of choose() that look at all points or cells, in their order. After choose(), each may be
  // repeated, which is how it is measured alone; for find_uncertain_points() the step before it is to be
  // repeated first.
  void fill_cells(std::span<const Point> points, bool with_shared, ThreadPool& pool);
  void find_uncertain_cells(ThreadPool& pool);
  void find_uncertain_points(std::span<const Point> points, ThreadPool& pool);
  void mark_reach(ThreadPool& pool);
  void gather(std::span<const Point> points, ThreadPool& pool);

 private:
  double choose_grid(std::span<const Point> points, const Box& box, double radius,
                     const InteriorGuard& guard);
  bool are_many_uncertain(std::span<const Point> points, double most) const;
  double share_of_part(std::span<const Point> points) const;
  Bitmap& occupied() { return fills_.front().occupied; }
  const Bitmap& occupied() const { return fills_.front().occupied; }
  Bitmap& shared() { return fills_.front().shared; }
  Bitmap& reached() { return fills_.front().reached; }
  const Bitmap& reached() const { return fills_.front().reached; }

  struct Fill {
    Bitmap occupied;
    Bitmap shared;   ///< cells with more than one point, where that is asked for
    Bitmap reached;  ///< cells of the part
  };
  struct Chunk {
    std::vector<std::uint32_t> uncertain;
    std::vector<Directions> open;
    std::vector<std::uint32_t> gathered;
  };

  Grid grid_;
  Scratch<std::uint32_t> cells_;  ///< point -> its cell
  std::deque<Fill> fills_;        ///< of each part of the points; after a step the first is that of all
  std::vector<Chunk> chunks_;     ///< what was found in each chunk of the points
  Bitmap uncertain_cells_;
  ClosePairs close_pairs_;
  std::vector<std::uint32_t> uncertain_;  ///< ascending
  std::vector<Directions> open_;  ///< uncertain point -> the directions in which it has large triangles
  std::vector<Point> points_;
  std::vector<std::uint32_t> caller_index_;
  std::vector<std::uint8_t> is_uncertain_;
};

/// The steps after the choice of the part, and what they work with.
struct Steps {
  ThreadPool& pool;
  DelaunayBuilder& builder;
  RegionFilter& filter;
  std::vector<Mesh::Index>& boundary;
  BoundaryTracer& tracer;
};

/// From points to the shape by way of the part.
class InteriorPath {
 public:
  /// Puts into `shape` what the whole way gives for these points and limits, and leaves the part's mesh in
  /// `steps`. Where statistics say another way than kInteriorLeftOut, `shape` is as it was and that way is to
  /// be gone. There is at least one point; `range` is that of all.
  Statistics extract(std::span<const Point> points, const CoordinateRange& range, const Limits& limits,
                     bool fill_single, const Steps& steps, IndexedMultiPolygon& shape,
                     const InteriorGuard& guard = {});

  /// Chooses a field of one limit when the part's mesh is there. `is_tested` as in
  /// AutomaticLimit::choose_one.
  using ChooseField = std::function<const SizeField&(const std::uint8_t* is_tested)>;
  /// The same for the limit that is chosen. No triangle with a circumradius of `radius` or more is to be left
  /// out; those of the field's wide triangles are no smaller.
  Statistics extract(std::span<const Point> points, const CoordinateRange& range, double radius,
                     const ChooseField& choose_field, bool fill_single, const Steps& steps,
                     IndexedMultiPolygon& shape, const InteriorGuard& guard = {});

  /// After it left the interior out: vertex of the mesh -> the caller's point.
  const std::uint32_t* caller_index() const { return caller_index_.data(); }

 private:
  template <class Filter>
  std::optional<Way> filter_part(const CoordinateRange& range, const Steps& steps, const Filter& filter);
  template <class Filter>
  Statistics extract_part(std::span<const Point> points, const CoordinateRange& range, double radius,
                          bool circumradii_matter, const Steps& steps, IndexedMultiPolygon& shape,
                          const InteriorGuard& guard, const Filter& filter);

  InteriorPart part_;
  std::vector<std::uint8_t> is_tested_;  ///< vertex of the mesh -> whether it is uncertain
  std::vector<std::uint32_t> caller_index_;
};

}  // namespace polylidar::detail
