#include "benchmarks/tune/tuned_plan.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/tune/analysis.hpp"

namespace hullbench::tune {
namespace {

/// The places in the tuning of the plan's test cases that satisfy a condition.
template <typename Condition>
std::vector<std::size_t> cases_of(const plan::Plan& plan, const Tuning& tuning, Condition condition) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < tuning.cases.size(); ++i) {
    const TuningCase& one = tuning.cases[i];
    const auto same = [&](const plan::PlanCase& other) { return other.key() == one.plan_case.key(); };
    if (one.side() == Side::kTest && one.seed == plan.seed &&
        std::ranges::any_of(plan.expanded_cases, same) && condition(i))
      result.push_back(i);
  }
  return result;
}

/// The data sets of these cases; empty, for all, when the plan has no others.
std::vector<std::string> datasets_of(const plan::Plan& plan, const Tuning& tuning,
                                     const std::vector<std::size_t>& cases) {
  std::set<std::string> all;
  for (const plan::PlanCase& one : plan.expanded_cases) all.insert(one.dataset);
  std::set<std::string> some;
  for (const std::size_t i : cases) some.insert(tuning.cases[i].plan_case.dataset);
  return some.size() == all.size() ? std::vector<std::string>()
                                   : std::vector<std::string>(some.begin(), some.end());
}

std::map<std::string, plan::ParameterChoice> as_choices(const Parameters& parameters) {
  return {parameters.begin(), parameters.end()};
}

/// With the words and limits that the plan has for the method anyway.
plan::PlanMethod entry_for(const plan::Plan& plan, const std::string& method, const std::string& protocol) {
  const auto like = std::ranges::find_if(
      plan.methods, [&](const plan::PlanMethod& other) { return other.method == method; });
  plan::PlanMethod entry;
  if (like != plan.methods.end()) entry = *like;
  entry.method = method;
  entry.protocol = protocol;
  entry.datasets.clear();
  entry.parameters.clear();
  entry.note.clear();
  return entry;
}

/// Of a method that the plan does not name. What the default of the others is the plan says: a parameter that
/// can be left out is not always one that anybody leaves out.
void add_default(plan::Plan& result, const plan::Plan& plan, const MethodTuning& method) {
  const bool named = std::ranges::any_of(
      plan.methods, [&](const plan::PlanMethod& entry) { return entry.method == method.name; });
  if (named || !has_defaults(*method.info)) return;
  plan::PlanMethod entry = entry_for(plan, method.name, "default");
  entry.parameters = as_choices(fixed_parameters(*method.info));
  entry.note = "Of the method's own parameters those that it has without being told, and holes.";
  result.methods.push_back(entry);
}

void add_tuned(plan::Plan& result, const plan::Plan& plan, const Tuning& tuning, const MethodTuning& method) {
  const auto tuned = choose_tuned(method);
  if (!tuned) return;
  const auto cases = cases_of(plan, tuning, [&](std::size_t i) { return !method.cases[i].sweep.empty(); });
  if (cases.empty()) return;
  plan::PlanMethod entry = entry_for(plan, method.name, "tuned");
  entry.datasets = datasets_of(plan, tuning, cases);
  entry.parameters = as_choices(fixed_parameters(method, tuned->holes));
  entry.parameters[method.axis->parameter] =
      method.axis->spacings ? plan::ParameterChoice(plan::ScaledChoice{tuned->position, method.axis->power})
                            : plan::ParameterChoice(tuned->position);
  entry.note = "One value for all shapes, with the smallest median error on " +
               std::to_string(tuned->training_cases) + " training cases.";
  result.methods.push_back(entry);
}

void add_oracle(plan::Plan& result, const plan::Plan& plan, const Tuning& tuning,
                const MethodTuning& method) {
  if (!method.axis) return;
  // A choice that the method itself refused is none.
  const auto has_choice = [&](std::size_t i) {
    const record::RunRecord* best = best_evaluation(method.cases[i]);
    return best != nullptr && best->parameters.size() == method.info->parameters.size();
  };
  std::set<std::string> without;
  for (const std::size_t i : cases_of(plan, tuning, [&](std::size_t i) { return !has_choice(i); }))
    without.insert(tuning.cases[i].plan_case.dataset);
  const auto cases = cases_of(
      plan, tuning, [&](std::size_t i) { return !without.contains(tuning.cases[i].plan_case.dataset); });
  if (cases.empty()) return;
  plan::PlanMethod entry = entry_for(plan, method.name, "oracle");
  entry.datasets = datasets_of(plan, tuning, cases);
  for (const ParameterInfo& parameter : method.info->parameters) {
    plan::CaseChoice choice;
    std::set<double> different;
    for (const std::size_t i : cases) {
      const double value = best_evaluation(method.cases[i])->parameters.at(parameter.name);
      choice.values[tuning.cases[i].plan_case.key()] = value;
      different.insert(value);
    }
    entry.parameters[parameter.name] = different.size() == 1 ? plan::ParameterChoice(*different.begin())
                                                             : plan::ParameterChoice(std::move(choice));
  }
  entry.note = "The best of a search on each instance: what this method could give at best.";
  result.methods.push_back(entry);
}

void keep_test_cases(plan::Plan& plan) {
  std::erase_if(plan.expanded_cases,
                [](const plan::PlanCase& one) { return side_of(one.dataset) != Side::kTest; });
  plan.cases = json::array();
  for (const plan::PlanCase& one : plan.expanded_cases) {
    json group = {{"dataset", one.dataset}, {"holes", {one.holes}}};
    if (one.n > 0) group["n"] = {one.n};
    plan.cases.push_back(std::move(group));
  }
}

}  // namespace

plan::Plan tuned_plan(const plan::Plan& plan, const Tuning& tuning) {
  plan::Plan result = plan;
  if (plan.accepted.empty()) keep_test_cases(result);
  const plan::Plan kept = result;
  result.name += "-tuned";
  result.title += ", parameters chosen by hullbench tune";
  result.paper.clear();
  result.filter.clear();
  result.methods.clear();
  for (const MethodTuning& method : tuning.methods) {
    if (!method.info) continue;
    for (const plan::PlanMethod& entry : plan.methods) {
      if (entry.method == method.name && entry.protocol != "tuned" && entry.protocol != "oracle")
        result.methods.push_back(entry);
    }
    add_default(result, kept, method);
    add_tuned(result, kept, tuning, method);
    add_oracle(result, kept, tuning, method);
  }
  return result;
}

}  // namespace hullbench::tune
