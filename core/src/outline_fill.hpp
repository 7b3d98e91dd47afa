// Finds what outlines enclose when all points lie on outlines and no triangle of usual size is inside.
#pragma once

#include <cstdint>
#include <vector>

#include "half_edge.hpp"
#include "joined_things.hpp"
#include "size_field.hpp"

namespace polylidar::detail {

/// Selects triangles by the outlines that points lie on, keeping its memory between calls.
///
/// Points that are joined by edges no longer than the field's step form a *wall*. Triangles that share longer
/// edges form a *face*; one face is the outside. Going inwards from the outside, faces are inside and outside
/// by turns: a face that touches the walls round the outside is inside, a face beyond a wall that stands
/// inside is a hole, and so on. Triangles without an edge longer than a step are part of the wall, and
/// walls belong to the shape. A detail below 1 also adds triangles without an edge longer than step / detail;
/// a detail above 1 changes nothing.
class OutlineFill {
 public:
  /// Writes into `kept`, the words of `mesh`, what the outlines enclose, and returns true. It does so only if
  /// the triangles within the limit cover less than 0.4 of that area, or if half of the points lie between
  /// inside and outside. Otherwise it returns false and leaves `kept` as it is. O(n log n).
  bool run(const Mesh& mesh, const Point* vertices, const OutlineSteps& outlines, std::uint64_t* kept);

 private:
  using Index = Mesh::Index;

  struct Touch {
    Index face;
    Index wall;
  };
  /// How many points of a wall touch faces of each kind.
  struct WallPoints {
    Index outside = 0;
    Index inside = 0;
  };

  void find_walls_and_faces(const Mesh& mesh, const Point* vertices, double squared_step);
  void find_depths();
  double share_between(const Mesh& mesh);

  JoinedThings walls_;                   ///< of vertices
  JoinedThings faces_;                   ///< of triangles; one more, the outside, stands for all ghosts
  std::vector<std::uint8_t> is_wall_;    ///< triangle -> whether it has no edge longer than a step
  std::vector<Touch> walls_of_face_;     ///< sorted by face
  std::vector<Touch> faces_of_wall_;     ///< the same, by wall
  std::vector<Index> depth_;             ///< face -> how many walls lie between it and the outside
  std::vector<std::uint8_t> is_passed_;  ///< wall -> whether depth_ is known of what touches it
  std::vector<std::uint8_t> sides_;      ///< vertex -> what kinds of faces it touches
  std::vector<WallPoints> points_of_wall_;
  std::vector<Index> queue_;  ///< faces whose depth is known
};

}  // namespace polylidar::detail
