// All tables of a run, or of several.
#pragma once

#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::report {

/// All tables of some reports: methods and parameters, the reports' own tables, what differs from the paper,
/// and the notes that the reports share, once. A table of steps is left out of a report of many cases when
/// another one is about the steps alone.
std::vector<table::Document> make_documents(const std::vector<json>& reports);

}  // namespace hullbench::report
