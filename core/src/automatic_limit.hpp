// How large a triangle of the shape may be when the caller gives no limit. The rule uses the points only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "delaunay_builder.hpp"
#include "half_edge.hpp"
#include "point_passes.hpp"
#include "polylidar/concave_hull.hpp"
#include "scratch.hpp"
#include "size_field.hpp"
#include "thread_pool.hpp"
#include "window_sample.hpp"

namespace polylidar::detail {

/// The rule's constants, fitted on the training shapes of this project. core/AUTOMATIC.md says how, and what
/// `make fit-default` finds now. Sizes are lengths: the fourth roots of Triangle::size4().
struct AutomaticConstants {
  /// With this value chance makes a hole in one of a hundred sets.
  static constexpr double kWide = 8;

  double quantile = 0.6;  ///< a block's usual size is this quantile of its triangles' sizes
  double growth = 10;     ///< a block's usual size is at most 1 + growth / sqrt(blocks) times its neighbours'
  double reach = 5;       ///< an edge joins two blocks if it is at most this many usual sizes long
  double noise = 0.12;    ///< standard deviation, by chance alone, of the logarithm of a usual size
  std::size_t smoothed_from = 16;  ///< with fewer blocks none is moved towards its neighbours

  double usual = 0.667;      ///< the usual limit, in usual sizes times sqrt(log n)
  double pull = 10.9;        ///< the cost of a limit away from it, times n^(-1/5)
  double even_sizes = 0.52;  ///< most scatter of the sizes in a block without clusters
  double even_edges = 0.62;  ///< most scatter of the shortest edges of its triangles
  double doubt = 40;         ///< how strongly more scatter weakens the pull on larger limits
  double still = 0.018;      ///< a growth of the area that counts as none
  std::size_t below = 3;     ///< the growth is measured over this many cells of the grid below a limit
  std::size_t above = 6;     ///< and this many above it
  double spike = 1.57;       ///< the size from which a triangle on two border edges may be a spike
  double part = 2.4;         ///< a part has at least this many times log n triangles
  double wide = kWide;       ///< a hole has a triangle whose circle would hold log n + wide points or more
  double step = 3;           ///< neighbours on an outline are at most log n + step mean distances apart
};

/// What the usual sizes are found by.
enum class SizesBy : std::uint8_t {
  kOne,     ///< a few windows: one size for all places
  kPlaces,  ///< a window of each of many places, before anything else is triangulated
  kBlocks,  ///< the triangulation of all points
};

/// Chooses the limit from the triangulation, keeping its memory between calls.
///
/// **The field.** The mesh stores vertices and triangles in the order of the space-filling curve. A block is
/// a run of consecutive vertices that ends where the curve leaves a large cell, so it covers a compact place.
/// Its usual size is a quantile of the sizes of its triangles, whether density, scan lines or a lattice make
/// them. Chance alone makes the usual sizes of blocks of 64 points differ by `noise`. If they differ by no
/// more, as for uniform points, all blocks take the median. If they differ by more, the part of the variance
/// that noise explains is removed (James and Stein 1961). If a block differs by more than noise even from the
/// blocks round it, its size does not measure a density: scan lines that meet and part, or a hot spot smaller
/// than a block, cause it. Blocks are then moved towards the mean of their neighbourhood. A block may also
/// not be much larger than its neighbours: from block to block the usual size grows at most by the factor 1 +
/// growth / sqrt(number of blocks). So outliers round a shape do not count as a sparse part of it. A sparse
/// part that is far from the others, measured by its own spacing, is not bounded, since no short edge joins
/// it to them. The second smallest neighbour sets the bound, because the smallest may hold a bit of a dense
/// place beside it.
///
/// **The limit.** Let A(s) be the area of all triangles of size at most s, measured in usual sizes. While s
/// passes through the sizes of the voids that chance leaves, A grows quickly. Once s exceeds the width of
/// holes, notches and gaps, A grows quickly again, by what is outside the shape. Between the two it hardly
/// grows. The rule takes the s where A is stable and which is not far from the usual place of such an s:
///
///   s = argmin  log(g(s) + still) + pull n^(-1/5) log^2(s / (usual sqrt(log n))),   g = d log A / d log s,
///
/// on a grid of 16 sizes to the octave, g as a difference over `below` + `above` cells. `detail` divides s.
/// The largest void that chance makes among n points has a width that grows with sqrt(log n). The fewer
/// points there are, the less A says, and the more the usual place counts.
///
/// **Clusters.** If points cluster, the voids between the clusters are ordinary, though they are larger than
/// voids elsewhere. So the usual limit is less reliable. Points count as clustered if both the sizes of a
/// block's triangles and their shortest edges scatter more than without clusters. Then the pull on larger
/// limits is divided by 1 + doubt * (the excess scatter). On scan lines and roads the sizes scatter, but the
/// shortest edges do not. Among few points only the edges are looked at.
///
/// **Places.** Of many points whose density varies by a few times, the usual sizes come from small windows,
/// as one size for all places does: one window for each of up to 4096 squares instead of blocks. All else is
/// as with blocks. So the points in the interior need not be triangulated.
///
/// **Outlines.** If all points lie on curves, most triangles have an edge that is far longer than the
/// distance between neighbours on a curve. The gaps between n random points on a line are exponential: half
/// of them are longer than log 2 times their mean, the largest is about log n times their mean, and in one
/// set of 20 it is more than log n + 3 times. If many triangles have two edges longer than log n + `step`
/// mean distances, OutlineFill finds what the curves enclose.
///
/// **What chance leaves.** Spikes and small parts are dropped, and holes without a wide triangle are filled
/// (SizeField). Parts and circles are compared with log n, because the largest void and the largest cluster
/// that chance makes grow with it.
///
/// Apart from rounding, the field does not depend on the unit of the points or on their position, nor on
/// their order or the number of threads. Repeated points move the borders of the blocks, which changes the
/// limit within its noise. If `detail` is at most 1, at least one triangle is within the limit.
///
/// Source: this project; core/AUTOMATIC.md says what else was tried.
class AutomaticLimit {
 public:
  /// Mean number of points in a block. With many points blocks are larger, so that there are kMostBlocks.
  static constexpr std::size_t kBlockPoints = 64;
  static constexpr std::size_t kMostBlocks = 4096;

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
  /// vertices. None if no triangle has a size above zero; all are kept then.
  const std::optional<ChosenSizes>& range() const { return range_; }

