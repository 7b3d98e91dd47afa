#include "benchmarks/plan/plan.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/files.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/plan/field.hpp"
#include "benchmarks/plan/plan_schema.hpp"
#include "benchmarks/plan/release_seed.hpp"
#include "datasets/json_file.hpp"
#include "datasets/stress.hpp"

namespace hullbench::plan {
namespace {

constexpr int kPlanSchemaVersion = 1;

/// "ca" or ["ca", "hi"]
std::vector<std::string> names_in(const json& value) {
  return value.is_array() ? value.get<std::vector<std::string>>() : std::vector{value.get<std::string>()};
}

/// The ways to draw points, as they stand behind the '~' of a data set's name.
void check_stress(const json& stresses, const Place& place) {
  for (std::size_t i = 0; i < stresses.size(); ++i) {
    const auto stress = stresses[i].get<std::string>();
    if (split_stress("~" + stress)) continue;
    std::vector<std::string> known;
    for (const StressKind& kind : stress_kinds()) known.push_back(kind.name);
    place.element(i).fail("must be one of " + join_words(known) +
                          ", with a ':' and a level in its range behind it ('hullbench list'), not '" +
                          stress + "'");
  }
}

/// Every one of `names` with every one of `endings` behind it.
std::vector<std::string> with_endings(const std::vector<std::string>& names,
                                      const std::vector<std::string>& endings) {
  std::vector<std::string> result;
  for (const std::string& name : names) {
    for (const std::string& ending : endings) result.push_back(name + ending);
  }
  return result;
}

/// The cases of one element of "cases".
std::vector<PlanCase> read_case_group(const json& group, const Place& place) {
  std::vector<std::string> datasets = names_in(group["dataset"]);
  std::vector<std::string> endings;
  for (int number = 1; number <= group.value("members", 0); ++number)
    endings.push_back("-" + std::to_string(number));
  if (!endings.empty()) datasets = with_endings(datasets, endings);
  if (group.contains("stress")) {
    check_stress(group["stress"], place.member("stress"));
    datasets = with_endings(with_endings(datasets, {"~"}), names_in(group["stress"]));
  }
  std::vector<PlanCase> cases;
  for (const std::string& dataset : datasets) {
    for (const json& holes : group.value("holes", json::array({false}))) {
      for (const json& n : group.value("n", json::array({0})))
        cases.push_back({dataset, holes.get<bool>(), n.get<std::int64_t>()});
    }
  }
  return cases;
}

std::vector<PlanCase> read_cases(const json& groups, const Place& place) {
  std::vector<PlanCase> cases;
  std::set<std::string> seen;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const PlanCase& one : read_case_group(groups[i], place.element(i))) {
      cases.push_back(one);
      if (!seen.insert(one.key()).second) {
        place.element(i).fail("has the case " + one.shape() + " with n = " + std::to_string(one.n) +
                              " for the second time; leave one out");
      }
    }
  }
  return cases;
}

RuleChoice read_rule(const std::string& name, const std::string& protocol, const Place& place) {
  const ParameterRule* rule = find_rule(name);
  if (!rule) place.fail("names the unknown rule '" + name + "'; known are " + join_words(rule_names()));
  if (rule->reads_ground_truth && protocol != "paper" && protocol != "oracle") {
    place.fail("names the rule '" + name +
               "', which reads the ground truth: the protocol must be paper or oracle, not " + protocol);
  }
  return {name};
}

