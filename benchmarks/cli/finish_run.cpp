#include "benchmarks/cli/finish_run.hpp"

#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/report.hpp"

namespace hullbench::cli {

namespace fs = std::filesystem;
using nlohmann::json;

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
