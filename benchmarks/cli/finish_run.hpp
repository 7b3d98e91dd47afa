// What the harness writes when a run is over.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hullbench::cli {

/// The report of the run in `folder` with what a reader of report.json needs beside: the table of metrics, as
/// metric_table_to_json gives it.
nlohmann::json report_to_share(const std::filesystem::path& folder);

/// Writes tables and report of the run in `folder`; the report is the mark of a finished run.
void finish_run(const std::filesystem::path& folder);

}  // namespace hullbench::cli
