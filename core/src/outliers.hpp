// Outliers all round the shape, told by two densities.
#pragma once

#include <optional>

#include "mesh_blocks.hpp"
#include "spacings.hpp"

namespace polylidar::detail {

/// The spacing, as a fourth power, that separates the points of the shape from the outliers round it; none if
/// no outliers are found. The smaller `sureness` is, the more often chance finds some.
///
/// Outliers have a density of their own, a few times below the shape's. So the logarithms of the spacings
/// have two peaks with a valley between them. Where the density varies smoothly, there is no valley. It must
/// be deeper than chance explains: by `sureness` standard deviations. Also
/// - 3 to 30 % of the points must lie beyond it;
/// - those before it must have about one density: their spacings may spread a third more than those of points
///   at random. A lidar that rotates has valleys between its rings, but a density that varies far more;
/// - nine tenths of the points on the convex hull must lie beyond it. A sparse part of the shape does not
///   surround the rest.
///
/// Source: this project; core/AUTOMATIC.md, "The rule".
std::optional<double> spacing4_of_outliers(const SizedMesh& sized, const Spacings& spacings, double sureness);

}  // namespace polylidar::detail
