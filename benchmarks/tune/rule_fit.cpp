#include "benchmarks/tune/rule_fit.hpp"

#include <exception>
#include <memory>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "adapters/adapter.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/metrics/metrics.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/tune/split.hpp"
#include "datasets/datasets.hpp"
#include "polylidar/concave_hull.hpp"

namespace hullbench::tune {
namespace {

std::unique_ptr<Adapter> make_method(const std::string& name) {
  const AdapterEntry* entry = find_adapter(name);
  if (!entry) throw std::runtime_error("this build has no method '" + name + "' to fit a rule with");
  return entry->make();
}

/// l2; kInfinitelyBad for an invalid result.
double error_of_result(const metrics::CaseScorer& scorer, const MultiPolygon& result) {
  const metrics::AreaScores scores = scorer.area_scores(result);
  return scores.valid ? scores.l2.value_or(kInfinitelyBad) : kInfinitelyBad;
}

double error_of_result(const metrics::CaseScorer& scorer, Adapter& method, const Parameters& parameters) {
  NoSteps steps;
  try {
    method.run(parameters, steps);
    return error_of_result(scorer, method.extract(steps));
  } catch (const std::exception&) {
    return kInfinitelyBad;
  }
}

/// One case's part of the tables.
void measure_case(FitTables& tables, std::size_t which, const FitCase& wanted,
                  const std::vector<RuleUse>& uses) {
  const PointSet set = make_point_set(wanted.plan_case.dataset, wanted.plan_case.holes,
                                      static_cast<std::size_t>(wanted.plan_case.n), wanted.seed);
  const metrics::CaseScorer scorer(set.points, set.ground_truth);
  const double size = plan::auto_size({set.points});
  for (std::size_t u = 0; u < uses.size(); ++u) {
    const std::unique_ptr<Adapter> method = make_method(uses[u].method);
    method->load(set.points);
    Parameters parameters = uses[u].fixed;
    for (std::size_t k = 0; k < tables.uses[u].candidates.size(); ++k) {
      parameters[uses[u].parameter] = tables.uses[u].candidates[k] * size;
      tables.uses[u].errors[which][k] = error_of_result(scorer, *method, parameters);
    }
  }
  tables.core_errors[which] =
      error_of_result(scorer, polylidar::to_coordinates(polylidar::concave_hull(set.points), set.points));
}

}  // namespace

std::vector<FitCase> training_cases(const std::vector<plan::Plan>& plans, int seeds, std::int64_t points) {
  std::vector<FitCase> cases;
  std::set<std::pair<std::string, std::uint64_t>> seen;
  const auto add = [&](plan::PlanCase plan_case, std::uint64_t first_seed) {
    FitCase one = {std::move(plan_case), first_seed};
    if (one.plan_case.n == 0 || side_of(one.plan_case.dataset) != Side::kTraining) return;
    if (points > 0) one.plan_case.n = points;
    for (int k = 0; k < seeds; ++k, ++one.seed) {
      if (seen.emplace(one.plan_case.key(), one.seed).second) cases.push_back(one);
    }
  };
  std::set<std::pair<std::string, std::int64_t>> stresses;  // with the number of points
  for (const plan::Plan& plan : plans) {
    if (!plan.accepted.empty()) continue;
    for (const plan::PlanCase& plan_case : plan.expanded_cases) {
      add(plan_case, plan.seed);
      const std::size_t mark = plan_case.dataset.find('~');
      if (mark != std::string::npos) stresses.emplace(plan_case.dataset.substr(mark), plan_case.n);
    }
  }
  for (const plan::Plan& plan : plans) {
    if (!plan.accepted.empty()) continue;
    for (const plan::PlanCase& plan_case : plan.expanded_cases) {
      if (!levels_of(plan_case.dataset).empty()) continue;
      for (const auto& [ending, n] : stresses) {
        if (n == plan_case.n) add({plan_case.dataset + ending, plan_case.holes, n}, plan.seed);
      }
    }
  }
  return cases;
}

std::vector<RuleUse> rule_uses() {
  const std::map<std::string, double> with_holes = {{"allow_holes", 1}};
  return {{"auto_circumradius",
           "polylidar",
           "alpha",
           {},
           plan::kCircumradiusShare,
           "the largest circumradius of a triangle that stays"},
          {"auto_edge_length",
           "polylidar",
           "max_edge_length",
           {},
           plan::kEdgeShare,
           "the longest edge of a triangle that stays"},
          {"auto_edge_length", "geos_concave_hull", "max_edge_length", with_holes, plan::kEdgeShare,
           "the longest edge that erosion leaves, from the border and from holes"},
          {"auto_edge_length",
           "chi_shape",
           "max_edge_length",
           {},
           plan::kEdgeShare,
           "the longest edge that erosion leaves, from the border alone"}};
}

std::vector<double> usual_shares() {
  std::vector<double> shares;
  for (int percent = 50; percent <= 180; percent += 5) shares.push_back(percent / 100.0);
  return shares;
}

FitTables measure_fit(const std::vector<FitCase>& cases, const std::vector<RuleUse>& uses,
                      const std::vector<double>& shares, const std::vector<int>& cores) {
  FitTables tables;
  for (const FitCase& one : cases) tables.shapes.push_back(base_shape(one.plan_case.dataset));
  const std::vector<std::vector<double>> nothing(cases.size(), std::vector<double>(shares.size()));
  tables.uses.assign(uses.size(), {shares, tables.shapes, nothing});
  tables.core_errors.resize(cases.size());
  for_each_in_parallel(cases.size(), cores, [&](std::size_t i) { measure_case(tables, i, cases[i], uses); });
  return tables;
}

}  // namespace hullbench::tune
