#include "benchmarks/plan/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/record/record.hpp"
#include "datasets/stress.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench::plan {
namespace {

using nlohmann::json;

constexpr int kPlanSchemaVersion = 1;
constexpr auto kMaxPoints = static_cast<std::int64_t>(polylidar::kMaxPoints);
constexpr std::int64_t kMaxMembers = 1'000'000;

/// Who may choose parameters, and whether with a look at the ground truth.
struct Protocol {
  const char* name;
  bool may_read_ground_truth;
};
constexpr std::array<Protocol, 5> kProtocols = {
    {{"paper", true}, {"default", false}, {"auto", false}, {"tuned", false}, {"oracle", true}}};

bool is_name_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

bool is_name_letter_or_mark(char c) {
  return is_name_letter(c) || c == '~' || c == ':' || c == '.';
}

/// A value in a plan and where it stands, for messages such as "plan 'states': methods[2].protocol must be
/// ...".
class Node {
 public:
  Node(const json& value, std::string source, std::string path)
      : value_(value), source_(std::move(source)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw ConfigurationError(source_ + ": " + (path_.empty() ? "the plan" : path_) + " " + what);
  }

  const json& value() const { return value_; }

  void only_keys(const std::vector<std::string>& known) const {
    if (!value_.is_object()) fail("must be an object");
    for (const auto& [key, unused] : value_.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        child(key).fail("is not a key that is known here; known are " + join_words(known));
      }
    }
  }

  bool has(const std::string& key) const { return value_.contains(key); }

  /// The member `key`; it must be there.
  Node at(const std::string& key) const {
    if (!has(key)) fail("lacks the key '" + key + "'");
    return child(key);
  }

  /// The elements; there must be one at least.
  std::vector<Node> elements() const {
    if (!value_.is_array() || value_.empty()) fail("must be a list with at least one element");
    std::vector<Node> result;
    for (std::size_t i = 0; i < value_.size(); ++i) {
      result.emplace_back(value_[i], source_, path_ + "[" + std::to_string(i) + "]");
    }
    return result;
  }

  /// Name and node of every member.
  std::vector<std::pair<std::string, Node>> members() const {
    if (!value_.is_object()) fail("must be an object");
    std::vector<std::pair<std::string, Node>> result;
    for (const auto& [key, unused] : value_.items()) result.emplace_back(key, child(key));
    return result;
  }

  std::string text() const {
    if (!value_.is_string()) fail("must be a string");
    return value_.get<std::string>();
  }

  /// Not empty and of letters that can stand in a run's name.
  std::string identifier() const {
    std::string name = text();
    const bool good = !name.empty() && std::all_of(name.begin(), name.end(), is_name_letter);
    if (!good) fail("must be a name of small letters, digits, '_' and '-', not '" + name + "'");
    return name;
  }

  /// A name of a data set, perhaps with a stress behind it; whether there is one is not looked at.
  std::string dataset_name() const {
    const std::string name = text();
    const std::size_t mark = std::min(name.find('~'), name.size());
    const bool good =
        mark > 0 && std::all_of(name.begin(), name.end(), is_name_letter_or_mark) &&
        std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(mark), is_name_letter);
    if (!good) {
      fail(
          "must be a data set's name of small letters, digits, '_' and '-', with a stress behind it or "
          "without "
          "(ca, ca~noise:0.5), not '" +
          name + "'");
    }
    return name;
  }

  bool boolean() const {
    if (!value_.is_boolean()) fail("must be true or false");
    return value_.get<bool>();
  }

  double number(double minimum, double maximum) const {
    if (!value_.is_number()) fail("must be a number");
    const double result = value_.get<double>();
    if (!(result >= minimum && result <= maximum)) fail_range(minimum, maximum);
    return result;
  }

  std::int64_t integer(std::int64_t minimum, std::int64_t maximum) const {
    const bool fits =
        value_.is_number_integer() &&
        (!value_.is_number_unsigned() ||
         value_.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()));
    if (!fits || value_.get<std::int64_t>() < minimum || value_.get<std::int64_t>() > maximum) {
      fail("must be a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum));
    }
    return value_.get<std::int64_t>();
  }

  std::uint64_t seed() const {
    if (!value_.is_number_unsigned()) fail("must be a whole number from 0 to 2^64 - 1");
    return value_.get<std::uint64_t>();
  }

 private:
  Node child(const std::string& key) const {
    static const json nothing;
    return {value_.contains(key) ? value_[key] : nothing, source_, path_.empty() ? key : path_ + "." + key};
  }

  [[noreturn]] void fail_range(double minimum, double maximum) const {
    std::ostringstream text;
    text << "must be a number from " << minimum << " to " << maximum;
    fail(text.str());
  }

  const json& value_;
  std::string source_;
  std::string path_;
};

