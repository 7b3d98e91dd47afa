// `hullbench merge`
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/run/merge.hpp"
#include "benchmarks/run/runner.hpp"

namespace hullbench::cli {
namespace {

struct MergeCommand {
  std::vector<fs::path> sources;  ///< folders of runs, or all of suites, which are merged by plan
  fs::path out;                   ///< new or empty; never one of `sources`, in one of them or around one
  bool force = false;             ///< `out` may hold anything but a suite, or a run when `sources` are suites
};

ExitCode merged_exit_code(const std::vector<run::MergedRun>& runs) {
  run::RunResult result;
  bool missing = false;
  for (const run::MergedRun& run : runs) {
    const auto accepted = run.header.at("plan").value("accepted", std::vector<std::string>());
    for (const record::RunRecord& row : run.rows) run::count_row(result, row.status, accepted);
    missing = missing || run.rows.size() < run.planned;
  }
  const ExitCode code = run::exit_code(result);
  return code == kExitOk && missing ? kExitFailures : code;
}

/// The folders with runs in `sources` by plan, in the order of the plans.
std::vector<std::vector<fs::path>> runs_by_plan(const std::vector<fs::path>& sources) {
  std::vector<std::vector<std::string>> lists;
  std::map<std::string, std::vector<fs::path>> folders;
  for (const fs::path& source : sources) {
    auto& list = lists.emplace_back();
    for (const fs::path& run : record::suite_runs(source)) {
      list.push_back(run.filename().string());
      folders[list.back()].push_back(run);
    }
  }
  std::vector<std::vector<fs::path>> result;
  for (const std::string& name : run::common_order(lists)) result.push_back(folders.at(name));
  return result;
}

/// Whether `path` is `folder` or in it, whatever links lead there.
bool is_within(const fs::path& path, const fs::path& folder) {
  const auto resolved = [](const fs::path& given) { return fs::weakly_canonical(fs::absolute(given)); };
  return *resolved(path).lexically_relative(resolved(folder)).begin() != "..";
}

/// Throws unless the output may go to `command.out`.
void check_out(const MergeCommand& command) {
  const std::string out = command.out.string();
  for (const fs::path& source : command.sources) {
    if (is_within(command.out, source) || is_within(source, command.out))
      throw ConfigurationError("the output folder " + out + " is, holds or is in " + source.string() +
                               ", one of the runs to be merged; choose another --out");
  }
  make_writable_folder(command.out);
  const bool of_suites = record::is_suite(command.sources.front());
  if (of_suites ? fs::exists(command.out / "run.json") : record::is_suite(command.out)) {
    throw ConfigurationError("the output folder " + out + " holds a " + (of_suites ? "run" : "suite") +
                             "; choose another one with --out");
  }
  if (!command.force && !fs::is_empty(command.out)) {
    throw ConfigurationError("the output folder " + out +
                             " is not empty; choose another one with --out, or write to it with --force");
  }
}

void say_merged(const std::vector<run::MergedRun>& runs, const MergeCommand& command) {
  for (const run::MergedRun& run : runs) {
    std::cerr << "hullbench: " << run.header.at("plan").at("name").get<std::string>() << ": "
              << run.rows.size() << " of " << run.planned << " planned runs\n";
    for (const json& note : run.header.at("notes"))
      std::cerr << "hullbench: " << note.get<std::string>() << "\n";
  }
  std::cerr << "hullbench: merged " << command.sources.size() << " folders into " << command.out.string()
            << "\n";
}

/// Writes the merged run, or suite, with report and tables. Throws before anything is written.
ExitCode merge(const MergeCommand& command) {
  const auto suites = static_cast<std::size_t>(std::ranges::count_if(command.sources, record::is_suite));
  if (suites != 0 && suites != command.sources.size())
    throw ConfigurationError("some of the folders hold a run and some a suite; merge runs or suites");
  std::size_t not_started = 0;
  for (const fs::path& source : command.sources) not_started += say_plans_without_run(source);
  std::vector<run::MergedRun> runs;
  if (suites == 0) {
    runs.push_back(run::merge_runs(command.sources));
  } else {
    for (const auto& folders : runs_by_plan(command.sources)) runs.push_back(run::merge_runs(folders));
  }
  if (std::ranges::all_of(runs, [](const run::MergedRun& run) { return run.rows.empty(); })) {
    std::cerr << "hullbench: none of the folders has a finished run; nothing is merged\n";
    return kExitNothing;
  }
  check_out(command);
  if (suites == 0) {
    write_run(runs.front(), command.out);
  } else {
    write_suite(runs, command.out);
  }
  table::print_markdown(report::make_documents(reports_in(command.out)), std::cout);
  say_merged(runs, command);
  const ExitCode code = merged_exit_code(runs);
  return code == kExitOk && not_started > 0 ? kExitFailures : code;
}

}  // namespace

void add_merge(CLI::App& app, Action& action) {
  const auto command = std::make_shared<MergeCommand>();
  CLI::App& options = add_command(app, "merge", "Join runs of the same plan, such as its shards",
                                  "hullbench merge shard-1 shard-2 --out whole");
  options.add_option("RUN", command->sources, "Folders of runs, or of suites")->required();
  options.add_option("--out", command->out, "Folder for the joined run, new or empty")->required();
  options.add_flag("--force", command->force, "Write into the folder even if it is not empty");
  set_action(options, action, command, &merge);
}

}  // namespace hullbench::cli
