#include "benchmarks/run_command.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "benchmarks/environment.hpp"
#include "benchmarks/gbench_export.hpp"
#include "benchmarks/listing.hpp"
#include "benchmarks/method_catalog.hpp"
#include "benchmarks/plan.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/run_directory.hpp"
#include "benchmarks/stray_processes.hpp"
#include "benchmarks/suite.hpp"
#include "benchmarks/tool_description.hpp"
#include "benchmarks/worker_process.hpp"
#include "datasets/datasets.hpp"
#include "datasets/rgbd/recordings.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kResults = "results";

/// A plan and those of its runs that were asked for.
struct Experiment {
  Plan plan;
  std::string filter;
  std::vector<PlannedRun> runs;
};

std::size_t count_recordings(const fs::path& folder) {
  try {
    return list_recordings(folder).size();
  } catch (const std::runtime_error& error) {
    throw ConfigurationError(error.what());
  }
}

Experiment make_experiment(const std::string& name, const RunCommand& command, const MethodCatalog& catalog) {
  Plan plan = load_plan(name, HULLBENCH_PLAN_FOLDER);
  for (const std::string& method : command.with) add_methods(plan, catalog.runs_of(method));
  if (!command.recordings.empty()) use_recordings(plan, count_recordings(command.recordings));
  plan.repetitions = command.repetitions.value_or(plan.repetitions);
  plan.seed = command.seed.value_or(plan.seed);
  plan.timeout_s = command.timeout_s.value_or(plan.timeout_s);
  plan.mem_limit_mib = command.mem_limit_mib.value_or(plan.mem_limit_mib);
  for (PlanMethod& method : plan.methods) {
    if (command.repetitions) method.repetitions.reset();
    if (command.timeout_s) method.timeout_s.reset();
    if (command.mem_limit_mib) method.mem_limit_mib.reset();
  }
  check_plan(plan, catalog.names(), datasets({default_data_directory(), command.recordings}));
  std::string filter = command.filter.empty() ? plan.filter : command.filter;
  std::vector<PlannedRun> runs = planned_runs(plan, filter);
  return {std::move(plan), std::move(filter), std::move(runs)};
}

/// The formula of every rule that the plan names.
json describe_rules(const Plan& plan) {
  json rules = json::object();
  for (const PlanMethod& method : plan.methods) {
    for (const auto& [name, choice] : method.parameters) {
      if (const auto* rule = std::get_if<RuleChoice>(&choice))
        rules[rule->rule] = find_rule(rule->rule)->formula;
    }
  }
  return rules;
}

/// The hashes of the manifests of the plan's methods.
json manifest_hashes(const Plan& plan, const MethodCatalog& catalog) {
  json hashes = json::object();
  for (const PlanMethod& method : plan.methods) {
    const auto found = catalog.hashes().find(method.method);
    if (found != catalog.hashes().end()) hashes[found->first] = found->second;
  }
  return hashes;
}

json describe_run(const Experiment& experiment, const RunCommand& command, const MethodCatalog& catalog) {
  const Plan& plan = experiment.plan;
  std::vector<std::string> used;
  used.reserve(experiment.runs.size());
  for (const PlannedRun& run : experiment.runs) used.push_back(plan.expanded_cases[run.case_index].dataset);
  return {{"schema_version", kSchemaVersion},
          {"created", utc_now()},
          {"resumed", json::array()},
          {"tool", describe_tool()},
          {"environment", collect_environment()},
          {"plan", plan_to_json(plan)},
          {"rules", describe_rules(plan)},
          {"seed", plan.seed},
          {"filter", experiment.filter.empty() ? json(nullptr) : json(experiment.filter)},
          {"manifests", manifest_hashes(plan, catalog)},
          {"shard", command.shard ? json(to_string(*command.shard)) : json(nullptr)},
          {"repetitions", plan.repetitions},
          {"datasets", describe_datasets({default_data_directory(), command.recordings}, used)}};
}

/// Which cores do what: the last allowed one is the workers', and the harness keeps off it while they work.
struct Cores {
  std::vector<int> all;
  std::optional<int> worker;
};

Cores reserve_worker_core() {
  Cores cores = {allowed_cores(), std::nullopt};
  if (cores.all.empty()) return cores;
  cores.worker = cores.all.back();
  leave_core(*cores.worker);
  return cores;
}

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// The header of the run in `directory`: the earlier start's, with this start added, or the new one.
json header_to_write(const RunDirectory& directory, const json& header) {
  if (!directory.resumed()) return header;
  json earlier = directory.header();
  earlier["resumed"].push_back(header.at("created"));
  return earlier;
}

