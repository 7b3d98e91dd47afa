// How large a triangle of the shape may be when nobody says it: a rule that sees the points alone.
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
#include "polylidar/concave_hull.hpp"
#include "scratch.hpp"
#include "size_field.hpp"
#include "thread_pool.hpp"
#include "window_sample.hpp"

namespace polylidar::detail {

/// The rule's numbers, found on the training side of this project's shapes; core/AUTOMATIC.md says how, and
/// what `make fit-default` finds. Sizes are lengths, the fourth roots of Triangle::size4().
struct AutomaticConstants {
  /// With so many, chance makes a hole in one of a hundred sets.
  static constexpr double kWide = 8;

  double quantile = 0.6;  ///< a block's usual size is this quantile of its triangles' sizes
  double growth = 10;     ///< a block's usual size is at most 1 + growth / sqrt(blocks) times its neighbours'
  double reach = 5;       ///< usual sizes over which an edge joins two blocks
  double noise = 0.12;    ///< standard deviation of the logarithm of a usual size where all are equal
  std::size_t smoothed_from = 16;  ///< of fewer blocks none is moved towards those round it

  double usual = 2.0;        ///< where the limit usually is, in usual sizes
  double pull = 1.8;         ///< how much another one costs
  double even_sizes = 0.52;  ///< sizes in a block scatter by at most so much where points do not cluster
  double even_edges = 0.62;  ///< and triangles' shortest edges by at most so much
  double doubt = 25;         ///< how strongly more scatter than that weakens the pull on larger limits
  double still = 0.018;      ///< a growth of the area that is as good as none
  std::size_t below = 3;     ///< over so many cells of the grid below a limit the growth is taken
  std::size_t above = 6;     ///< and above it
  double spike = 1.57;       ///< the size from which a triangle on two border edges may be a spike
  double part = 2.4;         ///< a part has at least so many times log n triangles
  double wide = kWide;  ///< a hole has a triangle whose circle would have log n and so many points or more
  double step = 3;      ///< neighbours on an outline are at most log n and so many mean distances apart
};

/// Chooses the limit from the triangulation, keeping its memory between calls.
///
/// **The field.** Vertices and their triangles stand in the mesh along the space-filling curve, so a block of
/// consecutive ones covers a compact place where it ends as the curve leaves a large cell. A block's usual
/// size is a quantile of its triangles' sizes, whatever makes them: density, scan lines, a lattice. Chance
/// alone makes the usual sizes of blocks of 64 points differ by `noise`. Where they differ by no more, as
/// those of uniform points, all blocks take the median; where they differ by more, noise's part of the
/// variance is taken from them (James and Stein 1961). Where a block differs by more than that even from
/// those round it, its size is no density: scan lines that meet and part, or a hot spot smaller than a block,
/// make it. Then blocks are moved towards the mean of their place. And a block may not be much larger than
/// its neighbours: going from block to block, the usual size grows at most by the factor 1 + growth /
/// sqrt(number of blocks). So outliers round a shape are no sparse part of it. A sparse part far from the
/// others, in its own scale, is not bounded: no short edge joins it. It is the second smallest neighbour that
/// counts, since one may hold a bit of a dense place beside it.
///
/// **The limit.** In usual sizes, let A(s) be the area of the triangles of size s at most. Below the size of
/// the usual voids A grows quickly, by the triangles that chance made larger than others; beyond the width of
/// holes, notches and gaps it grows quickly again, by what is not of the shape. Between the two it hardly
/// grows. The rule takes s where A is stable, not far from where that usually is:
///
///   s = argmin  log(g(s) + still) + pull log^2(s / usual),   g = d log A / d log s,
///
/// on a grid of 16 sizes to the octave, g as a difference over `below` + `above` cells. `detail` divides s.
///
/// **Clusters.** Where points cluster, the usual voids lie between the clusters, and are larger than where
/// points do not. So less is known of where the limit usually is: where both the sizes of a block's triangles
/// and their shortest edges scatter by more than those of points that do not cluster, the pull on larger
/// limits is divided by 1 + doubt times what is more. Between scan lines and roads sizes scatter, but
/// shortest edges do not.
///
/// **Outlines.** Where points lie on curves only, most triangles have an edge that is far longer than the
/// distance of neighbours on a curve. Gaps between n points at random on a line are exponential: half of them
/// are longer than log 2 of their mean, and the largest is about log n of them, and in one set of 20 more
/// than log n + 3. Where many triangles have two edges longer than log n + `step`, OutlineFill is asked what
/// the curves enclose.
///
/// **What chance leaves.** Spikes, small parts and holes without a wide triangle go (SizeField). Parts and
/// circles are measured against log n, since the largest void and the largest cluster that chance makes grow
/// with it.
///
/// The field does not depend on the unit of the points or on where they lie but for rounding, nor on their
/// order or the number of threads. Points that repeat others move the blocks' borders, which moves the limit
/// within its noise. Where `detail` is at most 1 some triangle is always within the limit.
///
/// Source: this project; core/AUTOMATIC.md says what else was tried.
class AutomaticLimit {
 public:
  /// Points of a block on average, in a mesh of few; of many, as many as make kMostBlocks blocks.
  static constexpr std::size_t kBlockPoints = 64;
  static constexpr std::size_t kMostBlocks = 4096;

  /// Chooses the sizes for the mesh of `builder` and `detail` > 0: by one limit for all places where
  /// find_one() finds it, and else by blocks. O(n); of many triangles blocks look at a part only.
  void choose(const DelaunayBuilder& builder, double detail, ThreadPool& pool,
              const AutomaticConstants& constants = {});

