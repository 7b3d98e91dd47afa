// `hullbench metrics`
#include <iostream>

#include "benchmarks/cli/options.hpp"
#include "benchmarks/metrics/metric_table.hpp"

namespace hullbench::cli {
namespace {

struct MetricsCommand {
  bool json = false;
  bool markdown = false;
};

ExitCode show_metrics(const MetricsCommand& command) {
  if (command.json) {
    std::cout << metrics::metric_table_to_json().dump(2) << "\n";
  } else if (command.markdown) {
    std::cout << metrics::metric_table_to_markdown();
  } else {
    metrics::print_metric_table(std::cout);
  }
  return kExitOk;
}

}  // namespace

void add_metrics(CLI::App& app, Action& action) {
  const auto command = std::make_shared<MetricsCommand>();
  CLI::App& options =
      add_command(app, "metrics", "Show what is scored, and how each metric is defined", "hullbench metrics");
  CLI::Option* json = options.add_flag("--json", command->json, "Print JSON");
  options.add_flag("--markdown", command->markdown, "Print the table of benchmarks/metrics/METRICS.md")
      ->excludes(json);
  set_action(options, action, command, &show_metrics);
}

}  // namespace hullbench::cli
