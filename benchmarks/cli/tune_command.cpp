// `hullbench tune`: searches every method's parameter and says what each way of choosing it costs.
#include <algorithm>
#include <iostream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/terminal.hpp"
#include "benchmarks/cli/tool_description.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "benchmarks/run/progress.hpp"
#include "benchmarks/run/row_store.hpp"
#include "benchmarks/tune/tuned_plan.hpp"
#include "benchmarks/tune/tuner.hpp"
#include "benchmarks/tune/tuning_report.hpp"
#include "benchmarks/worker/stray_processes.hpp"
#include "benchmarks/worker/worker_process.hpp"
#include "datasets/data_folder.hpp"
#include "datasets/datasets.hpp"

namespace hullbench::cli {
namespace {

constexpr const char* kSweepFile = "sweep.jsonl";
constexpr const char* kSummaryFile = "tune.json";
constexpr const char* kTuningTablesFile = "tuning.md";

struct TuneCommand {
  std::vector<std::string> plans;  ///< one or more: their cases
  std::string methods;             ///< regular expression; empty: all built-in methods
  std::optional<fs::path> out;
  std::optional<double> timeout_s;  ///< for one evaluation, instead of the plan's
  std::optional<int> jobs;          ///< none: one a core
  std::optional<run::Shard> shard;  ///< none: all methods
  std::vector<fs::path> adapters;   ///< more folders with manifests
};

std::vector<plan::Plan> load_plans(const TuneCommand& command, const run::MethodCatalog& catalog) {
  std::vector<plan::Plan> plans;
  for (const std::string& name : command.plans) {
    plan::Plan plan = plan::load_plan(name, data_folder() / "benchmarks" / "plans");
    const auto same = [&](const plan::Plan& other) { return other.name == plan.name; };
    if (std::ranges::any_of(plans, same))
      throw ConfigurationError("the plan '" + plan.name + "' is named twice; leave one out");
    plan::check_plan(plan, catalog.names(), datasets());
    plans.push_back(std::move(plan));
  }
  return plans;
}

/// The methods that `pattern` chooses, in the catalogue's order.
std::vector<std::string> chosen_methods(const std::string& pattern, const run::MethodCatalog& catalog) {
  std::regex expression;
  try {
    expression = std::regex(pattern, std::regex::ECMAScript);
  } catch (const std::regex_error&) {
    throw ConfigurationError("'" + pattern +
                             "' is not a regular expression; mend it or quote its characters");
  }
  std::vector<std::string> chosen;
  for (const worker::Method& method : catalog.methods()) {
    // A method of a manifest says who it is before it starts; a built-in one does not.
    const bool wanted = pattern.empty() ? !method.info : std::regex_match(method.name, expression);
    if (wanted) chosen.push_back(method.name);
  }
  if (chosen.empty()) {
    throw ConfigurationError("no method has a name that matches '" + pattern +
                             "'; 'hullbench list' shows the names");
  }
  return chosen;
}

/// For the search alone: a plan with the chosen parameters keeps the limits of its plan.
void limit_time(std::vector<tune::TuningCase>& cases, double timeout_s) {
  for (tune::TuningCase& one : cases) {
    one.timeout_s = timeout_s;
    for (plan::PlanMethod& entry : one.entries) entry.timeout_s.reset();
  }
}

/// Those of `methods` that are in the shard: every count-th.
std::vector<std::string> part_of(const std::vector<std::string>& methods,
                                 const std::optional<run::Shard>& shard) {
  if (!shard) return methods;
  std::vector<std::string> kept;
  for (std::size_t i = shard->number - 1; i < methods.size(); i += shard->count) kept.push_back(methods[i]);
  return kept;
}

fs::path folder_of(const TuneCommand& command, const std::vector<plan::Plan>& plans) {
  if (command.out) return *command.out;
  return fs::path("results") / "tune" / joined(plans, "+", &plan::Plan::name);
}

/// "sweep.jsonl", "sweep-2-of-3.jsonl"
std::string sweep_file(const std::optional<run::Shard>& shard) {
  if (!shard) return kSweepFile;
  return "sweep-" + std::to_string(shard->number) + "-of-" + std::to_string(shard->count) + ".jsonl";
}

/// Reads the evaluations of other shards, or of the whole, in the folder.
void read_other_sweeps(const fs::path& folder, const std::string& own, run::RowStore& store) {
  std::set<fs::path> others;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name != own && name.starts_with("sweep") && entry.path().extension() == ".jsonl")
      others.insert(entry.path());
  }
  for (const fs::path& file : others) store.read_rows(file);
}

