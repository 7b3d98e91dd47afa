// How constants are judged that are to suit many shapes: errors by case, and one number of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hullbench::tune {

/// The errors of one method with each of some values of a constant.
struct ErrorTable {
  std::vector<double> candidates;
  std::vector<std::string> shapes;          ///< case -> its base shape (datasets.hpp)
  std::vector<std::vector<double>> errors;  ///< case -> candidate -> l2; kInfinitelyBad for a failure
};

/// An error below this counts as this: its logarithm would outweigh all others.
inline constexpr double kLeastError = 1e-4;
/// What a failure counts as, and an error above this: ten times the shape's area, more than its convex hull
/// has wherever there is much to fit.
inline constexpr double kMostError = 10;

/// The geometric mean over shapes of the geometric mean over a shape's cases. Every shape counts the same,
/// however many cases are of it, and an error that is twice another one's costs the same on an easy case as
/// on a hard one. `shapes` and `errors` by case; 0 for no case.
double fit_score(const std::vector<std::string>& shapes, const std::vector<double>& errors);

/// What one candidate gave.
struct CandidateScore {
  double candidate = 0;
  double score = 0;   ///< fit_score
  double median = 0;  ///< of the errors of all cases, as the league takes it
  std::size_t failures = 0;
};

/// The score curve, in the order of the candidates.
std::vector<CandidateScore> score_curve(const ErrorTable& table);

/// The one with the least score; of equal ones the first. Needs one at least.
const CandidateScore& best_of(const std::vector<CandidateScore>& curve);

/// The place of the candidate that suits several uses of one constant: of the least product of their scores,
/// so that no use counts more because it is harder. `curves` are of the same candidates; one at least.
std::size_t best_for_all(const std::vector<std::vector<CandidateScore>>& curves);

}  // namespace hullbench::tune
