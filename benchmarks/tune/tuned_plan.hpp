// The chosen parameters as a plan, so that `hullbench run` measures them with every metric.
#pragma once

#include "benchmarks/plan/plan.hpp"
#include "benchmarks/tune/tuning.hpp"

namespace hullbench::tune {

/// `plan` with its test cases alone, but with all cases where it accepts failures, and for every method of
/// `tuning` that starts here: its own entries in the plan, or `default` where the plan does not name it and
/// it can do without parameters, and, in the place of any such there, `tuned` and `oracle`. Its name is the
/// plan's with "-tuned". Other methods of the plan are left out. A protocol that has nothing to say on any
/// case of the plan is left out.
plan::Plan tuned_plan(const plan::Plan& plan, const Tuning& tuning);

}  // namespace hullbench::tune
