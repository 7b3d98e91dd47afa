// report.json: everything a run left, with a summary from which tables are printed.
#pragma once

#include <filesystem>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace hullbench::report {

/// The report of a run directory: `run.json` (schema_version, tool, plan, seed, filter, repetitions,
/// datasets, methods, environment, created) with the lines of `runs.jsonl`, or `runs.jsonl.xz`, as `runs`,
/// and a `summary`. When an id occurs more than once (a forced repetition), its last line counts. A torn last
/// line is left out and said in `notes`. Deterministic in its input. Throws std::runtime_error naming the
/// file when one is missing or malformed.
json make_report(const fs::path& run_directory);

/// The reports of the runs in the suite in `folder`, in its order, as make_report gives them; those that were
/// not begun are left out. Throws std::runtime_error naming the file when suite.json cannot be read.
std::vector<json> suite_reports(const fs::path& folder);

/// The `summary` of a report's other members: `totals` (rows by status), `rows` (one a run, in the order of
/// `runs`: id, name, status, the statistics of the headline time `time` and of the paper's boundary
/// `paper_time`, l2, l2_paper, iou, valid, order, fastest), `claims` (see claims.hpp), `noise`, `protocols`
/// (who chose the parameters, in words) and `headline` (the fastest rival with the same polygons). results/
/// report.schema.json describes all of them.
json make_summary(const json& report);

/// Writes `report` to `path` like write_json_file, but each run and each row of the summary on one line:
/// there may be many thousands.
void write_report_file(const fs::path& path, const json& report);

}  // namespace hullbench::report
