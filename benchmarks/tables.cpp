#include "benchmarks/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/bootstrap.hpp"
#include "benchmarks/claims.hpp"
#include "benchmarks/collection_tables.hpp"
#include "benchmarks/curve_table.hpp"
#include "benchmarks/labels.hpp"
#include "benchmarks/number_format.hpp"
#include "benchmarks/report_notes.hpp"
#include "benchmarks/statistics.hpp"
#include "benchmarks/table_context.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

/// "ca_holes"
std::string shape_id(const Case& which) {
  return which.dataset + (which.holes ? "_holes" : "");
}

std::vector<TableSection> shape_tables(TableContext& context, const Shape& shape) {
  struct Kind {
    Quantity quantity;
    const char* id;
    const char* caption;
  };
  constexpr std::array<Kind, 3> kKinds = {
      {{Quantity::kEqualWork, "time", "time of equal work, ms"},
       {Quantity::kPaperBoundary, "paper_time", "time as the paper took it, ms"},
       {Quantity::kError, "error",
        "error L2, % of the ground truth's area (as the paper divides it: of the result's area)"}}};
  const std::vector<Line> lines = lines_of(context, shape);
  std::vector<TableSection> sections;
  for (const Kind& kind : kKinds) {
    if (kind.quantity != Quantity::kError && !context.measurements.has_times()) continue;
    std::vector<std::string> header = {"Number of points"};
    for (const Case& which : shape) header.push_back(std::to_string(which.n));
    TableSection section{shape_id(shape.front()) + "_" + kind.id,
                         shape_title(context, shape.front()) + ": " + kind.caption,
                         TextTable(std::move(header)),
                         {}};
    for (const Line& line : lines) section.table.add_row(row(context, line, shape, kind.quantity));
    sections.push_back(std::move(section));
  }
  return sections;
}

/// One value of a line on a case: the median of its equal-work times or of its errors; none when it failed.
std::optional<double> value_of(const TableContext& context, const Line& line, const Case& which,
                               Quantity quantity) {
  const auto runs = context.measurements.find(line.method, line.protocol, which);
  if (runs.empty() || first_failure(runs) != nullptr) return std::nullopt;
  if (quantity == Quantity::kEqualWork) return median(all_times(runs, Boundary::kEqualWork));
  const std::vector<double> errors = all_values(runs, "l2");
  if (errors.empty()) return std::nullopt;
  return median(std::span<const double>(errors));
}

/// Ratios by shape.
using Ratios = std::map<std::pair<std::string, bool>, std::vector<double>>;

std::vector<double> values_of(const Ratios& by_shape) {
  std::vector<double> result;
  for (const auto& [shape, values] : by_shape) result.insert(result.end(), values.begin(), values.end());
  return result;
}

/// Their median, the least and the largest as cells.
std::vector<std::string> ratio_cells(const Ratios& by_shape) {
  const std::vector<double> ratios = values_of(by_shape);
  if (ratios.empty()) return {kNothing, kNothing, kNothing};
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return {three_digits(median(std::span<const double>(ratios))), three_digits(*least), three_digits(*most)};
}

const std::vector<std::string> kWithTimes = {"Method", "Cases", "Time", "95 %",        "least", "most",
                                             "L2",     "least", "most", "Holes: time", "L2"};
const std::vector<std::string> kErrorsOnly = {"Method", "Cases", "L2", "least", "most", "Holes: L2"};

/// The interval of their median, clustered by shape.
std::string interval_cell(const Ratios& by_shape) {
  std::vector<std::vector<double>> clusters;
  for (const auto& [shape, values] : by_shape) clusters.push_back(values);
  const auto interval = clustered_median_interval(clusters);
  return interval ? three_digits(interval->low) + "–" + three_digits(interval->high) : kNothing;
}

