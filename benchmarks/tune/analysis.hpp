// What a search says about a method: how wide its good range is, which one value suits many shapes, and what
// each way of choosing the parameter costs. Errors are l2; a failure is infinitely bad (search.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/statistics/bootstrap.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/tune/tuning.hpp"

namespace hullbench::tune {

/// The error may be this many times its best inside the tolerance.
inline constexpr double kToleratedError = 1.1;

/// How many octaves wide the range around the best position is in which the error stays within
/// kToleratedError of the best. Between evaluations the error is taken as linear in the logarithm of the
/// position; next to a failure the range ends at the last evaluation that was none, and at the axis' ends it
/// is cut. `points` in any order; of equal best errors the smallest position is the best one. None without an
/// evaluation that gave a result.
std::optional<double> tolerance_octaves(std::vector<SearchPoint> points);

/// The same of the method's sweep on a case.
std::optional<double> tolerance_octaves(const MethodOnCase& found);

/// One value for many shapes.
struct TunedValue {
  double position = 0;         ///< of the grid, on the method's axis
  double training_median = 0;  ///< of l2 there, weighted (strata.hpp)
  std::size_t training_cases = 0;
  bool holes = true;    ///< whether holes are switched on, if they can be
  bool at_end = false;  ///< it is the first or the last of the grid: better ones may lie outside
};

/// The best position of the last round of successive halving (halving.hpp), with holes or without: that with
/// the smallest weighted median of l2 over all training cases on which the method was tried; with holes and
/// the smaller one of two that are equally good. The median, as failures are infinitely bad: by the mean a
/// single one would rule a value out. None without a round, and when no position gives a result on half of
/// the weight.
std::optional<TunedValue> choose_tuned(const MethodTuning& method);

/// Of several errors or differences; kInfinitelyBad where the middle is a failure.
struct Quartiles {
  double q1 = 0;
  double median = 0;
  double q3 = 0;
};
/// Needs one value at least.
Quartiles quartiles_of(const std::vector<double>& values);

/// How one way of choosing the parameter did on the test cases. Medians are weighted (strata.hpp).
struct ProtocolScore {
  std::string protocol;    ///< "paper", "default", "auto", "tuned", "oracle"
  std::size_t cases = 0;   ///< of which the protocol has an evaluation
  std::size_t failed = 0;  ///< of these, without a result
  double l2_median = 0;
  std::optional<statistics::Interval> l2_interval;  ///< of the median, by base shape (weighted.hpp)
  /// l2 minus the oracle's on the same case; of cases on which the oracle has a result. None: there is none.
  std::optional<double> regret_median;
  std::optional<statistics::Interval> regret_interval;
};

/// Every protocol that has an evaluation on a test case, in the order of the tables. A method without an axis
/// has no oracle and no regret.
std::vector<ProtocolScore> protocol_scores(const Tuning& tuning, const MethodTuning& method,
                                           const std::optional<TunedValue>& tuned);

/// What a search with so many evaluations reaches on the test cases.
struct SearchCost {
  std::size_t evaluations = 0;
  std::size_t cases = 0;
  double l2_median = 0;  ///< weighted; kInfinitelyBad where the middle is a failure
  std::optional<statistics::Interval> l2_interval;  ///< as ProtocolScore's
};

/// From one evaluation to kSweepPoints + kRefinements. The positions of the sweep are taken in random order:
/// of a case the median over all orders counts, so 1 is what a blind choice gives. Then come the refinements,
/// in theirs. Positions that the search gave up are failures. Nothing for a method without an axis.
std::vector<SearchCost> search_costs(const Tuning& tuning, const MethodTuning& method);

/// The errors at one position of the grid, over the cases that were swept.
struct CurvePoint {
  double position = 0;
  std::size_t cases = 0;
  std::size_t failed = 0;
  Quartiles l2;
  Quartiles relative;  ///< l2 divided by the case's best on the grid, >= 1; 1 where both are 0
};

/// The sensitivity curve: l2 against the axis, ascending, over the training cases of the first round, which
/// have the whole grid; without a training case over the test cases, whose grid is coarser (kSweepPoints).
/// Cases without any result are left out.
std::vector<CurvePoint> sensitivity_curve(const Tuning& tuning, const MethodTuning& method);

}  // namespace hullbench::tune
