// `hullbench run`: from the command line's words to rows, report and tables.
#include "benchmarks/cli/run_command.hpp"

#include <algorithm>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/utc_now.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/cli/listing.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/cli/terminal.hpp"
#include "benchmarks/cli/tool_description.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/environment.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/gbench_export.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/run/canary.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "benchmarks/run/runner.hpp"
#include "benchmarks/run/suite.hpp"
#include "benchmarks/worker/stray_processes.hpp"
#include "benchmarks/worker/worker_process.hpp"
#include "datasets/data_folder.hpp"
#include "datasets/datasets.hpp"
#include "datasets/rgbd/recordings.hpp"

namespace hullbench::cli {
namespace {

const fs::path kResults = "results";

/// A plan and those of its runs that were asked for.
struct Experiment {
  plan::Plan plan;
  std::string filter;
  std::vector<plan::PlannedRun> runs;
};

std::size_t count_recordings(const fs::path& folder) {
  try {
    return list_recordings(folder).size();
  } catch (const std::runtime_error& error) {
    throw ConfigurationError(error.what());
  }
}

Experiment make_experiment(const std::string& name, const RunCommand& command,
                           const run::MethodCatalog& catalog) {
  plan::Plan plan = plan::load_plan(name, data_folder() / "benchmarks" / "plans");
  for (const std::string& method : command.with) plan::add_methods(plan, catalog.runs_of(method));
  if (!command.recordings.empty()) plan::use_recordings(plan, count_recordings(command.recordings));
  plan.repetitions = command.repetitions.value_or(plan.repetitions);
  plan.passes = command.passes.value_or(plan.passes);
  plan.seed = command.seed.value_or(plan.seed);
  plan.timeout_s = command.timeout_s.value_or(plan.timeout_s);
  plan.mem_limit_mib = command.mem_limit_mib.value_or(plan.mem_limit_mib);
  for (plan::PlanMethod& method : plan.methods) {
    if (command.repetitions) method.repetitions.reset();
    if (command.timeout_s) method.timeout_s.reset();
    if (command.mem_limit_mib) method.mem_limit_mib.reset();
  }
  plan::check_plan(plan, catalog.names(), datasets({default_data_directory(), command.recordings}));
  std::string filter = command.filter.empty() ? plan.filter : command.filter;
  std::vector<plan::PlannedRun> runs = plan::planned_runs(plan, filter);
  return {std::move(plan), std::move(filter), std::move(runs)};
}

/// The formula of every rule that the plan names.
json describe_rules(const plan::Plan& plan) {
  json rules = json::object();
  for (const plan::PlanMethod& method : plan.methods) {
    for (const auto& [name, choice] : method.parameters) {
      if (const auto* rule = std::get_if<plan::RuleChoice>(&choice))
        rules[rule->rule] = plan::find_rule(rule->rule)->formula;
    }
  }
  return rules;
}

/// The hashes of the manifests of the plan's methods.
json manifest_hashes(const plan::Plan& plan, const run::MethodCatalog& catalog) {
  json hashes = json::object();
  for (const plan::PlanMethod& method : plan.methods) {
    const auto found = catalog.hashes().find(method.method);
    if (found != catalog.hashes().end()) hashes[found->first] = found->second;
  }
  return hashes;
}

json describe_run(const Experiment& experiment, const RunCommand& command,
                  const run::MethodCatalog& catalog) {
  const plan::Plan& plan = experiment.plan;
  std::vector<std::string> used;
  used.reserve(experiment.runs.size());
  for (const plan::PlannedRun& run : experiment.runs)
    used.push_back(plan.expanded_cases[run.case_index].dataset);
  return {{"schema_version", record::kSchemaVersion},
          {"created", utc_now()},
          {"resumed", json::array()},
          {"tool", describe_tool()},
          {"environment", record::collect_environment()},
          {"plan", plan::plan_to_json(plan)},
          {"rules", describe_rules(plan)},
          {"seed", plan.seed},
          {"filter", experiment.filter.empty() ? json(nullptr) : json(experiment.filter)},
          {"manifests", manifest_hashes(plan, catalog)},
          {"shard", command.shard ? json(to_string(*command.shard)) : json(nullptr)},
          {"repetitions", plan.repetitions},
          {"passes", plan.passes},
          {"datasets", describe_datasets({default_data_directory(), command.recordings}, used)}};
}

/// The header of the run in `directory`: the earlier start's, with this start added, or the new one.
json header_to_write(const run::RunDirectory& directory, const json& header) {
  if (!directory.resumed()) return header;
  json earlier = directory.header();
  earlier["resumed"].push_back(header.at("created"));
  return earlier;
}

void say_what_goes_on(const run::RunDirectory& directory, const Experiment& experiment) {
  const std::size_t planned = experiment.runs.size();
  if (!directory.resumed()) {
    std::cerr << "hullbench: " << planned << " runs to do, into " << directory.path().string() << "\n";
    return;
  }
  const auto& rows = directory.rows();
  const auto missing = std::ranges::count_if(
      rows, [](const record::RunRecord& row) { return row.status == record::Status::kNotInstalled; });
  const auto finished =
      static_cast<std::ptrdiff_t>(run::count_finished(experiment.plan, experiment.runs, directory));
  std::cerr << "hullbench: going on with the run in " << directory.path().string() << ": "
            << finished - missing << " of " << planned
            << " runs are finished and not measured again (--force starts anew)";
  if (missing > 0) std::cerr << "; tried again because a package was missing: " << missing;
  std::cerr << "\n";
}

void say_counts(const run::RunResult& result) {
  int failed = 0;
  const auto count = [&](record::Status status) {
    const auto found = result.counts.find(status);
    return found == result.counts.end() ? 0 : found->second;
  };
  for (const record::Status status :
       {record::Status::kTimeout, record::Status::kMemory, record::Status::kCrash, record::Status::kError,
        record::Status::kInvalidOutput}) {
    failed += count(status);
  }
  std::cerr << "hullbench: " << count(record::Status::kOk) << " ok, " << failed << " failed, "
            << count(record::Status::kNotInstalled) << " not installed";
  if (count(record::Status::kUnsupported) > 0)
    std::cerr << ", " << count(record::Status::kUnsupported) << " unsupported";
  if (result.accepted > 0) std::cerr << ", " << result.accepted << " not ok as the plan accepts";
  std::cerr << "\n";
}

void say_files(const fs::path& directory, const fs::path& shown, const std::vector<const char*>& files) {
  std::cerr << "hullbench: wrote";
  for (const char* file : files) std::cerr << " " << (shown / file).string();
  if (shown != directory) std::cerr << " (in " << directory.string() << ")";
  std::cerr << "\n";
}

/// One of the call's experiments on its way to its tables.
struct Task {
  const Experiment* experiment = nullptr;
  json header;
  fs::path folder;                               ///< of its run
  std::unique_ptr<run::RunDirectory> directory;  ///< none: an earlier call has finished it
  run::RunResult result;                         ///< of the last pass so far
};

/// Measures the tasks of one call, pass by pass through all of them.
class Measuring {
 public:
  Measuring(const RunCommand& command, const run::MethodCatalog& catalog, std::vector<Task>& tasks)
      : command_(command),
        catalog_(catalog),
        tasks_(tasks),
        cores_(reserve_worker_core()),
        canary_(cores_.worker),
        machine_([this] { return canary_.look(); }),
        progress_(make_progress(make_sections())) {}

