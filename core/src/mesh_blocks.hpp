// Blocks of a mesh: runs of its vertices, each of which covers a compact place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay_builder.hpp"
#include "filter_rules.hpp"
#include "half_edge.hpp"
#include "thread_pool.hpp"
#include "usual_sizes.hpp"

namespace polylidar::detail {

/// A mesh and, if they were measured, the sizes of its triangles.
struct SizedMesh {
  const Mesh& mesh;
  const Point* vertices;
  const double* size4;  ///< triangle -> Triangle::size4(); null if they were not measured

  /// A finite triangle, as the next.
  Triangle triangle(Mesh::Index t) const { return {mesh, vertices, t}; }
  double size4_of(Mesh::Index t) const { return size4 != nullptr ? size4[t] : triangle(t).size4(); }
};

/// Calls visit(t) for the finite triangles in every `step`-th pair of the records from `begin` to `end`,
/// which are even. Whole pairs, since the first of a pair is smaller than the second on average.
template <class Visit>
void for_every_nth_pair(const Mesh& mesh, Mesh::Index begin, Mesh::Index end, Mesh::Index step,
                        const Visit& visit) {
  for (Mesh::Index first = begin; first < end; first += 2 * step) {
    if (!mesh.is_ghost(first)) visit(first);
    if (!mesh.is_ghost(first + 1)) visit(first + 1);
  }
}

/// The mesh stores vertices and triangles in the order of the space-filling curve. A block is a run of
/// consecutive vertices that ends where the curve leaves a large cell, so it covers a compact place. Its
/// usual size is a quantile of the sizes of its triangles, whether density, scan lines or a lattice make
/// them. Keeps its memory.
class MeshBlocks {
 public:
  /// Mean number of points in a block. With many points blocks are larger, so that there are about kMost.
  static constexpr std::size_t kPoints = 64;
  static constexpr std::size_t kMost = 4096;

  /// Records of triangles from `begin` to one before `end`.
  struct Records {
    Mesh::Index begin;
    Mesh::Index end;
  };

  /// Divides the vertices of `builder`, of which `points` do not repeat others, into blocks, and puts the
  /// block of each vertex into `block_of_vertex`.
  void divide(const DelaunayBuilder& builder, double points, std::vector<std::uint32_t>& block_of_vertex);
  std::size_t count() const { return ends_.size(); }
  /// Those of a block.
  Records records_of(const Mesh& mesh, std::size_t block) const;
  /// Finds the usual size of each block, which is this quantile, and on which others it borders.
  /// `block_of_vertex` is what divide() found. Of blocks with many triangles only some are looked at.
  void measure(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex, double quantile,
               ThreadPool& pool, UsualSizes& sizes);

 private:
  /// The data of a block that is being looked at.
  struct BlockScratch {
    std::vector<double> sizes;          ///< of its triangles, and room for more
    std::vector<Mesh::Index> crossing;  ///< half-edges with twins in other blocks
    /// Block -> its index among the borders, where it is a neighbour of the block that is looked at.
    std::vector<std::uint32_t> border_with;
  };

  double measure_block(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
                       std::uint32_t block, double quantile, BlockScratch& scratch,
                       std::vector<UsualSizes::Border>& borders) const;

  std::vector<std::size_t> ends_;  ///< block -> one past its last vertex
  std::vector<BlockScratch> scratch_of_chunk_;
};

}  // namespace polylidar::detail
