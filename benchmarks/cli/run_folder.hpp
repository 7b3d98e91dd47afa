// The folders of runs, as the commands read and finish them.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "benchmarks/run/merge.hpp"

namespace hullbench::cli {

/// Throws ConfigurationError unless `folder` is one.
void check_run_folder(const std::filesystem::path& folder);

/// The reports in `folder`, that of a run or of a suite. Throws as check_run_folder().
std::vector<nlohmann::json> reports_in(const std::filesystem::path& folder);

/// The report of the run in `folder` with what a reader of report.json needs beside: the table of metrics, as
/// metric_table_to_json gives it.
nlohmann::json report_to_share(const std::filesystem::path& folder);

/// Writes tables and report of the run in `folder`; the report is the mark of a finished run.
void finish_run(const std::filesystem::path& folder);

/// Writes a run that was made of stored ones: rows, pictures, kept polygons, tables and report.
void write_run(const run::MergedRun& run, const std::filesystem::path& folder);

/// The same of several plans, as a suite.
void write_suite(const std::vector<run::MergedRun>& runs, const std::filesystem::path& folder);

}  // namespace hullbench::cli
