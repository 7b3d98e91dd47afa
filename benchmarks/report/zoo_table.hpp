// The table of the plan zoo: a row a case, a column a method, and in each cell how it ended.
#pragma once

#include <string>

#include "benchmarks/report/table_context.hpp"

namespace hullbench::report {

/// How `run` ended, in a word or two: "ok", "wrong", "invalid", "lost points", "empty", "time-out", "crash",
/// "no memory" or "error"; nothing (table::kNothing) where the method is not installed. `has_area`: whether
/// the points have one; where they have none, an empty result and an error are "ok".
std::string zoo_word(const record::RunRecord& run, bool has_area);

/// All cases and methods of the run.
table::Table zoo_table(const TableContext& context);

}  // namespace hullbench::report
