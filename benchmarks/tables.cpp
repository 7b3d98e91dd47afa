#include "benchmarks/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/claims.hpp"
#include "benchmarks/collection_tables.hpp"
#include "benchmarks/number_format.hpp"
#include "benchmarks/report_notes.hpp"
#include "benchmarks/statistics.hpp"
#include "benchmarks/table_context.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

void print_shape(TableContext& context, const Shape& shape, std::ostream& out) {
  const std::array<std::pair<Quantity, const char*>, 3> tables = {
      {{Quantity::kEqualWork, "time of equal work, ms"},
       {Quantity::kPaperBoundary, "time as the paper took it, ms"},
       {Quantity::kError,
        "error L2, % of the ground truth's area (as the paper divides it: of the result's area)"}}};
  const std::vector<Line> lines = lines_of(context, shape);
  for (const auto& [quantity, caption] : tables) {
    out << "### " << shape_title(context, shape.front()) << ": " << caption << "\n\n";
    std::vector<std::string> header = {"Number of points"};
    for (const Case& which : shape) header.push_back(std::to_string(which.n));
    TextTable table(std::move(header));
    for (const Line& line : lines) table.add_row(row(context, line, shape, quantity));
    table.print(out);
    out << '\n';
  }
}

bool is_steps_shape(const Case& which) {
  const json& steps = paper().at("steps");
  return which.dataset == steps.at("dataset") && which.holes == steps.at("holes");
}

std::vector<std::string> measured_steps(const TableContext& context, const Line& line, const Case& which) {
  const auto runs = context.measurements.find(line.method, line.protocol, which);
  if (runs.empty() || first_failure(runs) != nullptr) return {};
  std::vector<std::string> result = {label(context, line)};
  for (const PaperStep& step : paper_steps()) {
    std::vector<std::int64_t> values;
    for (const RunRecord* run : runs) {
      const auto repetitions = step_times(*run, step.parts);
      values.insert(values.end(), repetitions.begin(), repetitions.end());
    }
    result.push_back(values.empty() ? kNothing : milliseconds(median(values)));
  }
  for (const Boundary boundary : {Boundary::kPaper, Boundary::kEqualWork}) {
    const std::vector<std::int64_t> values = all_times(runs, boundary);
    result.push_back(values.empty() ? kNothing : milliseconds(median(values)));
  }
  return result;
}

std::vector<std::string> published_steps(const std::string& method) {
  const json& published = paper().at("steps").at("milliseconds");
  if (!published.contains(method)) return {};
  std::vector<std::string> result = {paper().at("methods").value(method, method) + ", in the paper"};
  const auto text = [&](const json& value) {
    return value.is_number() ? fixed(value.get<double>(), 1) : kNothing;
  };
  for (const PaperStep& step : paper_steps()) result.push_back(text(published.at(method).at(step.name)));
  result.push_back(text(published.at(method).at("total")));
  result.emplace_back(kNothing);
  return result;
}

/// The steps of the methods on the paper's shape, at the paper's size with the paper's values beside them, or
/// at the largest size there is without.
void print_steps(const TableContext& context, std::ostream& out) {
  const json& steps = paper().at("steps");
  const Case* chosen = nullptr;
  for (const Case& which : context.measurements.cases()) {
    if (is_steps_shape(which) && (chosen == nullptr || chosen->n != steps.at("n"))) chosen = &which;
  }
  if (chosen == nullptr) return;
  const bool comparable = chosen->n == steps.at("n");
  std::vector<std::string> header = {"Method"};
  for (const PaperStep& step : paper_steps()) header.push_back(step.name);
  header.insert(header.end(), {"as the paper took it", "equal work"});
  TextTable table(std::move(header));
  std::set<std::string> compared;
  for (const Line& line : lines_of(context, {*chosen})) {
    std::vector<std::string> ours = measured_steps(context, line, *chosen);
    if (!ours.empty()) table.add_row(std::move(ours));
    if (!comparable || line.protocol != paper().at("protocol") || !compared.insert(line.method).second)
      continue;
    if (auto theirs = published_steps(line.method); !theirs.empty()) table.add_row(std::move(theirs));
  }
  out << "### " << shape_title(context, *chosen) << ", n = " << chosen->n << ": time of the steps, ms\n\n";
  table.print(out);
  out << '\n';
  const std::string where = steps.at("where").get<std::string>();
  print_item(comparable ? "Medians; the paper's values are from its " + where + ", each the " +
                              steps.at("statistic").get<std::string>() +
                              ". A dash: the method does not tell the step."
                        : "Medians. The paper's " + where + " is for n = " + steps.at("n").dump() +
                              ", which was not measured here. A dash: the method does not tell the step.",
             out);
  out << '\n';
}

std::string holds_text(const json& holds) {
  if (!holds.is_boolean()) return kNothing;
  return holds.get<bool>() ? "yes" : "no";
}

void print_claims(TableContext& context, std::ostream& out) {
  TextTable table({"Claim", "Paper", "Here", "Equal work", "Holds"});
  for (const json& claim : context.report.at("summary").at("claims")) {
    const std::string mark = context.notes.mark(claim.at("where").get<std::string>() + ": " +
                                                claim.at("detail").get<std::string>());
    const json& equal_work = claim.at("equal_work");
    table.add_row({claim.at("claim").get<std::string>() + " " + mark, claim.at("paper").get<std::string>(),
                   claim.at("ours").get<std::string>(),
                   equal_work.is_string() ? equal_work.get<std::string>() : kNothing,
                   holds_text(claim.at("holds"))});
  }
  if (table.empty()) return;
  out << "### The paper's claims beside ours\n\n";
  table.print(out);
  out << '\n';
}

/// Whether the paper's claims and step times can be put beside this report at all.
bool is_papers_experiment(const TableContext& context) {
  const json& datasets = paper().at("claims").at("datasets");
  const auto& runs = context.measurements.runs();
  return std::any_of(runs.begin(), runs.end(), [&](const RunRecord& run) {
    return run.protocol == paper().at("protocol") &&
           std::find(datasets.begin(), datasets.end(), run.dataset) != datasets.end();
  });
}

}  // namespace

void print_tables(const json& report, std::ostream& out) {
  TableContext context{report, Measurements(report), {}};
  out << "## " << report.at("plan").value("title", std::string("Benchmark run")) << "\n\n";
  const std::vector<Shape> all_shapes = shapes(context.measurements.cases());
  if (is_collection(all_shapes)) {
    print_collection(context, all_shapes, out);
  } else {
    for (const Shape& shape : all_shapes) print_shape(context, shape, out);
  }
  if (is_papers_experiment(context)) {
    print_steps(context, out);
    print_claims(context, out);
  }
  out << "### Notes\n\n";
  context.notes.print(out);
  print_report_notes(report, context.measurements.runs(), out);
}

}  // namespace hullbench
