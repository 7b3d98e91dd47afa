// What a reader must know to read the tables of a report: what the numbers are, under which conditions they
// were taken, and what is missing.
#pragma once

#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "benchmarks/record.hpp"

namespace hullbench {

/// Prints them as list items. `runs` are the parsed runs of `report`.
void print_report_notes(const nlohmann::json& report, const std::vector<RunRecord>& runs, std::ostream& out);

}  // namespace hullbench