template <typename Value>
void read_values(const Node& node, std::vector<Value>& values, Value (*read)(const Node&)) {
  std::set<Value> seen;
  for (const Node& element : node.elements()) {
    values.push_back(read(element));
    if (!seen.insert(values.back()).second) element.fail("is there twice; leave one out");
  }
}

std::vector<std::string> read_dataset_names(const Node& node) {
  std::vector<std::string> names;
  read_values<std::string>(node, names, [](const Node& value) { return value.dataset_name(); });
  return names;
}

/// "noise:0.5" as it stands behind the '~' of a data set's name.
std::string read_stress(const Node& node) {
  const std::string stress = node.text();
  if (!split_stress("~" + stress)) {
    std::vector<std::string> known;
    for (const StressKind& kind : stress_kinds()) known.push_back(kind.name);
    node.fail("must be one of " + join_words(known) +
              ", with a ':' and a level in its range behind it ('hullbench list'), not '" + stress + "'");
  }
  return stress;
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

std::vector<std::string> read_case_datasets(const Node& group) {
  const Node node = group.at("dataset");
  std::vector<std::string> names =
      node.value().is_array() ? read_dataset_names(node) : std::vector{node.dataset_name()};
  std::vector<std::string> endings;
  if (group.has("members")) {
    const std::int64_t count = group.at("members").integer(1, kMaxMembers);
    for (std::int64_t number = 1; number <= count; ++number) endings.push_back("-" + std::to_string(number));
    names = with_endings(names, endings);
  }
  if (group.has("stress")) {
    endings.clear();
    read_values<std::string>(group.at("stress"), endings,
                             [](const Node& value) { return "~" + read_stress(value); });
    names = with_endings(names, endings);
  }
  return names;
}

/// The cases of one element of `cases`: data set by data set, of each first all sizes with the first value of
/// `holes`.
std::vector<PlanCase> read_case_group(const Node& group) {
  group.only_keys({"dataset", "members", "stress", "holes", "n"});
  const std::vector<std::string> datasets = read_case_datasets(group);
  std::vector<bool> holes = {false};
  if (group.has("holes")) {
    holes.clear();
    for (const Node& value : group.at("holes").elements()) holes.push_back(value.boolean());
  }
  std::vector<std::int64_t> sizes;
  if (group.has("n")) {
    read_values<std::int64_t>(group.at("n"), sizes,
                              [](const Node& value) { return value.integer(3, kMaxPoints); });
  } else {
    sizes.push_back(0);
  }
  std::vector<PlanCase> cases;
  for (const std::string& dataset : datasets) {
    for (const bool with_holes : holes) {
      for (const std::int64_t n : sizes) cases.push_back({dataset, with_holes, n});
    }
  }
  return cases;
}

void read_cases(const Node& node, std::vector<PlanCase>& cases) {
  std::set<std::string> seen;
  for (const Node& group : node.elements()) {
    for (const PlanCase& one : read_case_group(group)) {
      cases.push_back(one);
      if (!seen.insert(one.shape() + " " + std::to_string(one.n)).second) {
        group.fail("has the case " + one.shape() + " with n = " + std::to_string(one.n) +
                   " for the second time; leave one out");
      }
    }
  }
}

const Protocol& find_protocol(const Node& node) {
  const std::string name = node.text();
  std::vector<std::string> names;
  for (const Protocol& protocol : kProtocols) {
    if (name == protocol.name) return protocol;
    names.emplace_back(protocol.name);
  }
  node.fail("must be one of " + join_words(names) + ", not '" + name + "'");
}

RuleChoice read_rule(const Node& node, const Protocol& protocol) {
  const std::string name = node.text();
  const ParameterRule* rule = find_rule(name);
  if (!rule) node.fail("names the unknown rule '" + name + "'; known are " + join_words(rule_names()));
  if (rule->reads_ground_truth && !protocol.may_read_ground_truth) {
    node.fail("names the rule '" + name +
              "', which reads the ground truth: the protocol must be paper or oracle, not " + protocol.name);
  }
  return {name};
}

/// A number, or infinity for null.
double read_value(const Node& node) {
  constexpr double kLimit = std::numeric_limits<double>::max();
  return node.value().is_null() ? std::numeric_limits<double>::infinity() : node.number(-kLimit, kLimit);
}

ScaledChoice read_scaled(const Node& node) {
  ScaledChoice choice;
  choice.factor = node.at("scaled").number(0, 1e100);
  if (node.has("power")) choice.power = static_cast<int>(node.at("power").integer(1, 2));
  return choice;
}

ParameterChoice read_parameter(const Node& node, const Protocol& protocol) {
  if (node.value().is_number() || node.value().is_null()) return read_value(node);
  if (!node.value().is_object())
    node.fail("must be a number, null or an object with the key 'rule', 'scaled' or 'cases'");
  node.only_keys({"rule", "scaled", "power", "cases"});
  if (node.has("rule") + node.has("scaled") + node.has("cases") != 1 ||
      node.has("power") > node.has("scaled"))
    node.fail("must have one of the keys 'rule', 'scaled' (with or without 'power') and 'cases'");
  if (node.has("rule")) return read_rule(node.at("rule"), protocol);
  if (node.has("scaled")) return read_scaled(node);
  CaseChoice choice;
  for (const auto& [key, value] : node.at("cases").members()) choice.values[key] = read_value(value);
  return choice;
}

int read_repetitions(const Node& node) {
  return static_cast<int>(node.at("repetitions").integer(1, 1'000'000));
}

double read_timeout(const Node& node) {
  return node.at("timeout_s").number(0.001, 1e6);
}

std::int64_t read_memory_limit(const Node& node) {
  return node.at("mem_limit_mib").integer(64, 1 << 30);
}

PlanMethod read_method(const Node& node) {
  node.only_keys(
      {"method", "protocol", "datasets", "repetitions", "timeout_s", "mem_limit_mib", "parameters", "note"});
  PlanMethod method;
  method.method = node.at("method").identifier();
  const Protocol& protocol = find_protocol(node.at("protocol"));
  method.protocol = protocol.name;
  if (node.has("datasets")) method.datasets = read_dataset_names(node.at("datasets"));
  if (node.has("parameters")) {
    for (const auto& [name, value] : node.at("parameters").members()) {
      method.parameters[name] = read_parameter(value, protocol);
    }
  }
  if (node.has("repetitions")) method.repetitions = read_repetitions(node);
  if (node.has("timeout_s")) method.timeout_s = read_timeout(node);
  if (node.has("mem_limit_mib")) method.mem_limit_mib = read_memory_limit(node);
  if (node.has("note")) method.note = node.at("note").text();
  if (method.protocol == "default" && !method.parameters.empty() && method.note.empty())
    node.fail("gives parameters under the protocol default; say in its 'note' whose default they are");
  return method;
}

void read_methods(const Node& node, std::vector<PlanMethod>& methods) {
  for (const Node& element : node.elements()) {
    methods.push_back(read_method(element));
    const PlanMethod& added = methods.back();
    const auto same = [&](const PlanMethod& other) {
      return other.method == added.method && other.protocol == added.protocol;
    };
    if (std::count_if(methods.begin(), methods.end(), same) > 1) {
      element.fail("repeats the method '" + added.method + "' with the protocol '" + added.protocol +
                   "'; their runs would have the same names, so leave one out");
    }
    const auto limited_otherwise = [&](const PlanMethod& other) {
      return other.method == added.method && other.mem_limit_mib != added.mem_limit_mib;
    };
    if (std::any_of(methods.begin(), methods.end(), limited_otherwise)) {
      element.fail(
          "gives '" + added.method +
          "' another mem_limit_mib than its other entry; they share a worker, so give both the same");
    }
  }
}

PlanAxis read_axis(const Node& node) {
  node.only_keys({"of", "title", "unit"});
  PlanAxis axis;
  axis.of = node.at("of").identifier();
  axis.title = node.has("title") ? node.at("title").text() : axis.of;
  if (node.has("unit")) axis.unit = node.at("unit").text();
  return axis;
}

std::string read_accepted(const Node& node) {
  const std::string name = node.text();
  std::vector<std::string> names;
  for (const record::Status status : record::kAllStatuses) names.push_back(to_string(status));
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    node.fail("must be one of " + join_words(names) + ", not '" + name + "'");
  }
  return name;
}