  /// Measures them all and writes the report and the tables of each after its last pass. Whether it was not
  /// interrupted.
  bool measure() {
    for (std::size_t place = 0; place < steps_.size(); ++place) {
      const Step& step = steps_[place];
      progress_.enter(place);
      if (!measure(step)) return false;
      const bool pass_ends = place + 1 == steps_.size() || steps_[place + 1].pass != step.pass;
      if (pass_ends && step.pass < passes_) say_pass(step.pass);
    }
    return true;
  }

 private:
  /// One pass of one task.
  struct Step {
    Task* task = nullptr;
    int pass = 1;
  };

  /// "table 1 of 2, pass 1 of 3", with what there are several of.
  std::string where(const Task& task, int pass) const {
    const int passes = task.experiment->plan.passes;
    std::vector<std::string> parts;
    if (tasks_.size() > 1)
      parts.push_back("table " + std::to_string(&task - tasks_.data() + 1) + " of " +
                      std::to_string(tasks_.size()));
    if (passes > 1) parts.push_back("pass " + std::to_string(pass) + " of " + std::to_string(passes));
    return joined(parts, ", ");
  }

  /// Finds the steps too, one for each section.
  std::vector<run::ProgressSection> make_sections() {
    for (const Task& task : tasks_) passes_ = std::max(passes_, task.experiment->plan.passes);
    std::vector<run::ProgressSection> sections;
    for (int pass = 1; pass <= passes_; ++pass) {
      for (Task& task : tasks_) {
        const auto& [plan, filter, runs] = *task.experiment;
        const bool last = pass == plan.passes;
        // The last pass writes the report, whatever is left to measure.
        if (pass > plan.passes || (!last && pass > 1 && !run::has_repetitions(plan, runs, pass))) continue;
        steps_.push_back({&task, pass});
        const bool measures = task.directory && run::has_repetitions(plan, runs, pass);
        const std::string there = where(task, pass);
        sections.push_back({there.empty() ? "" : plan.title + ", " + there,
                            measures ? run::progress_runs(plan, runs, pass) : std::vector<run::ProgressRun>(),
                            plan.name});
      }
    }
    return sections;
  }

