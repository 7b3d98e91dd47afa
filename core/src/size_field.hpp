// A limit for the size of triangles that varies by place: one value a block of the mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "half_edge.hpp"

namespace polylidar::detail {

/// What to look for where points may lie on outlines only.
struct OutlineSteps {
  double squared_step = 0;   ///< the square of the greatest distance of neighbours on an outline
  double squared_reach = 0;  ///< of edges between points that belong together; larger for a detail below 1
  double twice_area = 0;     ///< of the triangles within the limit at a detail of 1
};

/// A block is a range of vertices, which follow each other along the curve, with their two records each.
/// Where there is one block it may be that of any mesh.
struct SizeField {
  /// Block -> the fourth power of the largest size of a triangle; inclusive.
  std::vector<double> limit4;
  /// Of limit4: the fourth power of the size from which a spike is not of the shape.
  double spike_share = 0;
  /// Regions of fewer triangles are not of the shape.
  std::size_t least_part = 0;
  /// A hole has a dropped triangle with a squared circumradius of so many mean squared sizes of the kept
  /// triangles round it at least, however large it is. 0: no hole is filled.
  double wide_square = 0;
  /// Where there is one limit: and one with a circumradius of so many limits.
  double wide_radius = 0;
  /// Where points may lie on outlines only; none where they do not.
  std::optional<OutlineSteps> outlines = {};
  /// Vertex -> its block, where there are several.
  std::vector<std::uint32_t> block_of_vertex = {};
  /// Triangle of the mesh -> Triangle::size4(), NaN of a ghost; null where not all were measured. It lives as
  /// long as what chose the field.
  const double* size4 = nullptr;

  bool is_one() const { return limit4.size() == 1; }
  double limit4_at(Mesh::Index triangle) const {
    return is_one() ? limit4.front() : limit4[block_of_vertex[triangle / 2]];
  }
};

}  // namespace polylidar::detail
