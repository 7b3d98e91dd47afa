#include "benchmarks/run_command.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/environment.hpp"
#include "benchmarks/listing.hpp"
#include "benchmarks/plan.hpp"
#include "benchmarks/report.hpp"
#include "benchmarks/revision.hpp"
#include "benchmarks/run_directory.hpp"
#include "benchmarks/tables.hpp"
#include "datasets/datasets.hpp"
#include "datasets/sha256.hpp"

namespace hullbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kResults = "results";

Plan effective_plan(const RunCommand& command) {
  Plan plan = load_plan(command.plan, HULLBENCH_PLAN_FOLDER);
  plan.repetitions = command.repetitions.value_or(plan.repetitions);
  plan.seed = command.seed.value_or(plan.seed);
  plan.timeout_s = command.timeout_s.value_or(plan.timeout_s);
  plan.mem_limit_mib = command.mem_limit_mib.value_or(plan.mem_limit_mib);
  std::vector<std::string> methods;
  for (const AdapterEntry& entry : adapter_registry()) methods.push_back(entry.name);
  check_plan(plan, methods, datasets());
  return plan;
}

json describe_tool() {
  const Revision built_from = revision();
  return {{"name", "hullbench"},
          {"version", HULLBENCH_VERSION},
          {"commit", built_from.commit ? json(*built_from.commit) : json(nullptr)},
          {"dirty", built_from.dirty ? json(*built_from.dirty) : json(nullptr)},
          {"binary_sha256", sha256_file("/proc/self/exe")}};
}

json describe_run(const Plan& plan, const std::vector<PlannedRun>& runs, const std::string& filter) {
  std::vector<std::string> used;
  used.reserve(runs.size());
  for (const PlannedRun& run : runs) used.push_back(plan.expanded_cases[run.case_index].dataset);
  return {{"schema_version", kSchemaVersion},
          {"created", utc_now()},
          {"resumed", json::array()},
          {"tool", describe_tool()},
          {"environment", collect_environment()},
          {"plan", plan_to_json(plan)},
          {"seed", plan.seed},
          {"filter", filter.empty() ? json(nullptr) : json(filter)},
          {"repetitions", plan.repetitions},
          {"datasets", describe_datasets(used)}};
}

/// The last allowed core is the workers'; the harness keeps off it where it can.
std::optional<int> reserve_worker_core() {
  const std::vector<int> cores = allowed_cores();
  if (cores.empty()) return std::nullopt;
  leave_core(cores.back());
  return cores.back();
}

std::map<std::string, std::string> method_titles() {
  std::map<std::string, std::string> titles;
  for (const AdapterEntry& entry : adapter_registry()) titles[entry.name] = entry.title;
  return titles;
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
  std::cerr << "hullbench: going on with the run in " << directory.path().string() << ": "
            << directory.rows().size() << " of " << planned
            << " runs are finished and not measured again (--force starts anew)\n";
}

void write_text_file(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out << text << std::flush;
  if (!out) throw std::runtime_error("cannot write " + path.string() + "; is the disk full?");
}

void write_report(const fs::path& directory) {
  const json report = make_report(directory);
  std::ostringstream tables;
  print_tables(report, tables);
  std::cout << tables.str() << std::flush;
  write_text_file(directory / "tables.md", tables.str());
  // Last, because it marks the run as finished.
  write_json_file(directory / "report.json", report);
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
  std::cerr << "\n";
}

void say_files(const fs::path& directory, const fs::path& shown) {
  std::cerr << "hullbench: wrote";
  for (const char* file : {"report.json", "tables.md", "runs.jsonl", "repetitions.jsonl", "run.json"}) {
    std::cerr << " " << (shown / file).string();
  }
  if (shown != directory) std::cerr << " (in " << directory.string() << ")";
  std::cerr << "\n";
}

int measure(const RunCommand& command, const Plan& plan, const std::vector<PlannedRun>& runs,
            const WorkerCommand& worker_command) {
  const json header = describe_run(plan, runs, command.filter);
  const auto directory = open_run_directory(header, {command.out, command.force, kResults});
  if (!command.out) point_latest_to(directory->path(), kResults);
  say_what_goes_on(*directory, runs.size());

  const RunnerOptions options = {
      worker_command, {plan.mem_limit_mib, reserve_worker_core()}, method_titles()};
  Progress progress(std::cerr, ::isatty(STDERR_FILENO) == 1, terminal_width(), progress_runs(plan, runs));
  const RunResult result =
      run_plan(plan, runs, header_to_write(*directory, header), options, *directory, progress);
  progress.end();
  if (result.interrupted) {
    std::cerr << "hullbench: interrupted; finished runs are kept in " << directory->path().string()
              << ", and the same command goes on from there\n";
    return exit_code(result);
  }
  write_report(directory->path());
  say_counts(result);
  say_files(directory->path(), command.out ? directory->path() : kResults / "latest");
  return exit_code(result);
}

}  // namespace

int run_command(const RunCommand& command, const WorkerCommand& worker_command) {
  const Plan plan = effective_plan(command);
  const std::vector<PlannedRun> runs = planned_runs(plan, command.filter);
  if (runs.empty()) {
    std::cerr << "hullbench: no run of the plan '" << plan.name << "' has a name that matches '"
              << command.filter << "'; --dry-run without --filter prints the names\n";
    return 6;
  }
  if (command.dry_run) {
    for (const PlannedRun& run : runs) std::cout << run.name << "\n";
    return 0;
  }
  return measure(command, plan, runs, worker_command);
}

}  // namespace hullbench
