// The usual size of triangles, block by block, and how it is freed of what does not measure a density.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "automatic_constants.hpp"
#include "polylidar/delaunay.hpp"

namespace polylidar::detail {

/// A usual size for each block, and which blocks border on which. A block is a run of vertices (MeshBlocks)
/// or a place (WindowSample). Sizes are fourth powers of lengths, as Triangle::size4(). Keeps its memory.
///
/// Chance alone makes the usual sizes of blocks of 64 points differ by `noise`. If they differ by no more, as
/// for uniform points, all blocks take the median. If they differ by more, the part of the variance that
/// noise explains is removed (James and Stein 1961). If a block differs by more than noise even from the
/// blocks round it, its size does not measure a density: scan lines that meet and part, or a hot spot smaller
/// than a block, cause it. Blocks are then moved towards the mean of their neighbourhood. A block may also
/// not be much larger than its neighbours: from block to block the usual size grows at most by the factor 1 +
/// growth / sqrt(number of blocks). So outliers round a shape do not count as a sparse part of it. A sparse
/// part that is far from the others, measured by its own spacing, is not bounded, since no short edge joins
/// it to them.
///
/// Apart from rounding, no step depends on the order of the borders.
class UsualSizes {
 public:
  /// Of a block without triangles.
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  /// Two blocks that share an edge, and the fourth power of the length of the shortest shared edge that was
  /// looked at. The same two may be there twice, also the other way round.
  struct Border {
    std::uint32_t block;
    std::uint32_t neighbour;
    double length4;
  };

  /// So many blocks, all unknown, without borders; these come in so many chunks.
  void reset(std::size_t blocks, std::size_t chunks = 1);
  /// Block -> its usual size, or kUnknown.
  std::vector<double>& usual4() { return usual4_; }
  const std::vector<double>& usual4() const { return usual4_; }
  std::vector<Border>& borders(std::size_t chunk) { return borders_of_chunk_[chunk]; }

  /// Where blocks differ from those round them by more than noise explains, moves each towards the mean of
  /// itself and its neighbours, by the share of the difference's variance that is not noise's.
  void smooth(const AutomaticConstants& constants);
  /// Gives each block the median of its own usual size and those of its neighbours, as far as they are known.
  /// Among scan lines a window may lie where two lines nearly meet.
  void take_medians_of_neighbours();
  /// No block may be larger than the median of the blocks up to this size. Returns it; kUnknown if there is
  /// no such block, and nothing changes.
  double level_above(double size4);
  /// No block may be larger than the second smallest of its neighbours allows, nor that one than its own. The
  /// smallest may hold a bit of a dense place beside it. The growth is that of so many blocks.
  void bound_growth(std::size_t blocks, const AutomaticConstants& constants);
  /// Takes from the differences what noise explains. All blocks are known after that, if any was.
  void shrink_to_median(double noise);
  /// Raises this share of the sizes, the smallest ones, to the next larger one, and returns that.
  double raise_least(double share);

 private:
  /// A summary of the neighbours of a block.
  struct Smallest {
    std::uint32_t neighbour = kNone;
    double first4 = kUnknown;
    double second4 = kUnknown;
  };
  /// The sum, in fine units, and the number of the logarithms of the usual sizes of a block's neighbours. A
  /// border counts once for each of its two sides that was looked at.
  struct NeighbourSum {
    std::int64_t sum = 0;
    std::int64_t count = 0;
  };

  template <class Visit>
  void for_each_neighbour(double reach, const Visit& visit) const;

  std::vector<double> usual4_;
  std::vector<double> measured4_;  ///< the same before the step that works on it
  std::vector<std::vector<Border>> borders_of_chunk_;
  std::vector<Smallest> smallest_;
  std::vector<NeighbourSum> neighbour_sums_;
  std::vector<double> logs_;     ///< block -> logarithm of its usual size, then how smoothing changes it
  std::vector<double> scratch_;  ///< values of which a quantile is taken
};

}  // namespace polylidar::detail
