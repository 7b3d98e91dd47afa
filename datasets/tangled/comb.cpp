#include "datasets/tangled/comb.hpp"

#include <algorithm>
#include <vector>

#include "datasets/tangled/ring_steps.hpp"
#include "datasets/tangled_shapes.hpp"

namespace hullbench {

using polylidar::Point;
using polylidar::Ring;

namespace {

/// The left and the right edge of `teeth` teeth, in turn, along a bar of `length`.
std::vector<double> tooth_edges(std::size_t teeth, double length, Random& random) {
  if (teeth == 0) return {};
  // A lone tooth that is flush at both ends would be no tooth.
  const bool flush_start = teeth > 1 && random.below(2) == 0;
  const bool flush_end = teeth > 1 && random.below(2) == 0;
  const std::size_t pieces = 2 * teeth + 1 - (flush_start ? 1 : 0) - (flush_end ? 1 : 0);
  std::vector<double> cuts = random_cuts(pieces, kLeastFeature, length, random);
  if (!flush_start) cuts.erase(cuts.begin());
  if (!flush_end) cuts.pop_back();
  return cuts;
}

/// The outline of the bar's upper side, at height 0, from left to right.
Ring upper_side(const CombPlan& plan, std::size_t teeth, Random& random) {
  Ring side{{0, 0}};
  const std::vector<double> edges = tooth_edges(teeth, plan.length, random);
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const double tip = random.between(plan.shortest_tooth, plan.longest_tooth);
    side.insert(side.end(), {{edges[i], 0}, {edges[i], tip}, {edges[i + 1], tip}, {edges[i + 1], 0}});
  }
  side.push_back({plan.length, 0});
  return side;
}

}  // namespace

Ring make_comb(const CombPlan& plan, Random& random) {
  Ring ring = upper_side(plan, plan.teeth_below, random);
  for (Point& vertex : ring) vertex.y = -vertex.y;
  Ring above = upper_side(plan, plan.teeth_above, random);
  std::reverse(above.begin(), above.end());
  for (const Point& vertex : above) ring.push_back({vertex.x, vertex.y + plan.bar});
  ring = without_straight_corners(std::move(ring));
  centre_on_origin(ring);
  return ring;
}

Ring draw_comb(Random& random) {
  CombPlan plan{.length = 200};
  plan.bar = random.between(10, 30);
  plan.longest_tooth = random.between(40, 90);
  plan.shortest_tooth = random.between(20, plan.longest_tooth);
  const std::size_t teeth = 4 + random.below(6);
  // At least two to a side: a lone tooth would take a third of the bar.
  plan.teeth_below = random.below(2) == 0 ? 0 : 2 + random.below(teeth / 2 - 1);
  plan.teeth_above = teeth - plan.teeth_below;
  return make_comb(plan, random);
}

}  // namespace hullbench
