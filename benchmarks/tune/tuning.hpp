// What a search over methods and cases gives, before anything is said about it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/tune/search_axis.hpp"
#include "benchmarks/tune/split.hpp"
#include "benchmarks/tune/strata.hpp"

namespace hullbench::tune {

/// One case of the plans.
struct TuningCase {
  plan::PlanCase plan_case;
  std::uint64_t seed = 0;                      ///< of the points
  double timeout_s = 0;                        ///< for one evaluation
  std::vector<plan::PlanMethod> entries = {};  ///< of the plans that have the case, those that apply to it
  // Known once its points were drawn:
  std::string dataset_sha256 = {};
  std::int64_t n = 0;     ///< number of points
  double spacing = 0;     ///< mean_spacing of its points (parameter_rules.hpp)
  std::string kind = {};  ///< of its truth (strata.hpp)

  std::string shape() const { return base_shape(plan_case.dataset); }
  Side side() const { return side_of(plan_case.dataset); }
  /// What its weight depends on.
  Membership membership() const { return {sampler_of(plan_case.dataset) + ", " + kind, shape()}; }
};

/// An evaluation at a position of the axis.
struct SweepEvaluation {
  double position = 0;
  bool on_grid = false;  ///< of the sweep, whose positions are those of a grid; else of the refinement
  bool holes = true;     ///< what the method's switches for holes were set to (fixed_parameters)
  record::RunRecord evaluation;
};

/// All evaluations of one method on one case: rows of runs that nobody timed (RunRecord::program).
struct MethodOnCase {
  std::vector<SweepEvaluation> sweep;                  ///< in the order of the search
  std::map<std::string, record::RunRecord> protocols;  ///< "paper", "default", "auto", where there is one
};

/// l2, or kInfinitelyBad (search.hpp) without one.
double error_of(const record::RunRecord& evaluation);

/// The best of all evaluations, whoever asked for it: of equal errors the first one of the sweep, then of the
/// protocols. Of failures alone the first; null when there is no evaluation at all.
const record::RunRecord* best_evaluation(const MethodOnCase& found);

/// The evaluation of the sweep at that position, with holes or without; null when it was not evaluated.
const record::RunRecord* evaluation_at(const MethodOnCase& found, double position, bool holes = true);

/// The error there. A position that a search did not come to, given up after time-outs, is a failure.
double error_at(const MethodOnCase& found, double position, bool holes = true);

/// What successive halving (halving.hpp) knew when a round was over.
struct HalvingRound {
  std::size_t cases = 0;          ///< training cases on which the method had been tried by then
  std::vector<double> positions;  ///< that were still tried, ascending
  std::vector<double> scores;     ///< position -> weighted median of l2 over these cases; kInfinitelyBad
  std::vector<double> scores_without_holes;  ///< the same with holes switched off; empty: there is no switch
};

/// One method.
struct MethodTuning {
  std::string name;
  std::string title;
  std::optional<MethodInfo> info;    ///< none: it does not start here
  std::string detail;                ///< why it does not start
  std::string remedy;                ///< the command that helps
  std::optional<SearchAxis> axis;    ///< none: it has no parameter to search, or the plan wants none searched
  Parameters others = {};            ///< that are neither searched nor switches for holes, and not left out
  std::vector<MethodOnCase> cases;   ///< by case; empty when it does not start
  std::vector<HalvingRound> rounds;  ///< none without an axis or a training case
};

/// What is given besides the searched parameter, with holes or without.
Parameters fixed_parameters(const MethodTuning& method, bool holes = true);

struct Tuning {
  std::vector<TuningCase> cases;
  std::vector<MethodTuning> methods;
  bool interrupted = false;  ///< then cases and methods are incomplete
};

}  // namespace hullbench::tune
