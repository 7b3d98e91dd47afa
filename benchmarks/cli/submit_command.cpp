// `hullbench submit pack` and `hullbench submit check`: methods that are handed in.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/scratch_folder.hpp"
#include "benchmarks/base/utc_now.hpp"
#include "benchmarks/cli/options.hpp"
#include "benchmarks/cli/run_command.hpp"
#include "benchmarks/cli/run_folder.hpp"
#include "benchmarks/cli/tool_description.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/report/documents.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "benchmarks/run/submission.hpp"
#include "datasets/data_folder.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::cli {
namespace {

struct PackCommand {
  std::string name;
  std::vector<fs::path> adapters;  ///< more folders with manifests
  fs::path out;                    ///< new or empty
  double timeout_s = 60;           ///< for one run of the contract
};

struct CheckCommand {
  fs::path folder;
};

plan::Plan submission_plan() {
  return plan::load_plan(run::kSubmissionPlan, data_folder() / "benchmarks" / "plans");
}

/// The methods that come with this program, not the user's.
std::vector<std::string> own_methods() {
  return run::MethodCatalog({data_folder() / "adapters" / "manifests"}).names();
}

json contract_of(const worker::Method& method, const PackCommand& command) {
  const ScratchFolder scratch("hullbench-contract");
  const auto timeout = std::chrono::milliseconds(static_cast<std::int64_t>(command.timeout_s * 1000));
  json contract = json::array();
  const auto note = [&](const run::Verdict& verdict) {
    std::cerr << "hullbench: contract: " << verdict.name << ": " << (verdict.kept ? "kept" : verdict.words)
              << "\n";
    contract.push_back({{"name", verdict.name},
                        {"kept", verdict.kept},
                        {"status", to_string(verdict.status)},
                        {"words", verdict.words}});
  };
  run::test_contract(method, {{submission_plan().mem_limit_mib, std::nullopt}, timeout}, scratch.path(),
                     note);
  return contract;
}

/// Copies what the method is made of: its manifest and the programs beside it, without hidden files and other
/// methods.
void copy_method(const std::string& name, const PackCommand& command) {
  for (const run::Manifest& manifest : run::load_manifests(run::manifest_folders(command.adapters))) {
    if (manifest.method.name != name) continue;
    const fs::path target = command.out / run::kSubmissionMethod;
    fs::create_directories(target);
    for (const auto& entry : fs::directory_iterator(manifest.file.parent_path())) {
      const std::string file = entry.path().filename().string();
      const bool is_other_manifest =
          run::is_manifest(entry.path()) && file != manifest.file.filename().string();
      if (!entry.is_regular_file() || file.starts_with(".") || is_other_manifest ||
          entry.file_size() > run::kLargestProgram)
        continue;
      fs::copy_file(entry.path(), target / file, fs::copy_options::overwrite_existing);
    }
  }
}

/// Says in the run in `folder` which method's rows are handed in.
void mark_as_open(const fs::path& folder, const std::string& name) {
  json header = record::load_run(folder);
  header.erase("runs");
  if (header.at("notes").empty()) header.erase("notes");
  for (json& method : header.at("methods")) {
    if (method.at("name") != json(name)) continue;
    method["division"] = run::kOpenDivision;
    method["title"] = method.at("title").get<std::string>() + run::kHandedIn;
  }
  write_json_file(folder / record::kHeaderFile, header);
  finish_run(folder);
}

ExitCode pack(const PackCommand& command) {
  const run::MethodCatalog catalog(run::manifest_folders(command.adapters));
  const worker::Method& method = catalog.find(command.name);
  const std::vector<std::string> known = own_methods();
  if (std::ranges::find(known, command.name) != known.end())
    throw ConfigurationError("this project has the method '" + command.name +
                             "' already; there is nothing to hand in");
  plan::Plan own = submission_plan();
  own.methods = catalog.runs_of(command.name);
  if (const std::string fault = run::fault_of_entries(plan::plan_to_json(own).at("methods")); !fault.empty())
    throw ConfigurationError("the manifest of " + command.name +
                             " cannot be handed in as it is: in its \"runs\" " + fault);
  make_writable_folder(command.out);
  const fs::path run = command.out / run::kSubmissionRun;
  // An interrupted pack goes on.
  if (!fs::is_empty(command.out) && (!fs::exists(run) || fs::exists(command.out / run::kSubmissionFile)))
    throw ConfigurationError("the folder " + command.out.string() +
                             " is not empty; choose another one with --out");
  json submission = {{"kind", "submission"},
                     {"schema_version", record::kSchemaVersion},
                     {"created", utc_now()},
                     {"tool", describe_tool()},
                     {"method", command.name}};
  submission["contract"] = contract_of(method, command);
  if (submission["contract"].back()["status"] == json("not_installed")) {
    std::cerr << "hullbench: " << command.name
              << " does not start: " << submission["contract"].back()["words"].get<std::string>() << "\n";
    return kExitNothing;
  }
  RunCommand measured;
  measured.plans = {run::kSubmissionPlan};
  measured.with = {command.name};
  measured.adapters = command.adapters;
  measured.out = run;
  measured.keep_polygons = true;
  // A failure is a row, which is handed in as it is.
  if (const ExitCode code = run_plans(measured); code != kExitOk && code != kExitFailures) return code;
  mark_as_open(run, command.name);
  copy_method(command.name, command);
  submission["files"] = json::object();
  for (const std::string& file : run::submitted_files(command.out))
    submission["files"][file] = sha256_file(command.out / file);
  write_json_file(command.out / run::kSubmissionFile, submission);
  std::cerr << "hullbench: packed " << submission["files"].size() << " files into " << command.out.string()
            << "; 'hullbench submit check " << command.out.string() << "' checks them\n";
  return kExitOk;
}

ExitCode check(const CheckCommand& command) {
  const auto say = [](const run::Verdict& verdict) {
    std::cout << "- " << (verdict.kept ? "ok" : "FAIL") << ": " << verdict.name << ": " << verdict.words
              << "\n";
  };
  std::optional<run::Rescored> checked = run::check_submission(
      command.folder, submission_plan(), own_methods(), allowed_cores(), {default_data_directory(), {}}, say);
  if (!checked) {
    std::cerr << "hullbench: " << command.folder.string() << " cannot be taken as it is\n";
    return kExitError;
  }
  // The tables are made of what was worked out here, not of what is in the pack.
  const ScratchFolder scratch("hullbench-submission");
  const fs::path whole = scratch.path() / "run";
  const std::size_t planned = checked->rows.size();
  write_run({std::move(checked->header), std::move(checked->rows), planned, {}}, whole);
  std::cout << "\n";
  table::print_markdown(report::make_documents(reports_in(whole)), std::cout);
  return kExitOk;
}

void add_pack(CLI::App& app, Action& action) {
  const auto command = std::make_shared<PackCommand>();
  CLI::App& options =
      add_command(app, "pack", "Try and measure a method, and pack its rows, polygons and files",
                  "hullbench submit pack my_hull --adapters methods --out my_hull_submission");
  options.add_option("NAME", command->name, "The method's name")->required();
  add_adapters(options, command->adapters);
  options.add_option("--out", command->out, "Folder for the pack, new or empty")->required();
  options.add_option("--timeout", command->timeout_s, "Time limit of one run of the contract in seconds")
      ->check(timeout_range())
      ->capture_default_str();
  set_action(options, action, command, &pack);
}

void add_check(CLI::App& app, Action& action) {
  const auto command = std::make_shared<CheckCommand>();
  CLI::App& options =
      add_command(app, "check", "Check a pack: files, records and cases; all scores are worked out anew",
                  "hullbench submit check my_hull_submission");
  options.add_option("FOLDER", command->folder, "The pack's folder")->required();
  set_action(options, action, command, &check);
}

}  // namespace

void add_submit(CLI::App& app, Action& action) {
  CLI::App& options =
      add_command(app, "submit", "Hand in a method, or check one that was handed in",
                  "hullbench submit pack my_hull --adapters methods --out my_hull_submission");
  options.require_subcommand(1);
  add_pack(options, action);
  add_check(options, action);
}

}  // namespace hullbench::cli
