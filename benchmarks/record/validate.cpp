#include "benchmarks/record/validate.hpp"

#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "benchmarks/base/words.hpp"
#include "benchmarks/record/embedded.hpp"
#include "benchmarks/record/json_lines.hpp"
#include "benchmarks/record/record.hpp"

namespace hullbench::record {
namespace {

using nlohmann::json;
using Adapter = valijson::adapters::NlohmannJsonAdapter;

constexpr std::string_view kRunSchemaReference = "run.schema.json";

std::unique_ptr<valijson::Schema> parse_schema(std::string_view text) {
  const json document = json::parse(text);
  const json run_schema = json::parse(kRunSchemaJson);
  const auto fetch = [&](const std::string& reference) -> const json* {
    return reference == kRunSchemaReference ? &run_schema : nullptr;
  };
  auto schema = std::make_unique<valijson::Schema>();
  valijson::SchemaParser parser;
  parser.populateSchema(Adapter(document), *schema, fetch, [](const json*) {});
  return schema;
}

/// The place of an error, which comes as {"<root>", "[\"runs\"]", "[3]", ...}, as a JSON pointer (RFC 6901).
std::string json_pointer(const std::vector<std::string>& context) {
  std::string pointer;
  for (std::size_t level = 1; level < context.size(); ++level) {
    std::string step = context[level];
    if (step.size() >= 2 && step.front() == '[' && step.back() == ']') step = step.substr(1, step.size() - 2);
    if (step.size() >= 2 && step.front() == '"' && step.back() == '"') step = step.substr(1, step.size() - 2);
    pointer += '/';
    for (const char c : step) {
      if (c == '~')
        pointer += "~0";
      else if (c == '/')
        pointer += "~1";
      else
        pointer += c;
    }
  }
  return pointer;
}

/// An object with a fault also fails every schema around it; that is said in these words and tells nothing
/// new.
bool is_consequence(const std::string& description) {
  return description.rfind("Failed to validate", 0) == 0;
}

/// One sentence about a fault: the place, what the validator says and, where it is short, what stands there.
std::string fault_sentence(const json& document, const std::string& place, std::string description) {
  constexpr std::string_view kUnknownMember =
      "Object contains a property that could not be validated using 'properties' or 'additionalProperties' "
      "constraints";
  if (description.rfind(kUnknownMember, 0) == 0) {
    description = "There is a member that does not belong there" + description.substr(kUnknownMember.size());
  }
  const json::json_pointer pointer(place);
  if (document.contains(pointer) && document.at(pointer).is_primitive()) {
    while (!description.empty() && description.back() == '.') description.pop_back();
    description +=
        ", found " + document.at(pointer).dump(-1, ' ', false, json::error_handler_t::replace).substr(0, 80);
  }
  return "At " + (place.empty() ? std::string("the top level") : place) + ": " + sentence(description);
}

std::vector<std::string> faults(const valijson::Schema& schema, const json& document) {
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(schema, Adapter(document), &results)) return {};
  std::vector<std::string> sentences;
  std::set<std::string> known;
  for (const bool with_consequences : {false, true}) {
    for (const auto& error : results) {
      if (is_consequence(error.description) && !with_consequences) continue;
      const std::string text = fault_sentence(document, json_pointer(error.context), error.description);
      if (known.insert(text).second) sentences.push_back(text);
    }
    if (!sentences.empty()) break;
  }
  return sentences;
}

/// The schema of what says its `kind`: lines of pictures.jsonl and sweep.jsonl, tune.json, league.json and
/// tables.json. Null for any other.
const valijson::Schema* schema_of_kind(const json& document) {
  static const auto picture = parse_schema(kPictureSchemaJson);
  static const auto evaluation = parse_schema(kSweepSchemaJson);
  static const auto tuning = parse_schema(kTuneSchemaJson);
  static const auto league = parse_schema(kLeagueSchemaJson);
  static const auto tables = parse_schema(kTablesSchemaJson);
  static const std::map<std::string, const valijson::Schema*> schemas = {
      {"case", picture.get()},  {"result", picture.get()}, {"evaluation", evaluation.get()},
      {"tuning", tuning.get()}, {"league", league.get()},  {"tables", tables.get()}};
  if (!document.is_object() || !document.contains("kind") || !document["kind"].is_string()) return nullptr;
  const auto found = schemas.find(document["kind"].get<std::string>());
  return found == schemas.end() ? nullptr : found->second;
}

std::vector<std::string> validate_lines(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error("Cannot read " + path.string() + ".");
  const JsonLines lines = load_json_lines(path);
  std::vector<std::string> result;
  for (std::size_t index = 0; index < lines.lines.size(); ++index) {
    const json& line = lines.lines[index];
    const valijson::Schema* schema = schema_of_kind(line);
    for (const std::string& fault : schema != nullptr ? faults(*schema, line) : validate_run(line)) {
      result.push_back("Record " + std::to_string(index + 1) + ": " + fault);
    }
  }
  if (!lines.torn.empty())
    result.emplace_back("The last line is cut short: it does not end with a line feed.");
  return result;
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
  static const std::unique_ptr<valijson::Schema> schema = parse_schema(kReportSchemaJson);
  return faults(*schema, report);
}

std::vector<std::string> validate_run(const json& run) {
  static const std::unique_ptr<valijson::Schema> schema = parse_schema(kRunSchemaJson);
  return faults(*schema, run);
}

std::vector<std::string> validate_by_kind(const json& document) {
  const valijson::Schema* schema = schema_of_kind(document);
  if (schema == nullptr) throw std::invalid_argument("there is no schema for this kind of document");
  return faults(*schema, document);
}

std::vector<std::string> validate_manifest(const json& manifest) {
  static const std::unique_ptr<valijson::Schema> schema = parse_schema(kManifestSchemaJson);
  return faults(*schema, manifest);
}

std::vector<std::string> validate_file(const std::filesystem::path& path) {
  if (path.extension() == ".jsonl") return validate_lines(path);
  std::ifstream in(path, std::ios::binary);
  std::ostringstream content;
  if (in) content << in.rdbuf();
  if (!in || std::filesystem::is_directory(path))
    throw std::runtime_error("Cannot read " + path.string() + ".");
  try {
    json document = json::parse(content.str());
    if (document.is_object() && document.contains("manifest_version")) return validate_manifest(document);
    if (schema_of_kind(document) != nullptr) return validate_by_kind(document);
    if (path.filename() == "run.json" && document.is_object()) complete_run_description(document);
    return validate_report(document);
  } catch (const json::parse_error& error) {
    throw std::runtime_error(path.string() + " is not JSON: " + error.what() + ".");
  }
}

}  // namespace hullbench::record
