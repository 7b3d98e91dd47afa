// Shapes with one feature that shrinks from member to member: a hole's radius, a part's width, a gap.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "polylidar/geometry.hpp"

namespace hullbench {

/// Every graded shape covers so many squared units, so 2000 points have a spacing h = sqrt(area / n) of one
/// unit, and the feature of member k is k h wide.
inline constexpr double kGradedArea = 2000;

/// Members of each kind: features of 1, 2, ... 10 units.
inline constexpr std::size_t kGradedMembers = 10;

/// One kind of graded shapes.
struct GradedShape {
  std::string name;     ///< of the family: "channel"
  std::string title;    ///< of the family, with what the member's number measures: "Square, channel, width"
  std::string feature;  ///< what the number measures: "radius", "width" or "gap"
  /// The shape whose feature measures `size` units, > 0: valid, shells counter-clockwise, holes clockwise.
  polylidar::MultiPolygon (*make)(double size) = nullptr;
};

/// Every kind. A round part is a regular 64-gon, and its radius that of the corners.
///
/// pierced    a square with four round holes of that radius
/// annulus    a disc with one round hole of that radius in the middle
/// windows    a square with nine square holes; the radius is half a hole's side
/// channel    a square with a channel of that width into it, three fifths of its side deep
/// peninsula  a square with a bar of that width on it, three fifths of its side long
/// teeth      a bar with teeth 25 long, as wide as the gaps between them
/// squares    four squares with that gap between neighbours
/// discs      nine discs in three rows, with that gap
/// strips     five strips, 8 by 50, side by side with that gap
const std::vector<GradedShape>& graded_shapes();

}  // namespace hullbench
