#include "benchmarks/record/stored_run.hpp"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/record/validate.hpp"

namespace hullbench::record {
namespace {

json read_run_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw ConfigurationError("Cannot read " + path.string() + ": is this the folder of a run?");
  try {
    json run = json::parse(in);
    if (!run.is_object()) throw ConfigurationError(path.string() + " does not hold a JSON object.");
    const json version = run.value("schema_version", json());
    if (version != kSchemaVersion) {
      throw ConfigurationError(path.string() + " is of another schema version (" + version.dump() +
                               ") than this program's (" + std::to_string(kSchemaVersion) +
                               "); use the version of hullbench that made it");
    }
    return run;
  } catch (const json::exception& error) {
    throw ConfigurationError(path.string() + " is not a run's description: " + error.what() + ".");
  }
}

}  // namespace

std::vector<RunRecord> records_of(const JsonLines& lines, const fs::path& path) {
  std::vector<RunRecord> records;
  records.reserve(lines.lines.size());
  for (std::size_t i = 0; i < lines.lines.size(); ++i) {
    try {
      records.push_back(lines.lines[i].get<RunRecord>());
    } catch (const std::exception& error) {
      throw ConfigurationError("line " + std::to_string(lines.numbers[i]) + " of " + path.string() +
                               " is not a run's record (" + error.what() + "); " + kDeleteLine);
    }
  }
  return records;
}

json last_of_each_id(JsonLines lines, const fs::path& path) {
  json result = json::array();
  std::map<std::string, std::size_t> places;  // by id, in result
  const std::vector<RunRecord> records = records_of(lines, path);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto [place, is_new] = places.emplace(records[i].id, result.size());
    if (is_new) {
      result.push_back(std::move(lines.lines[i]));
    } else {
      result[place->second] = std::move(lines.lines[i]);
    }
  }
  return result;
}

std::vector<std::string> plans_without_run(const fs::path& folder) {
  std::vector<std::string> names;
  const json suite = read_suite(folder);
  if (!suite.is_object()) return names;
  for (const json& plan : suite.at("plans")) {
    if (!fs::exists(folder / plan.get<std::string>() / kHeaderFile)) names.push_back(plan);
  }
  return names;
}

void check_run(const fs::path& run_directory) {
  const fs::path file = run_directory / kHeaderFile;
  const std::vector<std::string> faults = validate_run(read_run_file(file));
  if (faults.empty()) return;
  throw ConfigurationError(file.string() + " is not a run's description: " + faults.front());
}

json load_run(const fs::path& run_directory) {
  json report = read_run_file(run_directory / kHeaderFile);
  fs::path lines_file = run_directory / kRowsFile;
  if (!fs::exists(lines_file)) lines_file += ".xz";
  JsonLines lines = load_json_lines(lines_file);
  report["runs"] = last_of_each_id(lines, lines_file);
  // Only a merged run has notes of its own.
  if (!report.contains("notes")) report["notes"] = json::array();
  if (!lines.torn.empty()) report["notes"].push_back(kTornNote);
  return report;
}

bool is_suite(const fs::path& folder) {
  return fs::exists(folder / kSuiteFile);
}

json read_suite(const fs::path& folder) {
  std::ifstream in(folder / kSuiteFile, std::ios::binary);
  json suite = in ? json::parse(in, nullptr, false) : json();
  const json plans = suite.is_object() ? suite.value("plans", json()) : json();
  const auto is_name = [](const json& plan) { return plan.is_string(); };
  return plans.is_array() && std::all_of(plans.begin(), plans.end(), is_name) ? suite : json();
}

std::vector<fs::path> suite_runs(const fs::path& folder) {
  const json suite = read_suite(folder);
  if (!suite.is_object()) {
    throw ConfigurationError("cannot read " + (folder / kSuiteFile).string() +
                             ": is it a suite's description?");
  }
  std::vector<fs::path> runs;
  for (const json& plan : suite.at("plans")) {
    const fs::path run = folder / plan.get<std::string>();
    if (fs::exists(run / kHeaderFile)) runs.push_back(run);
  }
  return runs;
}

std::vector<fs::path> runs_in(const fs::path& folder) {
  return is_suite(folder) ? suite_runs(folder) : std::vector{folder};
}

}  // namespace hullbench::record
