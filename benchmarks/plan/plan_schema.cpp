#include "benchmarks/plan/plan_schema.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/json_schema.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/plan/embedded.hpp"

namespace hullbench::plan {
namespace {

const json& schema() {
  static const json document = json::parse(kPlanSchemaJson);
  return document;
}

const json& resolved(const json& part) {
  if (!part.contains("$ref")) return part;
  return schema().at(json::json_pointer(part["$ref"].get<std::string>().substr(1)));
}

/// "a whole number from 1 to 100", "one of paper, default and auto", "a number or null"
std::string expected(const json& part) {
  static const std::map<std::string, std::string> types = {{"boolean", "true or false"},
                                                           {"string", "a string"},
                                                           {"object", "an object"},
                                                           {"array", "a list"},
                                                           {"number", "a number"},
                                                           {"integer", "a whole number"},
                                                           {"null", "null"}};
  std::vector<std::string> values;
  for (const json& value : part.value("enum", json::array()))
    values.push_back(value.is_string() ? value.get<std::string>() : value.dump());
  if (!values.empty()) return (values.size() > 1 ? "one of " : "") + join_words(values);
  std::string text;
  for (const json& type : part["type"].is_array() ? part["type"] : json::array({part["type"]}))
    text += (text.empty() ? "" : " or ") + types.at(type.get<std::string>());
  if (part.contains("minItems")) text += " with at least one element";
  if (part.contains("minimum")) text += " from " + part["minimum"].dump();
  if (part.contains("maximum")) text += " to " + part["maximum"].dump();
  return text;
}

void refuse_keys(const json& part, const json& object, const Place& place) {
  const json& members = part["properties"];
  std::vector<std::string> known;
  for (const auto& [key, unused] : members.items()) known.push_back(key);
  for (const auto& [key, unused] : object.items()) {
    if (!members.contains(key))
      place.member(key).fail("is not a key that is known here; known are " + join_words(known));
  }
  for (const json& required : part.value("required", json::array())) {
    const auto key = required.get<std::string>();
    if (!object.contains(key))
      place.fail("lacks the key '" + key + "': " + members[key]["description"].get<std::string>());
  }
  std::vector<std::string> choice;
  for (const json& one : part.value("anyOf", json::array())) {
    if (one.size() == 1 && one.contains("required"))
      choice.push_back("'" + one["required"][0].get<std::string>() + "'");
  }
  if (!choice.empty()) place.fail("needs at least one of the keys " + join_words(choice));
}

void refuse_repetition(const json& list, const Place& place) {
  for (std::size_t i = 1; i < list.size(); ++i) {
    const auto end = list.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(list.begin(), end, list[i]) != end) place.element(i).fail("is there twice; leave one out");
  }
}

/// What the schema says of the member or element `step` of `value`, for which `part` is; null when nothing.
const json* part_below(const json& part, const json& value, const std::string& step) {
  if (value.is_array()) return part.contains("items") ? &part["items"] : nullptr;
  if (!part.contains("properties"))
    return part.contains("additionalProperties") ? &part["additionalProperties"] : nullptr;
  return part["properties"].contains(step) ? &part["properties"][step] : nullptr;
}

/// Says what is wrong `steps` below `value`, of which `entry` of the schema says what it should be.
[[noreturn]] void refuse(const json& entry, const json& value, const std::vector<std::string>& steps,
                         const Place& place) {
  const json& part = resolved(entry);
  if (const json* below = steps.empty() ? nullptr : part_below(part, value, steps.front())) {
    const std::string& step = steps.front();
    const std::vector<std::string> rest(steps.begin() + 1, steps.end());
    if (value.is_object()) refuse(*below, value[step], rest, place.member(step));
    const std::size_t index = std::stoul(step);
    refuse(*below, value[index], rest, place.element(index));
  }
  if (value.is_object() && part.contains("properties")) refuse_keys(part, value, place);
  if (value.is_array() && part.contains("uniqueItems")) refuse_repetition(value, place);
  // What refers to a part says better what this very value is for.
  const json& words = entry.contains("description") ? entry : part;
  const std::string example = part.contains("enum") ? "" : ", such as " + words["examples"][0].dump();
  place.fail("must be " + expected(part) + example + ", not " + dump_text(value, -1).substr(0, 80) + ": " +
             words["description"].get<std::string>());
}

void check(const JsonSchema& checked, const json& entry, const json& value, const Place& place) {
  const std::vector<SchemaFault> faults = checked.faults(value);
  if (faults.empty()) return;
  std::vector<std::string> steps;
  for (json::json_pointer rest = faults.front().place; !rest.empty(); rest.pop_back())
    steps.insert(steps.begin(), rest.back());
  refuse(entry, value, steps, place);
}

}  // namespace

void Place::fail(const std::string& what) const {
  throw ConfigurationError(source_ + ": " + (path_.empty() ? "the plan" : path_) + " " + what);
}

void check_plan_schema(const json& plan, const Place& place) {
  static const JsonSchema checked(schema());
  check(checked, schema(), plan, place);
}

void check_methods_schema(const json& methods, const Place& place) {
  static const json entry = {{"$ref", "#/$defs/methods"}};
  static const json document = {{"$defs", schema()["$defs"]}, {"allOf", json::array({entry})}};
  static const JsonSchema checked(document);
  check(checked, entry, methods, place);
}

}  // namespace hullbench::plan
