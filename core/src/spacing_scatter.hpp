// How much the spacing of the points differs from one point to the next.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "automatic_constants.hpp"
#include "half_edge.hpp"
#include "mesh_blocks.hpp"

namespace polylidar::detail {

/// The *spacing* at a point is the size of the third smallest triangle round it: about the median, and never
/// that of a void beside the point while three other triangles are small. Returns its fourth power at the
/// start of half-edge `e`, infinity where fewer than three triangles meet. size4_of: triangle -> the fourth
/// power of its size, NaN of a ghost.
template <class Size4Of>
double spacing4_at(const Mesh& mesh, Mesh::Index e, const Size4Of& size4_of);

/// By how much spacings scatter more than those of points whose density varies smoothly; 0 if they do not.
/// `spacings4`: at some of so many points, fourth powers, in usual sizes of their places.
///
/// Scatter is the logarithm of the 0.85 quantile over the median. Points at random have 0.27. On scan lines
/// and roads it is less, as neighbours are evenly spaced. Where the density changes within a few points, as
/// in clusters, it is more.
double excess_scatter(std::vector<double> spacings4, double points, const AutomaticConstants& constants);
/// At up to about a thousand points of a mesh. 0 also if half of the triangles are flat, as points on lines
/// and outlines make them, or if the distances to the nearest neighbours scatter clearly less than those of
/// points at random: on roads that cross and on grids, spacings scatter though neighbours are evenly spaced.
/// `usual4`: block -> the fourth power of its usual size; `points`: how many do not
/// repeat others.
double excess_scatter(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
                      std::span<const double> usual4, double points, const AutomaticConstants& constants);

template <class Size4Of>
double spacing4_at(const Mesh& mesh, Mesh::Index e, const Size4Of& size4_of) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double first = kInfinity;
  double second = kInfinity;
  double third = kInfinity;
  Mesh::Index turned = e;
  do {
    const double size4 = size4_of(Mesh::triangle_of(turned));
    third = std::min(third, std::max(size4, second));  // the first where one is NaN
    second = std::min(second, std::max(size4, first));
    first = std::min(first, size4);
    turned = mesh.twin(Mesh::previous(turned));
  } while (turned != e);
  return third;
}

}  // namespace polylidar::detail