/// Where `auto` has numbers beside its rule: the parameter with the rule, which is then searched beside the
/// same numbers. Else none.
std::optional<tune::Searched> searched_of(const plan::PlanMethod& entry) {
  if (entry.protocol != "auto") return std::nullopt;
  tune::Searched searched;
  for (const auto& [name, choice] : entry.parameters) {
    const auto* number = std::get_if<double>(&choice);
    const bool is_of_holes = name.find("hole") != std::string::npos;
    if (number != nullptr && !is_of_holes) searched.others[name] = *number;
    if (std::holds_alternative<plan::RuleChoice>(choice)) searched.parameter = name;
  }
  // Without such numbers the usual axis is no worse: of a perimeter and a circumradius it is the perimeter.
  const bool is_usual = searched.parameter.empty() || searched.others.empty();
  return is_usual ? std::nullopt : std::optional(searched);
}

tune::TunerOptions tuner_options(const TuneCommand& command, const run::MethodCatalog& catalog,
                                 const std::vector<plan::Plan>& plans, const json& tool) {
  tune::TunerOptions options;
  options.find_method = [&catalog](const std::string& name) { return catalog.find(name); };
  options.methods = part_of(chosen_methods(command.methods, catalog), command.shard);
  for (const std::string& method : options.methods) {
    const auto manifest = catalog.hashes().find(method);
    options.programs[method] =
        manifest == catalog.hashes().end() ? tool.at("binary_sha256").get<std::string>() : manifest->second;
  }
  const auto cores = static_cast<int>(allowed_cores().size());
  options.jobs = command.jobs.value_or(std::max(cores, 1));
  options.mem_limit_mib = 0;
  for (const plan::Plan& plan : plans) {
    options.mem_limit_mib = std::max(options.mem_limit_mib, plan.mem_limit_mib);
    for (const plan::PlanMethod& entry : plan.methods) {
      if (const auto searched = searched_of(entry)) options.searched.emplace(entry.method, *searched);
      options.mem_limit_mib = std::max(options.mem_limit_mib, entry.mem_limit_mib.value_or(0));
      if (!entry.search) options.not_searched.insert(entry.method);
    }
  }
  return options;
}

/// A method that has nothing but failures on a case has failed.
ExitCode exit_code(const tune::Tuning& tuning) {
  bool any_result = false;
  bool any_failure = false;
  for (const tune::MethodTuning& method : tuning.methods) {
    for (const tune::MethodOnCase& found : method.cases) {
      const record::RunRecord* best = tune::best_evaluation(found);
      if (best == nullptr) continue;
      any_result = any_result || best->metrics.contains("l2");
      any_failure =
          any_failure || (!best->metrics.contains("l2") && best->status != record::Status::kUnsupported &&
                          best->status != record::Status::kNotInstalled);
    }
  }
  if (any_failure) return kExitFailures;
  return any_result ? kExitOk : kExitNothing;
}

void write_results(const fs::path& folder, const tune::Tuning& tuning, const std::vector<plan::Plan>& plans,
                   const json& tool, const run::RowStore& store) {
  std::string sweep;
  for (const json& line : tune::sweep_lines(tuning, store.rows())) sweep += dump_text(line, -1) + "\n";
  write_text_file(folder / kSweepFile, sweep);
  std::vector<std::string> names;
  for (const plan::Plan& plan : plans) {
    names.push_back(plan.name);
    const plan::Plan chosen = tune::tuned_plan(plan, tuning);
    if (!chosen.methods.empty() && !chosen.expanded_cases.empty())
      write_text_file(folder / (chosen.name + ".json"), plan::plan_to_json(chosen).dump(1) + "\n");
  }
  const json summary = tune::tuning_to_json(tuning, names, tool);
  write_text_file(folder / kSummaryFile, dump_text(summary, 1) + "\n");
  std::ostringstream tables;
  table::print_markdown(tune::tuning_document(summary), tables);
  write_text_file(folder / kTuningTablesFile, tables.str());
  std::cout << tables.str();
}

