#include "spacing_scatter.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "outline_steps.hpp"
#include "quantile.hpp"

namespace polylidar::detail {

namespace {

/// How much lengths scatter, and what chance may add to that or take from it: about three standard
/// deviations.
struct Scatter {
  double value;
  double by_chance;
};

/// Of a scatter at so many points.
double by_chance(double points) {
  constexpr double kThreeDeviations = 1.6;
  return kThreeDeviations / std::sqrt(points);
}

/// Of lengths at some of so many points, at least one length, as fourth powers; may reorder them.
Scatter scatter_of(std::vector<double>& lengths4, double points) {
  constexpr double kLarge = 0.85;  // among the larger ones are those of outliers
  const double deviations = by_chance(std::min(points, static_cast<double>(lengths4.size())));
  const double median = quantile_of(lengths4, 0.5);
  if (!(median > 0) || !std::isfinite(median)) return {0, deviations};
  return {std::log(quantile_of(lengths4, kLarge) / median) / 4, deviations};
}

double excess(const Scatter& scatter, const AutomaticConstants& constants) {
  return std::max(scatter.value - scatter.by_chance - constants.even, 0.0);
}

/// The fourth power of the distance from the start of half-edge `e` to the nearest other vertex.
double nearest4_at(const SizedMesh& sized, Mesh::Index e) {
  const Mesh& mesh = sized.mesh;
  const Point& point = sized.vertices[mesh.origin(e)];
  double squared = std::numeric_limits<double>::infinity();
  Mesh::Index turned = e;
  do {
    const Mesh::Index other = mesh.origin(Mesh::next(turned));
    if (other != kNone) squared = std::min(squared, squared_length(sized.vertices[other] - point));
    turned = mesh.twin(Mesh::previous(turned));
  } while (turned != e);
  return squared * squared;
}

/// Fills `lengths4` with length4_at(half-edge), in usual sizes, at the first corners of about so many
/// triangles. Returns whether half of these triangles are flat.
template <class Length4At>
bool look_at(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
             std::span<const double> usual4, Mesh::Index triangles, const Length4At& length4_at,
             std::vector<double>& lengths4) {
  const Mesh& mesh = sized.mesh;
  for (Mesh::Index step = (mesh.triangle_count() / triangles) | 1U;; step = 1) {
    lengths4.clear();
    std::size_t flat = 0;
    for (std::size_t i = 0; i < mesh.triangle_count(); i += step) {
      const auto t = static_cast<Mesh::Index>(i);
      if (mesh.is_ghost(t)) continue;
      const Mesh::Index corner = Mesh::kStride * t;
      lengths4.push_back(length4_at(corner) / usual4[block_of_vertex[mesh.origin(corner)]]);
      const Triangle triangle = sized.triangle(t);
      flat += is_flat(triangle.twice_area(), triangle.squared_longest_edge()) ? 1U : 0U;
    }
    if (step == 1 || lengths4.size() >= triangles / 4) return 2 * flat >= lengths4.size();
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
  constexpr double kLeastOfNearest = 0.34;  // points at random have 0.50
  std::vector<double> lengths4;
  lengths4.reserve(2 * kMost);
  const auto spacing4_of = [&](Mesh::Index corner) {
    return spacing4_at(sized.mesh, corner, [&](Mesh::Index t) {
      if (sized.size4 != nullptr) return sized.size4[t];
      return sized.mesh.is_ghost(t) ? std::numeric_limits<double>::quiet_NaN() : sized.triangle(t).size4();
    });
  };
  if (look_at(sized, block_of_vertex, usual4, kAtFirst, spacing4_of, lengths4)) return 0;
  const Scatter first = scatter_of(lengths4, points);
  const double of_most = by_chance(std::min(points, static_cast<double>(kMost)));
  if (first.value + first.by_chance < constants.even + of_most) return 0;
  if (look_at(sized, block_of_vertex, usual4, kMost, spacing4_of, lengths4)) return 0;
  const double of_spacings = excess(scatter_of(lengths4, points), constants);
  if (of_spacings == 0) return 0;
  const auto nearest4_of = [&](Mesh::Index corner) { return nearest4_at(sized, corner); };
  look_at(sized, block_of_vertex, usual4, kMost, nearest4_of, lengths4);
  const Scatter nearest = scatter_of(lengths4, points);
  return nearest.value - nearest.by_chance < kLeastOfNearest ? 0 : of_spacings;
}

}  // namespace polylidar::detail
