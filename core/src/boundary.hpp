// From the boundary half-edges of the shape to rings and polygons.
#pragma once

#include <cstdint>
#include <vector>

#include "half_edge.hpp"
#include "polylidar/concave_hull.hpp"

namespace polylidar::detail {

/// Traces polygons, keeping its memory between calls.
class BoundaryTracer {
 public:
  /// One polygon a region of edge-connected kept triangles of `mesh`, whose boundary half-edges are
  /// `boundary`, by the caller's indices (`caller_index`: vertex of the mesh -> caller's point). `vertices`
  /// are the mesh's positions. Linear in the number of boundary half-edges and of the triangles round their
  /// vertices; where there are several regions and one of them has a hole, linear in the number of triangles.
  void trace(Mesh& mesh, const Point* vertices, std::size_t vertex_count, const std::uint32_t* caller_index,
             const std::vector<Mesh::Index>& boundary, IndexedMultiPolygon& shape);

 private:
  using Index = Mesh::Index;

  struct TracedRing {
    std::uint32_t begin;  ///< in ring_vertices_
    std::uint32_t end;
    std::uint32_t region;  ///< kNone until known
    bool is_shell;
    Index half_edge;  ///< some half-edge of its region
  };

  void trace_walk(Mesh& mesh, const Point* vertices, Index first);
  void add_ring(const Point* vertices, std::size_t stack_begin, Index half_edge);
  void assign_holes(Mesh& mesh);
  void emit(const std::uint32_t* caller_index, IndexedMultiPolygon& shape);

  std::vector<std::uint32_t>
      walk_;  ///< vertices of the walk being traced, without the rings already split off
  Scratch<std::uint32_t> place_in_walk_;  ///< boundary vertex -> its place in walk_, kNone if it is not there
  std::vector<std::uint32_t> ring_vertices_;  ///< of all rings, in the order of `rings_`
  std::vector<TracedRing> rings_;
  std::vector<std::uint32_t> ring_order_;  ///< rings by region, the shell first
  std::vector<std::uint32_t> next_place_;  ///< region -> where in ring_order_ its next hole goes
  std::vector<Index> stack_;
  std::uint32_t region_count_ = 0;
};

}  // namespace polylidar::detail
