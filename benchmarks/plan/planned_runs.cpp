// What a plan comes to: its runs and their parameters, and whether there is all that they ask for.
#include <algorithm>
#include <regex>
#include <stdexcept>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/plan/plan.hpp"

namespace hullbench::plan {
namespace {

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
  if (std::ranges::find(known, name) != known.end()) return;
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

void check_plan(const Plan& plan, const std::vector<std::string>& methods,
                const std::vector<DatasetInfo>& datasets) {
  for (const PlanCase& plan_case : plan.expanded_cases) require_dataset(plan_case, datasets, plan.name);
  require_axis(plan);
  for (const PlanMethod& method : plan.methods) {
    require_known("method", method.method, methods, plan.name);
    for (const std::string& dataset : method.datasets) {
      const auto same = [&](const PlanCase& plan_case) { return is_dataset_of(plan_case, dataset); };
      if (std::ranges::none_of(plan.expanded_cases, same)) {
        throw ConfigurationError("the plan '" + plan.name + "' lets " + method.method +
                                 " keep to the data set '" + dataset + "', of which it has no case");
      }
    }
    require_values(plan, method);
  }
}

bool applies(const PlanMethod& method, const PlanCase& plan_case) {
  return method.datasets.empty() || std::ranges::any_of(method.datasets, [&](const std::string& name) {
           return is_dataset_of(plan_case, name);
         });
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
