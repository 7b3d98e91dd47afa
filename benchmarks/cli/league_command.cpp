#include "benchmarks/cli/league_command.hpp"

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/league/league.hpp"
#include "benchmarks/league/league_report.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/report.hpp"

namespace hullbench::cli {

using nlohmann::json;

int league_command(const LeagueCommand& command) {
  std::vector<json> reports;
  for (const std::filesystem::path& folder : command.runs) {
    if (!std::filesystem::is_directory(folder))
      throw ConfigurationError("there is no run in " + folder.string() +
                               "; give the folder of a run or suite");
    const std::vector<json> some =
        record::is_suite(folder) ? report::suite_reports(folder) : std::vector{record::load_run(folder)};
    reports.insert(reports.end(), some.begin(), some.end());
  }
  if (std::all_of(reports.begin(), reports.end(),
                  [](const json& report) { return report.at("runs").empty(); })) {
    std::cerr << "hullbench: none of the folders has a finished run; there is nothing to judge\n";
    return 6;
  }
  const json league =
      league::league_to_json(league::make_league(reports, command.split_seed, !command.all_cases), reports);
  table::print_markdown(league::league_document(league), std::cout);
  if (!command.out.empty()) {
    write_json_file(command.out, league);
    std::cerr << "hullbench: wrote " << command.out.string() << "\n";
  }
  return 0;
}

}  // namespace hullbench::cli
