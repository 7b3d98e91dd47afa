#include "benchmarks/record/validate.hpp"

#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/json_schema.hpp"
#include "benchmarks/record/embedded.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"
#include "datasets/json_file.hpp"

namespace hullbench::record {
namespace {

JsonSchema parse_schema(std::string_view text) {
  const json run_schema = json::parse(kRunSchemaJson);
  return JsonSchema(json::parse(text), [&](const std::string& name) {
    return name == "run.schema.json" ? &run_schema : nullptr;
  });
}

/// One sentence a fault, with its place.
std::vector<std::string> faults(const JsonSchema& schema, const json& document) {
  std::vector<std::string> sentences;
  for (const SchemaFault& fault : schema.faults(document)) {
    const std::string place = fault.place.empty() ? "the top level" : fault.place.to_string();
    sentences.push_back("At " + place + ": " + fault.sentence);
  }
  return sentences;
}

/// The schema of what says its `kind`: lines of pictures.jsonl, tune.json, league.json, tables.json and
/// submission.json. Null for any other.
const JsonSchema* schema_of_kind(const json& document) {
  static const JsonSchema picture = parse_schema(kPictureSchemaJson);
  static const JsonSchema tuning = parse_schema(kTuneSchemaJson);
  static const JsonSchema league = parse_schema(kLeagueSchemaJson);
  static const JsonSchema tables = parse_schema(kTablesSchemaJson);
  static const JsonSchema submission = parse_schema(kSubmissionSchemaJson);
  static const std::map<std::string, const JsonSchema*> schemas = {
      {"case", &picture},  {"result", &picture}, {"tuning", &tuning},
      {"league", &league}, {"tables", &tables},  {"submission", &submission}};
  if (!document.is_object() || !document.contains("kind") || !document["kind"].is_string()) return nullptr;
  const auto found = schemas.find(document["kind"].get<std::string>());
  return found == schemas.end() ? nullptr : found->second;
}

/// Of one line of runs.jsonl, or of sweep.jsonl, whose rows say their program.
std::vector<std::string> validate_row(const json& row) {
  static const JsonSchema of_run = parse_schema(kRunSchemaJson);
  static const JsonSchema of_search = parse_schema(kSweepSchemaJson);
  return faults(row.is_object() && row.contains("program") ? of_search : of_run, row);
}

std::vector<std::string> validate_lines(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw std::runtime_error("Cannot read " + path.string() + ".");
  JsonLines lines;
  try {
    lines = load_json_lines(path);
  } catch (const ConfigurationError& error) {
    return {error.what()};
  }
  std::vector<std::string> result;
  for (std::size_t index = 0; index < lines.lines.size(); ++index) {
    const json& line = lines.lines[index];
    const JsonSchema* schema = schema_of_kind(line);
    for (const std::string& fault : schema != nullptr ? faults(*schema, line) : validate_row(line)) {
      result.push_back("Record " + std::to_string(index + 1) + ": " + fault);
    }
  }
  if (lines.lines.empty() && lines.torn.empty()) result.emplace_back("It has no record.");
  if (!lines.torn.empty())
    result.emplace_back("The last line is cut short: it does not end with a line feed.");
  return result;
}

/// What the schema of manifests cannot say.
std::vector<std::string> parameter_faults(const json& parameters) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto number = [](const json& value, double none) {
    return value.is_null() ? none : value.get<double>();
  };
  std::vector<std::string> sentences;
  std::set<std::string> names;
  for (const json& parameter : parameters) {
    const auto name = parameter.at("name").get<std::string>();
    const auto add = [&](const std::string& fault) {
      sentences.push_back("The parameter '" + name + "' " + fault);
    };
    const double minimum = number(parameter.at("minimum"), -kInfinity);
    const double maximum = number(parameter.at("maximum"), kInfinity);
    if (!names.insert(name).second) add("is there twice.");
    if (minimum > maximum) {
      add("has a minimum above its maximum.");
    } else if (parameter.contains("default")) {
      const double value = number(parameter["default"], kInfinity);
      if (value < minimum || value > maximum) add("has a default outside its range.");
    }
  }
  return sentences;
}

/// Makes of run.json the report of a run that has no row yet: one schema says what both hold.
void complete_run_description(json& document) {
  json totals = json::object();
  for (const Status status : kAllStatuses) totals[to_string(status)] = 0;
  document["runs"] = json::array();
  document["notes"] = json::array();
  document["summary"] = {{"totals", totals}, {"rows", json::array()}, {"claims", json::array()}};
}

}  // namespace

std::vector<std::string> validate_report(const json& report) {
  static const JsonSchema schema = parse_schema(kReportSchemaJson);
  return faults(schema, report);
}

std::vector<std::string> validate_run(json description) {
  complete_run_description(description);
  return validate_report(description);
}

std::vector<std::string> validate_by_kind(const json& document) {
  const JsonSchema* schema = schema_of_kind(document);
  if (schema == nullptr) throw std::invalid_argument("there is no schema for this kind of document");
  return faults(*schema, document);
}

std::vector<std::string> validate_manifest(const json& manifest) {
  static const JsonSchema schema = parse_schema(kManifestSchemaJson);
  std::vector<std::string> sentences = faults(schema, manifest);
  if (sentences.empty()) sentences = parameter_faults(manifest["parameters"]);
  return sentences;
}

std::vector<std::string> validate_file(const fs::path& path) {
  if (path.extension() == ".jsonl" || path.string().ends_with(".jsonl.xz")) return validate_lines(path);
  const std::string content = required_text(path);
  try {
    json document = parse_json_text(content);
    if (document.is_object() && document.contains("manifest_version")) return validate_manifest(document);
    if (schema_of_kind(document) != nullptr) return validate_by_kind(document);
    if (path.filename() == "run.json" && document.is_object()) return validate_run(std::move(document));
    return validate_report(document);
  } catch (const RepeatedKey& error) {
    return {std::string("It ") + error.what() + "."};
  } catch (const json::exception& error) {
    throw std::runtime_error(path.string() + " is not JSON: " + error.what() + ".");
  }
}

}  // namespace hullbench::record
