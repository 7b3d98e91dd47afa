// The concave hull without triangulating the interior: finds the points that are enough.
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
#include "reach.hpp"
#include "region.hpp"
#include "scratch.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// When to try to leave the interior out, and when to give up. With the defaults it saves time; tests set
/// other values, so that every input takes this way.
struct InteriorGuard {
  std::size_t least_points = 4096;
  /// Most cells of the grid for each point. With more, most cells near a point, or most of the box, would be
  /// empty.
  double most_cells_a_point = 46;
  /// Largest share of uncertain points, estimated from a few hundred points that are looked at first.
  double most_uncertain = 0.13;
  /// Largest share of the points that would have to be triangulated, estimated before they are gathered.
  double most_triangulated = 0.5;
  /// Largest share of the points that the part may have once it is gathered. It is larger, as the time to
  /// find the part is spent then.
  double most_gathered = 0.8;
};

/// The radius r below which every Delaunay triangle passes the filter, in exact arithmetic. The limit that
/// allows the least circumradius decides. A triangle's edges are chords of its circle, and no triangle in a
/// circle of radius r has a greater perimeter than 3 sqrt(3) r. Infinite without limits.
double least_dropped_radius(const Limits& limits);

/// The certificate's radius is (1 - kSafety) r, and two points closer than kTooClose * r (filter_rules.hpp)
/// are too close. INTERIOR.md derives both constants from the rounding of the filter's rules.
inline constexpr double kSafety = 0x1p-8;
/// The certificate's radius is smaller by this share, too. The share is irrational: limits and coordinates
/// often have few decimals, so otherwise the side of some cells could be a multiple of the points' decimal
/// unit, and many points would lie on the borders of cells.
inline constexpr double kUneven = 0.0006180339887498949;
/// The greatest radius that helps, in multiples of the spacing that the points would have if they filled
/// their box. A radius well beyond the spacing makes the part larger, not smaller.
inline constexpr double kWidestInSpacings = 2.5;

/// So many times a part is enlarged before all points are triangulated.
inline constexpr int kMostEnlarged = 8;

/// Finds the points that decide the shape, and keeps its memory between calls.
///
/// Let r be a radius as in least_dropped_radius. Points that are certified (certificate.hpp) for a radius a
/// little below r are *certain*, all others *uncertain*. The part has every point within 4 r / 3 of an
/// uncertain one, and those in the disks of radius r that touch it in its open directions. These are all
/// neighbours that it has in a triangle with a circumradius below r. So at the uncertain points the part's
/// Delaunay triangulation has the same triangles as that of all points. A filter by given limits drops no
/// triangle of all points that has a certain corner.
class InteriorPart {
 public:
  /// Chooses the part for a radius r > 0. Returns the reason if that does not save time or cannot be proved
  /// right. `range` is that of `points`; `circumradii_matter`: whether the filter compares circumradii with
  /// r.
  std::optional<Way> choose(std::span<const Point> points, const CoordinateRange& range, double radius,
                            bool circumradii_matter, const InteriorGuard& guard, ThreadPool& pool);

  /// After choose: enlarges the part by the points up to 2.7 r from the corners of these triangles of the
  /// mesh, so that those which are in the triangulation of all points are surely whole.
  void reach_round(std::span<const Mesh::Index> triangles, const DelaunayBuilder& builder,
                   std::span<const Point> points, ThreadPool& pool);

  /// After choose: detail::is_surely_whole() of this part.
  bool is_surely_whole(const Triangle& triangle) const {
    return detail::is_surely_whole(triangle, grid_, occupied(), reached());
  }

  /// After choose: the part, in the order of the caller's points, with all copies of a point.
  std::span<const Point> points() const { return points_; }
  /// Point of the part -> the caller's.
  std::span<const std::uint32_t> caller_index() const { return caller_index_; }
  /// Point of the part -> whether it is uncertain.
  std::span<const std::uint8_t> is_uncertain() const { return is_uncertain_; }
  std::size_t uncertain_count() const { return uncertain_.size(); }

  // The steps of choose() that look at all points or cells, in order. After choose() each may be repeated, to
  // measure it alone; find_uncertain_points() needs the step before it to be repeated first.
  void fill_cells(std::span<const Point> points, ThreadPool& pool);
  void find_uncertain_cells(ThreadPool& pool);
  void find_uncertain_points(std::span<const Point> points, ThreadPool& pool);
  void mark_reach(ThreadPool& pool);
  void gather(std::span<const Point> points, ThreadPool& pool);

 private:
  /// What a thread marks.
  struct Fill {
    Bitmap occupied;
    Bitmap shared;         ///< cells with more than one point, if asked for
    Bitmap reached;        ///< cells of the part
    bool is_used = false;  ///< in this step
  };

  double choose_grid(std::span<const Point> points, const Box& box, double radius,
                     const InteriorGuard& guard);
  void begin_cells(std::span<const Point> points);
  void fill_other_cells(std::span<const Point> points, ThreadPool& pool);
  double cells_in_disk(std::span<const Point> points) const;
  bool are_uncertain_beside_one(std::span<const Point> points);
  template <class Begin, class Task>
  void for_each_into_fills(std::size_t count, ThreadPool& pool, const Begin& begin, const Task& task);
  template <class Join>
  void join_fills(ThreadPool& pool, const Join& join);
  void find_shared_cells(std::size_t points, ThreadPool& pool);
  bool are_many_uncertain(std::span<const Point> points, double most) const;
  double share_of_part(std::span<const Point> points) const;
  Bitmap& occupied() { return fills_.front().occupied; }
  const Bitmap& occupied() const { return fills_.front().occupied; }
  Bitmap& shared() { return fills_.front().shared; }
  Bitmap& reached() { return fills_.front().reached; }
  const Bitmap& reached() const { return fills_.front().reached; }

  struct Chunk {
    std::vector<std::uint32_t> uncertain;
    std::vector<Directions> open;
    std::vector<std::uint32_t> gathered;
  };

  Grid grid_;
  Scratch<std::uint32_t> cells_;  ///< point -> its cell
  std::deque<Fill> fills_;        ///< of each thread; after a step the first is that of all
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

/// From the points to the shape, through the part.
class InteriorPath {
 public:
  /// Puts into `shape` what the triangulation of all points gives for these limits, and leaves the part's
  /// mesh in `steps`. If the statistics name another way than kInteriorLeftOut, `shape` has not changed and
  /// the caller must triangulate all points. Needs at least one point; `range` is that of all points.
  Statistics extract(std::span<const Point> points, const CoordinateRange& range, const Limits& limits,
                     bool fill_single, const Steps& steps, IndexedMultiPolygon& shape,
                     const InteriorGuard& guard = {});

  /// Called when the part's mesh is ready; chooses a field with one limit, or one by corners. `is_tested` as
  /// in AutomaticLimit::choose_found.
  using ChooseField = std::function<const SizeField&(const std::uint8_t* is_tested)>;
  /// The same for a limit that is chosen. No triangle with a circumradius of `radius` or more may be left
  /// out; the field's wide triangles all have at least that circumradius.
  Statistics extract(std::span<const Point> points, const CoordinateRange& range, double radius,
                     const ChooseField& choose_field, bool fill_single, const Steps& steps,
                     IndexedMultiPolygon& shape, const InteriorGuard& guard = {});

  /// If the interior was left out: vertex of the mesh -> the caller's point.
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
