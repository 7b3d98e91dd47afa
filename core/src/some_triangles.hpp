// A sample of a mesh's triangles.
#pragma once

#include <cstddef>

#include "half_edge.hpp"

namespace polylidar::detail {

/// Visits about `number` triangles, evenly over the mesh; all if there are fewer than twice as many. Points
/// that repeat others leave their records unused, and a step over records could keep step with them; so where
/// many are unused, steps are over triangles.
template <typename Visit>
void for_some_triangles(const Mesh& mesh, std::size_t number, const Visit& visit) {
  const std::size_t records = mesh.triangle_count();
  const std::size_t step = (records / number) | 1U;
  const auto is_triangle = [&](std::size_t i) { return !mesh.is_ghost(static_cast<Mesh::Index>(i)); };
  std::size_t looked_at = 0;
  std::size_t found = 0;
  for (std::size_t i = 0; i < records; i += step) {
    ++looked_at;
    found += is_triangle(i) ? 1U : 0U;
  }
  if (16 * found >= 15 * looked_at || step == 1) {
    for (std::size_t i = 0; i < records; i += step) {
      if (is_triangle(i)) visit(static_cast<Mesh::Index>(i));
    }
    return;
  }
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < records; ++i) triangles += is_triangle(i) ? 1U : 0U;
  const std::size_t between = (triangles / number) | 1U;
  std::size_t passed = 0;
  for (std::size_t i = 0; i < records; ++i) {
    if (is_triangle(i) && passed++ % between == 0) visit(static_cast<Mesh::Index>(i));
  }
}

}  // namespace polylidar::detail
