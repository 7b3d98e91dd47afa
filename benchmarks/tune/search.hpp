// The search on one case: a sweep over the whole axis, then a refinement around the best of it. The same
// budget for every method.
#pragma once

#include <functional>
#include <vector>

#include "benchmarks/tune/search_axis.hpp"

namespace hullbench::tune {

/// Positions that one value for many shapes is chosen from (halving.hpp), a third of an octave apart where
/// the axis has its eight.
inline constexpr int kGridPoints = 25;
/// Positions of the sweep over the axis on one case: every third of these, an octave apart.
inline constexpr int kSweepPoints = 9;
/// Evaluations of the refinement, which is a golden-section search (Kiefer, Sequential Minimax Search for a
/// Maximum, 1953) between the neighbours of the sweep's best position.
inline constexpr int kRefinements = 6;
/// After so many runs out of time one after the other a sweep of one case is given up.
inline constexpr int kMostTimeouts = 3;

/// What stands for infinity where errors are compared: failures are infinitely bad, and medians of them must
/// stay numbers.
inline constexpr double kInfinitelyBad = 1e300;

/// Whether `error`, or a median of errors, is that of failures.
inline bool is_infinitely_bad(double error) {
  return error > 1e200;
}

/// What one evaluation gave.
struct Trial {
  double error = kInfinitelyBad;  ///< >= 0, finite
  bool timed_out = false;
};

/// One position that was evaluated.
struct SearchPoint {
  double position = 0;
  double error = kInfinitelyBad;
  bool on_grid = false;
};

/// Evaluates the positions of `axis` in the order of the search, at most kSweepPoints + kRefinements, and
/// gives them back in it. A position is not asked for twice. Of equal errors the smaller position counts as
/// the better one. Without any position that gave a result there is no refinement. The error need not have a
/// single minimum: then the refinement finds a local one, and the sweep's is never lost.
std::vector<SearchPoint> search(const SearchAxis& axis,
                                const std::function<Trial(double position)>& evaluate);

}  // namespace hullbench::tune
