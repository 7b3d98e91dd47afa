// How much the spacing of the points differs from one point to the next.
#pragma once

#include <cstdint>
#include <span>

#include "automatic_constants.hpp"
#include "mesh_blocks.hpp"
#include "spacings.hpp"

namespace polylidar::detail {

/// By how much the spacings of points, in usual sizes of their places, scatter more than those of points
/// whose density varies smoothly; 0 if they do not. `usual4`: block -> the fourth power of its usual size;
/// `points`: how many do not repeat others.
///
/// Scatter is the logarithm of the 0.6 quantile over the 0.2 quantile. Points at random have 0.33. Where the
/// density changes within a few points, as in clusters, it is more. Outliers have large spacings; up to a
/// fifth of them hardly changes these quantiles.
///
/// 0 also if half of the triangles are flat, as points on lines and outlines make them, or if the distances
/// to the nearest neighbours do not surely scatter more than on a grid: on roads that cross, spacings scatter
/// though neighbours are evenly spaced.
double excess_scatter(const SizedMesh& sized, const Spacings& spacings,
                      std::span<const std::uint32_t> block_of_vertex, std::span<const double> usual4,
                      double points, const AutomaticConstants& constants);

}  // namespace polylidar::detail
