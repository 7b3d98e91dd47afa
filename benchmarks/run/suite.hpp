// Several plans run one after another: a folder with a run of each, and the tables of all of them together.
//
//   suite.json      the plans in their order, and what must be the same for the suite to go on
//   <plan>/         the run of that plan; see run_directory.hpp
//   tables.md       written last: the mark of a finished suite
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/report/document.hpp"
#include "benchmarks/run/run_directory.hpp"

namespace hullbench {

/// The folder for a suite of runs with these headers (one or more, of plans with different names). The newest
/// suite of the same runs in `place.results`/runs is gone on with when it is not finished, and so is the one
/// in `place.out`, finished or not; else a new one is made. Throws ConfigurationError when the folder cannot
/// be written, or `place.out` holds something else and `force` is not set; with `force` the runs that an
/// earlier suite left in it are started anew.
std::filesystem::path open_suite(const std::vector<nlohmann::json>& headers, const RunPlace& place);

/// Whether there is a suite in `folder`.
bool is_suite(const std::filesystem::path& folder);

/// The reports of the runs in the suite in `folder`, in its order, as make_report gives them; those that were
/// not begun are left out. Throws std::runtime_error naming the file when suite.json cannot be read.
std::vector<nlohmann::json> suite_reports(const std::filesystem::path& folder);

/// The folders of the runs in the suite in `folder`, in its order; those that were not begun are left out.
/// Throws like suite_reports.
std::vector<std::filesystem::path> suite_runs(const std::filesystem::path& folder);

/// The report of the run in `folder` with what a reader of report.json needs beside: the table of metrics, as
/// metric_table_to_json gives it.
nlohmann::json report_to_share(const std::filesystem::path& folder);

/// Writes tables and report of the run in `folder`; the report is the mark of a finished run.
void finish_run(const std::filesystem::path& folder);

/// All tables of some reports: methods and parameters, the reports' own tables, what differs from the paper,
/// and the notes that the reports share, once. A table of steps is left out of a report of many cases when
/// another one is about the steps alone.
std::vector<Document> make_documents(const std::vector<nlohmann::json>& reports);

}  // namespace hullbench
