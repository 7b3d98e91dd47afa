// What a reader must know to read the tables of a report: what the numbers are, under which conditions they
// were taken, and what is missing.
#pragma once

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/report/measurements.hpp"

namespace hullbench::report {

/// What is special to this run: the plan's notes, what is missing, how many rows ended how, one sentence or
/// more a note; of a report without times why there are none. `measurements` are of `report`.
std::vector<std::string> run_notes(const json& report, const Measurements& measurements);

/// What holds for every run of a suite alike: how to read the tables, every machine, the build.
std::vector<std::string> common_notes(const json& report, const Measurements& measurements);

}  // namespace hullbench::report
