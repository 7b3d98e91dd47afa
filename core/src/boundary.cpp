#include "boundary.hpp"

#include <algorithm>

#include "predicates_inline.hpp"
#include "vector.hpp"

namespace polylidar::detail {

namespace {

/// The boundary half-edge that follows `e` (a -> b) when turning at b through the region's own triangles.
Mesh::Index next_boundary(const Mesh& mesh, Mesh::Index e) {
  Mesh::Index f = Mesh::next(e);
  for (;;) {
    const Mesh::Index twin = mesh.twin(f);
    if (!mesh.is_kept(Mesh::triangle_of(twin))) return f;
    f = Mesh::next(twin);
  }
}

/// From the half-edge `leaving` a vertex of the region's boundary, straight to the left (along -x) through
/// the region until the next boundary; returns the triangle in front of it. The way runs an infinitesimal
/// step below the vertex, so that points at its height count as above and it never meets a vertex. The region
/// must lie to the left of the vertex.
Mesh::Index next_boundary_to_the_left(const Mesh& mesh, const Point* vertices, Mesh::Index leaving) {
  const double height = vertices[mesh.origin(leaving)].y;
  const auto is_above = [&](Mesh::Index e) { return vertices[mesh.origin(e)].y >= height; };
  // Round the vertex: the triangle (vertex, p, q) through which the way leaves has p above and q below it.
  Mesh::Index e = leaving;
  for (;; e = mesh.twin(Mesh::previous(e))) {
    const Mesh::Index p = Mesh::next(e);
    const Mesh::Index q = Mesh::next(p);
    if (!mesh.is_ghost(Mesh::triangle_of(e)) && is_above(p) && !is_above(q)) {
      e = p;
      break;
    }
  }
  // It leaves every triangle by the edge that comes down.
  for (;;) {
    const Mesh::Index twin = mesh.twin(e);
    if (!mesh.is_kept(Mesh::triangle_of(twin))) return Mesh::triangle_of(e);
    const Mesh::Index next = Mesh::next(twin);
    e = is_above(next) && !is_above(Mesh::next(next)) ? next : Mesh::next(next);
  }
}

/// The half-edge that leaves the lexicographically least vertex of the walk that `first` is on.
Mesh::Index leave_least_vertex(const Mesh& mesh, const Point* vertices, Mesh::Index first) {
  Mesh::Index least = first;
  for (Mesh::Index e = next_boundary(mesh, first); e != first; e = next_boundary(mesh, e)) {
    if (less_by_x(vertices[mesh.origin(e)], vertices[mesh.origin(least)])) least = e;
  }
  return least;
}

/// Whether a simple ring runs counter-clockwise, exactly: it turns the same way at its lexicographically
/// least vertex.
bool is_counter_clockwise(const Point* vertices, std::span<const std::uint32_t> ring) {
  const auto less = [&](std::uint32_t a, std::uint32_t b) { return less_by_x(vertices[a], vertices[b]); };
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
  walks_.clear();
  joined_walks_.reset(0);
  region_count_ = 0;
  std::uint32_t* index = index_in_walk_.reserve(vertex_count);
  for (const Index e : boundary) {
    index[mesh.origin(e)] = kNone;
    mesh.taken(Mesh::triangle_of(e)) = 0;
    mesh.walk(Mesh::triangle_of(e)) = kNone;
  }
  for (const Index e : boundary) {
    if ((mesh.taken(Mesh::triangle_of(e)) & Mesh::taken_bit(e)) == 0) trace_walk(mesh, vertices, e);
  }
  if (region_count_ > 1) join_holes(mesh, vertices);
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
  std::uint32_t* index = index_in_walk_.data();
  const auto number = static_cast<std::uint32_t>(walks_.size());
  walks_.push_back({first, kNone});
  joined_walks_.add();
  bool has_shell = false;
  open_walk_.clear();
  Index e = first;
  do {
    const Index triangle = Mesh::triangle_of(e);
    mesh.taken(triangle) |= Mesh::taken_bit(e);
    if (mesh.walk(triangle) == kNone) {
      mesh.walk(triangle) = number;
    } else if (mesh.walk(triangle) != number) {  // two walks along one triangle run round one region
      joined_walks_.join(number, mesh.walk(triangle));
    }

    const std::uint32_t vertex = mesh.origin(e);
    if (index[vertex] != kNone) has_shell |= add_ring(vertices, index[vertex]);
    index[vertex] = static_cast<std::uint32_t>(open_walk_.size());
    open_walk_.push_back(vertex);
    e = next_boundary(mesh, e);
  } while (e != first);
  has_shell |= add_ring(vertices, 0);
  if (has_shell) walks_[number].region = region_count_++;
}

/// Makes a ring of the open walk's vertices from `begin` on and takes them off it. Returns whether it is a
/// shell.
bool BoundaryTracer::add_ring(const Point* vertices, std::size_t begin) {
  const std::span<const std::uint32_t> ring = std::span(open_walk_).subspan(begin);
  for (const std::uint32_t vertex : ring) index_in_walk_.data()[vertex] = kNone;
  const auto start = static_cast<std::uint32_t>(ring_vertices_.size());
  ring_vertices_.insert(ring_vertices_.end(), ring.begin(), ring.end());
  const bool is_shell = is_counter_clockwise(vertices, ring);
  rings_.push_back({start, static_cast<std::uint32_t>(ring_vertices_.size()),
                    static_cast<std::uint32_t>(walks_.size() - 1), is_shell});
  open_walk_.resize(begin);
  return is_shell;
}

/// Joins every walk that holds no shell with the walk on its left.
///
/// Such a walk runs round holes, so its region goes on to the left of its leftmost vertex, up to a boundary
/// edge that reaches further left still. The leftmost of the walks that are joined can therefore be none of
/// these: it is the one with the shell.
void BoundaryTracer::join_holes(const Mesh& mesh, const Point* vertices) {
  for (std::uint32_t w = 0; w < walks_.size(); ++w) {
    if (walks_[w].region != kNone) continue;
    const Index triangle =
        next_boundary_to_the_left(mesh, vertices, leave_least_vertex(mesh, vertices, walks_[w].first));
    joined_walks_.join(w, mesh.walk(triangle));
  }
  // The region's number goes from the walk with the shell to the one that stands for all of its walks.
  for (std::uint32_t w = 0; w < walks_.size(); ++w) {
    if (walks_[w].region != kNone) walks_[joined_walks_.standing_for(w)].region = walks_[w].region;
  }
}

std::uint32_t BoundaryTracer::region_of(const TracedRing& ring) {
  return region_count_ == 1 ? 0 : walks_[joined_walks_.standing_for(ring.walk)].region;
}

/// Writes the rings polygon by polygon, in the order that IndexedMultiPolygon states: it depends on which
/// rings there are, not on how they were found.
void BoundaryTracer::emit(const std::uint32_t* caller_index, IndexedMultiPolygon& shape) {
  for (std::uint32_t& vertex : ring_vertices_) vertex = caller_index[vertex];
  ring_order_.clear();
  for (std::uint32_t r = 0; r < rings_.size(); ++r) {
    const auto begin = ring_vertices_.begin() + rings_[r].begin;
    const auto end = ring_vertices_.begin() + rings_[r].end;
    std::rotate(begin, std::min_element(begin, end), end);
    // Two rings can share their first vertex, but not their first edge.
    ring_order_.emplace_back(std::uint64_t{begin[0]} << 32U | begin[1], r);
  }
  std::sort(ring_order_.begin(), ring_order_.end());
  number_polygons();

  shape.clear();
  shape.polygon_ends.resize(region_count_);
  for (const TracedRing& ring : rings_) ++shape.polygon_ends[region_of(ring)];
  next_index_.clear();
  std::uint32_t total = 0;
  for (std::uint32_t& end : shape.polygon_ends) {
    next_index_.push_back(total + 1);
    total = end += total;
  }
  written_order_.resize(rings_.size());
  for (const auto& [edge, r] : ring_order_) {
    const std::uint32_t polygon = region_of(rings_[r]);
    const std::uint32_t shell_index = polygon == 0 ? 0 : shape.polygon_ends[polygon - 1];
    written_order_[rings_[r].is_shell ? shell_index : next_index_[polygon]++] = r;
  }
  shape.vertices.reserve(ring_vertices_.size());
  for (const std::uint32_t r : written_order_) {
    shape.vertices.insert(shape.vertices.end(), ring_vertices_.begin() + rings_[r].begin,
                          ring_vertices_.begin() + rings_[r].end);
    shape.ring_ends.push_back(static_cast<std::uint32_t>(shape.vertices.size()));
  }
}

/// Numbers the regions anew, in the order of their shells in ring_order_.
void BoundaryTracer::number_polygons() {
  if (region_count_ <= 1) return;
  polygon_of_region_.resize(region_count_);
  std::uint32_t polygon = 0;
  for (const auto& [edge, r] : ring_order_) {
    if (rings_[r].is_shell) polygon_of_region_[region_of(rings_[r])] = polygon++;
  }
  for (Walk& walk : walks_) {
    if (walk.region != kNone) walk.region = polygon_of_region_[walk.region];
  }
}

std::vector<std::size_t> BoundaryTracer::count_triangles(const Mesh& mesh) const {
  std::vector<std::size_t> counts(region_count_);
  std::vector<bool> seen(mesh.triangle_count());
  std::vector<Index> open;  // seen, but not their neighbours
  const auto see = [&](Index t) {
    if (!mesh.is_kept(t) || seen[t]) return;
    seen[t] = true;
    open.push_back(t);
  };
  for (const Walk& walk : walks_) {
    if (walk.region == kNone) continue;
    // Of a region's walks more than one may bear its number; the first one takes all its triangles.
    for (see(Mesh::triangle_of(walk.first)); !open.empty(); ++counts[walk.region]) {
      const Index t = open.back();
      open.pop_back();
      for (Index k = 0; k < 3; ++k) see(Mesh::triangle_of(mesh.twin(Mesh::kStride * t + k)));
    }
  }
  return counts;
}

}  // namespace polylidar::detail
