// Several plans run one after another: a folder with a run of each (record/stored_run.hpp).
#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/run/run_directory.hpp"

namespace hullbench::run {

/// The folder for a suite of runs with these headers (one or more, of plans with different names). The newest
/// suite of the same runs in `place.results`/runs is gone on with when it is not finished, and so is the one
/// in `place.out`, finished or not; else a new one is made. Throws ConfigurationError when the folder cannot
/// be written, or `place.out` holds something else and `force` is not set; with `force` the runs that an
/// earlier suite left in it are started anew.
fs::path open_suite(const std::vector<json>& headers, const RunPlace& place);

}  // namespace hullbench::run
