// hullbench: the command line.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/cli/adapter_command.hpp"
#include "benchmarks/cli/compare_command.hpp"
#include "benchmarks/cli/finish_run.hpp"
#include "benchmarks/cli/league_command.hpp"
#include "benchmarks/cli/listing.hpp"
#include "benchmarks/cli/merge_command.hpp"
#include "benchmarks/cli/run_command.hpp"
#include "benchmarks/cli/tune_command.hpp"
#include "benchmarks/hull/hull_command.hpp"
#include "benchmarks/league/league_report.hpp"
#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/record/pictures.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/record/validate.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/report/gbench_export.hpp"
#include "benchmarks/report/readme.hpp"
#include "benchmarks/report/report.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "benchmarks/run/run_directory.hpp"
#include "benchmarks/worker/worker.hpp"

namespace {

using namespace hullbench;
using namespace hullbench::cli;
namespace fs = std::filesystem;

constexpr int kOk = 0;
constexpr int kHarnessError = 1;
constexpr int kUsage = 2;
constexpr int kInterrupted = 130;

constexpr const char* kFooter =
    "Exit codes: 0 everything asked for was done; 1 an error of the harness, or `validate` or `readme "
    "--check` found "
    "faults;\n"
    "2 usage or configuration; 4 some methods failed (their rows say how), or runs of a merge are missing; 6 "
    "nothing was measured, or nothing to compare; 130 "
    "interrupted.\n"
    "HULLBENCH_POSTGIS_DSN names a PostGIS server to use instead of a private one; HULLBENCH_POSTGRES_BIN "
    "the folder with\n"
    "the programs that a private server is made of; of postgis_legacy: HULLBENCH_POSTGIS_LEGACY_DSN, "
    "HULLBENCH_POSTGRES_LEGACY_BIN.";

constexpr const char* kAdaptersHelp =
    "A folder with manifests of methods (adapters/process/PROTOCOL.md) besides adapters/manifests and the "
    "user's ~/.config/hullbench/adapters";

constexpr const char* kExportGbenchHelp = "Also write the times into this file, as Google Benchmark's JSON";

/// Memory for a worker that only says who it is.
constexpr std::int64_t kListMemoryMib = 4096;

struct Arguments {
  bool json = false;
  std::vector<fs::path> list_adapters;
  bool metrics_json = false;
  bool metrics_markdown = false;
  RunCommand run;
  TuneCommand tune;
  LeagueCommand league;
  MergeCommand merge;
  std::string tables_path = "results/latest";
  bool tables_write = false;
  std::string tables_export_gbench;
  std::string report_path = "results/latest";
  fs::path report_out;
  CompareCommand compare;
  NewAdapterCommand new_adapter;
  TestAdapterCommand test_adapter;
  hull::HullCommand hull;
  std::string readme_run;
  std::string readme_path;
  bool readme_check = false;
  std::string validate_path;
  std::string worker_method;
};

int list(bool as_json, const std::vector<fs::path>& adapters) {
  const run::MethodCatalog catalog(run::manifest_folders(adapters));
  const nlohmann::json listing = make_listing(catalog.methods(), {kListMemoryMib, std::nullopt});
  if (as_json) {
    std::cout << listing.dump(2) << "\n";
  } else {
    print_listing(listing, std::cout);
  }
  return kOk;
}

int metrics(bool as_json, bool as_markdown) {
  if (as_json) {
    std::cout << metrics::metric_table_to_json().dump(2) << "\n";
  } else if (as_markdown) {
    std::cout << metrics::metric_table_to_markdown();
  } else {
    metrics::print_metric_table(std::cout);
  }
  return kOk;
}

void check_run_folder(const std::string& path) {
  if (!fs::is_directory(path)) {
    throw ConfigurationError("there is no run in " + path +
                             "; give a run's folder, or measure one with 'hullbench run'");
  }
}

/// The reports in `path`, the folder of a run or of a suite.
std::vector<nlohmann::json> reports_in(const std::string& path) {
  check_run_folder(path);
  return record::is_suite(path) ? report::suite_reports(path) : std::vector{report::make_report(path)};
}

int tables(const std::string& path, bool write, const std::string& gbench_file) {
  check_export_place(gbench_file);
  const std::vector<nlohmann::json> reports = reports_in(path);
  const std::vector<table::Document> documents = report::make_documents(reports);
  table::print_markdown(documents, std::cout);
  if (write) {
    table::write_tables(path, documents);
    league::write_league_tables(path);
  }
  if (!gbench_file.empty()) report::export_gbench(gbench_file, reports);
  return kOk;
}

/// Writes what figures and the HTML report are made from into `out`: report.json and the pictures of the run
/// in `path`, or of each run of a suite in a folder of its name.
int report(const std::string& path, const fs::path& out) {
  check_run_folder(path);
  const bool suite = record::is_suite(path);
  for (const fs::path& run : suite ? record::suite_runs(path) : std::vector<fs::path>{path}) {
    const fs::path folder = suite ? out / run.filename() : out;
    make_writable_folder(folder);
    if (fs::equivalent(folder, run))
      throw ConfigurationError("the folder " + folder.string() +
                               " is the run itself; choose another one with --out");
    report::write_report_file(folder / "report.json", report_to_share(run));
    fs::remove(folder / record::kPicturesFile);
    record::merge_pictures({run}, folder);
    std::cout << "wrote " << (folder / "report.json").string() << "\n";
  }
  return kOk;
}

int readme(const std::string& run, const std::string& path, bool check) {
  std::ifstream in(path, std::ios::binary);
  if (!in.is_open() || fs::is_directory(path)) throw ConfigurationError("there is no file " + path);
  const std::string before(std::istreambuf_iterator<char>(in), {});
  // Named by what it is, not by a link that will point to another one some day.
  const fs::path folder =
      fs::is_symlink(run) ? fs::path(run).parent_path() / fs::read_symlink(run) : fs::path(run);
  std::string results = report::readme_results(reports_in(run), folder.string());
  if (const nlohmann::json league = league::load_league(folder); !league.is_null())
    results += league::league_results(league, folder.string());
  const std::string after = report::with_results(before, results);
  if (before == after) {
    std::cout << path << " agrees with " << run << "\n";
    return kOk;
  }
  if (check) {
    std::cerr << "hullbench: the results in " << path << " are not those of " << run << "; 'hullbench readme "
              << run << " " << path << "' writes them anew\n";
    return kHarnessError;
  }
  write_text_file(path, after);
  std::cout << "wrote the results of " << run << " into " << path << "\n";
  return kOk;
}

int validate(const std::string& path) {
  if (!fs::is_regular_file(path)) throw ConfigurationError("there is no file " + path + " to validate");
  const std::vector<std::string> faults = record::validate_file(path);
  for (const std::string& fault : faults) std::cerr << "hullbench: " << path << ": " << fault << "\n";
  if (faults.empty()) std::cout << path << " is valid\n";
  return faults.empty() ? kOk : kHarnessError;
}

int worker(const std::string& method) {
  const auto& registry = adapter_registry();
  const auto entry = std::find_if(registry.begin(), registry.end(),
                                  [&](const AdapterEntry& candidate) { return candidate.name == method; });
  if (entry == registry.end()) {
    throw ConfigurationError("there is no method '" + method + "'; 'hullbench list' shows them");
  }
  return worker::run_worker(*entry);
}

void add_run(CLI::App& app, RunCommand& run) {
  CLI::App* command = app.add_subcommand("run", "Measure a plan, or several one after the other");
  command->add_option("PLAN", run.plans, "A plan's name (benchmarks/plans) or the path of its JSON file")
      ->required();
  command->add_option("--filter", run.filter, "Only runs whose name has a match of this regular expression");
  command->add_option("--repetitions", run.repetitions, "Timed repetitions of every run, over all passes")
      ->check(CLI::Range(1, 1000000));
  command
      ->add_option(
          "--passes", run.passes,
          "How often all plans are gone through, each time with a share of the repetitions, so that a "
          "slow hour of the machine is not one method's")
      ->check(CLI::Range(1, plan::kMaxPasses));
  command->add_option("--out", run.out, "Folder for the results instead of one in results/runs");
  command->add_option("--seed", run.seed, "Seed of the point samples and of the order of runs")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--timeout", run.timeout_s, "Seconds that one repetition may take")
      ->check(CLI::Range(0.001, 1e6));
  command->add_option("--mem-limit", run.mem_limit_mib, "MiB of address space for a method")
      ->check(CLI::Range(std::int64_t{64}, std::int64_t{1} << 30));
  command->add_option(
      "--recordings", run.recordings,
      "Folder of recorded floors that take the place of the simulated ones (datasets/rgbd/recordings.hpp)");
  command->add_option_function<std::string>(
      "--shard", [&run](const std::string& text) { run.shard = run::parse_shard(text); },
      "Only part K of N of the runs, given as K/N; 'hullbench merge' puts the parts together");
  command->add_option("--adapters", run.adapters, kAdaptersHelp)->allow_extra_args(false);
  command
      ->add_option("--with", run.with,
                   "Also measure this method of a manifest, with the parameters that the manifest gives")
      ->allow_extra_args(false);
  command->add_option("--export-gbench", run.export_gbench, kExportGbenchHelp);
  command->add_flag("--force", run.force, "Start anew instead of going on with an interrupted run");
  command->add_flag("--dry-run", run.dry_run, "Print the names of the runs and do nothing");
}

void add_tune(CLI::App& app, TuneCommand& tune) {
  CLI::App* command = app.add_subcommand(
      "tune",
      "Search every method's parameter and say what each way of choosing it costs (nothing is timed)");
  command
      ->add_option("PLAN", tune.plans,
                   "A plan's name (benchmarks/plans) or the path of its JSON file: its cases")
      ->required();
  command->add_option(
      "--methods", tune.methods,
      "Methods whose name is a match of this regular expression, instead of all built-in ones");
  command->add_option("--out", tune.out, "Folder for the results instead of one in results/tune");
  command->add_option("--seed", tune.seed, "Seed of the split into training and test shapes")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      ->add_option("--timeout", tune.timeout_s, "Seconds that one evaluation may take, instead of the plan's")
      ->check(CLI::Range(0.001, 1e6));
  command->add_option("--jobs", tune.jobs, "Evaluations at a time, instead of one a processor core")
      ->check(CLI::Range(1, 1024));
  command->add_option_function<std::string>(
      "--shard", [&tune](const std::string& text) { tune.shard = run::parse_shard(text); },
      "Only part K of N of the cases, given as K/N; when all are done, the same command without it, over the "
      "folder with their files sweep-K-of-N.jsonl, puts them together");
  command->add_option("--adapters", tune.adapters, kAdaptersHelp)->allow_extra_args(false);
}

void add_league(CLI::App& app, LeagueCommand& league) {
  CLI::App* command = app.add_subcommand(
      "league", "Say who is the most accurate over the cases of some runs, protocol by protocol");
  command->add_option("RUN", league.runs, "Folders of runs, or of suites")->required();
  command->add_option("--out", league.out, "File for it as JSON (results/league.schema.json)");
  command
      ->add_option("--seed", league.split_seed, "Seed of the split into training and test shapes, as of tune")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_flag("--all-cases", league.all_cases, "Of training shapes too");
}

void add_merge(CLI::App& app, MergeCommand& merge) {
  CLI::App* command = app.add_subcommand("merge", "Put runs of the same plan, such as its shards, together");
  command->add_option("RUN", merge.sources, "Folders of runs, or of suites")->required();
  command->add_option("--out", merge.out, "Folder for the merged run, new or empty")->required();
  command->add_flag("--force", merge.force, "Write to the folder even when something is in it");
}

void add_compare(CLI::App& app, CompareCommand& compare) {
  CLI::App* command = app.add_subcommand("compare", "Say what differs between two runs");
  command
      ->add_option("A", compare.a,
                   "A run's or suite's folder, a report.json or a runs.jsonl: the earlier one")
      ->required();
  command->add_option("B", compare.b, "Likewise: the one that is held against it")->required();
  command->add_option("--format", compare.format, "How to print it")
      ->check(CLI::IsMember({"markdown", "csv", "latex", "json"}))
      ->capture_default_str();
}

void add_adapter(CLI::App& app, Arguments& arguments) {
  CLI::App* command = app.add_subcommand("adapter", "Add a method, or try one")->require_subcommand(1);
  CLI::App* make = command->add_subcommand("new", "Write a method that works, to be filled in");
  make->add_option("NAME", arguments.new_adapter.name, "The method's name: small letters, digits and _")
      ->required();
  make->add_option("--lang", arguments.new_adapter.language, "Its language")
      ->check(CLI::IsMember({"cpp", "python", "js"}))
      ->required();
  make->add_option(
      "--out", arguments.new_adapter.out,
      "Folder for its files instead of this project's adapters (cpp) or the user's configuration "
      "folder");
  CLI::App* test = command->add_subcommand("test", "Say which points of the contract a method keeps");
  test->add_option("NAME", arguments.test_adapter.name, "The method's name")->required();
  test->add_option("--adapters", arguments.test_adapter.adapters, kAdaptersHelp)->allow_extra_args(false);
  test->add_option("--timeout", arguments.test_adapter.timeout_s, "Seconds that one run may take")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  test->add_option("--mem-limit", arguments.test_adapter.mem_limit_mib, "MiB of address space for the method")
      ->check(CLI::Range(std::int64_t{64}, std::int64_t{1} << 30))
      ->capture_default_str();
}

int adapter(const CLI::App& app, const Arguments& arguments) {
  if (app.got_subcommand("new")) return new_adapter_command(arguments.new_adapter);
  return test_adapter_command(arguments.test_adapter);
}

CLI::Validator zero_or_more() {
  return {[](const std::string& text) {
            double value = 0;
            const bool fits = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0;
            return fits ? std::string() : "'" + text + "' is not a number of 0 or more";
          },
          ">=0"};
}

void add_hull(CLI::App& app, hull::HullCommand& hull) {
  CLI::App* command = app.add_subcommand("hull", "Turn a file of points into polygons");
  command->footer(
      "Without --alpha, --max-edge-length and --max-perimeter the perimeter's limit is chosen from the "
      "points: "
      "where the\n"
      "area of the triangles within it depends least on it. It is printed to standard error. Holes of one\n"
      "triangle are filled then, as chance leaves them.\n"
      "The input's format is known by the ending of its name (.csv .tsv .txt .xyz .pts .asc .geojson .json "
      ".wkt\n"
      ".npy .ply), else by its content. Lengths are in the unit of the points.\n"
      "Exit codes: 0 done (the shape may be empty); 1 the result cannot be written; 2 usage, or an input "
      "that\n"
      "cannot be read; 130 interrupted.");
  command->add_option("FILE", hull.input, "The points; - for standard input")->required();
  command->add_option("--alpha", hull.alpha, "Largest circumradius of a triangle of the shape")
      ->check(zero_or_more());
  command->add_option("--max-edge-length", hull.max_edge_length, "Longest edge of a triangle of the shape")
      ->check(zero_or_more());
  command->add_option("--max-perimeter", hull.max_perimeter, "Largest perimeter of a triangle of the shape")
      ->check(zero_or_more());
  command->add_option("--input", hull.input_format, "The input's format")
      ->check(CLI::IsMember({"auto", "csv", "xyz", "geojson", "wkt", "npy", "ply"}))
      ->capture_default_str();
  command->add_option("--columns", hull.columns,
                      "Of text, the columns of x and y: names, as in lon,lat, or numbers from 1, as in 2,3");
  command->add_option("--format", hull.format, "The output's format")
      ->check(CLI::IsMember({"geojson", "wkt", "wkb", "svg"}))
      ->capture_default_str();
  command->add_option("--min-area", hull.min_area, "Fill smaller holes, then drop smaller polygons")
      ->check(zero_or_more());
  command->add_option("--min-triangles", hull.min_triangles, "Drop polygons of fewer Delaunay triangles");
  command
      ->add_option("--simplify", hull.simplify, "Leave out vertices that are this close to the new outline")
      ->check(zero_or_more());
  command->add_option("--threads", hull.threads, "Threads to compute with, instead of one a processor")
      ->check(CLI::Range(1U, 1024U));
  command->add_option("--out", hull.out, "File for the result instead of standard output");
}

void add_commands(CLI::App& app, Arguments& arguments) {
  app.require_subcommand(1);
  app.set_version_flag("--version", "hullbench " HULLBENCH_VERSION);
  app.footer(kFooter);
  CLI::App* list = app.add_subcommand("list", "Show methods and data sets");
  list->add_flag("--json", arguments.json, "As JSON");
  list->add_option("--adapters", arguments.list_adapters, kAdaptersHelp)->allow_extra_args(false);
  CLI::App* metrics = app.add_subcommand("metrics", "Show what is scored, and how each metric is defined");
  CLI::Option* as_json = metrics->add_flag("--json", arguments.metrics_json, "As JSON");
  metrics->add_flag("--markdown", arguments.metrics_markdown, "As benchmarks/metrics/METRICS.md has it")
      ->excludes(as_json);
  add_run(app, arguments.run);
  add_tune(app, arguments.tune);
  add_league(app, arguments.league);
  add_merge(app, arguments.merge);
  CLI::App* tables = app.add_subcommand("tables", "Print the tables of a run");
  tables->add_option("RUN", arguments.tables_path, "The run's folder")->capture_default_str();
  tables->add_flag("--write", arguments.tables_write, "Write its tables.md and tables/ anew too");
  tables->add_option("--export-gbench", arguments.tables_export_gbench, kExportGbenchHelp);
  CLI::App* report = app.add_subcommand("report", "Write a run's report.json and pictures, to be drawn from");
  report->add_option("RUN", arguments.report_path, "The folder of a run, or of a suite")
      ->capture_default_str();
  report->add_option("--out", arguments.report_out, "Folder for them")->required();
  add_compare(app, arguments.compare);
  add_adapter(app, arguments);
  add_hull(app, arguments.hull);
  CLI::App* readme = app.add_subcommand("readme", "Write a run's results into a README, between its marks");
  readme->add_option("RUN", arguments.readme_run, "The run's folder")->required();
  readme->add_option("FILE", arguments.readme_path, "The README")->required();
  readme->add_flag("--check", arguments.readme_check, "Only say whether it has them; exit code 1 when not");
  app.add_subcommand("validate",
                     "Check a record of a run, a search or a league (.json, .jsonl) against its schema")
      ->add_option("FILE", arguments.validate_path, "The file")
      ->required();
  app.add_subcommand("worker", "Run one method for another process (see benchmarks/worker/protocol.hpp)")
      ->add_option("--method", arguments.worker_method, "The method's name")
      ->required();
}

int dispatch(const CLI::App& app, const Arguments& arguments) {
  if (app.got_subcommand("worker")) return worker(arguments.worker_method);
  catch_interruptions();
  if (app.got_subcommand("adapter")) return adapter(*app.get_subcommand("adapter"), arguments);
  if (app.got_subcommand("list")) return list(arguments.json, arguments.list_adapters);
  if (app.got_subcommand("metrics")) return metrics(arguments.metrics_json, arguments.metrics_markdown);
  if (app.got_subcommand("run")) return run_command(arguments.run);
  if (app.got_subcommand("league")) return league_command(arguments.league);
  if (app.got_subcommand("tune")) return tune_command(arguments.tune);
  if (app.got_subcommand("merge")) return merge_command(arguments.merge);
  if (app.got_subcommand("tables"))
    return tables(arguments.tables_path, arguments.tables_write, arguments.tables_export_gbench);
  if (app.got_subcommand("report")) return report(arguments.report_path, arguments.report_out);
  if (app.got_subcommand("compare")) return compare_command(arguments.compare);
  if (app.got_subcommand("hull")) return hull::hull_command(arguments.hull);
  if (app.got_subcommand("readme")) {
    return readme(arguments.readme_run, arguments.readme_path, arguments.readme_check);
  }
  return validate(arguments.validate_path);
}

int complain(const std::string& what, int code) {
  std::cerr << "hullbench: " << what << "\n";
  return code;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Benchmark of concave-hull methods: the same points for all, every result scored.",
               "hullbench");
  Arguments arguments;
  add_commands(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return complain(
        std::string(error.what()) + "; 'hullbench --help' and 'hullbench COMMAND --help' show what there is",
        kUsage);
  }
  return dispatch(app, arguments);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const ConfigurationError& error) {
    return complain(error.what(), kUsage);
  } catch (const Interrupted&) {
    return complain("interrupted", kInterrupted);
  } catch (const std::exception& error) {
    return complain(error.what(), kHarnessError);
  }
}
