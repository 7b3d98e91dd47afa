// The table of a plan with an axis: how every method's error changes along it.
#pragma once

#include "benchmarks/report/table_context.hpp"
#include "benchmarks/table/table.hpp"

namespace hullbench::report {

/// A line a method, a column a place on the axis, from the least; words in the order in which they occur. A
/// cell is the median over the cases of L2; a failed run is infinitely bad, so a cell without a number says
/// that half of them failed, or more. The report's plan must have an axis.
table::Table curve_table(TableContext& context);

}  // namespace hullbench::report