/// What the paper's text says of its figure in one table: every method beside Polylidar, and what holes
/// change.
std::optional<TableSection> ratio_table(const TableContext& context, const std::vector<Case>& cases) {
  const Line reference = {paper().at("reference_method").get<std::string>(),
                          paper().at("protocol").get<std::string>()};
  const std::vector<Line> lines = lines_of(context, cases);
  if (std::find(lines.begin(), lines.end(), reference) == lines.end() || lines.size() < 2)
    return std::nullopt;
  const bool times = context.measurements.has_times();
  TableSection section{"ratios",
                       "All cases together: ratios to " + label(context, reference) +
                           ", and of the cases with holes to those without",
                       TextTable(times ? kWithTimes : kErrorsOnly),
                       {}};
  for (const Line& line : lines) {
    std::vector<std::string> cells = {label(context, line), ""};
    std::vector<std::string> holes_cells;
    std::size_t count = 0;
    for (const Quantity quantity : {Quantity::kEqualWork, Quantity::kError}) {
      if (quantity == Quantity::kEqualWork && !times) continue;
      Ratios to_reference;
      Ratios to_no_holes;
      for (const Case& which : cases) {
        const auto ours = value_of(context, line, which, quantity);
        const auto divide = [&](const std::optional<double>& by, Ratios& ratios) {
          if (ours && by && *by > 0) ratios[{which.dataset, which.holes}].push_back(*ours / *by);
        };
        divide(value_of(context, reference, which, quantity), to_reference);
        if (which.holes)
          divide(value_of(context, line, {which.dataset, false, which.n}, quantity), to_no_holes);
      }
      count = std::max(count, values_of(to_reference).size());
      auto ratios = ratio_cells(to_reference);
      if (quantity == Quantity::kEqualWork) ratios.insert(ratios.begin() + 1, interval_cell(to_reference));
      cells.insert(cells.end(), ratios.begin(), ratios.end());
      holes_cells.push_back(ratio_cells(to_no_holes).front());
    }
    cells[1] = std::to_string(count);
    cells.insert(cells.end(), holes_cells.begin(), holes_cells.end());
    section.table.add_row(std::move(cells));
  }
  section.remarks.emplace_back(
      (times ? "Ratios of the medians of the time of equal work, and of the errors as a part of the ground "
               "truth's area; "
             : "Ratios of the errors as a part of the ground truth's area; ") +
      std::string("of the cases the median, the least and the largest. Cases are a shape, with or without "
                  "holes, at a number of points. The ") +
      (times ? "last two columns" : "last column") + ": with holes over without, the median." +
      (times
           ? " 95 %: a bootstrap interval of the median that resamples whole shapes; of so few shapes it is "
             "a rough one."
           : ""));
  return section;
}

bool is_steps_shape(const Case& which) {
  const json& steps = paper().at("steps");
  return steps.at("dataset") == which.dataset && steps.at("holes") == which.holes;
}