void say_what_goes_on(const RunDirectory& directory, std::size_t planned) {
  if (!directory.resumed()) {
    std::cerr << "hullbench: " << planned << " runs to do, into " << directory.path().string() << "\n";
    return;
  }
  const auto& rows = directory.rows();
  const auto missing = std::count_if(
      rows.begin(), rows.end(), [](const RunRecord& row) { return row.status == Status::kNotInstalled; });
  std::cerr << "hullbench: going on with the run in " << directory.path().string() << ": "
            << std::ssize(rows) - missing << " of " << planned
            << " runs are finished and not measured again (--force starts anew)";
  if (missing > 0) std::cerr << "; tried again because the method was not installed: " << missing;
  std::cerr << "\n";
}

void say_counts(const RunResult& result) {
  int failed = 0;
  const auto count = [&](Status status) {
    const auto found = result.counts.find(status);
    return found == result.counts.end() ? 0 : found->second;
  };
  for (const Status status :
       {Status::kTimeout, Status::kMemory, Status::kCrash, Status::kError, Status::kInvalidOutput}) {
    failed += count(status);
  }
  std::cerr << "hullbench: " << count(Status::kOk) << " ok, " << failed << " failed, "
            << count(Status::kNotInstalled) << " not installed";
  if (count(Status::kUnsupported) > 0) std::cerr << ", " << count(Status::kUnsupported) << " unsupported";
  if (result.accepted > 0) std::cerr << ", " << result.accepted << " not ok as the plan accepts";
  std::cerr << "\n";
}

void say_files(const fs::path& directory, const fs::path& shown, const std::vector<const char*>& files) {
  std::cerr << "hullbench: wrote";
  for (const char* file : files) std::cerr << " " << (shown / file).string();
  if (shown != directory) std::cerr << " (in " << directory.string() << ")";
  std::cerr << "\n";
}

/// Everything that the experiments of one call share.
class Measuring {
 public:
  Measuring(const RunCommand& command, const MethodCatalog& catalog,
            const std::vector<Experiment>& experiments)
      : command_(command),
        catalog_(catalog),
        cores_(reserve_worker_core()),
        progress_(std::cerr, ::isatty(STDERR_FILENO) == 1, terminal_width(), sections_of(experiments)) {}

  /// Measures `experiment` into `directory` and writes its report and its tables there. `place`: of the
  /// experiment among all.
  RunResult measure(const Experiment& experiment, const json& header, RunDirectory& directory,
                    std::size_t place) {
    progress_.enter(place);
    say_what_goes_on(directory, experiment.runs.size());
    const RunnerOptions options = {[this](const std::string& name) { return catalog_.find(name); },
                                   cores_.worker,
                                   cores_.all,
                                   {default_data_directory(), command_.recordings}};
    RunResult result = run_plan(experiment.plan, experiment.runs, header_to_write(directory, header), options,
                                directory, progress_);
    progress_.end();
    if (result.interrupted) {
      std::cerr << "hullbench: interrupted; finished runs are kept in " << directory.path().string()
                << ", and the same command goes on from there\n";
      return result;
    }
    finish_run(directory.path());
    return result;
  }

 private:
  static std::vector<ProgressSection> sections_of(const std::vector<Experiment>& experiments) {
    std::vector<ProgressSection> sections;
    sections.reserve(experiments.size());
    for (const Experiment& experiment : experiments) {
      sections.push_back({experiment.plan.title, progress_runs(experiment.plan, experiment.runs)});
    }
    return sections;
  }

  const RunCommand& command_;
  const MethodCatalog& catalog_;
  Cores cores_;
  Progress progress_;
};

int measure_one(const RunCommand& command, const Experiment& experiment, const MethodCatalog& catalog) {
  const json header = describe_run(experiment, command, catalog);
  const auto directory = open_run_directory(header, {command.out, command.force, kResults});
  if (!command.out) point_latest_to(directory->path(), kResults);
  Measuring measuring(command, catalog, {experiment});
  const RunResult result = measuring.measure(experiment, header, *directory, 0);
  if (result.interrupted) return exit_code(result);
  const json report = make_report(directory->path());
  print_markdown(make_documents({report}), std::cout);
  if (!command.export_gbench.empty()) export_gbench(command.export_gbench, {report});
  say_counts(result);
  say_files(directory->path(), command.out ? directory->path() : kResults / "latest",
            {"report.json", "tables.md", "tables", "runs.jsonl", "repetitions.jsonl", "run.json"});
  return exit_code(result);
}

