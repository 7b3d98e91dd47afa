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
/// - those beyond must be about as far from their nearest neighbours as points at random. The rings of a
///   rotating lidar have valleys between them, too, but along a ring points are close;
/// - nine tenths of the points on the convex hull must lie beyond it. A sparse part of the shape rarely
///   surrounds the rest;
/// - those beyond must be spread over the whole convex hull. Where a shape has one dense place, as a country
///   has round its largest town, its sparse points leave the outside empty.
///
/// Source: this project; core/AUTOMATIC.md, "The rule".
std::optional<double> spacing4_of_outliers(const SizedMesh& sized, const Spacings& spacings, double sureness);

}  // namespace polylidar::detail