/// The same command goes on with what is there. The folder (--out, else results/tune/PLAN) gets
///
///   sweep.jsonl       every evaluation (results/sweep.schema.json), as they happen
///   tune.json         the summary (results/tune.schema.json)
///   tuning.md         its tables, which go to standard output too
///   PLAN-tuned.json   each plan with the chosen parameters (tuned_plan.hpp)
///
/// A shard only leaves its evaluations there, in sweep-K-of-N.jsonl. Throws ConfigurationError before
/// anything is evaluated.
ExitCode tune_plans(const TuneCommand& command) {
  const run::MethodCatalog catalog(run::manifest_folders(command.adapters));
  const std::vector<plan::Plan> plans = load_plans(command, catalog);
  const json tool = describe_tool();
  const tune::TunerOptions options = tuner_options(command, catalog, plans, tool);
  std::vector<tune::TuningCase> cases = tune::tuning_cases(plans);
  if (command.timeout_s) limit_time(cases, *command.timeout_s);
  if (cases.empty() || options.methods.empty()) {
    std::cerr << "hullbench: "
              << (cases.empty() ? "no case is on a side of the split (benchmarks/tune/split.cpp)"
                                : "there are too few methods for shard " + to_string(*command.shard))
              << ": nothing is evaluated here\n";
    return kExitNothing;
  }
  const fs::path folder = folder_of(command, plans);
  make_writable_folder(folder);
  const std::string file = sweep_file(command.shard);
  run::RowStore store({folder, file, "scratch-" + file, &record::RunRecord::id},
                      run::lock_or_throw(folder / file));
  read_other_sweeps(folder, file, store);
  worker::end_strays_of_dead_harnesses();
  run::Progress progress = make_progress({{"tune", tune::tuning_progress(cases, options.methods)}});
  std::cerr << "hullbench: " << options.methods.size() << " methods on " << cases.size() << " cases, into "
            << folder.string() << "; " << store.rows().size() << " evaluations are there already\n";
  const tune::Tuning tuning = tune::run_tuning(std::move(cases), options, store, progress);
  progress.end();
  if (tuning.interrupted) {
    std::cerr << "hullbench: interrupted; evaluations are kept in " << (folder / file).string()
              << ", and the same command goes on from there\n";
    return kExitInterrupted;
  }
  if (!command.shard) write_results(folder, tuning, plans, tool, store);
  std::cerr << "hullbench: wrote " << (folder / (command.shard ? file : kSummaryFile)).string() << "\n";
  return exit_code(tuning);
}

}  // namespace

void add_tune(CLI::App& app, Action& action) {
  const auto command = std::make_shared<TuneCommand>();
  CLI::App& options = add_command(
      app, "tune",
      "Find each method's best parameter and compare the errors of all protocols with it (nothing is timed)",
      "hullbench tune world_shapes --methods 'polylidar|geos_concave_hull'");
  add_plans(options, command->plans, ", whose cases are searched");
  options.add_option(
      "--methods", command->methods,
      "Only methods whose whole name matches this regular expression, instead of all built-in ones");
  options.add_option("--out", command->out, "Folder for the results, instead of results/tune/PLAN");
  options
      .add_option("--timeout", command->timeout_s,
                  "Time limit of one evaluation in seconds, instead of the plan's; the plans that are "
                  "written keep theirs")
      ->check(timeout_range());
  options
      .add_option("--jobs", command->jobs,
                  "Evaluations that run at the same time, instead of one for each processor core")
      ->check(CLI::Range(1, 1024));
  add_shard(
      options, command->shard,
      "Only part K of N of the methods, given as K/N. To join the parts, put all files sweep-K-of-N.jsonl "
      "into one folder and give the same command with it as --out, without --shard");
  add_adapters(options, command->adapters);
  set_action(options, action, command, &tune_plans);
}

}  // namespace hullbench::cli
