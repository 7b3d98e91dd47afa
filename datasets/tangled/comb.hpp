// A comb: a bar with teeth.
#pragma once

#include <cstddef>

#include "datasets/random.hpp"
#include "polylidar/geometry.hpp"

namespace hullbench {

/// What a comb is made with; lengths in the unit of the coordinates.
struct CombPlan {
  double length = 0;            ///< of the bar
  double bar = 0;               ///< how thick the bar is, at least kLeastFeature
  double shortest_tooth = 0;    ///< at least kLeastFeature
  double longest_tooth = 0;     ///< at least shortest_tooth
  std::size_t teeth_above = 0;  ///< the bar must be (2 * teeth + 1) * kLeastFeature long, or longer
  std::size_t teeth_below = 0;  ///< as teeth_above
};

/// A counter-clockwise ring with the middle of its bounding box on the origin and the bar along the x axis.
/// Teeth and the gaps beside them are rectangles of random width, teeth of random length; the first or last
/// of several teeth is flush with the bar's end as often as not. Simple because every edge is parallel to an
/// axis and its place on the bar is its own.
polylidar::Ring make_comb(const CombPlan& plan, Random& random);

/// A comb of length 200 with 4 to 9 teeth, all on one side or some on either. Two teeth on one side are
/// enough for a shape that no point sees whole: the long edges of each leave only the strip between them.
polylidar::Ring draw_comb(Random& random);

}  // namespace hullbench