  /// False when it was interrupted.
  bool measure(const Step& step) {
    Task& task = *step.task;
    const Experiment& experiment = *task.experiment;
    const std::string there = where(task, step.pass);
    if (!there.empty() && (task.directory || step.pass == 1)) {
      std::cerr << "hullbench: " << there << ": " << experiment.plan.title
                << (task.directory ? "\n" : " is finished already\n");
    }
    if (!task.directory) return true;
    if (step.pass == 1) say_what_goes_on(*task.directory, experiment);
    if (run::has_repetitions(experiment.plan, experiment.runs, step.pass)) {
      const run::RunnerOptions options = {[this](const std::string& name) { return catalog_.find(name); },
                                          cores_.worker,
                                          cores_.all,
                                          {default_data_directory(), command_.recordings},
                                          &machine_,
                                          command_.keep_polygons};
      task.result =
          run::run_plan(experiment.plan, experiment.runs, header_to_write(*task.directory, task.header),
                        options, *task.directory, progress_, step.pass);
      progress_.end();
    }
    if (task.result.interrupted) {
      std::cerr << "hullbench: interrupted; finished runs are kept in " << task.folder.string()
                << ", and the same command goes on from there\n";
      return false;
    }
    if (step.pass == experiment.plan.passes) finish_run(task.folder);
    return true;
  }

  void say_pass(int pass) const {
    const fs::path folder = tasks_.size() > 1 ? tasks_.front().folder.parent_path() : tasks_.front().folder;
    std::cerr << "hullbench: pass " << pass << " of " << passes_ << " is done; 'hullbench tables "
              << folder.string() << "' prints what it measured\n";
  }

