// Tables about the experiments themselves: which methods there are and which parameters they were given.
#pragma once

#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/table/table.hpp"

namespace hullbench::report {

/// A line a method of any of `reports`: what its library returns, whether its result may have holes and
/// several polygons (its adapter's capability flags), version and licence. A method that never started has
/// dashes.
table::Table methods_table(const std::vector<json>& reports);

/// A line a parameter of a method with a protocol that was run, and a column an experiment of `reports`, or a
/// data set where a plan gives values case by case: what the plan gives, a rule by its formula. Without text:
/// the method is not in it.
table::Table parameters_table(const std::vector<json>& reports);

}  // namespace hullbench::report
