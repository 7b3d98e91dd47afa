// A limit for the size of triangles that varies by place: one value a block of the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "half_edge.hpp"

namespace polylidar::detail {

/// A block is a range of vertices, which follow each other along the curve, with their two records each.
struct SizeField {
  /// Block -> the fourth power of the largest size of a triangle; inclusive.
  std::vector<double> limit4;
  /// Of limit4: the fourth power of the size from which a spike is not of the shape.
  double spike_share = 0;
  /// Regions of fewer triangles are not of the shape.
  std::size_t least_part = 0;
  /// Holes whose doubled area is less are of the shape, in mean squared sizes of the triangles round them.
  double least_hole = 0;
  /// Vertex -> its block.
  std::vector<std::uint32_t> block_of_vertex;

  std::uint32_t block_of(Mesh::Index triangle) const { return block_of_vertex[triangle / 2]; }
};

}  // namespace polylidar::detail
