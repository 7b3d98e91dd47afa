// `hullbench rescore`
#include <iostream>
#include <string>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/utc_now.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/cli/tool_description.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/run/rescore.hpp"

namespace hullbench::cli {
namespace {

struct RescoreCommand {
  fs::path run;         ///< the folder of a run or suite
  fs::path out;         ///< new or empty
  fs::path recordings;  ///< where recorded floors are; empty: nowhere
};

void check_out(const RescoreCommand& command) {
  if (fs::exists(command.out) && !fs::is_empty(command.out)) {
    throw ConfigurationError("the output folder " + command.out.string() +
                             " is not empty; choose another one with --out");
  }
  const bool was_there = fs::exists(command.out);
  make_writable_folder(command.out);
  if (!was_there) fs::remove(command.out);  // it is made again when there is something to write
}

/// Writes the run or suite with its new scores; the old one stays as it is.
ExitCode rescore(const RescoreCommand& command) {
  check_run_folder(command.run);
  check_out(command);
  std::vector<run::MergedRun> runs;
  std::size_t scored = 0;
  for (const fs::path& folder : record::runs_in(command.run)) {
    run::Rescored rescored =
        run::rescore(folder, allowed_cores(), {default_data_directory(), command.recordings});
    const std::string name = rescored.header.at("plan").at("name").get<std::string>();
    std::cerr << "hullbench: " << name << ": " << rescored.scored << " of " << rescored.rows.size()
              << " rows have new scores";
    if (rescored.without_polygons > 0)
      std::cerr << "; the polygons of " << rescored.without_polygons
                << " were not kept, so their scores are the old ones";
    std::cerr << "\n";
    scored += rescored.scored;
    rescored.header["rescored"] = {{"created", utc_now()}, {"tool", describe_tool()}};
    const std::size_t planned = rescored.rows.size();
    runs.push_back({std::move(rescored.header), std::move(rescored.rows), planned, {folder}});
  }
  if (scored == 0) {
    std::cerr << "hullbench: no polygons were kept in " << command.run.string()
              << "; 'hullbench run --keep-polygons' keeps them\n";
    return kExitNothing;
  }
  make_writable_folder(command.out);
  if (record::is_suite(command.run)) {
    write_suite(runs, command.out);
  } else {
    write_run(runs.front(), command.out);
  }
  table::print_markdown(report::make_documents(reports_in(command.out)), std::cout);
  std::cerr << "hullbench: wrote " << command.out.string() << "\n";
  return kExitOk;
}

}  // namespace

void add_rescore(CLI::App& app, Action& action) {
  const auto command = std::make_shared<RescoreCommand>();
  CLI::App& options = add_command(
      app, "rescore", "Score the kept polygons of a run again, as after a new metric; no method runs",
      "hullbench rescore results/latest --out rescored");
  options.add_option("RUN", command->run, "Folder of a run, or of a suite, made with 'run --keep-polygons'")
      ->required();
  options.add_option("--out", command->out, "Folder for the run with its new scores, new or empty")
      ->required();
  options.add_option("--recordings", command->recordings, "The folder of recorded floors that the run had");
  set_action(options, action, command, &rescore);
}

}  // namespace hullbench::cli
