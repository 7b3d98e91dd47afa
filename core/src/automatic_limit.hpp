// How large a triangle of the shape may be when the caller gives no limit. The rule uses the points only.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "area_growth.hpp"
#include "automatic_constants.hpp"
#include "delaunay_builder.hpp"
#include "mesh_blocks.hpp"
#include "point_passes.hpp"
#include "polylidar/concave_hull.hpp"
#include "scratch.hpp"
#include "size_field.hpp"
#include "thread_pool.hpp"
#include "usual_sizes.hpp"
#include "window_sample.hpp"

namespace polylidar::detail {

/// What the usual sizes are found by.
enum class SizesBy : std::uint8_t {
  kOne,     ///< a few windows: one size for all places
  kPlaces,  ///< a window of each of many places, before anything else is triangulated
  kBlocks,  ///< the triangulation of all points
};

/// Chooses the limit from the triangulation, keeping its memory between calls.
///
/// **The field.** Each block has a usual size, a quantile of the sizes of its triangles, and a limit in
/// proportion to it. Blocks are runs of vertices (MeshBlocks). Their usual sizes follow the density, as far
/// as they differ by more than chance explains (UsualSizes).
///
/// **The limit.** How many usual sizes it is depends on how the area of all triangles up to a size grows with
/// that size (AreaGrowth). `detail` divides it.
///
/// **Uneven points.** If the spacing of the points changes from one to the next by more than chance makes it,
/// as in clusters, the voids between them are ordinary, though they are larger than voids elsewhere. So the
/// usual limit is less reliable. Then the pull on larger limits is divided by 1 plus `doubt` times the excess
/// (excess_scatter).
///
/// **Places.** Of many points whose density varies by a few times, the usual sizes come from small windows,
/// as one size for all places does: one window for each of up to 4096 squares instead of blocks
/// (WindowSample). All else is as with blocks. So the points in the interior need not be triangulated.
///
/// **Outlines.** If all points lie on curves, no triangle between these has a usual size
/// (squared_outline_step). OutlineFill then finds what the curves enclose.
///
/// **What chance leaves.** Spikes and small regions are dropped, and holes without a wide triangle are filled
/// (SizeField). Regions and circles are compared with log n, because the largest void and the largest cluster
/// that chance makes grow with it.
///
/// Apart from rounding, the field does not depend on the unit of the points or on their position, nor on
/// their order or the number of threads. Repeated points move the borders of the blocks, which changes the
/// limit within its noise. If `detail` is at most 1, at least one triangle is within the limit.
///
/// Source: this project; core/AUTOMATIC.md says what else was tried.
class AutomaticLimit {
 public:
  /// Chooses the sizes for the mesh of `builder` and `detail` > 0, by what look() says. O(n); in blocks with
  /// many triangles only some are looked at.
  void choose(const DelaunayBuilder& builder, double detail, ThreadPool& pool,
              const AutomaticConstants& constants = {});

  // The steps of choose(), for a caller who triangulates only some of the points.

  /// Looks in windows for the usual sizes. One is enough if the density varies by no more than chance
  /// explains. If it varies by a few times and there are many points, places have their own. Blocks remain
  /// for all else. `box` is that of the points, whose order does not matter. O(n), up to three passes.
  SizesBy look(const PointPasses& points, const Box& box, ThreadPool& pool,
               const AutomaticConstants& constants = {});
  /// After look() found sizes without the triangulation, as the next: the circumradius from which a triangle
  /// is wide. choose_found() and the field need only wide triangles and those that a field drops.
  double wide_radius() const { return wide_radius_; }
  /// Chooses the limits. The builder's points are those that were looked at, or some of these. `is_tested`:
  /// vertex -> whether it is tested, for the mesh of a part. Every wide triangle of the whole mesh must then
  /// have a tested corner, and every triangle with a tested corner must belong to the whole mesh. Null: the
  /// mesh is the whole one. Throws has_changed() where a vertex lies in a place that had no points.
  void choose_found(const DelaunayBuilder& builder, const std::uint8_t* is_tested, double detail,
                    ThreadPool& pool, const AutomaticConstants& constants = {});
  /// Chooses a limit for each block.
  void choose_by_blocks(const DelaunayBuilder& builder, double detail, ThreadPool& pool,
                        const AutomaticConstants& constants = {});

  /// What the usual sizes of the last choice were found by.
  SizesBy sizes_by() const { return found_; }
  /// What was chosen; valid until the next call.
  const SizeField& field() const { return field_; }
  /// The least, the median and the largest size that a triangle may have, in the unit of the builder's
  /// vertices. None if there is no triangle.
  const std::optional<ChosenSizes>& range() const { return range_; }

 private:
  bool find_one(const PointPasses& points, const Box& box, ThreadPool& pool,
                const AutomaticConstants& constants);
  bool find_places(const PointPasses& points, ThreadPool& pool, const AutomaticConstants& constants);
  void take_sample_of_places();
  SizedMesh measure_triangles(const DelaunayBuilder& builder, ThreadPool& pool);
  void look_for_outlines(const SizedMesh& sized, double points, double detail, double step);
  void set_field(double points, double detail, const AutomaticConstants& constants, double most4);

  WindowSample windows_;
  MeshBlocks blocks_;
  UsualSizes sizes_;
  AreaGrowth areas_;
  SizeField field_;
  Scratch<double> size4_;  ///< of all triangles, for the field
  std::optional<ChosenSizes> range_;
  std::vector<double> scratch_;  ///< values of which a quantile is taken
  double doubt_ = 1;             ///< what the pull on larger limits is divided by
  double steadiest4_ = 0;        ///< fourth power of the limit at a detail of 1, in usual sizes
  // What look() found:
  SizesBy found_ = SizesBy::kBlocks;
  double points_ = 0;  ///< number of points without repeats
  double wide_radius_ = 0;
};

}  // namespace polylidar::detail
