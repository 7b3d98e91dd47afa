// `hullbench readme`
#include <iostream>
#include <optional>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/league/league_report.hpp"
#include "benchmarks/report/readme.hpp"

namespace hullbench::cli {
namespace {

struct ReadmeCommand {
  std::string run;
  std::string file;
  bool check = false;
};

std::string results_of(const std::string& run) {
  // Named by what it is, not by a link that will point to another one some day.
  const fs::path folder =
      fs::is_symlink(run) ? fs::path(run).parent_path() / fs::read_symlink(run) : fs::path(run);
  std::string results = report::readme_results(reports_in(run), folder.string());
  if (const json league = league::load_league(folder); !league.is_null())
    results += league::league_results(league, folder.string());
  return results;
}

ExitCode readme(const ReadmeCommand& command) {
  const auto& [run, file, check] = command;
  const std::optional<std::string> before = read_text_file(file);
  if (!before) throw ConfigurationError("there is no file " + file);
  const std::string after = report::with_results(*before, results_of(run));
  if (before == after) {
    std::cout << file << " agrees with " << run << "\n";
    return kExitOk;
  }
  if (check) {
    std::cerr << "hullbench: the results in " << file << " are not those of " << run << "; 'hullbench readme "
              << run << " " << file << "' writes them anew\n";
    return kExitError;
  }
  write_text_file(file, after);
  std::cout << "wrote the results of " << run << " into " << file << "\n";
  return kExitOk;
}

}  // namespace

void add_readme(CLI::App& app, Action& action) {
  const auto command = std::make_shared<ReadmeCommand>();
  CLI::App& options = add_command(app, "readme", "Update the tables of results in a README",
                                  "hullbench readme results/reference README.md --check");
  options.add_option("RUN", command->run, "The run's folder")->required();
  options.add_option("FILE", command->file, "The README")->required();
  options.add_flag("--check", command->check,
                   "Change nothing; exit with 1 if the tables are not those of the run");
  set_action(options, action, command, &readme);
}

}  // namespace hullbench::cli