/// A number, or infinity for null.
double value_from_json(const json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

ParameterChoice read_parameter(const json& value, const std::string& protocol, const Place& place) {
  if (!value.is_object()) return value_from_json(value);
  if (value.contains("rule"))
    return read_rule(value["rule"].get<std::string>(), protocol, place.member("rule"));
  if (value.contains("scaled")) return ScaledChoice{value["scaled"].get<double>(), value.value("power", 1)};
  CaseChoice choice;
  for (const auto& [key, one] : value["cases"].items()) choice.values[key] = value_from_json(one);
  return choice;
}

template <class Value>
std::optional<Value> read_optional(const json& object, const char* key) {
  return object.contains(key) ? std::optional(object[key].get<Value>()) : std::nullopt;
}

PlanMethod read_method(const json& entry, const Place& place) {
  PlanMethod method;
  method.method = entry["method"].get<std::string>();
  method.protocol = entry["protocol"].get<std::string>();
  method.datasets = entry.value("datasets", method.datasets);
  const json parameters = entry.value("parameters", json::object());
  const Place there = place.member("parameters");
  for (const auto& [name, value] : parameters.items())
    method.parameters[name] = read_parameter(value, method.protocol, there.member(name));
  method.repetitions = read_optional<int>(entry, "repetitions");
  method.timeout_s = read_optional<double>(entry, "timeout_s");
  method.mem_limit_mib = read_optional<std::int64_t>(entry, "mem_limit_mib");
  method.search = entry.value("search", true);
  method.note = entry.value("note", "");
  if (method.protocol == "default" && !method.parameters.empty() && method.note.empty())
    place.fail("gives parameters under the protocol default; say in its 'note' whose default they are");
  return method;
}

bool is_same_entry(const PlanMethod& a, const PlanMethod& b) {
  return a.method == b.method && a.protocol == b.protocol;
}

std::vector<PlanMethod> read_methods(const std::vector<PlanEntry>& entries) {
  std::vector<PlanMethod> methods;
  for (const auto& [entry, place] : entries) {
    const PlanMethod added = read_method(entry, place);
    for (const PlanMethod& other : methods) {
      if (is_same_entry(other, added)) {
        place.fail("repeats the method '" + added.method + "' with the protocol '" + added.protocol +
                   "'; their runs would have the same names, so leave one out");
      }
      if (other.method == added.method && other.mem_limit_mib != added.mem_limit_mib) {
        place.fail(
            "gives '" + added.method +
            "' another mem_limit_mib than its other entry; they share a worker, so give both the same");
      }
    }
    methods.push_back(added);
  }
  return methods;
}

/// A number, or the word of which the schema says what it stands for.
std::uint64_t read_seed(const json& seed) {
  return seed.is_string() ? release_seed() : seed.get<std::uint64_t>();
}

PlanAxis read_axis(const json& axis) {
  const auto of = axis["of"].get<std::string>();
  return {of, axis.value("title", of), axis.value("unit", "")};
}

/// "line 3, column 5" of a byte in a text; bytes count from 1.
std::string place_of_byte(const std::string& text, std::size_t byte) {
  const std::size_t end = byte == 0 ? 0 : std::min(byte - 1, text.size());
  const std::string_view before = std::string_view(text).substr(0, end);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t last = before.rfind('\n');
  const std::size_t column = last == std::string_view::npos ? end + 1 : end - last;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

std::vector<std::string> plan_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".json" && !name.ends_with(".schema")) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

json parameter_to_json(const ParameterChoice& choice) {
  if (const auto* rule = std::get_if<RuleChoice>(&choice)) return {{"rule", rule->rule}};
  if (const auto* scaled = std::get_if<ScaledChoice>(&choice))
    return {{"scaled", scaled->factor}, {"power", scaled->power}};
  json result;
  if (const auto* cases = std::get_if<CaseChoice>(&choice)) {
    for (const auto& [key, value] : cases->values) result["cases"][key] = finite_or_null(value);
  } else {
    result = finite_or_null(std::get<double>(choice));
  }
  return result;
}

json method_to_json(const PlanMethod& method) {
  json parameters = json::object();
  for (const auto& [name, choice] : method.parameters) parameters[name] = parameter_to_json(choice);
  json result = {{"method", method.method}, {"protocol", method.protocol}, {"parameters", parameters}};
  if (!method.datasets.empty()) result["datasets"] = method.datasets;
  if (method.repetitions) result["repetitions"] = *method.repetitions;
  if (method.timeout_s) result["timeout_s"] = *method.timeout_s;
  if (method.mem_limit_mib) result["mem_limit_mib"] = *method.mem_limit_mib;
  if (!method.search) result["search"] = false;
  if (!method.note.empty()) result["note"] = method.note;
  return result;
}

}  // namespace

json parse_json(const std::string& text, const std::string& source) {
  try {
    return parse_json_text(text);
  } catch (const RepeatedKey& error) {
    throw ConfigurationError(source + " " + error.what());
  } catch (const json::parse_error& error) {
    throw ConfigurationError(source + " is not JSON: mend it at " + place_of_byte(text, error.byte));
  } catch (const json::out_of_range&) {
    throw ConfigurationError(source + " has a number that is too large for a double; give a smaller one");
  }
}

Plan parse_plan(const std::string& text, const std::string& source) {
  const json document = parse_json(text, source);
  const Place root(source, "");
  check_plan_schema(document, root);
  Plan plan;
  plan.name = document["name"].get<std::string>();
  plan.title = document.value("title", plan.name);
  plan.paper = document.value("paper", plan.paper);
  plan.notes = document.value("notes", plan.notes);
  plan.repetitions = document.value("repetitions", plan.repetitions);
  plan.passes = document.value("passes", plan.passes);
  plan.warmup = document.value("warmup", plan.warmup);
  plan.timeout_s = document.value("timeout_s", plan.timeout_s);
  plan.mem_limit_mib = document.value("mem_limit_mib", plan.mem_limit_mib);
  if (document.contains("seed")) plan.seed = read_seed(document["seed"]);
  plan.filter = document.value("filter", plan.filter);
  plan.accepted = document.value("accepted", plan.accepted);
  plan.draws = document.value("draws", plan.draws);
  if (document.contains("axis")) plan.axis = read_axis(document["axis"]);
  plan.cases = document["cases"];
  plan.expanded_cases = read_cases(plan.cases, root.member("cases"));
  plan.methods = read_methods(entries_of(document, root));
  return plan;
}

