// `hullbench tables`
#include <iostream>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/league/league_report.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/gbench_export.hpp"

namespace hullbench::cli {
namespace {

struct TablesCommand {
  std::string run = "results/latest";
  bool write = false;
  fs::path export_gbench;
};

ExitCode tables(const TablesCommand& command) {
  check_export_place(command.export_gbench);
  const std::vector<json> reports = reports_in(command.run);
  const std::vector<table::Document> documents = report::make_documents(reports);
  table::print_markdown(documents, std::cout);
  if (command.write) {
    table::write_tables(command.run, documents);
    league::write_league_tables(command.run);
  }
  if (command.export_gbench.empty()) return kExitOk;
  if (reports.empty()) {
    throw ConfigurationError("no run was begun in " + command.run + ", so there is nothing to export");
  }
  report::export_gbench(command.export_gbench, reports);
  return kExitOk;
}

}  // namespace

void add_tables(CLI::App& app, Action& action) {
  const auto command = std::make_shared<TablesCommand>();
  CLI::App& options =
      add_command(app, "tables", "Print the tables of a run", "hullbench tables results/latest");
  options.add_option("RUN", command->run, "The folder of a run, or of a suite")->capture_default_str();
  options.add_flag("--write", command->write, "Also write the run's tables.md and tables/ anew");
  add_export_gbench(options, command->export_gbench);
  set_action(options, action, command, &tables);
}

}  // namespace hullbench::cli
