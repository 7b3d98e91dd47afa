#include "benchmarks/cli/run_folder.hpp"

#include <iostream>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/record/kept_polygons.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "benchmarks/run/suite.hpp"

namespace hullbench::cli {

void check_run_folder(const fs::path& folder) {
  if (!record::is_suite(folder) && !fs::exists(folder / record::kHeaderFile)) {
    throw ConfigurationError("there is no run in " + folder.string() +
                             "; give a run's folder, or measure one with 'hullbench run'");
  }
  for (const fs::path& run : record::runs_in(folder)) record::check_run(run);
}

std::size_t say_plans_without_run(const fs::path& folder) {
  const std::vector<std::string> names = record::plans_without_run(folder);
  if (!names.empty()) {
    std::cerr << "hullbench: of the suite in " << folder.string()
              << " these plans were not started: " << join_words(names) << "\n";
  }
  return names.size();
}

std::vector<json> reports_in(const fs::path& folder) {
  check_run_folder(folder);
  say_plans_without_run(folder);
  return record::is_suite(folder) ? report::suite_reports(folder) : std::vector{report::make_report(folder)};
}

json report_to_share(const fs::path& folder) {
  json report = report::make_report(folder);
  report["metrics"] = metrics::metric_table_to_json();
  return report;
}

void finish_run(const fs::path& folder) {
  const json report = report_to_share(folder);
  table::write_tables(folder, report::make_documents({report}));
  report::write_report_file(folder / record::kReportFile, report);
}

void write_run(const run::MergedRun& run, const fs::path& folder) {
  const auto directory = run::open_run_directory(run.header, {folder, true});
  directory->write_header(run.header);
  record::merge_pictures(run.folders, folder);
  for (const fs::path& source : run.folders) {
    if (fs::exists(source / record::kPolygonsFolder)) {
      fs::copy(source / record::kPolygonsFolder, folder / record::kPolygonsFolder,
               fs::copy_options::recursive | fs::copy_options::skip_existing);
    }
  }
  directory->append_rows(run.rows);
  // The rows have their times; single repetitions would only be needed to go on.
  fs::remove(folder / "repetitions.jsonl");
  finish_run(folder);
}

void write_suite(const std::vector<run::MergedRun>& runs, const fs::path& folder) {
  std::vector<json> headers;
  headers.reserve(runs.size());
  for (const run::MergedRun& run : runs) headers.push_back(run.header);
  run::open_suite(headers, {folder, true});
  for (const run::MergedRun& run : runs)
    write_run(run, folder / run.header.at("plan").at("name").get<std::string>());
  table::write_tables(folder, report::make_documents(report::suite_reports(folder)));
}

}  // namespace hullbench::cli