Plan load_plan(const std::string& name_or_path, const fs::path& folder) {
  const fs::path known = folder / (name_or_path + ".json");
  const bool is_path = name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json") ||
                       (!fs::exists(known) && fs::is_regular_file(name_or_path));
  const fs::path path = is_path ? fs::path(name_or_path) : known;
  const std::optional<std::string> text = read_text_file(path);
  if (!text) {
    const std::vector<std::string> names = plan_names(folder);
    throw ConfigurationError("there is no plan '" + name_or_path + "'; " +
                             (names.empty() ? "give the path of a plan's JSON file"
                                            : "known are " + join_words(names) + ", or give a file's path"));
  }
  return parse_plan(*text, is_path ? name_or_path : "plan '" + name_or_path + "'");
}

std::vector<PlanMethod> parse_plan_methods(const json& entries, const std::string& method,
                                           const std::string& source, const std::string& path) {
  if (entries.empty()) return {};
  if (std::any_of(entries.begin(), entries.end(),
                  [](const json& entry) { return entry.contains("method"); })) {
    throw ConfigurationError(source + ": " + path + " are all of this method; leave out the key 'method'");
  }
  json complete = entries;
  for (json& entry : complete) entry["method"] = method;
  const Place place(source, path);
  check_methods_schema(complete, place);
  std::vector<PlanEntry> own;
  for (std::size_t i = 0; i < complete.size(); ++i) own.push_back({complete[i], place.element(i)});
  return read_methods(own);
}

void add_methods(Plan& plan, const std::vector<PlanMethod>& methods) {
  for (const PlanMethod& added : methods) {
    const auto same = [&](const PlanMethod& other) { return is_same_entry(other, added); };
    if (std::ranges::any_of(plan.methods, same)) {
      throw ConfigurationError("the plan '" + plan.name + "' measures '" + added.method +
                               "' with the protocol '" + added.protocol + "' already; leave out --with " +
                               added.method);
    }
    plan.methods.push_back(added);
  }
}

json plan_to_json(const Plan& plan) {
  json methods = json::array();
  for (const PlanMethod& method : plan.methods) methods.push_back(method_to_json(method));
  json result = {{"schema_version", kPlanSchemaVersion},
                 {"name", plan.name},
                 {"title", plan.title},
                 {"repetitions", plan.repetitions},
                 {"warmup", plan.warmup},
                 {"timeout_s", plan.timeout_s},
                 {"mem_limit_mib", plan.mem_limit_mib},
                 {"seed", plan.seed},
                 {"cases", plan.cases},
                 {"methods", methods}};
  if (plan.passes != 1) result["passes"] = plan.passes;
  if (!plan.filter.empty()) result["filter"] = plan.filter;
  if (!plan.accepted.empty()) result["accepted"] = plan.accepted;
  if (plan.draws != 0) result["draws"] = plan.draws;
  if (plan.axis)
    result["axis"] = {{"of", plan.axis->of}, {"title", plan.axis->title}, {"unit", plan.axis->unit}};
  if (!plan.paper.empty()) result["paper"] = plan.paper;
  if (!plan.notes.empty()) result["notes"] = plan.notes;
  return result;
}

void use_recordings(Plan& plan, std::size_t count) {
  bool found = false;
  for (json& group : plan.cases) {
    if (group.at("dataset") != kSimulatedFloor) continue;
    group["dataset"] = kRecordedFloor;
    group["members"] = count;
    found = true;
  }
  const auto is_low = [](const json& group) { return group.at("dataset") == kLowFloor; };
  plan.cases.erase(std::remove_if(plan.cases.begin(), plan.cases.end(), is_low), plan.cases.end());
  if (std::ranges::any_of(plan.expanded_cases, [](const PlanCase& one) { return is_real(one.dataset); })) {
    plan.cases.push_back({{"dataset", kRealRecording}, {"members", count}});
    found = true;
  }
  if (!found) {
    throw ConfigurationError("the plan '" + plan.name +
                             "' has no simulated floors that recordings could take the place of, and no real "
                             "points; leave out --recordings, or run the plan 'rgbd' or 'real'");
  }
  plan.expanded_cases = read_cases(plan.cases, {"plan '" + plan.name + "' with recordings", "cases"});
}

}  // namespace hullbench::plan
