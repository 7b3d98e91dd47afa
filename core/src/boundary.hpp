// From the boundary half-edges of the shape to rings and polygons.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "half_edge.hpp"
#include "joined_things.hpp"
#include "polylidar/concave_hull.hpp"

namespace polylidar::detail {

/// Traces polygons, keeping its memory between calls.
class BoundaryTracer {
 public:
  /// One polygon for each edge-connected region of kept triangles of `mesh`. Vertices are given by the
  /// caller's indices (`caller_index`: vertex of the mesh -> caller's point). `boundary` are the boundary
  /// half-edges of the regions, `vertices` the positions in the mesh. Linear in the number of boundary
  /// half-edges and of the triangles round their vertices. If there are several regions, each hole adds the
  /// triangles on the way from it to the next boundary on its left.
  void trace(Mesh& mesh, const Point* vertices, std::size_t vertex_count, const std::uint32_t* caller_index,
             const std::vector<Mesh::Index>& boundary, IndexedMultiPolygon& shape);

  /// Polygon of the last `trace` -> how many triangles its region has. Visits all of them.
  std::vector<std::size_t> count_triangles(const Mesh& mesh) const;

 private:
  using Index = Mesh::Index;

  /// A closed walk along the boundary of one region. It is split into rings wherever it returns to a vertex.
  struct Walk {
    Index first;           ///< one of its half-edges
    std::uint32_t region;  ///< kNone unless it holds the region's shell
  };
  struct TracedRing {
    std::uint32_t begin;  ///< in ring_vertices_
    std::uint32_t end;
    std::uint32_t walk;
    bool is_shell;
  };

  void trace_walk(Mesh& mesh, const Point* vertices, Index first);
  bool add_ring(const Point* vertices, std::size_t begin);
  void join_holes(const Mesh& mesh, const Point* vertices);
  std::uint32_t region_of(const TracedRing& ring);
  void emit(const std::uint32_t* caller_index, IndexedMultiPolygon& shape);
  void number_polygons();

  std::vector<std::uint32_t>
      open_walk_;  ///< vertices of the walk being traced, without the rings already split off
  Scratch<std::uint32_t>
      index_in_walk_;  ///< boundary vertex -> its index in open_walk_, kNone if it is not there
  std::vector<std::uint32_t>
      ring_vertices_;  ///< of all rings, in the order of `rings_`; at last the caller's
  std::vector<TracedRing> rings_;
  std::vector<Walk> walks_;
  JoinedThings joined_walks_;                                        ///< of `walks_`: those round one region
  std::vector<std::pair<std::uint64_t, std::uint32_t>> ring_order_;  ///< first edge, ring; by first edge
  std::vector<std::uint32_t> polygon_of_region_;                     ///< when the regions are numbered anew
  std::vector<std::uint32_t> written_order_;                         ///< rings by polygon, the shell first
  std::vector<std::uint32_t> next_index_;  ///< polygon -> where in written_order_ its next hole goes
  std::uint32_t region_count_ = 0;
};

}  // namespace polylidar::detail
