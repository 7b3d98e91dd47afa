// The folders of runs, as the commands read and finish them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/run/merge.hpp"

namespace hullbench::cli {

/// Throws ConfigurationError, one sentence, unless `folder` is that of a run or a suite that can be read.
void check_run_folder(const fs::path& folder);

/// Says on standard error which plans of the suite in `folder`, if it is one, were not started. Returns how
/// many.
std::size_t say_plans_without_run(const fs::path& folder);

/// The reports in `folder`, that of a run or of a suite. Throws as check_run_folder().
std::vector<json> reports_in(const fs::path& folder);

/// The report of the run in `folder` with what a reader of report.json needs beside: the table of metrics, as
/// metric_table_to_json gives it.
json report_to_share(const fs::path& folder);

/// Writes tables and report of the run in `folder`; the report is the mark of a finished run.
void finish_run(const fs::path& folder);

/// Writes a run that was made of stored ones: rows, pictures, kept polygons, tables and report.
void write_run(const run::MergedRun& run, const fs::path& folder);

/// The same of several plans, as a suite.
void write_suite(const std::vector<run::MergedRun>& runs, const fs::path& folder);

}  // namespace hullbench::cli
