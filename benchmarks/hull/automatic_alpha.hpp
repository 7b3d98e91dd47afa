// The alpha of `hullbench hull` when nobody gives one.
#pragma once

#include <cstddef>
#include <vector>

namespace hullbench {

/// How many edges are enough to know their median: among 1e6 its standard error is about a thousandth of it.
inline constexpr std::size_t kAlphaSample = 1000000;

/// 1.8 times the median of `edge_lengths`, those of the points' Delaunay triangulation, in their unit; 0 for
/// none. Of uniform points, d to the unit area, the mean Delaunay edge is 32 / (9 pi sqrt(d)) = 1.13 /
/// sqrt(d) long (Miles 1970), and the paper's alpha for them is 2 / sqrt(d) (section III-B): 1.8 edges. The
/// median hardly sees the few long edges across gaps and along the convex hull, which would move the mean; of
/// uniform points it is 4 % below the mean, and so is this below the paper's alpha.
double automatic_alpha(std::vector<double> edge_lengths);

}  // namespace hullbench
