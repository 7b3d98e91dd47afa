// What runs and suites have left in their folders.
//
//   run.json       what was measured, with what, where
//   runs.jsonl     a line a finished run; of reference runs compressed, runs.jsonl.xz
//   report.json    written last: the mark of a finished run
//   suite.json     of a suite: its plans in their order; each has its run in the folder of its name
//   polygons/      the results, where they were kept (kept_polygons.hpp)
//   tables.md, tables/ (each as CSV and LaTeX, and all of them in tables.json)
#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::record {

inline constexpr const char* kHeaderFile = "run.json";
inline constexpr const char* kRowsFile = "runs.jsonl";
inline constexpr const char* kReportFile = "report.json";
inline constexpr const char* kSuiteFile = "suite.json";
inline constexpr const char* kTablesFile = "tables.md";
inline constexpr const char* kTablesFolder = "tables";
/// What load_run() adds to the notes of a run whose last line is torn.
inline constexpr const char* kTornNote =
    "The last line of runs.jsonl was cut short when the run was interrupted; it is left out.";

/// Throws ConfigurationError, one sentence, where there is no run in the folder, or its run.json does not
/// follow the schema.
void check_run(const fs::path& run_directory);

/// A run directory as it is: `run.json`, with its rows as `runs` and with `notes`; what make_report gives but
/// for the summary. Throws ConfigurationError naming the file that cannot be read.
json load_run(const fs::path& run_directory);

/// The lines of the runs file `path` with each id once: its last line, at the place of its first. Throws
/// ConfigurationError naming the file when one is not a run's record.
json last_of_each_id(JsonLines lines, const fs::path& path);

/// The lines of `path` as records. Throws ConfigurationError naming the file and the line that is none.
std::vector<RunRecord> records_of(const JsonLines& lines, const fs::path& path);

/// The plans of the suite in `folder` that have no run yet, as after an interruption.
std::vector<std::string> plans_without_run(const fs::path& folder);

/// Whether there is a suite in `folder`.
bool is_suite(const fs::path& folder);

/// suite.json of a folder; null when it has none that can be read.
json read_suite(const fs::path& folder);

/// The folders of the runs in the suite in `folder`, in its order; those that were not begun are left out.
/// Throws ConfigurationError naming the file when suite.json cannot be read.
std::vector<fs::path> suite_runs(const fs::path& folder);

/// The folders of the runs in `folder`: itself, or those of its suite, as suite_runs() gives them.
std::vector<fs::path> runs_in(const fs::path& folder);

}  // namespace hullbench::record