  const RunCommand& command_;
  const run::MethodCatalog& catalog_;
  std::vector<Task>& tasks_;
  int passes_ = 1;  ///< of the plan with the most
  std::vector<Step> steps_;
  Cores cores_;
  run::Canary canary_;
  run::MachineWatch machine_;
  run::Progress progress_;
};

ExitCode measure_one(const RunCommand& command, const Experiment& experiment,
                     const run::MethodCatalog& catalog) {
  std::vector<Task> tasks(1);
  Task& task = tasks.front();
  task.experiment = &experiment;
  task.header = describe_run(experiment, command, catalog);
  task.directory = run::open_run_directory(task.header, {command.out, command.force, kResults});
  task.folder = task.directory->path();
  if (!command.out) run::point_latest_to(task.folder, kResults);
  if (!Measuring(command, catalog, tasks).measure()) return exit_code(task.result);
  const json report = report::make_report(task.folder);
  table::print_markdown(report::make_documents({report}), std::cout);
  if (!command.export_gbench.empty()) report::export_gbench(command.export_gbench, {report});
  say_counts(task.result);
  say_files(task.folder, command.out ? task.folder : kResults / "latest",
            {"report.json", "tables.md", "tables", "runs.jsonl", "repetitions.jsonl", "run.json"});
  return exit_code(task.result);
}

/// What the rows of a finished run say.
run::RunResult finished_result(const fs::path& run) {
  run::RunResult result;
  const json report = report::make_report(run);
  const auto accepted = report.at("plan").value("accepted", std::vector<std::string>());
  for (const json& row : report.at("runs"))
    run::count_row(result, row.get<record::RunRecord>().status, accepted);
  return result;
}

ExitCode measure_suite(const RunCommand& command, const std::vector<Experiment>& experiments,
                       const run::MethodCatalog& catalog) {
  std::vector<json> headers;
  headers.reserve(experiments.size());
  for (const Experiment& experiment : experiments)
    headers.push_back(describe_run(experiment, command, catalog));
  const fs::path suite = run::open_suite(headers, {command.out, command.force, kResults});
  if (!command.out) run::point_latest_to(suite, kResults);
  std::vector<Task> tasks(experiments.size());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    Task& task = tasks[i];
    task.experiment = &experiments[i];
    task.header = headers[i];
    task.folder = suite / experiments[i].plan.name;
    const bool finished = !command.force && run::is_finished_run(task.folder, task.header);
    if (finished) task.result = finished_result(task.folder);
    // A method that was not installed may be there now.
    if (!finished || task.result.counts.contains(record::Status::kNotInstalled)) {
      task.directory = run::open_run_directory(task.header, {task.folder, command.force, kResults});
    }
  }
  const bool complete = Measuring(command, catalog, tasks).measure();
  run::RunResult all;
  for (const Task& task : tasks) {
    for (const auto& [status, count] : task.result.counts) all.counts[status] += count;
    all.accepted += task.result.accepted;
    all.interrupted = all.interrupted || task.result.interrupted;
  }
  if (!complete) return exit_code(all);
  const std::vector<json> reports = report::suite_reports(suite);
  const std::vector<table::Document> documents = report::make_documents(reports);
  table::print_markdown(documents, std::cout);
  table::write_tables(suite, documents);
  if (!command.export_gbench.empty()) report::export_gbench(command.export_gbench, reports);
  say_counts(all);
  say_files(suite, command.out ? suite : kResults / "latest", {"tables.md", "tables", "suite.json"});
  return exit_code(all);
}

/// Leaves of `experiment` what belongs to the shard that was asked for, and says so when that is nothing.
void keep_shard(Experiment& experiment, const RunCommand& command) {
  if (!command.shard || experiment.runs.empty()) return;
  experiment.runs = run::runs_of_shard(experiment.plan, experiment.runs, *command.shard);
  if (experiment.runs.empty()) {
    std::cerr << "hullbench: the plan '" << experiment.plan.name << "' has too few cases for shard "
              << to_string(*command.shard) << ": nothing of it is measured here\n";
  }
}

}  // namespace

