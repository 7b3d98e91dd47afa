#include "spacing_scatter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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

constexpr Mesh::Index kMostSpacings = 1024;  // about so many are looked at

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

/// As whole numbers doubles that are not negative have the same order, and the smaller of two is found
/// without a branch. NaN, here that of a ghost, is above infinity.
std::uint64_t in_order(double size4) {
  return std::bit_cast<std::uint64_t>(size4);
}

/// What is round a vertex, as fourth powers.
struct Around {
  double spacing4;  ///< infinity where fewer than three triangles meet
  double nearest4;  ///< the distance to the nearest other vertex
};

/// Of the start of half-edge `e`.
Around look_around(const SizedMesh& sized, Mesh::Index e) {
  const Mesh& mesh = sized.mesh;
  const Point& point = sized.vertices[mesh.origin(e)];
  std::uint64_t first = in_order(std::numeric_limits<double>::infinity());
  std::uint64_t second = first;
  std::uint64_t third = first;
  double squared = std::numeric_limits<double>::infinity();
  Mesh::Index turned = e;
  do {
    const Mesh::Index t = Mesh::triangle_of(turned);
    const Mesh::Index other = mesh.origin(Mesh::next(turned));
    const std::uint64_t size4 = in_order(sized.size4 != nullptr ? sized.size4[t]
                                         : mesh.is_ghost(t)     ? std::numeric_limits<double>::quiet_NaN()
                                                                : sized.triangle(t).size4());
    third = std::min(third, std::max(size4, second));
    second = std::min(second, std::max(size4, first));
    first = std::min(first, size4);
    if (other != kNone) squared = std::min(squared, squared_length(sized.vertices[other] - point));
    turned = mesh.twin(Mesh::previous(turned));
  } while (turned != e);
  return {std::bit_cast<double>(third), squared * squared};
}

/// The first corners of about `kMostSpacings` triangles, evenly over the mesh.
std::vector<Mesh::Index> corners_to_look_at(const Mesh& mesh) {
  std::vector<Mesh::Index> corners;
  corners.reserve(2 * kMostSpacings);
  for (Mesh::Index step = (mesh.triangle_count() / kMostSpacings) | 1U;; step = 1) {
    corners.clear();
    for (std::size_t i = 0; i < mesh.triangle_count(); i += step) {
      const auto t = static_cast<Mesh::Index>(i);
      if (!mesh.is_ghost(t)) corners.push_back(Mesh::kStride * t);
    }
    if (step == 1 || corners.size() >= kMostSpacings / 4) return corners;
  }
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

double excess_scatter(const SizedMesh& sized, std::span<const std::uint32_t> block_of_vertex,
                      std::span<const double> usual4, double points, const AutomaticConstants& constants) {
  // On a grid a neighbour is one step away or a diagonal: log sqrt(2). Points at random have 0.50.
  constexpr double kLeastOfNearest = 0.347;
  const std::vector<Mesh::Index> corners = corners_to_look_at(sized.mesh);
  std::vector<double> spacings4;
  std::vector<double> nearest4;
  spacings4.reserve(corners.size());
  nearest4.reserve(corners.size());
  for (const Mesh::Index corner : corners) {
    const Around around = look_around(sized, corner);
    const double usual = usual4[block_of_vertex[sized.mesh.origin(corner)]];
    const double spacing = around.spacing4 / usual;
    const double nearest = around.nearest4 / usual;
    if (std::isfinite(spacing)) spacings4.push_back(spacing);
    if (std::isfinite(nearest)) nearest4.push_back(nearest);
  }
  const double of_spacings = excess(scatter_of(spacings4, points, kOfSpacings), constants);
  if (of_spacings == 0 || are_flat(sized, corners)) return 0;
  const Scatter of_nearest = scatter_of(nearest4, points, kOfNearest);
  return of_nearest.value - of_nearest.by_chance < kLeastOfNearest ? 0 : of_spacings;
}

}  // namespace polylidar::detail
