// Fits the constants of the rules from the points (auto_edge_length and its neighbours in
// parameter_rules.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/plan/plan.hpp"
#include "benchmarks/tune/fit_score.hpp"

namespace hullbench::tune {

/// Points to fit on: a plan's case with the seed of its sample.
struct FitCase {
  plan::PlanCase plan_case;
  std::uint64_t seed = 1;
};

/// The cases of `plans` on the training side of the split, and each of their shapes as well with every stress
/// that one of the plans has at that number of points and training knows: so a shape that is in one plan only
/// counts under all kinds of sampling, as the others do. Each once, with the plans' seeds and the `seeds` - 1
/// that follow. Not those that come with their points, of which no other sample can be drawn, nor those of
/// plans that accept failures. With `points` > 0 that many points stand in the place of the plans' numbers.
std::vector<FitCase> training_cases(const std::vector<plan::Plan>& plans, int seeds, std::int64_t points);

/// A method whose parameter is to be a share of the size that the core chooses.
struct RuleUse {
  std::string rule;
  std::string method;                   ///< that runs in this process
  std::string parameter;                ///< a length
  std::map<std::string, double> fixed;  ///< its other parameters
  double share = 0;                     ///< that stands in the code
  std::string meaning;                  ///< as the table's caption says it
};

/// The uses that the constants in parameter_rules.hpp were fitted for: the circumradius and the longest edge
/// of the triangles that stay, and the border's edges of an erosion with holes and without.
std::vector<RuleUse> rule_uses();

/// What the shares of a fit are.
std::vector<double> usual_shares();

/// Everything that is measured for a fit.
struct FitTables {
  std::vector<ErrorTable> uses;     ///< by use; candidates are shares
  std::vector<std::string> shapes;  ///< by case
  std::vector<double> core_errors;  ///< by case: of the core's own choice
};

/// Measures every use with every share on all cases; on all of `cores` (parallel.hpp). Throws as
/// make_point_set, and std::runtime_error where a method is not there.
FitTables measure_fit(const std::vector<FitCase>& cases, const std::vector<RuleUse>& uses,
                      const std::vector<double>& shares, const std::vector<int>& cores);

}  // namespace hullbench::tune
