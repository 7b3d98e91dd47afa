#include "benchmarks/cli/run_folder.hpp"

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/report.hpp"

namespace hullbench::cli {

namespace fs = std::filesystem;
using nlohmann::json;

void check_run_folder(const fs::path& folder) {
  if (!fs::is_directory(folder)) {
    throw ConfigurationError("there is no run in " + folder.string() +
                             "; give a run's folder, or measure one with 'hullbench run'");
  }
}

std::vector<json> reports_in(const fs::path& folder) {
  check_run_folder(folder);
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

}  // namespace hullbench::cli