 private:
  /// Cells of the grid of limits; 16 cells cover one octave of sizes.
  static constexpr std::size_t kCells = 64;

  /// From `begin` to one before `end`.
  struct Records {
    Mesh::Index begin;
    Mesh::Index end;
  };
  /// Two blocks that share an edge, and the fourth power of the length of the shortest shared edge that was
  /// looked at.
  struct Border {
    std::uint32_t block;
    std::uint32_t neighbour;
    double length4;
  };
  /// A summary of the neighbours of a block.
  struct Smallest {
    std::uint32_t neighbour = kNone;
    double first4 = std::numeric_limits<double>::infinity();
    double second4 = std::numeric_limits<double>::infinity();
  };
  /// The sum, in fine units, and the number of the logarithms of the usual sizes of a block's neighbours. A
  /// border counts once for each of its two sides that was looked at.
  struct Around {
    std::int64_t sum = 0;
    std::int64_t count = 0;
  };
  /// The data of a block that is being looked at.
  struct BlockScratch {
    std::vector<double> sizes;          ///< of its triangles
    std::vector<Mesh::Index> crossing;  ///< half-edges with twins in other blocks
    /// Block -> its place among the borders, where it is a neighbour of the block that is looked at.
    std::vector<std::uint32_t> border_with;
  };
  struct Sampled {
    double size4;  ///< in usual sizes of its block
    double area;   ///< in squares of them, times the number of triangles that it stands for
  };

  void divide(const DelaunayBuilder& builder, double points);
  void measure_triangles(const Mesh& mesh, const Point* vertices, ThreadPool& pool);
  double size4_of(const Mesh& mesh, const Point* vertices, Mesh::Index t) const;
  void measure_blocks(const Mesh& mesh, const Point* vertices, ThreadPool& pool,
                      const AutomaticConstants& constants);
  Records records_of(const Mesh& mesh, std::size_t block) const;
  bool find_one(const PointPasses& points, const Box& box, ThreadPool& pool,
                const AutomaticConstants& constants);
  bool find_places(const PointPasses& points, ThreadPool& pool, const AutomaticConstants& constants);
  template <class ForEach>
  double scatter_in_blocks(std::size_t blocks, const ForEach& for_each_length4);
  double excess_scatter(const Mesh& mesh, const Point* vertices, const AutomaticConstants& constants);
  double excess_scatter_of_places(const AutomaticConstants& constants);
  double measure_block(const Mesh& mesh, const Point* vertices, std::uint32_t block, double quantile,
                       BlockScratch& scratch, std::vector<Border>& borders) const;
  template <class Visit>
  void for_each_neighbour(double reach, const Visit& visit) const;
  void smooth(const AutomaticConstants& constants);
  void take_medians_of_neighbours();
  void bound_growth(const AutomaticConstants& constants);
  void shrink_to_median(double noise);
  void sample(const Mesh& mesh, const Point* vertices);
  void sum_up_areas();
  void add_wide_areas(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                      ThreadPool& pool);
  double steadiest_size4(double points, const AutomaticConstants& constants) const;
  void look_for_outlines(const Mesh& mesh, const Point* vertices, double points, double detail,
                         const AutomaticConstants& constants);
  void set_field(double points, double detail, const AutomaticConstants& constants);

  WindowSample windows_;
  SizeField field_;
  Scratch<double> size4_;                ///< the sizes of all triangles, for the field
  std::vector<std::size_t> block_ends_;  ///< block -> one past its last vertex
  std::optional<ChosenSizes> range_;
  std::vector<double> usual4_;     ///< block -> fourth power of its usual size; infinity if unknown
  std::vector<double> measured4_;  ///< the same before the step that works on it
  std::vector<Smallest> smallest_;
  std::vector<Around> around_;
  std::vector<double> logs_;     ///< block -> logarithm of its usual size, then how smoothing changes it
  std::vector<double> scratch_;  ///< values of which a quantile is taken
  std::vector<BlockScratch> scratch_of_chunk_;
  std::vector<std::vector<Border>> borders_of_chunk_;
  std::vector<Sampled> samples_;
  double doubt_ = 1;                       ///< what the pull on larger limits is divided by
  double steadiest4_ = 0;                  ///< the limit at a detail of 1, in usual sizes
  double unit4_ = 0;                       ///< fourth power of the unit of the grid of limits
  std::array<double, kCells + 1> area_{};  ///< cell of that grid -> area of the triangles of its sizes
  // What look() found:
  SizesBy found_ = SizesBy::kBlocks;
  double points_ = 0;  ///< number of points without repeats
  double wide_radius_ = 0;
  double sampled_ = 0;  ///< number of triangles that samples_ stand for
};

}  // namespace polylidar::detail