ExitCode run_plans(const RunCommand& command) {
  const run::MethodCatalog catalog(run::manifest_folders(command.adapters));
  std::vector<Experiment> experiments;
  std::string names;
  bool any_run = false;
  for (const std::string& name : command.plans) {
    Experiment experiment = make_experiment(name, command, catalog);
    names += (names.empty() ? "'" : ", '") + experiment.plan.name + "'";
    const auto same = [&](const Experiment& other) { return other.plan.name == experiment.plan.name; };
    if (std::ranges::any_of(experiments, same)) {
      throw ConfigurationError("the plan '" + experiment.plan.name + "' is named twice; leave one out");
    }
    any_run = any_run || !experiment.runs.empty();
    keep_shard(experiment, command);
    if (!experiment.runs.empty()) experiments.push_back(std::move(experiment));
  }
  if (experiments.empty() && any_run) return kExitNothing;
  if (experiments.empty()) {
    const std::string way_out = command.filter.empty()
                                    ? "the plan's own filter; choose others with --filter"
                                    : "'" + command.filter + "'; --dry-run without --filter prints the names";
    std::cerr << "hullbench: no run of the plan" << (command.plans.size() == 1 ? " " : "s ") << names
              << " has a name that matches " << way_out << "\n";
    return kExitNothing;
  }
  if (command.dry_run) {
    for (const Experiment& experiment : experiments) {
      for (const plan::PlannedRun& run : experiment.runs) std::cout << run.name << "\n";
    }
    return kExitOk;
  }
  check_export_place(command.export_gbench);
  worker::end_strays_of_dead_harnesses();
  run::remove_stale_scratch(kResults);
  return command.plans.size() == 1 ? measure_one(command, experiments.front(), catalog)
                                   : measure_suite(command, experiments, catalog);
}

void add_run(CLI::App& app, Action& action) {
  const auto command = std::make_shared<RunCommand>();
  CLI::App& options = add_command(app, "run", "Measure a plan, or several one after the other",
                                  "hullbench run states --filter '^polylidar/ca/n:2000/' --repetitions 3");
  add_plans(options, command->plans, "");
  options.add_option("--filter", command->filter, "Only runs in whose name this regular expression matches");
  options
      .add_option("--repetitions", command->repetitions,
                  "Timed repetitions of every run, all passes together")
      ->check(CLI::Range(1, 1000000));
  options
      .add_option("--passes", command->passes,
                  "Go through all plans this many times, each time with a share of the repetitions: a slow "
                  "hour of the machine then slows all methods alike")
      ->check(CLI::Range(1, plan::kMaxPasses));
  options.add_option("--out", command->out, "Folder for the results, instead of a new one in results/runs");
  options.add_option("--seed", command->seed, "Seed of the sampled points and of the order of the runs")
      ->check(seed_range());
  options.add_option("--timeout", command->timeout_s, "Time limit of one repetition in seconds")
      ->check(timeout_range());
  options
      .add_option("--mem-limit", command->mem_limit_mib, "Memory limit of a method (address space) in MiB")
      ->check(memory_range());
  options.add_option(
      "--recordings", command->recordings,
      "Measure the recorded floors in this folder instead of the simulated ones, or besides the real points "
      "(datasets/README.md)");
  add_shard(options, command->shard,
            "Only part K of N of the runs, given as K/N, such as 2/8; 'hullbench merge' joins the parts");
  add_adapters(options, command->adapters);
  options
      .add_option("--with", command->with, "Also measure this method, with the parameters in its manifest")
      ->allow_extra_args(false);
  add_export_gbench(options, command->export_gbench);
  options.add_flag("--keep-polygons", command->keep_polygons,
                   "Keep the results in the run's folder, so that 'hullbench rescore' can score them again");
  options.add_flag("--force", command->force, "Start anew instead of continuing an interrupted run");
  options.add_flag("--dry-run", command->dry_run, "Only print the names of the runs");
  set_action(options, action, command, &run_plans);
}

}  // namespace hullbench::cli
