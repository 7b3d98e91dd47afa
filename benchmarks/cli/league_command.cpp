// `hullbench league`: the league of some runs, printed and written.
#include <algorithm>
#include <iostream>

#include "benchmarks/base/files.hpp"
#include "benchmarks/base/names.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/league/league.hpp"
#include "benchmarks/league/league_report.hpp"
#include "benchmarks/record/stored_run.hpp"

namespace hullbench::cli {
namespace {

struct LeagueCommand {
  std::vector<fs::path> runs;
  fs::path out;  ///< empty: only print
  fs::path csv;  ///< empty: none
  bool all_cases = false;
};

ExitCode print_league(const LeagueCommand& command) {
  std::vector<json> reports;
  for (const fs::path& folder : command.runs) {
    check_run_folder(folder);
    for (const fs::path& run : record::runs_in(folder)) reports.push_back(record::load_run(run));
  }
  if (std::ranges::all_of(reports, [](const json& report) { return report.at("runs").empty(); })) {
    std::cerr << "hullbench: none of the folders has a finished run; there is nothing to judge\n";
    return kExitNothing;
  }
  const league::League made = league::make_league(reports, !command.all_cases);
  const json league = league::league_to_json(made, reports);
  table::print_markdown(league::league_document(league), std::cout);
  if (!command.out.empty()) {
    write_json_file(command.out, league);
    std::cerr << "hullbench: wrote " << command.out.string() << "\n";
  }
  if (!command.csv.empty()) {
    write_text_file(command.csv, league::league_csv(made));
    std::cerr << "hullbench: wrote " << command.csv.string() << "\n";
  }
  return kExitOk;
}

}  // namespace

void add_league(CLI::App& app, Action& action) {
  const auto command = std::make_shared<LeagueCommand>();
  CLI::App& options = add_command(
      app, "league", "Rank the methods by their error over the cases of some runs, protocol by protocol",
      "hullbench league results/latest --out league.json");
  options.add_option("RUN", command->runs, "Folders of runs, or of suites")->required();
  options.add_option("--out", command->out,
                     "Also write the ranking as JSON into this file (results/league.schema.json)");
  options.add_option(
      "--csv", command->csv,
      "Also write every result as a line of this CSV file: method, task, fold, error, time, ...");
  options.add_flag("--all-cases", command->all_cases,
                   "Count the training shapes too, not the test shapes alone");
  set_action(options, action, command, &print_league);
}

}  // namespace hullbench::cli
