// How far apart the points are, at some of them.
#pragma once

#include <vector>

#include "mesh_blocks.hpp"

namespace polylidar::detail {

/// What is round a vertex, as fourth powers of lengths.
struct Around {
  /// The size of the third smallest triangle: about the median, and never that of a void beside the point
  /// while three other triangles are small. Infinite where fewer than three triangles meet.
  double spacing4;
  double nearest4;  ///< the distance to the nearest other vertex
};

/// Of the start of half-edge `e`.
Around look_around(const SizedMesh& sized, Mesh::Index e);

/// About a thousand points, evenly over the mesh.
struct Spacings {
  std::vector<Mesh::Index> corners;  ///< half-edges that start at them, each the first of its triangle
  std::vector<Around> around;        ///< of each
};

/// Looks round so many.
Spacings look_around_some(const SizedMesh& sized);

}  // namespace polylidar::detail
