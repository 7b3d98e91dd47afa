// What `hullbench list` prints.
#pragma once

#include <ostream>

#include "benchmarks/base/names.hpp"
#include "benchmarks/worker/method.hpp"
#include "benchmarks/worker/worker_process.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::cli {

/// {"methods": [...], "datasets": [...], "stress": [...]}: every one of `methods`, asked through a worker
/// each, all at the same time, every data set and every way to draw points that can stand behind a data set's
/// name. Members of a method as in describe_method, of a data set as in run.json. Throws Interrupted.
json make_listing(const std::vector<worker::Method>& methods, const worker::WorkerLimits& limits);

/// The same for people.
void print_listing(const json& listing, std::ostream& out);

/// The data sets as run.json and the report have them; only those that one of `names` belongs to, or all when
/// it is empty.
json describe_datasets(const DataFolders& folders = {}, const std::vector<std::string>& names = {});

}  // namespace hullbench::cli
