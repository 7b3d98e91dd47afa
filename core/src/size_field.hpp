// A limit for the size of triangles that varies by place: one value for each block of the mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "half_edge.hpp"

namespace polylidar::detail {

/// What to look for if all points may lie on outlines.
struct OutlineSteps {
  double squared_step = 0;   ///< the square of the greatest distance of neighbours on an outline
  double squared_reach = 0;  ///< of edges between points that belong together; larger for a detail below 1
  double twice_area = 0;     ///< of the triangles within the limit at a detail of 1
};

/// A block is a place: a range of consecutive vertices along the curve, or a square. A field of one block
/// fits any mesh.
struct SizeField {
  /// Block -> the fourth power of the largest size of a triangle; inclusive.
  std::vector<double> limit4;
  /// As a factor of limit4: the fourth power of the size from which a spike is dropped.
  double spike_share = 0;
  /// Regions with fewer triangles are dropped.
  std::size_t least_region = 0;
  /// The fourth power of the detail, at least 1: limit4 times this is the limit at a detail of 1.
  double detail4 = 1;
  /// A hole stays only if it has a dropped triangle whose squared circumradius is at least this many times
  /// the mean squared size of the kept triangles round the hole, whatever its area. 0: no hole is filled.
  double wide_square = 0;
  /// The circumradius of such a triangle must also be at least this.
  double wide_radius = 0;
  /// Set if all points may lie on outlines.
  std::optional<OutlineSteps> outlines = {};
  /// Vertex -> its block, if there are several.
  std::vector<std::uint32_t> block_of_vertex = {};
  /// What block a triangle belongs to: if false, that of the vertex with its record, which another mesh with
  /// the triangle may store elsewhere. If true, that of the corner whose limit is the middle one.
  bool is_by_corners = false;
  /// Triangle of the mesh -> Triangle::size4(), NaN for a ghost; null if not all were measured. It lives as
  /// long as the object that chose the field.
  const double* size4 = nullptr;

  bool is_one() const { return limit4.size() == 1; }
  double limit4_at(const Mesh& mesh, Mesh::Index triangle) const { return value_at(limit4, mesh, triangle); }
  /// Of a value that every block has, and that grows with the limit.
  double value_at(const std::vector<double>& of_block, const Mesh& mesh, Mesh::Index triangle) const {
    if (of_block.size() == 1) return of_block.front();
    if (!is_by_corners) return of_block[block_of_vertex[triangle / 2]];
    const Mesh::Index* const corners = mesh.corners(triangle);
    const double a = of_block[block_of_vertex[corners[0]]];
    const double b = of_block[block_of_vertex[corners[1]]];
    const double c = of_block[block_of_vertex[corners[2]]];
    return std::max(std::min(a, b), std::min(std::max(a, b), c));
  }
};

}  // namespace polylidar::detail