/// "line 3, column 5" of a byte in a text; bytes count from 1.
std::string place_of_byte(const std::string& text, std::size_t byte) {
  const std::size_t end = byte == 0 ? 0 : std::min(byte - 1, text.size());
  const std::string_view before = std::string_view(text).substr(0, end);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t last = before.rfind('\n');
  const std::size_t column = last == std::string_view::npos ? end + 1 : end - last;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

json parse_json(const std::string& text, const std::string& source) {
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    throw ConfigurationError(source + " is not JSON: mend it at " + place_of_byte(text, error.byte));
  }
}

std::vector<std::string> plan_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

json value_to_json(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json parameter_to_json(const ParameterChoice& choice) {
  if (const auto* rule = std::get_if<RuleChoice>(&choice)) return {{"rule", rule->rule}};
  if (const auto* scaled = std::get_if<ScaledChoice>(&choice))
    return {{"scaled", scaled->factor}, {"power", scaled->power}};
  json result;
  if (const auto* cases = std::get_if<CaseChoice>(&choice)) {
    for (const auto& [key, value] : cases->values) result["cases"][key] = value_to_json(value);
  } else {
    result = value_to_json(std::get<double>(choice));
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
  if (!method.note.empty()) result["note"] = method.note;
  return result;
}

/// Whether `name` is the case's data set, that without its stress, or the family it belongs to.
bool is_dataset_of(const PlanCase& plan_case, const std::string& name) {
  if (plan_case.dataset == name) return true;
  const std::string unstressed = plan_case.dataset.substr(0, plan_case.dataset.find('~'));
  if (unstressed == name) return true;
  const auto member = split_member_name(unstressed);
  return member && member->first == name;
}

std::string name_of(const PlanMethod& method, const PlanCase& plan_case) {
  return method.method + "/" + plan_case.name() + "/protocol:" + method.protocol;
}

/// That there is what a case asks for.
void require_dataset(const PlanCase& plan_case, const std::vector<DatasetInfo>& datasets,
                     const std::string& plan) {
  const DatasetInfo* info = find_dataset(datasets, plan_case.dataset);
  const auto refuse = [&](const std::string& what) {
    throw ConfigurationError("the plan '" + plan + "' " + what);
  };
  if (info == nullptr) {
    std::vector<std::string> known;
    known.reserve(datasets.size());
    for (const DatasetInfo& dataset : datasets) {
      known.push_back(dataset.members == 0 ? dataset.name
                                           : dataset.name + "-1 to -" + std::to_string(dataset.members));
    }
    refuse("names the data set '" + plan_case.dataset + "', which is not known; known are " +
           join_words(known) + " ('hullbench list')");
  }
  if (plan_case.holes && !info->has_holes_variant) {
    refuse("asks for " + plan_case.dataset +
           " with holes, which there is not; leave out true in its 'holes'");
  }
  if (plan_case.n == 0 && !info->own_points) {
    refuse("gives no 'n' for " + plan_case.dataset +
           ", which has no points of its own; add the numbers of points");
  }
  if (plan_case.n != 0 && info->own_points) {
    refuse("gives 'n' for " + plan_case.dataset + ", which comes with its points; leave it out");
  }
}

/// The value for a case; null when there is none.
const double* find_value(const CaseChoice& choice, const PlanCase& plan_case) {
  auto found = choice.values.find(plan_case.key());
  if (found == choice.values.end()) found = choice.values.find(plan_case.shape());
  return found == choice.values.end() ? nullptr : &found->second;
}

void require_known(const std::string& what, const std::string& name, const std::vector<std::string>& known,
                   const std::string& plan) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  throw ConfigurationError("the plan '" + plan + "' names the " + what + " '" + name +
                           "', which is not known; known are " + join_words(known) + " ('hullbench list')");
}

/// Every case must have a place on the plan's axis.
void require_axis(const Plan& plan) {
  if (!plan.axis || plan.axis->of == "n" || plan.axis->of == "sampling") return;
  for (const PlanCase& plan_case : plan.expanded_cases) {
    if (levels_of(plan_case.dataset).contains(plan.axis->of)) continue;
    throw ConfigurationError("the plan '" + plan.name + "' has the axis '" + plan.axis->of +
                             "', of which its case " + plan_case.dataset +
                             " has no level; choose n, sampling or a level of every case");
  }
}

/// A parameter that is given case by case must have a value for every case of the method.
void require_values(const Plan& plan, const PlanMethod& method) {
  for (const PlanCase& plan_case : plan.expanded_cases) {
    if (!applies(method, plan_case)) continue;
    for (const auto& [name, choice] : method.parameters) {
      const auto* cases = std::get_if<CaseChoice>(&choice);
      if (!cases || find_value(*cases, plan_case)) continue;
      throw ConfigurationError("the plan '" + plan.name + "' gives " + method.method + " no '" + name +
                               "' for " + plan_case.shape() + "; add it to the parameter's cases");
    }
  }
}

}  // namespace

