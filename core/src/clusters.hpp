// How strongly points cluster, told by how lengths scatter within a block.
#pragma once

#include <cstdint>
#include <span>

#include "automatic_constants.hpp"
#include "mesh_blocks.hpp"
#include "window_sample.hpp"

namespace polylidar::detail {

/// The limit that is taken where the points do not cluster.
struct UsualLimit {
  std::span<const std::uint32_t> block_of_vertex;
  std::span<const double> usual4;  ///< block -> the fourth power of its usual size
  double limit4;                   ///< the fourth power of the limit, in usual sizes
};

/// By how much sizes of triangles and their shortest edges both scatter more than those of points that do not
/// cluster; 0 if one of them does not. On scan lines and roads the sizes scatter, but the shortest edges do
/// not.
///
/// The fewer blocks there are, the less their scatters say: thin shapes and outliers make lengths scatter,
/// too. But the usual limit leaves a thin shape in one piece, and clusters in many. So in fewer than 96
/// blocks only two fifths of the excess count for certain. The rest counts in proportion to the share of the
/// points outside the largest piece, up to half of them.
///
/// In fewer than 16 blocks many triangles lie outside the shape, so sizes scatter anyway; but the shortest
/// edges of most of these are steps along the outline. So there the edges alone are looked at, of all blocks
/// together, and their scatter must be surely larger. If half of the triangles are flat, points lie on lines
/// or outlines, whose steps scatter without clusters. Two fifths of the excess count, in proportion to the
/// share of the points outside the largest piece, up to a quarter of them.
double excess_scatter(const SizedMesh& sized, const MeshBlocks& blocks, const UsualLimit& usual,
                      const AutomaticConstants& constants);
/// The same of the windows of places, after look_by_places() returned true.
double excess_scatter(const WindowSample& windows, const AutomaticConstants& constants);

}  // namespace polylidar::detail
