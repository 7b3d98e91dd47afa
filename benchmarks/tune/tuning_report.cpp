#include "benchmarks/tune/tuning_report.hpp"

#include <limits>
#include <optional>
#include <set>

#include "benchmarks/base/words.hpp"
#include "benchmarks/record/record.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/tune/analysis.hpp"
#include "benchmarks/tune/search.hpp"

namespace hullbench::tune {
namespace {

/// Null for a failure.
json error_to_json(double error) {
  return is_infinitely_bad(error) ? json(nullptr) : json(error);
}

json optional_to_json(const std::optional<double>& value) {
  return value ? error_to_json(*value) : json(nullptr);
}

json interval_to_json(const std::optional<statistics::Interval>& interval) {
  if (!interval) return nullptr;
  return {error_to_json(interval->low), error_to_json(interval->high)};
}

json quartiles_to_json(const Quartiles& quartiles) {
  return {{"q1", error_to_json(quartiles.q1)},
          {"median", error_to_json(quartiles.median)},
          {"q3", error_to_json(quartiles.q3)}};
}

json case_to_json(const TuningCase& one) {
  return {{"case", one.plan_case.name()},
          {"dataset", one.plan_case.dataset},
          {"shape", one.shape()},
          {"side", to_string(one.side())},
          {"kind", one.kind},
          {"n", one.n},
          {"holes", one.plan_case.holes},
          {"seed", one.seed},
          {"dataset_sha256", one.dataset_sha256},
          {"spacing", one.spacing}};
}

json axis_to_json(const std::optional<SearchAxis>& axis) {
  if (!axis) return nullptr;
  return {{"parameter", axis->parameter},
          {"unit", axis->unit},
          {"kind", axis->spacings ? "spacings" : "own"},
          {"power", axis->power},
          {"low", axis->low},
          {"high", axis->high},
          {"grid", grid(*axis, kGridPoints)}};
}

json score_to_json(const ProtocolScore& score) {
  return {{"protocol", score.protocol},
          {"cases", score.cases},
          {"failed", score.failed},
          {"l2_median", error_to_json(score.l2_median)},
          {"l2_interval", interval_to_json(score.l2_interval)},
          {"regret_median", optional_to_json(score.regret_median)},
          {"regret_interval", interval_to_json(score.regret_interval)}};
}

json tuned_to_json(const MethodTuning& method, const std::optional<TunedValue>& tuned) {
  if (!tuned) return nullptr;
  return {{"position", tuned->position},
          {"training_median", tuned->training_median},
          {"training_cases", tuned->training_cases},
          {"fixed", record::parameters_to_json(fixed_parameters(method, tuned->holes))},
          {"at_end", tuned->at_end}};
}

json scores_to_json(const std::vector<double>& scores) {
  json result = json::array();
  for (const double score : scores) result.push_back(error_to_json(score));
  return result;
}

json rounds_to_json(const MethodTuning& method) {
  json rounds = json::array();
  for (const HalvingRound& round : method.rounds) {
    json& one = rounds.emplace_back(json{
        {"cases", round.cases}, {"positions", round.positions}, {"scores", scores_to_json(round.scores)}});
    if (!round.scores_without_holes.empty())
      one["scores_without_holes"] = scores_to_json(round.scores_without_holes);
  }
  return rounds;
}

json tolerance_to_json(const Tuning& tuning, const MethodTuning& method) {
  std::vector<double> widths;
  for (std::size_t i = 0; i < method.cases.size(); ++i) {
    if (tuning.cases[i].side() != Side::kTest) continue;
    if (const auto width = tolerance_octaves(method.cases[i])) widths.push_back(*width);
  }
  if (widths.empty()) return nullptr;
  json result = quartiles_to_json(quartiles_of(widths));
  result["cases"] = widths.size();
  return result;
}

json curve_to_json(const Tuning& tuning, const MethodTuning& method) {
  json curve = json::array();
  for (const CurvePoint& point : sensitivity_curve(tuning, method)) {
    curve.push_back({{"position", point.position},
                     {"cases", point.cases},
                     {"failed", point.failed},
                     {"l2", quartiles_to_json(point.l2)},
                     {"relative", quartiles_to_json(point.relative)}});
  }
  return curve;
}

json search_to_json(const Tuning& tuning, const MethodTuning& method) {
  json costs = json::array();
  for (const SearchCost& one : search_costs(tuning, method)) {
    costs.push_back({{"evaluations", one.evaluations},
                     {"cases", one.cases},
                     {"l2_median", error_to_json(one.l2_median)},
                     {"l2_interval", interval_to_json(one.l2_interval)}});
  }
  return costs;
}

/// Where on the axis an evaluation lies; null when it is not of the sweep.
json position_of(const MethodOnCase& found, const record::RunRecord& evaluation) {
  for (const SweepEvaluation& one : found.sweep) {
    if (one.evaluation.id == evaluation.id) return one.position;
  }
  return nullptr;
}

json oracle_to_json(const Tuning& tuning, const MethodTuning& method) {
  json choices = json::array();
  if (!method.axis) return choices;
  for (std::size_t i = 0; i < method.cases.size(); ++i) {
    const record::RunRecord* best = best_evaluation(method.cases[i]);
    if (best == nullptr || tuning.cases[i].side() != Side::kTest) continue;
    choices.push_back({{"case", tuning.cases[i].plan_case.name()},
                       {"seed", tuning.cases[i].seed},
                       {"position", position_of(method.cases[i], *best)},
                       {"parameters", record::parameters_to_json(best->parameters)},
                       {"status", to_string(best->status)},
                       {"l2", best->metrics.value("l2", json())},
                       {"tolerance_octaves", optional_to_json(tolerance_octaves(method.cases[i]))}});
  }
  return choices;
}

json method_to_json(const Tuning& tuning, const MethodTuning& method) {
  json result = {
      {"method", method.name},
      {"title", method.title},
      {"version", method.info ? method.info->version : ""},
      {"installed", method.info.has_value()},
      {"detail", method.detail},
      {"remedy", method.remedy},
      {"axis", axis_to_json(method.axis)},
      {"fixed", method.info ? record::parameters_to_json(fixed_parameters(method)) : json::object()},
      {"tuned", nullptr},
      {"rounds", json::array()},
      {"tolerance_octaves", nullptr},
      {"protocols", json::array()},
      {"curve", json::array()},
      {"search", json::array()},
      {"oracle", json::array()}};
  if (!method.info) return result;
  const auto tuned = choose_tuned(method);
  result["tuned"] = tuned_to_json(method, tuned);
  result["rounds"] = rounds_to_json(method);
  result["tolerance_octaves"] = tolerance_to_json(tuning, method);
  for (const ProtocolScore& score : protocol_scores(tuning, method, tuned))
    result["protocols"].push_back(score_to_json(score));
  result["curve"] = curve_to_json(tuning, method);
  result["search"] = search_to_json(tuning, method);
  result["oracle"] = oracle_to_json(tuning, method);
  return result;
}

// The tables.

/// l2 in percent, as other tables have it; null is infinite.
table::Number percent(const json& value) {
  const double percent =
      value.is_null() ? std::numeric_limits<double>::infinity() : 100 * value.get<double>();
  return {percent, percent < 10 ? 2 : 1};
}

table::Cell interval_cell(const json& interval) {
  if (interval.is_null()) return {};
  return table::Range{percent(interval[0]), percent(interval[1])};
}

table::Table protocol_table(const json& summary) {
  table::Table table{"protocols",
                     "Protocols on the test cases",
                     {table::words("Method"), table::words("Protocol"), "Cases", "Failed",
                      table::Column("L2 %", "%"), table::Column("L2 % interval", "%"),
                      table::Column("Regret %", "%"), table::Column("Regret % interval", "%")}};
  for (const json& method : summary.at("methods")) {
    for (const json& score : method.at("protocols")) {
      const bool regret = !method.at("axis").is_null() && !score.at("regret_interval").is_null();
      table.add_row({method.at("title").get<std::string>(), score.at("protocol").get<std::string>(),
                     score.at("cases").get<std::size_t>(), score.at("failed").get<std::size_t>(),
                     percent(score.at("l2_median")), interval_cell(score.at("l2_interval")),
                     regret ? percent(score.at("regret_median")) : table::Cell(),
                     regret ? interval_cell(score.at("regret_interval")) : table::Cell()});
    }
  }
  return table;
}

std::string axis_text(const json& axis) {
  if (axis.is_null()) return "nothing is searched";
  auto name = axis.at("parameter").get<std::string>();
  if (axis.at("kind") == "own") return name;
  return name + (axis.at("power") == 2 ? " = (x h)²" : " = x h");
}

table::Table tuned_table(const json& summary) {
  table::Table table{"tuned",
                     "What was searched, the tuned value and the tolerance",
                     {table::words("Method"), table::words("Parameter"), "From", "To", "Tuned x",
                      table::Column("Training L2 %", "%"), table::Column("Tolerance octaves", "octaves"),
                      table::Column("Quartiles", "octaves")}};
  const auto number = [](const json& value) { return table::Number(value.get<double>()); };
  const auto octaves = [](const json& value) { return table::Number(value.get<double>(), 2); };
  for (const json& method : summary.at("methods")) {
    if (!method.at("installed").get<bool>()) continue;
    const json& axis = method.at("axis");
    const json& tuned = method.at("tuned");
    const json& tolerance = method.at("tolerance_octaves");
    std::vector<table::Cell> cells(table.columns.size());
    cells[0] = method.at("title").get<std::string>();
    cells[1] = axis_text(axis);
    if (!axis.is_null()) {
      cells[2] = number(axis.at("low"));
      cells[3] = number(axis.at("high"));
    }
    if (!tuned.is_null()) {
      cells[4] = number(tuned.at("position"));
      if (tuned.at("at_end").get<bool>()) cells[4].sign = "(end)";
      cells[5] = percent(tuned.at("training_median"));
    }
    if (!tolerance.is_null()) {
      cells[6] = octaves(tolerance.at("median"));
      cells[7] = table::Range{octaves(tolerance.at("q1")), octaves(tolerance.at("q3"))};
    }
    table.add_row(std::move(cells));
  }
  return table;
}

/// The shapes of a side, each once; of more than twenty the number.
std::string shapes_text(const json& summary, const std::string& side) {
  std::set<std::string> shapes;
  for (const json& one : summary.at("cases")) {
    if (one.at("side") == side) shapes.insert(one.at("shape").get<std::string>());
  }
  constexpr std::size_t kMostNames = 20;
  if (shapes.empty()) return "none";
  if (shapes.size() > kMostNames) return std::to_string(shapes.size()) + " shapes";
  return join_words({shapes.begin(), shapes.end()});
}

std::vector<std::string> document_notes(const json& summary) {
  std::vector<std::string> notes = {
      "Training shapes: " + shapes_text(summary, "training") + ".",
      "Test shapes: " + shapes_text(summary, "test") + ".",
      ("Whole sources of shapes and whole ways to sample are of one side (benchmarks/tune/split.cpp, with "
       "the reasons); a training shape that is sampled as only tests are is left out."),
      ("h is the points' mean spacing over their convex hull, √(A_hull/n); it is known without the ground "
       "truth."),
      ("default: as the plan says, and where it says nothing without parameters but with holes; tuned: the "
       "one x with the smallest median error on the training cases, by successive halving; oracle: the best "
       "of all evaluations on the same "
       "instance; paper and auto: as the plan says."),
      ("L2 is the area of the symmetric difference over the ground truth's, regret its excess over the "
       "oracle's on the same instance; medians with 95 % bootstrap intervals that take a shape's cases as "
       "one."),
      ("Every stratum, a way to sample and a kind of shape (simple, with holes, of several parts), counts "
       "the same in a median; in it every shape, and of a shape every case."),
      ("Tolerance: how wide a range of the parameter keeps the error within 10 % of its best, in factors of "
       "two; the median over the cases."),
      "A failure counts as infinitely bad: \"∞\" stands where the median is one."};
  for (const json& method : summary.at("methods")) {
    if (method.at("installed").get<bool>()) continue;
    notes.push_back(method.at("title").get<std::string>() +
                    " does not start here: " + sentence(method.at("detail").get<std::string>()));
  }
  return notes;
}

// The lines of sweep.jsonl.

/// The protocols that chose an evaluation of a method on a case.
json protocols_of(const MethodTuning& method, const TuningCase& one, const MethodOnCase& found,
                  const std::optional<TunedValue>& tuned, const std::string& id) {
  json protocols = json::array();
  for (const auto& [protocol, evaluation] : found.protocols) {
    if (evaluation.id == id) protocols.push_back(protocol);
  }
  const record::RunRecord* chosen =
      tuned && one.side() == Side::kTest ? evaluation_at(found, tuned->position, tuned->holes) : nullptr;
  if (chosen != nullptr && chosen->id == id) protocols.push_back("tuned");
  const record::RunRecord* best = one.side() == Side::kTest ? best_evaluation(found) : nullptr;
  if (method.axis && best != nullptr && best->id == id) protocols.push_back("oracle");
  return protocols;
}

}  // namespace

json tuning_to_json(const Tuning& tuning, const std::vector<std::string>& plans, const json& tool) {
  json summary = {{"kind", "tuning"},
                  {"schema_version", record::kSchemaVersion},
                  {"tool", tool},
                  {"plans", plans},
                  {"split", split_to_json()},
                  {"budget", {{"grid", kGridPoints}, {"sweep", kSweepPoints}, {"refinement", kRefinements}}},
                  {"cases", json::array()},
                  {"methods", json::array()}};
  for (const TuningCase& one : tuning.cases) summary["cases"].push_back(case_to_json(one));
  for (const MethodTuning& method : tuning.methods)
    summary["methods"].push_back(method_to_json(tuning, method));
  return summary;
}

table::Document tuning_document(const json& summary) {
  table::Document document;
  document.title = "Parameters: " + join_words(summary.at("plans").get<std::vector<std::string>>());
  for (table::Table table : {protocol_table(summary), tuned_table(summary)}) {
    if (!table.rows.empty()) document.tables.push_back(std::move(table));
  }
  document.notes = document_notes(summary);
  return document;
}

std::vector<json> sweep_lines(const Tuning& tuning, const std::deque<record::RunRecord>& known) {
  std::vector<json> lines;
  std::set<std::string> written;
  for (const MethodTuning& method : tuning.methods) {
    if (!method.info) continue;
    const auto tuned = choose_tuned(method);
    for (std::size_t i = 0; i < method.cases.size(); ++i) {
      const MethodOnCase& found = method.cases[i];
      const auto add = [&](const record::RunRecord& evaluation, const json& position, bool on_grid) {
        if (!written.insert(evaluation.id).second) return;
        json& line = lines.emplace_back(evaluation);
        line["side"] = to_string(tuning.cases[i].side());
        line["position"] = position;
        line["on_grid"] = on_grid;
        line["protocols"] = protocols_of(method, tuning.cases[i], found, tuned, evaluation.id);
      };
      for (const SweepEvaluation& one : found.sweep) add(one.evaluation, one.position, one.on_grid);
      for (const auto& [protocol, evaluation] : found.protocols) add(evaluation, nullptr, false);
    }
  }
  for (const record::RunRecord& evaluation : known) {
    if (written.insert(evaluation.id).second) lines.emplace_back(evaluation);
  }
  return lines;
}

}  // namespace hullbench::tune
