// What is written of a search: tune.json (results/tune.schema.json), sweep.jsonl (results/sweep.schema.json)
// and the tables.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/table/writers.hpp"
#include "benchmarks/tune/tuning.hpp"

namespace hullbench::tune {

/// The summary: the split, the cases with their sides, and of every method its axis, protocols, tuned value,
/// tolerance, sensitivity curve and the oracle's choices. Errors that are not there (failures) are null.
json tuning_to_json(const Tuning& tuning, const std::vector<std::string>& plans, const json& tool);

/// The tables of a summary that tuning_to_json made.
table::Document tuning_document(const json& summary);

/// Every evaluation, each once, method by method on each case in the order of the search, with what it was
/// for: `side`, `position` (null: not of the sweep), `on_grid` and `protocols` ("oracle" and "tuned" among
/// them). Then those that `known` has besides, which an earlier search of this folder asked for.
std::vector<json> sweep_lines(const Tuning& tuning, const std::deque<record::RunRecord>& known);

}  // namespace hullbench::tune
