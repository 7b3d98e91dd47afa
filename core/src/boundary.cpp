#include "boundary.hpp"

#include <algorithm>

#include "predicates_inline.hpp"

namespace polylidar::detail {

namespace {

/// The boundary half-edge that follows `e` (a -> b): the first one met when turning at b through triangles
/// that are not in the region, those of other regions and the ghosts outside the convex hull among them. The
/// ring therefore runs along one edge-connected piece of the outside, which meets b only once: where a hole
/// touches a shell or another hole in a vertex, each stays a ring of its own.
Mesh::Index next_boundary(const Mesh& mesh, Mesh::Index e, std::uint32_t region) {
  Mesh::Index outside = mesh.twin(e);  // b -> a
  for (;;) {
    const Mesh::Index candidate = mesh.twin(Mesh::previous(outside));  // b -> x
    if (mesh.label(Mesh::triangle_of(candidate)) == region) return candidate;
    outside = candidate;
  }
}

/// Appends the ring that starts with half-edge `first` to `ring`, as vertices of the mesh.
void trace_ring(Mesh& mesh, Mesh::Index first, std::uint32_t region, std::vector<std::uint32_t>& ring) {
  Mesh::Index e = first;
  do {
    mesh.taken(Mesh::triangle_of(e)) |= 1U << (e & 3U);
    ring.push_back(mesh.origin(e));
    e = next_boundary(mesh, e, region);
  } while (e != first);
}

/// Whether a simple ring runs counter-clockwise, exactly: it turns the same way at its lexicographically
/// least vertex.
bool is_counter_clockwise(const Point* vertices, std::span<const std::uint32_t> ring) {
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    return vertices[a].x < vertices[b].x || (vertices[a].x == vertices[b].x && vertices[a].y < vertices[b].y);
  };
  const std::size_t count = ring.size();
  const auto least =
      static_cast<std::size_t>(std::min_element(ring.begin(), ring.end(), less) - ring.begin());
  const Point& before = vertices[ring[(least + count - 1) % count]];
  const Point& after = vertices[ring[(least + 1) % count]];
  return orient2d_fast(before, vertices[ring[least]], after) > 0;
}

/// Moves the shell, the one counter-clockwise ring, before the holes of the polygon whose rings start at
/// `first_ring`.
void put_shell_first(const Point* vertices, std::size_t first_ring, IndexedMultiPolygon& shape) {
  std::vector<std::uint32_t>& ends = shape.ring_ends;
  const std::uint32_t polygon_begin = first_ring == 0 ? 0 : ends[first_ring - 1];
  std::uint32_t begin = polygon_begin;
  for (std::size_t r = first_ring; r < ends.size(); begin = ends[r++]) {
    if (!is_counter_clockwise(vertices, {shape.vertices.data() + begin, shape.vertices.data() + ends[r]}))
      continue;
    const std::uint32_t shell_size = ends[r] - begin;
    std::rotate(shape.vertices.begin() + polygon_begin, shape.vertices.begin() + begin,
                shape.vertices.begin() + ends[r]);
    for (std::size_t hole = r; hole > first_ring; --hole) ends[hole] = ends[hole - 1] + shell_size;
    ends[first_ring] = polygon_begin + shell_size;
    return;
  }
}

}  // namespace

void trace_polygons(Mesh& mesh, const Point* vertices, const std::uint32_t* caller_index,
                    const RegionBoundaries& boundaries, IndexedMultiPolygon& shape) {
  shape.clear();
  std::uint32_t begin = 0;
  for (std::uint32_t region = 0; region < boundaries.ends.size(); ++region) {
    const std::size_t first_ring = shape.ring_ends.size();
    for (std::uint32_t i = begin; i < boundaries.ends[region]; ++i) {
      const Mesh::Index e = boundaries.half_edges[i];
      if ((mesh.taken(Mesh::triangle_of(e)) >> (e & 3U) & 1U) != 0) continue;
      trace_ring(mesh, e, region, shape.vertices);
      shape.ring_ends.push_back(static_cast<std::uint32_t>(shape.vertices.size()));
    }
    if (shape.ring_ends.size() > first_ring + 1) put_shell_first(vertices, first_ring, shape);
    shape.polygon_ends.push_back(static_cast<std::uint32_t>(shape.ring_ends.size()));
    begin = boundaries.ends[region];
  }
  for (std::uint32_t& vertex : shape.vertices) vertex = caller_index[vertex];
}

}  // namespace polylidar::detail