/// What the rows of a finished run say.
RunResult finished_result(const fs::path& run) {
  RunResult result;
  const json report = make_report(run);
  const auto accepted = report.at("plan").value("accepted", std::vector<std::string>());
  for (const json& row : report.at("runs")) count_row(result, row.get<RunRecord>().status, accepted);
  return result;
}

int measure_suite(const RunCommand& command, const std::vector<Experiment>& experiments,
                  const MethodCatalog& catalog) {
  std::vector<json> headers;
  headers.reserve(experiments.size());
  for (const Experiment& experiment : experiments)
    headers.push_back(describe_run(experiment, command, catalog));
  const fs::path suite = open_suite(headers, {command.out, command.force, kResults});
  if (!command.out) point_latest_to(suite, kResults);
  Measuring measuring(command, catalog, experiments);
  RunResult all;
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    const Plan& plan = experiments[i].plan;
    const fs::path run = suite / plan.name;
    std::cerr << "hullbench: table " << i + 1 << " of " << experiments.size() << ": " << plan.title;
    RunResult result;
    if (!command.force && is_finished_run(run, headers[i])) result = finished_result(run);
    // A method that was not installed may be there now.
    if (!result.counts.empty() && !result.counts.contains(Status::kNotInstalled)) {
      std::cerr << " is finished already\n";
    } else {
      std::cerr << "\n";
      const auto directory = open_run_directory(headers[i], {run, command.force, kResults});
      result = measuring.measure(experiments[i], headers[i], *directory, i);
    }
    if (result.interrupted) return exit_code(result);
    for (const auto& [status, count] : result.counts) all.counts[status] += count;
    all.accepted += result.accepted;
  }
  const std::vector<json> reports = suite_reports(suite);
  const std::vector<Document> documents = make_documents(reports);
  print_markdown(documents, std::cout);
  write_tables(suite, documents);
  if (!command.export_gbench.empty()) export_gbench(command.export_gbench, reports);
  say_counts(all);
  say_files(suite, command.out ? suite : kResults / "latest", {"tables.md", "tables", "suite.json"});
  return exit_code(all);
}

/// Leaves of `experiment` what belongs to the shard that was asked for, and says so when that is nothing.
void keep_shard(Experiment& experiment, const RunCommand& command) {
  if (!command.shard || experiment.runs.empty()) return;
  experiment.runs = runs_of_shard(experiment.plan, experiment.runs, *command.shard);
  if (experiment.runs.empty()) {
    std::cerr << "hullbench: the plan '" << experiment.plan.name << "' has too few cases for shard "
              << to_string(*command.shard) << ": nothing of it is measured here\n";
  }
}

}  // namespace

void check_export_place(const fs::path& file) {
  if (file.empty()) return;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (fs::is_directory(file) || ::access(folder.c_str(), W_OK) != 0) {
    throw ConfigurationError("cannot write " + file.string() +
                             "; give --export-gbench a file in a folder that is there and writable");
  }
}

int run_command(const RunCommand& command) {
  const MethodCatalog catalog(manifest_folders(command.adapters));
  std::vector<Experiment> experiments;
  std::string names;
  bool any_run = false;
  for (const std::string& name : command.plans) {
    Experiment experiment = make_experiment(name, command, catalog);
    names += (names.empty() ? "'" : ", '") + experiment.plan.name + "'";
    const auto same = [&](const Experiment& other) { return other.plan.name == experiment.plan.name; };
    if (std::any_of(experiments.begin(), experiments.end(), same)) {
      throw ConfigurationError("the plan '" + experiment.plan.name + "' is named twice; leave one out");
    }
    any_run = any_run || !experiment.runs.empty();
    keep_shard(experiment, command);
    if (!experiment.runs.empty()) experiments.push_back(std::move(experiment));
  }
  if (experiments.empty() && any_run) return 6;
  if (experiments.empty()) {
    const std::string way_out = command.filter.empty()
                                    ? "the plan's own filter; choose others with --filter"
                                    : "'" + command.filter + "'; --dry-run without --filter prints the names";
    std::cerr << "hullbench: no run of the plan" << (command.plans.size() == 1 ? " " : "s ") << names
              << " has a name that matches " << way_out << "\n";
    return 6;
  }
  if (command.dry_run) {
    for (const Experiment& experiment : experiments) {
      for (const PlannedRun& run : experiment.runs) std::cout << run.name << "\n";
    }
    return 0;
  }
  check_export_place(command.export_gbench);
  end_strays_of_dead_harnesses();
  remove_stale_scratch(kResults);
  return command.plans.size() == 1 ? measure_one(command, experiments.front(), catalog)
                                   : measure_suite(command, experiments, catalog);
}

}  // namespace hullbench
