#include "spacing_scatter.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "outline_steps.hpp"
#include "quantile.hpp"

namespace polylidar::detail {

namespace {

/// How much spacings scatter, and what chance may add to that or take from it: about three
/// standard deviations.
struct Scatter {
  double value;
  double by_chance;
};

/// Of spacings, at least one, at some of so many points, as fourth powers; may reorder them.
Scatter scatter_of(std::vector<double>& spacings4, double points) {
  constexpr double kLarge = 0.85;    // among the larger ones are those of outliers
  constexpr double kByChance = 1.6;  // times the root of the number of points looked at
  const double looked_at = std::min(points, static_cast<double>(spacings4.size()));
  const double by_chance = kByChance / std::sqrt(looked_at);
  const double median = quantile_of(spacings4, 0.5);
  if (!(median > 0) || !std::isfinite(median)) return {0, by_chance};
  return {std::log(quantile_of(spacings4, kLarge) / median) / 4, by_chance};
}

double excess(const Scatter& scatter, const AutomaticConstants& constants) {
  return std::max(scatter.value - scatter.by_chance - constants.even, 0.0);
}

/// Fills `spacings4` with those at the first corners of about so many triangles, in usual sizes. Returns
/// whether half of these triangles are flat.
bool look_at(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
             std::span<const double> usual4, Mesh::Index triangles, std::vector<double>& spacings4) {
  const Mesh& mesh = sized.mesh;
  const auto size4_of = [&](Mesh::Index t) {
    if (sized.size4 != nullptr) return sized.size4[t];
    return mesh.is_ghost(t) ? std::numeric_limits<double>::quiet_NaN() : sized.triangle(t).size4();
  };
  for (Mesh::Index step = (mesh.triangle_count() / triangles) | 1U;; step = 1) {
    spacings4.clear();
    std::size_t flat = 0;
    for (std::size_t i = 0; i < mesh.triangle_count(); i += step) {
      const auto t = static_cast<Mesh::Index>(i);
      if (mesh.is_ghost(t)) continue;
      const Mesh::Index corner = Mesh::kStride * t;
      spacings4.push_back(spacing4_at(mesh, corner, size4_of) / usual4[block_of_vertex[mesh.origin(corner)]]);
      const Triangle triangle = sized.triangle(t);
      flat += is_flat(triangle.twice_area(), triangle.squared_longest_edge()) ? 1U : 0U;
    }
    if (step == 1 || spacings4.size() >= triangles / 4) return 2 * flat >= spacings4.size();
  }
}

}  // namespace

double excess_scatter(std::vector<double> spacings4, double points, const AutomaticConstants& constants) {
  return spacings4.empty() ? 0 : excess(scatter_of(spacings4, points), constants);
}

double excess_scatter(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
                      std::span<const double> usual4, double points, const AutomaticConstants& constants) {
  constexpr Mesh::Index kAtFirst = 256;  // enough where points are clearly even
  constexpr Mesh::Index kMost = 1024;
  std::vector<double> spacings4;
  spacings4.reserve(2 * kMost);
  if (look_at(sized, block_of_vertex, usual4, kAtFirst, spacings4)) return 0;
  const Scatter first = scatter_of(spacings4, points);
  if (first.value + first.by_chance < constants.even) return 0;
  return look_at(sized, block_of_vertex, usual4, kMost, spacings4)
             ? 0
             : excess(scatter_of(spacings4, points), constants);
}

}  // namespace polylidar::detail
