#include "polylidar/delaunay.hpp"

#include "delaunay_builder.hpp"

namespace polylidar {

Triangulation delaunay(std::span<const Point> points) {
  using detail::Mesh;
  detail::DelaunayBuilder builder;
  detail::ThreadPool this_thread;
  builder.build(points, this_thread);
  const Mesh& mesh = builder.mesh();
  const std::uint32_t* caller_index = builder.caller_index();

  // Triangle of the mesh -> triangle of the result; kNone for ghosts.
  std::vector<std::uint32_t> number(mesh.triangle_count());
  std::uint32_t count = 0;
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) number[t] = mesh.is_ghost(t) ? kNone : count++;

  Triangulation result;
  result.triangles.resize(std::size_t{3} * count);
  result.halfedges.resize(std::size_t{3} * count);
  for (Mesh::Index t = 0; t < mesh.triangle_count(); ++t) {
    if (number[t] == kNone) continue;
    for (Mesh::Index k = 0; k < 3; ++k) {
      const Mesh::Index e = Mesh::kStride * t + k;
      const Mesh::Index twin = mesh.twin(e);
      const std::uint32_t neighbour = number[Mesh::triangle_of(twin)];
      result.triangles[3 * number[t] + k] = caller_index[mesh.origin(e)];
      result.halfedges[3 * number[t] + k] = neighbour == kNone ? kNone : 3 * neighbour + (twin & 3U);
    }
  }
  return result;
}

}  // namespace polylidar
