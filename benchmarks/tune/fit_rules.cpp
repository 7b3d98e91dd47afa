// build/fit_rules: fits what stands as a number in a rule from the points, on the training side of the split,
// and prints it beside what stands in the code. Accuracy only: nothing is timed, and the result does not
// depend on the machine.

#include <cstdint>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/exit_code.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/plan/plan.hpp"
#include "benchmarks/table/writers.hpp"
#include "benchmarks/tune/rule_fit.hpp"
#include "benchmarks/worker/worker_process.hpp"
#include "tool/program/command_line.hpp"

namespace hullbench::tune {
namespace {

/// Those that the parameters' search and the league are made of (league/evaluate.sh).
const std::vector<std::string> kPlans = {"world_shapes", "world_samplers", "world_crossed"};

table::Number percent(double share) {
  return {100 * share, 2};
}

void print_curve(const RuleUse& use, const std::vector<CandidateScore>& curve) {
  table::Table table{"curve",
                     use.meaning,
                     {table::words("share of S"), table::with_unit("score", "%"),
                      table::with_unit("median", "%"), "failures"}};
  for (const CandidateScore& one : curve)
    table.add_row({table::Number(one.candidate, 2), percent(one.score), percent(one.median), one.failures});
  std::cout << "\n## " << use.rule << ": " << use.meaning << " (" << use.method << ")\n\n";
  table::print_markdown(table, std::cout);
  std::cout << "\nBest: " << fixed(best_of(curve).candidate, 2) << ".\n";
}

/// The one share for all uses of a rule, what it costs each, and what stands in the code.
void print_share(const std::string& rule, const std::vector<RuleUse>& uses,
                 const std::vector<std::vector<CandidateScore>>& curves) {
  std::vector<RuleUse> of_rule;
  std::vector<std::vector<CandidateScore>> its_curves;
  for (std::size_t u = 0; u < uses.size(); ++u) {
    if (uses[u].rule != rule) continue;
    of_rule.push_back(uses[u]);
    its_curves.push_back(curves[u]);
  }
  const std::size_t best = best_for_all(its_curves);
  table::Table table{"share",
                     rule,
                     {table::words("limits"), table::with_unit("score", "%"),
                      table::with_unit("with its own best share", "%")}};
  for (std::size_t u = 0; u < of_rule.size(); ++u)
    table.add_row(
        {of_rule[u].meaning, percent(its_curves[u][best].score), percent(best_of(its_curves[u]).score)});
  std::cout << "\n## " << rule << ": one share for all, " << fixed(its_curves[0][best].candidate, 2)
            << "; in the code " << fixed(of_rule[0].share, 2) << "\n\n";
  table::print_markdown(table, std::cout);
}

ExitCode fit(const std::vector<std::string>& names, int seeds, std::int64_t points) {
  std::vector<plan::Plan> plans;
  plans.reserve(names.size());
  for (const std::string& name : names) plans.push_back(plan::load_plan(name, HULLBENCH_PLAN_FOLDER));
  const std::vector<FitCase> cases = training_cases(plans, seeds, points);
  if (cases.empty()) throw ConfigurationError("no case of these plans is on the training side of the split");
  const std::vector<RuleUse> uses = rule_uses();
  const FitTables tables = measure_fit(cases, uses, usual_shares(), allowed_cores());
  const std::set<std::string> shapes(tables.shapes.begin(), tables.shapes.end());
  std::cout << "# Constants of the rules from the points, fitted on " << cases.size() << " cases of "
            << shapes.size() << " training shapes\n\n";
  table::print_item(join_words(std::vector<std::string>(shapes.begin(), shapes.end())) + ".", std::cout);
  table::print_item("Score: the geometric mean over shapes of the geometric mean of a shape's errors (L2).",
                    std::cout);
  table::print_item("S: the median of the sizes that the core chooses from the points.", std::cout);
  std::vector<std::vector<CandidateScore>> curves;
  for (const ErrorTable& table : tables.uses) curves.push_back(score_curve(table));
  for (std::size_t u = 0; u < uses.size(); ++u) print_curve(uses[u], curves[u]);
  for (const char* rule : {"auto_circumradius", "auto_edge_length"}) print_share(rule, uses, curves);
  std::cout << "\nThe core by itself: " << percent(fit_score(tables.shapes, tables.core_errors)).text()
            << " %.\n";
  return kExitOk;
}

}  // namespace
}  // namespace hullbench::tune

int main(int argc, char** argv) {
  CLI::App app("Fits the constants of the rules that choose parameters from the points alone", "fit_rules");
  std::vector<std::string> plans = hullbench::tune::kPlans;
  int seeds = 1;
  std::int64_t points = 0;
  app.add_option("PLAN", plans, "Plans whose training cases are fitted on");
  app.add_option("--seeds", seeds, "Samples of each case")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--points", points, "Points of each case, instead of the plans'")
      ->check(CLI::Range(3, 1000000));
  app.footer(hullbench::kExitCodesHelp);
  const auto fit = [&] { return hullbench::tune::fit(plans, seeds, points); };
  return hullbench::exit_code_of("fit_rules", std::cerr,
                                 [&] { return polylidar::tool::parsed_action(app, fit, argc, argv)(); });
}
