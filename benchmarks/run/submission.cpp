#include "benchmarks/run/submission.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <stdexcept>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/record/stored_run.hpp"
#include "benchmarks/record/validate.hpp"
#include "datasets/sha256.hpp"

namespace hullbench::run {
namespace {

// Beyond any pack that is made here: a larger one is not read.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{64} << 20U;
constexpr std::uintmax_t kLargestJson = std::uintmax_t{4} << 20U;
constexpr int kDeepest = 32;
constexpr std::size_t kLongestText = 4000;

/// The JSON in `text`. Throws std::runtime_error when it is none, or deeper or with longer texts than any
/// record.
json parse(const std::string& text, const std::string& name) {
  const auto look = [&](int depth, json::parse_event_t event, const json& parsed) {
    if (depth > kDeepest) throw std::runtime_error(name + " is nested too deeply");
    const bool is_text = event == json::parse_event_t::key || event == json::parse_event_t::value;
    if (is_text && parsed.is_string() && parsed.get_ref<const std::string&>().size() > kLongestText)
      throw std::runtime_error(name + " has a text of more than " + std::to_string(kLongestText) +
                               " characters");
    return true;
  };
  try {
    return json::parse(text, look);
  } catch (const json::parse_error&) {
    throw std::runtime_error(name + " is not JSON");
  }
}

std::string read(const fs::path& file) {
  const std::optional<std::string> text = read_text_file(file);
  if (!text) throw std::runtime_error("cannot read " + file.filename().string());
  return *text;
}

/// What is wrong with the kinds and sizes of what is in the folder: nothing in it leads out of it.
std::string fault_of_folder(const fs::path& folder) {
  if (fs::is_symlink(folder)) return "the folder is a link";
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).generic_string();
    const auto is_plain = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
             c == '_' || c == '-' || c == '/';
    };
    if (!std::ranges::all_of(name, is_plain))
      return "a file's name has other characters than A-Z a-z 0-9 . _ -";
    const fs::file_status status = entry.symlink_status();
    if (status.type() == fs::file_type::directory) continue;
    if (status.type() != fs::file_type::regular) return name + " is no file";
    const bool is_json = name.ends_with(".json");
    if (entry.file_size() > (is_json ? kLargestJson : kLargestFile)) return name + " is too large";
  }
  if (fs::exists(folder / kSubmissionRun / record::kSuiteFile)) return "the run is a suite";
  return "";
}

std::string fault_of_description(const json& submission, const std::vector<std::string>& known) {
  if (!submission.is_object() || submission.value("kind", json()) != json("submission"))
    return "submission.json is no submission";
  if (const auto faults = record::validate_by_kind(submission); !faults.empty()) return faults.front();
  const auto method = submission.at("method").get<std::string>();
  if (std::ranges::find(known, method) != known.end()) return "this project has a method " + method;
  return "";
}

std::string fault_of_files(const fs::path& folder, const json& submission) {
  const json& packed = submission.at("files");
  const std::vector<std::string> files = submitted_files(folder);
  for (const std::string& file : files) {
    if (!packed.contains(file)) return file + " was not packed";
  }
  for (const auto& [file, sha256] : packed.items()) {
    if (!std::binary_search(files.begin(), files.end(), file)) return file + " is missing";
    if (sha256 != json(sha256_file(folder / file))) return file + " was changed after it was packed";
  }
  return "";
}

std::string fault_of_records(const fs::path& run) {
  parse(read(run / record::kHeaderFile), record::kHeaderFile);
  std::istringstream lines(read(run / record::kRowsFile));
  for (std::string line; std::getline(lines, line);) parse(line, record::kRowsFile);
  for (const char* file : {record::kHeaderFile, record::kRowsFile}) {
    if (const auto faults = record::validate_file(run / file); !faults.empty())
      return file + (": " + faults.front());
  }
  return "";
}

/// What the run is not of the plan, but for the method's own entries.
std::string fault_of_plan(const json& run, const plan::Plan& plan, const std::string& method) {
  json theirs = run.at("plan");
  json own = json::array();
  json others = json::array();
  for (const json& entry : theirs.at("methods"))
    (entry.at("method") == json(method) ? own : others).push_back(entry);
  if (own.empty()) return "it does not name " + method;
  if (std::string fault = fault_of_entries(own); !fault.empty()) return fault;
  theirs["methods"] = others;
  const json ours = plan::plan_to_json(plan);
  json all = ours;
  all.update(theirs);
  for (const auto& [key, unused] : all.items()) {
    if (theirs.value(key, json()) != ours.value(key, json()))
      return "its " + key + " are not those of the plan '" + kSubmissionPlan + "'";
  }
  if (run.at("seed") != json(plan.seed)) return "its seed is not that of the plan";
  for (const char* key : {"filter", "shard", "merged", "rescored"}) {
    if (!run.value(key, json()).is_null()) return std::string("it has a ") + key;
  }
  return "";
}

/// What the rows are not of those that the plan asks for.
std::string fault_of_rows(const json& run, const std::string& method) {
  const plan::Plan plan = plan::parse_plan(run.at("plan").dump(), record::kHeaderFile);
  std::map<std::string, record::RunRecord> rows;
  for (const json& line : run.at("runs")) {
    auto row = line.get<record::RunRecord>();
    const std::string name = row.name;
    if (!rows.emplace(name, std::move(row)).second) return name + " is there twice";
  }
  const auto planned = plan::planned_runs(plan, "");
  for (const plan::PlannedRun& one : planned) {
    const auto found = rows.find(one.name);
    if (found == rows.end()) return "the row " + one.name + " is missing";
    const record::RunRecord& row = found->second;
    const plan::PlanMethod& entry = plan.methods[one.method_index];
    const plan::PlanCase& of = plan.expanded_cases[one.case_index];
    if (row.method != entry.method || row.protocol != entry.protocol || row.dataset != of.dataset ||
        row.n != of.n || row.holes != of.holes || row.seed != plan.seed ||
        row.id != record::run_identity(row))
      return one.name + " is not the row that its name says";
    if (row.method == method && row.status == record::Status::kNotInstalled)
      return one.name + " is of a method that was not installed";
  }
  return rows.size() == planned.size() ? "" : "there are rows that the plan does not ask for";
}

