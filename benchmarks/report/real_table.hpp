// The tables of the plan real: points without a truth, of which no error can be told.
#pragma once

#include <vector>

#include "benchmarks/report/table_context.hpp"

namespace hullbench::report {

/// Of each method, over all sets: how many have a result, and medians of what can be told. Then a table a
/// quantity, a row a set and a column a method: points covered, parts and holes, area, agreement of the hulls
/// of two halves and of 90 %, and agreement with the study window where one is known. The last one says where
/// each set is from. A set whose package is not installed says so, with the command that installs it.
std::vector<table::Table> real_tables(TableContext& context);

}  // namespace hullbench::report
