// A limit for the size of triangles that varies by place: one value a block of the mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "half_edge.hpp"

namespace polylidar::detail {

/// Blocks are 2^shift consecutive triangles of the mesh, at least Mesh::kWordBits.
struct SizeField {
  /// Block -> the fourth power of the largest size of a triangle; inclusive.
  std::vector<double> limit4;
  /// Of limit4: the fourth power of the size from which a spike is not of the shape.
  double spike_share = 0;
  /// Regions of fewer triangles are not of the shape.
  std::size_t least_part = 0;
  /// Holes whose doubled area is less are of the shape, in mean squared sizes of the triangles round them.
  double least_hole = 0;
  unsigned shift = 0;

  std::size_t block_of(Mesh::Index triangle) const { return triangle >> shift; }
};

}  // namespace polylidar::detail