std::vector<std::string> measured_steps(const TableContext& context, const Line& line, const Case& which) {
  const auto runs = context.measurements.find(line.method, line.protocol, which);
  if (runs.empty() || first_failure(runs) != nullptr) return {};
  std::vector<std::string> result = {label(context, line)};
  for (const PaperStep& step : paper_steps()) {
    const std::vector<std::int64_t> values = all_step_times(runs, step);
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
std::optional<TableSection> steps_table(const TableContext& context) {
  if (!context.measurements.has_times()) return std::nullopt;
  const json& steps = paper().at("steps");
  const Case* chosen = nullptr;
  for (const Case& which : context.measurements.cases()) {
    if (is_steps_shape(which) && (chosen == nullptr || chosen->n != steps.at("n"))) chosen = &which;
  }
  if (chosen == nullptr) return std::nullopt;
  const bool comparable = chosen->n == steps.at("n");
  std::vector<std::string> header = {"Method"};
  for (const PaperStep& step : paper_steps()) header.push_back(step.name);
  header.insert(header.end(), {"as the paper took it", "equal work"});
  TableSection section{
      kStepsTable,
      shape_title(context, *chosen) + ", n = " + std::to_string(chosen->n) + ": time of the steps, ms",
      TextTable(std::move(header)),
      {}};
  std::set<std::string> compared;
  for (const Line& line : lines_of(context, {*chosen})) {
    std::vector<std::string> ours = measured_steps(context, line, *chosen);
    if (!ours.empty()) section.table.add_row(std::move(ours));
    if (!comparable || paper().at("protocol") != line.protocol || !compared.insert(line.method).second)
      continue;
    if (auto theirs = published_steps(line.method); !theirs.empty()) section.table.add_row(std::move(theirs));
  }
  const std::string where = steps.at("where").get<std::string>();
  section.remarks.push_back(
      comparable
          ? "Medians; the paper's values are from its " + where + ", each the " +
                steps.at("statistic").get<std::string>() + ". A dash: the method does not tell the step."
          : "Medians. The paper's " + where + " is for n = " + steps.at("n").dump() +
                ", which was not measured here. A dash: the method does not tell the step.");
  return section;
}

std::string holds_text(const json& holds) {
  if (!holds.is_boolean()) return kNothing;
  return holds.get<bool>() ? "yes" : "no";
}

std::optional<TableSection> claims_table(TableContext& context) {
  const bool times = context.measurements.has_times();
  std::vector<std::string> header = {"Claim", "Paper", "Here", "Holds"};
  if (times) header.insert(header.end() - 1, "Equal work");
  TableSection section{"claims", "The paper's claims beside ours", TextTable(std::move(header)), {}};
  const json& known = paper().at("claims").at("list");
  const auto known_claim = [&](const json& id) {
    return *std::find_if(known.begin(), known.end(), [&](const json& claim) { return claim.at("id") == id; });
  };
  for (const json& claim : context.report.at("summary").at("claims")) {
    // Of an experiment on one case only the claims about a single case can be judged; the others need its
    // neighbours.
    const json checked = known_claim(claim.at("id"));
    if (context.measurements.cases().size() == 1 && !checked.at("check").contains("only")) continue;
    if (is_about_time(checked) && !times) continue;
    const std::string mark = context.notes.mark(claim.at("where").get<std::string>() + ": " +
                                                claim.at("detail").get<std::string>());
    const json& equal_work = claim.at("equal_work");
    std::vector<std::string> cells = {claim.at("claim").get<std::string>() + " " + mark,
                                      claim.at("paper").get<std::string>(),
                                      claim.at("ours").get<std::string>()};
    if (times) cells.push_back(equal_work.is_string() ? equal_work.get<std::string>() : kNothing);
    cells.push_back(holds_text(claim.at("holds")));
    section.table.add_row(std::move(cells));
  }
  if (section.table.empty()) return std::nullopt;
  return section;
}

/// Whether the paper's claims and step times can be put beside this report at all.
bool is_papers_experiment(const TableContext& context) {
  const json& datasets = paper().at("claims").at("datasets");
  const auto& runs = context.measurements.runs();
  return std::any_of(runs.begin(), runs.end(), [&](const RunRecord& run) {
    return paper().at("protocol") == run.protocol &&
           std::find(datasets.begin(), datasets.end(), run.dataset) != datasets.end();
  });
}

void add(Document& document, std::optional<TableSection> section) {
  if (section) document.tables.push_back(std::move(*section));
}

void add_all(Document& document, std::vector<TableSection> sections) {
  std::move(sections.begin(), sections.end(), std::back_inserter(document.tables));
}

}  // namespace

Document make_document(const json& report) {
  TableContext context{report, Measurements(report), {}};
  Document document;
  const std::string name = report.at("plan").value("name", std::string("run"));
  const std::string experiment = report.at("plan").value("paper", std::string());
  document.title = report.at("plan").value("title", std::string("Benchmark run")) +
                   (experiment.empty() ? "" : " (the paper's " + experiment + ")");
  const std::vector<Shape> all_shapes = shapes(context.measurements.cases());
  const bool has_axis = report.at("plan").contains("axis");
  if (has_axis) {
    document.tables.push_back(curve_table(context));
  } else if (is_collection(all_shapes)) {
    add_all(document, collection_tables(context, all_shapes));
  } else if (context.measurements.cases().size() > 1) {
    for (const Shape& shape : all_shapes) add_all(document, shape_tables(context, shape));
    add(document, ratio_table(context, context.measurements.cases()));
  }
  if (!has_axis && is_papers_experiment(context)) {
    add(document, steps_table(context));
    add(document, claims_table(context));
  }
  for (TableSection& section : document.tables) section.id = name + "_" + section.id;
  document.notes = context.notes.marked();
  for (auto& note : run_notes(report, context.measurements)) document.notes.push_back(std::move(note));
  document.common_notes = common_notes(report, context.measurements);
  return document;
}

}  // namespace hullbench
