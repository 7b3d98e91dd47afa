// The tables of a report.
#pragma once

#include "benchmarks/base/names.hpp"
#include "benchmarks/table/table.hpp"

namespace hullbench::report {

/// What a steps table is called after the plan's name: "states_steps".
inline constexpr const char* kStepsTable = "steps";

/// The tables of `report` (as made by make_report). Of many shapes at one size those of
/// collection_tables.hpp. Else for every data set, with and without holes, time of equal work, time within
/// the paper's boundary, and error, methods by numbers of points, and the ratios over all of them. Then the
/// fastest rival with the same polygons, and first calls where they are known; of
/// the paper's own shapes, the time of the steps and the paper's claims beside ours. Which methods, data sets
/// and sizes there are is read from the report. A table's id begins with the plan's name.
table::Document make_document(const json& report);

}  // namespace hullbench::report