Plan parse_plan(const std::string& text, const std::string& source) {
  const json document = parse_json(text, source);
  const Node root(document, source, "");
  root.only_keys({"schema_version", "name", "title", "paper", "notes", "repetitions", "passes", "warmup",
                  "timeout_s", "mem_limit_mib", "seed", "filter", "accepted", "axis", "cases", "methods"});
  if (root.has("schema_version") && root.at("schema_version").value() != kPlanSchemaVersion) {
    root.at("schema_version").fail("must be " + std::to_string(kPlanSchemaVersion) + " for this program");
  }
  Plan plan;
  plan.name = root.at("name").identifier();
  plan.title = root.has("title") ? root.at("title").text() : plan.name;
  if (root.has("paper")) plan.paper = root.at("paper").text();
  if (root.has("notes")) {
    for (const Node& note : root.at("notes").elements()) plan.notes.push_back(note.text());
  }
  if (root.has("repetitions")) plan.repetitions = read_repetitions(root);
  if (root.has("passes")) plan.passes = static_cast<int>(root.at("passes").integer(1, kMaxPasses));
  if (root.has("warmup")) plan.warmup = static_cast<int>(root.at("warmup").integer(0, 1000));
  if (root.has("timeout_s")) plan.timeout_s = read_timeout(root);
  if (root.has("mem_limit_mib")) plan.mem_limit_mib = read_memory_limit(root);
  if (root.has("seed")) plan.seed = root.at("seed").seed();
  if (root.has("filter")) plan.filter = root.at("filter").text();
  if (root.has("axis")) plan.axis = read_axis(root.at("axis"));
  if (root.has("accepted")) read_values<std::string>(root.at("accepted"), plan.accepted, read_accepted);
  read_cases(root.at("cases"), plan.expanded_cases);
  plan.cases = document["cases"];
  read_methods(root.at("methods"), plan.methods);
  return plan;
}

