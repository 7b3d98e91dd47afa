#include "boundary.hpp"

#include <algorithm>

#include "predicates_inline.hpp"

namespace polylidar::detail {

namespace {

/// The boundary half-edge that follows `e` (a -> b) when turning at b through the region's own triangles.
Mesh::Index next_boundary(const Mesh& mesh, Mesh::Index e) {
  Mesh::Index f = Mesh::next(e);
  for (;;) {
    const Mesh::Index twin = mesh.twin(f);
    if ((mesh.state(Mesh::triangle_of(twin)) & Mesh::kKept) == 0) return f;
    f = Mesh::next(twin);
  }
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
  const Point& before = vertices[ring[least == 0 ? count - 1 : least - 1]];
  const Point& after = vertices[ring[least + 1 == count ? 0 : least + 1]];
  return orient2d_fast(before, vertices[ring[least]], after) > 0;
}

}  // namespace

void BoundaryTracer::trace(Mesh& mesh, const Point* vertices, std::size_t vertex_count,
                           const std::uint32_t* caller_index, const std::vector<Index>& boundary,
                           IndexedMultiPolygon& shape) {
  ring_vertices_.clear();
  rings_.clear();
  region_count_ = 0;
  std::uint32_t* place = place_in_walk_.reserve(vertex_count);
  for (const Index e : boundary) {
    place[mesh.origin(e)] = kNone;
    mesh.state(Mesh::triangle_of(e)) = Mesh::kKept;  // forgets an earlier trace
  }
  for (const Index e : boundary) {
    if ((mesh.state(Mesh::triangle_of(e)) & Mesh::taken_bit(e)) == 0) trace_walk(mesh, vertices, e);
  }
  assign_holes(mesh);
  emit(caller_index, shape);
}

/// Follows the boundary from `first` until it closes, splitting off a ring whenever it comes back to a
/// vertex.
///
/// Turning inside the region, the walk passes a vertex once for each fan of triangles that the region has
/// there. Two fans of one region in a vertex mean that a hole touches the shell or another hole there, and
/// the walk runs round both. Split at such vertices, each becomes a simple ring of its own, as the OGC's
/// definition of a polygon wants it.
void BoundaryTracer::trace_walk(Mesh& mesh, const Point* vertices, Index first) {
  std::uint32_t* place = place_in_walk_.data();
  const std::size_t first_ring = rings_.size();
  walk_.clear();
  Index e = first;
  do {
    mesh.state(Mesh::triangle_of(e)) |= Mesh::taken_bit(e);
    const std::uint32_t vertex = mesh.origin(e);
    if (place[vertex] != kNone) add_ring(vertices, place[vertex], first);
    place[vertex] = static_cast<std::uint32_t>(walk_.size());
    walk_.push_back(vertex);
    e = next_boundary(mesh, e);
  } while (e != first);
  add_ring(vertices, 0, first);

  // The walk round the outside of a region holds its shell; one round a hole holds holes only.
  const auto shell = std::find_if(rings_.begin() + static_cast<std::ptrdiff_t>(first_ring), rings_.end(),
                                  [](const TracedRing& ring) { return ring.is_shell; });
  if (shell == rings_.end()) return;
  for (std::size_t r = first_ring; r < rings_.size(); ++r) rings_[r].region = region_count_;
  ++region_count_;
}

/// Makes a ring of the walk's vertices from `begin` on and takes them off the walk.
void BoundaryTracer::add_ring(const Point* vertices, std::size_t begin, Index half_edge) {
  const std::span<const std::uint32_t> ring = std::span(walk_).subspan(begin);
  for (const std::uint32_t vertex : ring) place_in_walk_.data()[vertex] = kNone;
  const auto start = static_cast<std::uint32_t>(ring_vertices_.size());
  ring_vertices_.insert(ring_vertices_.end(), ring.begin(), ring.end());
  rings_.push_back({start, static_cast<std::uint32_t>(ring_vertices_.size()), kNone,
                    is_counter_clockwise(vertices, ring), half_edge});
  walk_.resize(begin);
}

/// Finds the region of the holes whose walk does not touch their shell.
void BoundaryTracer::assign_holes(Mesh& mesh) {
  const bool any =
      std::any_of(rings_.begin(), rings_.end(), [](const TracedRing& ring) { return ring.region == kNone; });
  if (!any) return;
  if (region_count_ == 1) {
    for (TracedRing& ring : rings_) ring.region = 0;
    return;
  }
  for (Index t = 0; t < mesh.triangle_count(); ++t) mesh.region(t) = kNone;
  for (const TracedRing& shell : rings_) {
    if (!shell.is_shell) continue;
    const Index seed = Mesh::triangle_of(shell.half_edge);
    mesh.region(seed) = shell.region;
    stack_.push_back(seed);
    while (!stack_.empty()) {
      const Index t = stack_.back();
      stack_.pop_back();
      for (Index k = 0; k < 3; ++k) {
        const Index neighbour = Mesh::triangle_of(mesh.twin(Mesh::kStride * t + k));
        if ((mesh.state(neighbour) & Mesh::kKept) == 0 || mesh.region(neighbour) != kNone) continue;
        mesh.region(neighbour) = shell.region;
        stack_.push_back(neighbour);
      }
    }
  }
  for (TracedRing& ring : rings_) {
    if (ring.region == kNone) ring.region = mesh.region(Mesh::triangle_of(ring.half_edge));
  }
}

/// Writes the rings region by region, each shell before its holes.
void BoundaryTracer::emit(const std::uint32_t* caller_index, IndexedMultiPolygon& shape) {
  shape.clear();
  shape.polygon_ends.resize(region_count_);
  for (const TracedRing& ring : rings_) ++shape.polygon_ends[ring.region];
  next_place_.clear();
  std::uint32_t total = 0;
  for (std::uint32_t& end : shape.polygon_ends) {
    next_place_.push_back(total + 1);
    total = end += total;
  }

  ring_order_.resize(rings_.size());
  for (std::uint32_t r = 0; r < rings_.size(); ++r) {
    const std::uint32_t region = rings_[r].region;
    const std::uint32_t shell_place = region == 0 ? 0 : shape.polygon_ends[region - 1];
    ring_order_[rings_[r].is_shell ? shell_place : next_place_[region]++] = r;
  }
  shape.vertices.reserve(ring_vertices_.size());
  for (const std::uint32_t r : ring_order_) {
    for (std::uint32_t i = rings_[r].begin; i < rings_[r].end; ++i) {
      shape.vertices.push_back(caller_index[ring_vertices_[i]]);
    }
    shape.ring_ends.push_back(static_cast<std::uint32_t>(shape.vertices.size()));
  }
}

}  // namespace polylidar::detail
