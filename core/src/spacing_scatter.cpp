#include "spacing_scatter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "outline_steps.hpp"
#include "quantile.hpp"

namespace polylidar::detail {

namespace {

/// How much lengths scatter, and what chance may have added to that or taken from it.
struct Scatter {
  double value;
  double by_chance;
};

/// How scatter is measured: as the logarithm of one quantile over another. Chance adds up to about
/// `by_chance` / sqrt(lengths): three standard deviations of points at random.
struct Measure {
  double small;
  double large;
  double by_chance;
};

constexpr Measure kOfSpacings = {0.2, 0.6, 2.4};  // a fifth of outliers hardly changes these quantiles
constexpr Measure kOfNearest = {0.5, 0.85, 1.6};

/// Of finite lengths at some of so many points, as fourth powers; may reorder them.
Scatter scatter_of(std::vector<double>& lengths4, double points, const Measure& measure) {
  if (lengths4.empty()) return {0, 0};
  const double looked_at = std::min(points, static_cast<double>(lengths4.size()));
  const double chance = measure.by_chance / std::sqrt(looked_at);
  const double small = quantile_of(lengths4, measure.small);
  if (small == 0) return {0, chance};
  return {std::log(quantile_of(lengths4, measure.large) / small) / 4, chance};
}

double excess(const Scatter& scatter, const AutomaticConstants& constants) {
  return std::max(scatter.value - scatter.by_chance - constants.even, 0.0);
}

/// Whether half of the triangles with these corners are flat.
bool are_flat(const SizedMesh& sized, const std::vector<Mesh::Index>& corners) {
  const auto flat = std::count_if(corners.begin(), corners.end(), [&](Mesh::Index corner) {
    const Triangle triangle = sized.triangle(Mesh::triangle_of(corner));
    return is_flat(triangle.twice_area(), triangle.squared_longest_edge());
  });
  return 2 * static_cast<std::size_t>(flat) >= corners.size();
}

}  // namespace

double excess_scatter(const SizedMesh& sized, const Spacings& spacings,
                      std::span<const std::uint32_t> block_of_vertex, std::span<const double> usual4,
                      double points, const AutomaticConstants& constants) {
  // On a grid a neighbour is one step away or a diagonal: log sqrt(2). Points at random have 0.50.
  constexpr double kLeastOfNearest = 0.347;
  std::vector<double> spacings4;
  std::vector<double> nearest4;
  spacings4.reserve(spacings.corners.size());
  nearest4.reserve(spacings.corners.size());
  for (std::size_t i = 0; i < spacings.corners.size(); ++i) {
    const double usual = usual4[block_of_vertex[sized.mesh.origin(spacings.corners[i])]];
    const double spacing = spacings.around[i].spacing4 / usual;
    const double nearest = spacings.around[i].nearest4 / usual;
    if (std::isfinite(spacing)) spacings4.push_back(spacing);
    if (std::isfinite(nearest)) nearest4.push_back(nearest);
  }
  const double of_spacings = excess(scatter_of(spacings4, points, kOfSpacings), constants);
  if (of_spacings == 0 || are_flat(sized, spacings.corners)) return 0;
  const Scatter of_nearest = scatter_of(nearest4, points, kOfNearest);
  return of_nearest.value - of_nearest.by_chance < kLeastOfNearest ? 0 : of_spacings;
}

}  // namespace polylidar::detail
