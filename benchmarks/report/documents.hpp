// All tables of a run, or of several.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "benchmarks/table/writers.hpp"

namespace hullbench::report {

/// All tables of some reports: methods and parameters, the reports' own tables, what differs from the paper,
/// and the notes that the reports share, once. A table of steps is left out of a report of many cases when
/// another one is about the steps alone.
std::vector<table::Document> make_documents(const std::vector<nlohmann::json>& reports);

}  // namespace hullbench::report
