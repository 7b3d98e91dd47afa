#include "benchmarks/plan/field.hpp"

#include <cstddef>
#include <map>
#include <set>
#include <string>

#include "benchmarks/base/words.hpp"
#include "benchmarks/plan/embedded.hpp"

namespace hullbench::plan {
namespace {

const json& field() {
  static const json entries = json::parse(kFieldJson).at("methods");
  return entries;
}

/// "polylidar/paper"
std::string way_of(const json& entry) {
  return entry["method"].get<std::string>() + "/" + entry["protocol"].get<std::string>();
}

bool is_named(const json& entry, const std::string& name) {
  return name == entry["method"] || name == entry["protocol"] || name == way_of(entry);
}

[[noreturn]] void refuse_name(const std::string& name, const Place& place) {
  std::set<std::string> methods;
  std::set<std::string> protocols;
  for (const json& entry : field()) {
    methods.insert(entry["method"].get<std::string>());
    protocols.insert(entry["protocol"].get<std::string>());
  }
  place.fail("names '" + name + "', which the field has not; name a protocol (" +
             join_words({protocols.begin(), protocols.end()}) + "), a method (" +
             join_words({methods.begin(), methods.end()}) + ") or a METHOD/PROTOCOL of the plan 'field'");
}

/// Takes the entries of the field that the list at `place` names, or leaves them out again.
void choose(const json& names, bool take, std::vector<bool>& taken, const Place& place) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto name = names[i].get<std::string>();
    bool is_known = false;
    bool says_something = false;
    for (std::size_t e = 0; e < taken.size(); ++e) {
      if (!is_named(field()[e], name)) continue;
      is_known = true;
      says_something = says_something || taken[e] != take;
      taken[e] = take;
    }
    if (!is_known) refuse_name(name, place.element(i));
    if (!says_something) {
      place.element(i).fail("names '" + name + "', which is " +
                            (take ? "taken already" : "not taken anyway") + "; leave it out");
    }
  }
}

}  // namespace

std::vector<PlanEntry> entries_of(const json& plan, const Place& place) {
  std::vector<bool> taken(field().size());
  choose(plan.value("field", json::array()), true, taken, place.member("field"));
  choose(plan.value("without", json::array()), false, taken, place.member("without"));
  std::vector<PlanEntry> entries;
  std::map<std::string, std::size_t> unchanged;  // the places in `entries` of what can still be changed
  for (std::size_t e = 0; e < taken.size(); ++e) {
    if (!taken[e]) continue;
    unchanged[way_of(field()[e])] = entries.size();
    entries.push_back({field()[e], place.member("field")});
  }
  const json own = plan.value("methods", json::array());
  for (std::size_t i = 0; i < own.size(); ++i) {
    const Place there = place.member("methods").element(i);
    const auto changed = unchanged.find(way_of(own[i]));
    if (changed == unchanged.end()) {
      entries.push_back({own[i], there});
      continue;
    }
    PlanEntry& entry = entries[changed->second];
    // It says whose default the parameters were.
    if (own[i]["protocol"] == "default" && own[i].contains("parameters")) entry.value.erase("note");
    json parameters = entry.value.value("parameters", json::object());
    if (own[i].contains("parameters")) parameters.update(own[i]["parameters"]);
    entry.value.update(own[i]);
    if (!parameters.empty()) entry.value["parameters"] = std::move(parameters);
    entry.place = there;
    unchanged.erase(changed);
  }
  if (entries.empty()) place.member("without").fail("leaves no method; take one out of it");
  return entries;
}

}  // namespace hullbench::plan
