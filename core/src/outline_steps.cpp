#include "outline_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "filter_rules.hpp"
#include "quantile.hpp"
#include "some_triangles.hpp"

namespace polylidar::detail {

namespace {

/// Whether no point lies inside the convex hull: there are two triangles fewer than points on it, and a ghost
/// for each of these.
bool are_all_on_hull(const Mesh& mesh) {
  std::size_t finite = 0;
  std::size_t ghosts = 0;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    if (!mesh.is_ghost(t)) {
      ++finite;
    } else if (!mesh.is_unused(t)) {
      ++ghosts;
    }
  }
  return ghosts == finite + 2;
}

}  // namespace

std::optional<double> squared_outline_step(const Mesh& mesh, const Point* vertices, double points,
                                           double step) {
  constexpr double kFewest = 32;
  constexpr double kFewestOnHull = 8;
  constexpr double kMostOnHull = 256;   // of more, the walls tell
  constexpr double kFlatOnHull = 0.25;  // half of the triangles of a regular dodecagon are as flat
  constexpr double kLeastShare = 0.06;  // of triangles that span from one outline to another
  constexpr double kMedianGap = std::numbers::ln2;  // of the mean
  const bool is_convex = points >= kFewestOnHull && points < kMostOnHull && are_all_on_hull(mesh);
  if (points < kFewest && !is_convex) return std::nullopt;
  const auto for_some = [&](std::size_t number, const auto& visit) {
    for_some_triangles(mesh, number, [&](Mesh::Index t) { visit(Triangle(mesh, vertices, t)); });
  };
  std::size_t looked_at = 0;
  std::size_t flat = 0;
  for_some(256, [&](const Triangle& triangle) {
    ++looked_at;
    const double share = is_convex ? kFlatOnHull : kFlat;
    flat += is_flat(triangle.twice_area(), triangle.squared_longest_edge(), share) ? 1U : 0U;
  });
  if (looked_at == 0 || 2 * flat < looked_at) return std::nullopt;
  if (is_convex) return std::numeric_limits<double>::infinity();

  std::vector<double> shortest;  // squares of edges, triangle by triangle
  std::vector<double> second;
  for_some(2048, [&](const Triangle& triangle) {
    std::array<double, 3> edges{triangle.squared_ab(), triangle.squared_bc(), triangle.squared_ca()};
    std::sort(edges.begin(), edges.end());
    shortest.push_back(edges[0]);
    second.push_back(edges[1]);
  });
  if (second.empty()) return std::nullopt;
  const double steps = (std::log(points) + step) / kMedianGap;
  const double squared_step = quantile_of(shortest, 0.5) * steps * steps;
  const auto longer =
      std::count_if(second.begin(), second.end(), [&](double edge) { return edge > squared_step; });
  if (static_cast<double>(longer) < kLeastShare * static_cast<double>(second.size())) return std::nullopt;
  return squared_step;
}

}  // namespace polylidar::detail