Plan load_plan(const std::string& name_or_path, const std::filesystem::path& folder) {
  const bool is_path = name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json");
  const std::filesystem::path path =
      is_path ? std::filesystem::path(name_or_path) : folder / (name_or_path + ".json");
  std::ifstream in(path, std::ios::binary);
  if (!in.is_open() || std::filesystem::is_directory(path)) {
    const std::vector<std::string> names = plan_names(folder);
    throw ConfigurationError("there is no plan '" + name_or_path + "'; " +
                             (names.empty() ? "give the path of a plan's JSON file"
                                            : "known are " + join_words(names) + ", or give a file's path"));
  }
  const std::string text(std::istreambuf_iterator<char>(in), {});
  return parse_plan(text, is_path ? name_or_path : "plan '" + name_or_path + "'");
}

std::vector<PlanMethod> parse_plan_methods(const json& entries, const std::string& method,
                                           const std::string& source, const std::string& path) {
  if (entries.empty()) return {};
  json complete = entries;
  for (json& entry : complete) {
    if (entry.contains("method")) {
      throw ConfigurationError(source + ": " + path + " are all of this method; leave out the key 'method'");
    }
    entry["method"] = method;
  }
  std::vector<PlanMethod> methods;
  read_methods(Node(complete, source, path), methods);
  return methods;
}

