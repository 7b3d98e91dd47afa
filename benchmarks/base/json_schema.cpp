#include "benchmarks/base/json_schema.hpp"

#include <cstdint>
#include <set>
#include <string_view>
#include <utility>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "benchmarks/base/files.hpp"
#include "benchmarks/base/words.hpp"

namespace hullbench {
namespace {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

/// Halves integers above 2^63 - 1, such as a seed may be: the validator would take them for negative ones.
void halve_largest(json& value) {
  if (value.is_number_unsigned() && value.get<std::int64_t>() < 0) value = value.get<std::uint64_t>() >> 1U;
  if (!value.is_structured()) return;
  for (json& element : value) halve_largest(element);
}

/// The place of an error, which comes as {"<root>", "[\"runs\"]", "[3]", ...}.
json::json_pointer pointer_of(const std::vector<std::string>& context) {
  json::json_pointer pointer;
  for (std::size_t level = 1; level < context.size(); ++level) {
    std::string step = context[level];
    if (step.size() >= 2 && step.front() == '[' && step.back() == ']') step = step.substr(1, step.size() - 2);
    if (step.size() >= 2 && step.front() == '"' && step.back() == '"') step = step.substr(1, step.size() - 2);
    pointer.push_back(std::move(step));
  }
  return pointer;
}

/// An object with a fault also fails every schema around it; that is said in these words and tells nothing
/// new.
bool is_consequence(const std::string& description) {
  return description.rfind("Failed to validate", 0) == 0;
}

/// What the validator says and, where it is short, what stands there.
std::string sentence_of(const json& document, const json::json_pointer& place, std::string description) {
  constexpr std::string_view kUnknownMember =
      "Object contains a property that could not be validated using 'properties' or 'additionalProperties' "
      "constraints";
  if (description.rfind(kUnknownMember, 0) == 0) {
    description = "There is a member that does not belong there" + description.substr(kUnknownMember.size());
  }
  if (document.contains(place) && document.at(place).is_primitive()) {
    while (!description.empty() && description.back() == '.') description.pop_back();
    description += ", found " + dump_text(document.at(place), -1).substr(0, 80);
  }
  return sentence(description);
}

}  // namespace

JsonSchema::JsonSchema(const json& schema, const Find& find) : schema_(std::make_unique<valijson::Schema>()) {
  const auto fetch = [&](const std::string& name) { return find ? find(name) : nullptr; };
  valijson::SchemaParser parser;
  parser.populateSchema<Adapter>(Adapter(schema), *schema_, fetch, [](const json*) {});
}

JsonSchema::~JsonSchema() = default;

std::vector<SchemaFault> JsonSchema::faults(const json& document) const {
  valijson::Validator validator;
  valijson::ValidationResults results;
  json signed_document = document;
  halve_largest(signed_document);
  if (validator.validate(*schema_, Adapter(signed_document), &results)) return {};
  std::vector<SchemaFault> faults;
  std::set<std::pair<std::string, std::string>> known;
  for (const bool with_consequences : {false, true}) {
    for (const auto& error : results) {
      if (is_consequence(error.description) && !with_consequences) continue;
      const json::json_pointer place = pointer_of(error.context);
      std::string text = sentence_of(document, place, error.description);
      if (known.emplace(place.to_string(), text).second) faults.push_back({place, std::move(text)});
    }
    if (!faults.empty()) break;
  }
  return faults;
}

}  // namespace hullbench