/// Whose rows are handed in, and does the run say so?
std::string fault_of_division(const json& run, const std::string& method) {
  for (const json& one : run.at("methods")) {
    const bool is_own = one.at("name") == json(method);
    const bool is_marked = one.value("division", json()) == json(kOpenDivision) &&
                           one.at("title").get<std::string>().ends_with(kHandedIn);
    if (is_own != is_marked || one.contains("division") != is_own)
      return "run.json does not say of " + method + " alone that it was handed in";
  }
  return "";
}

/// GEOS's versions differ in the last digits of an area.
bool is_same(const json& before, const json& now) {
  constexpr double kRounding = 1e-6;
  if (!before.is_number() || !now.is_number()) return before == now;
  const auto a = before.get<double>();
  const auto b = now.get<double>();
  return std::abs(a - b) <= kRounding * std::max({std::abs(a), std::abs(b), 1e-3});
}

/// Where a distance was taken can differ by a tie, and a reason is in GEOS's words.
bool is_compared(const std::string& metric) {
  return !metric.ends_with("_x") && !metric.ends_with("_y") && metric != "invalid_reason" &&
         std::ranges::find(kOfTheRun, metric) == kOfTheRun.end();
}

std::string fault_of_scores(const json& run, const Rescored& rescored) {
  if (rescored.without_polygons > 0)
    return std::to_string(rescored.without_polygons) + " rows have a result whose polygons are not there";
  for (std::size_t i = 0; i < rescored.rows.size(); ++i) {
    const auto before = run.at("runs").at(i).get<record::RunRecord>();
    const record::RunRecord& now = rescored.rows[i];
    if (before.status != now.status)
      return now.name + " is " + to_string(now.status) + ", not " + to_string(before.status);
    for (const auto& [name, value] : now.metrics.items()) {
      const json told = before.metrics.value(name, json());
      if (is_compared(name) && !is_same(told, value))
        return now.name + " has " + name + " " + value.dump() + ", not " + told.dump();
    }
  }
  return "";
}

}  // namespace

std::vector<std::string> submitted_files(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string file = entry.path().lexically_relative(folder).generic_string();
    if (!entry.is_directory() && file != kSubmissionFile) files.push_back(file);
  }
  std::ranges::sort(files);
  return files;
}

std::string fault_of_entries(const json& entries) {
  for (const json& entry : entries) {
    for (const char* key : {"datasets", "repetitions", "timeout_s", "mem_limit_mib"}) {
      if (entry.contains(key)) return std::string("the method has ") + key + " of its own";
    }
    const json parameters = entry.value("parameters", json::object());
    for (const auto& [name, choice] : parameters.items()) {
      if (choice.is_object() && choice.contains("cases"))
        return "the method has another " + name + " for each case";
    }
  }
  return "";
}

std::optional<Rescored> check_submission(const fs::path& folder, const plan::Plan& plan,
                                         const std::vector<std::string>& known, const std::vector<int>& cores,
                                         const DataFolders& folders,
                                         const std::function<void(const Verdict&)>& say) {
  if (!fs::is_regular_file(folder / kSubmissionFile)) {
    throw ConfigurationError("there is no " + (folder / kSubmissionFile).string() +
                             "; 'hullbench submit pack' makes such a folder");
  }
  const auto judge = [&](const char* name, const std::string& good,
                         const std::function<std::string()>& find_fault) {
    std::string fault;
    try {
      fault = find_fault();
    } catch (const Interrupted&) {
      throw;
    } catch (const std::exception& error) {
      fault = error.what();
    }
    std::replace_if(
        fault.begin(), fault.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '`'; },
        ' ');
    say({name, fault.empty(), record::Status::kOk, fault.empty() ? good : fault});
    return fault.empty();
  };
  const fs::path run_folder = folder / kSubmissionRun;
  json submission;
  json run;
  std::string method;
  Rescored rescored;
  const bool is_sound =
      judge("folder", "plain files of usual sizes", [&] { return fault_of_folder(folder); }) &&
      judge("description", "submission.json is valid",
            [&] {
              submission = parse(read(folder / kSubmissionFile), kSubmissionFile);
              return fault_of_description(submission, known);
            }) &&
      judge("files", "as they were packed", [&] { return fault_of_files(folder, submission); }) &&
      judge("records", "run.json and runs.jsonl follow their schemas",
            [&] { return fault_of_records(run_folder); }) &&
      judge("plan", "that of this program",
            [&] {
              method = submission.at("method").get<std::string>();
              run = record::load_run(run_folder);
              return fault_of_plan(run, plan, method);
            }) &&
      judge("rows", "none missing, none too many", [&] { return fault_of_rows(run, method); }) &&
      judge("division", "its rows are told apart", [&] { return fault_of_division(run, method); }) &&
      judge("scores", "worked out anew from the polygons: the same", [&] {
        rescored = rescore(run_folder, cores, folders);
        return fault_of_scores(run, rescored);
      });
  return is_sound ? std::optional(std::move(rescored)) : std::nullopt;
}  // NOLINT(clang-analyzer-cplusplus.NewDeleteLeaks): the analyser does not follow the moves of a json

}  // namespace hullbench::run