void add_methods(Plan& plan, const std::vector<PlanMethod>& methods) {
  for (const PlanMethod& added : methods) {
    const auto same = [&](const PlanMethod& other) {
      return other.method == added.method && other.protocol == added.protocol;
    };
    if (std::any_of(plan.methods.begin(), plan.methods.end(), same)) {
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
  if (plan.axis)
    result["axis"] = {{"of", plan.axis->of}, {"title", plan.axis->title}, {"unit", plan.axis->unit}};
  if (!plan.paper.empty()) result["paper"] = plan.paper;
  if (!plan.notes.empty()) result["notes"] = plan.notes;
  return result;
}

void check_plan(const Plan& plan, const std::vector<std::string>& methods,
                const std::vector<DatasetInfo>& datasets) {
  for (const PlanCase& plan_case : plan.expanded_cases) require_dataset(plan_case, datasets, plan.name);
  require_axis(plan);
  for (const PlanMethod& method : plan.methods) {
    require_known("method", method.method, methods, plan.name);
    for (const std::string& dataset : method.datasets) {
      const auto same = [&](const PlanCase& plan_case) { return is_dataset_of(plan_case, dataset); };
      if (std::none_of(plan.expanded_cases.begin(), plan.expanded_cases.end(), same)) {
        throw ConfigurationError("the plan '" + plan.name + "' lets " + method.method +
                                 " keep to the data set '" + dataset + "', of which it has no case");
      }
    }
    require_values(plan, method);
  }
}

void use_recordings(Plan& plan, std::size_t count) {
  bool found = false;
  for (json& group : plan.cases) {
    if (group.at("dataset") != kSimulatedFloor) continue;
    group["dataset"] = kRecordedFloor;
    group["members"] = count;
    found = true;
  }
  if (!found) {
    throw ConfigurationError("the plan '" + plan.name +
                             "' has no simulated floors that recordings could take the place of; leave out "
                             "--recordings, or run the plan 'rgbd'");
  }
  plan.expanded_cases.clear();
  read_cases(Node(plan.cases, "plan '" + plan.name + "' with recordings", "cases"), plan.expanded_cases);
}

bool applies(const PlanMethod& method, const PlanCase& plan_case) {
  return method.datasets.empty() ||
         std::any_of(method.datasets.begin(), method.datasets.end(),
                     [&](const std::string& name) { return is_dataset_of(plan_case, name); });
}

int repetitions_of(const Plan& plan, const PlanMethod& method) {
  return method.repetitions.value_or(plan.repetitions);
}

int share_of_pass(int repetitions, int passes, int pass) {
  return (repetitions + passes - pass) / passes;
}

std::vector<PlannedRun> planned_runs(const Plan& plan, const std::string& filter) {
  std::regex pattern;
  try {
    pattern = std::regex(filter, std::regex::ECMAScript);
  } catch (const std::regex_error&) {
    throw ConfigurationError("the filter '" + filter +
                             "' is not a regular expression; mend it or quote its characters");
  }
  std::vector<PlannedRun> runs;
  for (std::size_t c = 0; c < plan.expanded_cases.size(); ++c) {
    for (std::size_t m = 0; m < plan.methods.size(); ++m) {
      if (!applies(plan.methods[m], plan.expanded_cases[c])) continue;
      std::string name = name_of(plan.methods[m], plan.expanded_cases[c]);
      if (!filter.empty() && !std::regex_search(name, pattern)) continue;
      runs.push_back({c, m, std::move(name)});
    }
  }
  return runs;
}

std::map<std::string, double> choose_parameters(const PlanMethod& method, const PlanCase& plan_case,
                                                const RuleInput& input) {
  std::map<std::string, double> result;
  for (const auto& [name, choice] : method.parameters) {
    if (const auto* rule = std::get_if<RuleChoice>(&choice)) {
      result[name] = find_rule(rule->rule)->value(input);
    } else if (const auto* scaled = std::get_if<ScaledChoice>(&choice)) {
      const double length = scaled->factor * mean_spacing(input.points);
      result[name] = scaled->power == 2 ? length * length : length;
    } else if (const auto* cases = std::get_if<CaseChoice>(&choice)) {
      const double* value = find_value(*cases, plan_case);
      if (value == nullptr) throw std::out_of_range("no value of '" + name + "' for " + plan_case.key());
      result[name] = *value;
    } else {
      result[name] = std::get<double>(choice);
    }
  }
  return result;
}

}  // namespace hullbench::plan