  // The steps of choose(), for a caller who triangulates a part of the points only.

  /// Looks for one usual size for all places in a few windows. Returns false where the density differs from
  /// place to place by more than chance explains, or points are too few for windows. `box` is that of
  /// `points`, whose order does not matter. O(n).
  bool find_one(std::span<const Point> points, const Box& box, ThreadPool& pool,
                const AutomaticConstants& constants = {});
  /// After find_one() said yes: the circumradius from which on a triangle is wide. choose_one() and the field
  /// need no others than these and what a field drops.
  double wide_radius() const { return wide_radius_; }
  /// After find_one() said yes: chooses the limit for all places. `is_tested`: vertex -> whether; of the
  /// mesh of a part, where every wide triangle of the whole mesh has a tested corner, and every triangle with
  /// one is of the whole mesh. Null: the mesh is the whole one.
  void choose_one(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested, double detail,
                  ThreadPool& pool, const AutomaticConstants& constants = {});
  /// Chooses a limit for each block.
  void choose_by_blocks(const DelaunayBuilder& builder, double detail, ThreadPool& pool,
                        const AutomaticConstants& constants = {});

  /// What was chosen; valid until the next call.
  const SizeField& field() const { return field_; }
  /// The least, the median and the largest size that a triangle may have, in the unit of the builder's
  /// vertices; none where no triangle has a size above zero, and so all are kept.
  const std::optional<ChosenSizes>& range() const { return range_; }

 private:
  /// Of the grid of limits, of 16 cells to an octave of sizes.
  static constexpr std::size_t kCells = 64;

  /// From `begin` to one before `end`.
  struct Records {
    Mesh::Index begin;
    Mesh::Index end;
  };
  /// Blocks that share an edge, and the fourth power of the length of the shortest that was looked at.
  struct Border {
    std::uint32_t block;
    std::uint32_t neighbour;
    double length4;
  };
  /// Of the neighbours of a block.
  struct Smallest {
    std::uint32_t neighbour = kNone;
    double first4 = std::numeric_limits<double>::infinity();
    double second4 = std::numeric_limits<double>::infinity();
  };
  /// The logarithms of the usual sizes of a block's neighbours: their sum, in fine units, and how many
  /// there are. A border counts once for each of its sides that was looked at.
  struct Around {
    std::int64_t sum = 0;
    std::int64_t count = 0;
  };
  /// What is looked at of a block.
  struct BlockScratch {
    std::vector<double> sizes;          ///< of its triangles
    std::vector<Mesh::Index> crossing;  ///< half-edges whose twins are in other blocks
  };
  struct Sampled {
    double size4;  ///< in usual sizes of its block
    double area;   ///< in squares of them
  };

  void divide(const DelaunayBuilder& builder, double points);
  void measure_triangles(const Mesh& mesh, const Point* vertices, ThreadPool& pool);
  double size4_of(const Mesh& mesh, const Point* vertices, Mesh::Index t) const;
  void measure_blocks(const Mesh& mesh, const Point* vertices, ThreadPool& pool,
                      const AutomaticConstants& constants);
  Records records_of(const Mesh& mesh, std::size_t block) const;
  template <class Length4>
  double scatter_in_blocks(const Mesh& mesh, const Length4& length4);
  double excess_scatter(const Mesh& mesh, const Point* vertices, const AutomaticConstants& constants);
  double measure_block(const Mesh& mesh, const Point* vertices, std::uint32_t block, double quantile,
                       BlockScratch& scratch, std::vector<Border>& borders) const;
  template <class Visit>
  void for_each_neighbour(double reach, const Visit& visit) const;
  void smooth(const AutomaticConstants& constants);
  void bound_growth(const AutomaticConstants& constants);
  void shrink_to_median(double noise);
  void sample(const Mesh& mesh, const Point* vertices);
  void sum_up_areas();
  void add_wide_areas(const Mesh& mesh, const Point* vertices, const std::uint8_t* is_tested,
                      ThreadPool& pool);
  double steadiest_size4(const AutomaticConstants& constants) const;
  void look_for_outlines(const Mesh& mesh, const Point* vertices, double points, double detail,
                         const AutomaticConstants& constants);
  void set_field(double points, double detail, bool is_one, const AutomaticConstants& constants);

  WindowSample windows_;
  SizeField field_;
  Scratch<double> size4_;                ///< what the field says of triangles
  std::vector<std::size_t> block_ends_;  ///< block -> one past its last vertex
  std::optional<ChosenSizes> range_;
  std::vector<double> usual4_;  ///< block -> fourth power of its usual size; infinity where nothing is known
  std::vector<double> measured4_;  ///< the same before the step that works on it
  std::vector<Smallest> smallest_;
  std::vector<Around> around_;
  std::vector<double> logs_;     ///< block -> logarithm of its usual size, then how smoothing changes it
  std::vector<double> scratch_;  ///< of whatever a quantile is taken
  std::vector<BlockScratch> scratch_of_chunk_;
  std::vector<std::vector<Border>> borders_of_chunk_;
  std::vector<Sampled> samples_;
  double doubt_ = 1;                       ///< what the pull on larger limits is divided by
  double steadiest4_ = 0;                  ///< the limit at a detail of 1, in usual sizes
  double unit4_ = 0;                       ///< fourth power of the unit of the grid of limits
  std::array<double, kCells + 1> area_{};  ///< cell of that grid -> area of the triangles of its sizes
  // Of find_one():
  double points_ = 0;  ///< that are no repeats
  double wide_radius_ = 0;
};

}  // namespace polylidar::detail
