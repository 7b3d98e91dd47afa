// A report as tables: Markdown that reads as well in a terminal.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>

namespace hullbench {

/// Prints the tables of `report` (as made by make_report): for every data set, with and without holes, time
/// of equal work, time within the paper's boundary, and error, methods by numbers of points; then the time of
/// the steps, the paper's claims beside ours, and the notes. Which methods, data sets and sizes there are is
/// read from the report.
void print_tables(const nlohmann::json& report, std::ostream& out);

}  // namespace hullbench
