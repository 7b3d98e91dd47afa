#include "benchmarks/report/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/collection_tables.hpp"
#include "benchmarks/report/curve_table.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/report/ratios.hpp"
#include "benchmarks/report/report_notes.hpp"
#include "benchmarks/report/table_context.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

using nlohmann::json;

/// "ca_holes"
std::string shape_id(const Case& which) {
  return which.dataset + (which.holes ? "_holes" : "");
}

std::vector<table::TableSection> shape_tables(TableContext& context, const Shape& shape) {
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
  std::vector<table::TableSection> sections;
  for (const Kind& kind : kKinds) {
    if (kind.quantity != Quantity::kError && !context.measurements.has_times()) continue;
    std::vector<std::string> header = {"Number of points"};
    for (const Case& which : shape) header.push_back(std::to_string(which.n));
    table::TableSection section{shape_id(shape.front()) + "_" + kind.id,
                                shape_title(context, shape.front()) + ": " + kind.caption,
                                table::TextTable(std::move(header)),
                                {}};
    for (const Line& line : lines) section.table.add_row(row(context, line, shape, kind.quantity));
    explain_hull_mark(section);
    sections.push_back(std::move(section));
  }
  return sections;
}

/// Median, interval, least and largest as cells.
std::vector<std::string> ratio_cells(const Ratios& ratios) {
  if (!ratios.median) return {kNothing, kNothing, kNothing, kNothing};
  return {ratio_text(*ratios.median), interval_text(ratios.interval), ratio_text(ratios.least),
          ratio_text(ratios.most)};
}

/// The medians of the times and errors of the cases with holes over those without, of one line. A case with
/// holes on which it failed is infinitely bad.
std::vector<std::string> holes_cells(const TableContext& context, const Line& line,
                                     const std::vector<Case>& cases) {
  std::vector<double> times;
  std::vector<double> errors;
  for (const Case& which : cases) {
    if (!which.holes) continue;
    const auto with = context.measurements.find(line.method, line.protocol, which);
    const auto without =
        context.measurements.find(line.method, line.protocol, {which.dataset, false, which.n});
    if (with.empty() || without.empty() || first_failure(without) != nullptr) continue;
    const bool failed = first_failure(with) != nullptr;
    const auto add = [&](std::vector<double>& ratios, auto values) {
      if (failed) return ratios.push_back(std::numeric_limits<double>::infinity());
      const double by = values(without);
      if (by > 0) ratios.push_back(values(with) / by);
    };
    if (context.measurements.has_times())
      add(times, [](const auto& runs) { return statistics::median(all_times(runs, Boundary::kEqualWork)); });
    add(errors, [](const auto& runs) {
      const std::vector<double> values = all_values(runs, "l2");
      return values.empty() ? 0 : statistics::median(std::span<const double>(values));
    });
  }
  std::vector<std::string> cells;
  for (const auto& ratios : {times, errors}) {
    cells.push_back(ratios.empty() ? kNothing
                                   : ratio_text(statistics::median(std::span<const double>(ratios))));
  }
  if (!context.measurements.has_times()) cells.erase(cells.begin());
  return cells;
}

const std::vector<std::string> kWithTimes = {"Method", "Solved", "Time", "95 %",        "least", "most",
                                             "L2",     "least",  "most", "Holes: time", "L2"};
const std::vector<std::string> kErrorsOnly = {"Method", "Solved", "L2", "least", "most", "Holes: L2"};

/// What the paper's text says of its figure in one table: every method beside Polylidar, and what holes
/// change.
std::optional<table::TableSection> ratio_table(const TableContext& context, const std::vector<Case>& cases) {
  const Line reference = reference_line();
  const std::vector<Line> lines = lines_of(context, cases);
  if (std::find(lines.begin(), lines.end(), reference) == lines.end() || lines.size() < 2)
    return std::nullopt;
  const bool times = context.measurements.has_times();
  table::TableSection section{"ratios",
                              "All cases together: ratios to " + label(context, reference) +
                                  ", and of the cases with holes to those without",
                              table::TextTable(times ? kWithTimes : kErrorsOnly),
                              {}};
  for (const Line& line : lines) {
    const Ratios errors = metric_ratios(context.measurements, line, reference, cases, "l2");
    const Ratios slower = time_ratios(context.measurements, line, reference, cases);
    const Ratios& counted = errors.cases > slower.cases ? errors : slower;
    std::vector<std::string> cells = {label(context, line), std::to_string(counted.cases - counted.failures) +
                                                                " of " + std::to_string(counted.cases)};
    const auto append = [&](const std::vector<std::string>& more) {
      cells.insert(cells.end(), more.begin(), more.end());
    };
    if (times) append(ratio_cells(slower));
    std::vector<std::string> error_cells = ratio_cells(errors);
    error_cells.erase(error_cells.begin() + 1);
    append(error_cells);
    append(holes_cells(context, line, cases));
    section.table.add_row(std::move(cells));
  }
  section.remarks.push_back(
      (times ? "Ratios of the times of equal work, and of the errors as a part of the ground truth's area. "
             : "Ratios of the errors as a part of the ground truth's area. ") +
      std::string("Cases are a shape, with or without holes, at a number of points. The ") +
      (times ? "last two columns" : "last column") + ": with holes over without, the median of the cases.");
  return section;
}

/// The rivals that are quoted: the fastest one that gives the same polygons, and the paper's.
std::optional<table::TableSection> headline_table(const TableContext& context) {
  const json& headline = context.report.at("summary").at("headline");
  if (headline.is_null()) return std::nullopt;
  const auto label_of = [&](const json& line) {
    return label(context, {line.at("method").get<std::string>(), line.at("protocol").get<std::string>()});
  };
  const std::string reference = label_of(headline.at("reference"));
  table::TableSection section{
      "headline",
      context.report.at("plan").at("title").get<std::string>() +
          ": the fastest rival with the same polygons, time over that of " + reference,
      table::TextTable({"Method", "Same polygons", "Cases", "Failed", "Time", "95 %", "least", "most"}),
      {}};
  bool any_same = false;
  std::string does_more;
  for (const json& rival : headline.at("rivals")) {
    const bool same = rival.at("same_polygons").get<bool>();
    any_same = any_same || same;
    does_more = rival.value("does_more", does_more);
    const auto number = [&](const char* name) {
      return rival.at(name).is_null() ? std::numeric_limits<double>::infinity()
                                      : rival.at(name).get<double>();
    };
    const auto interval = rival.at("low").is_null()
                              ? std::nullopt
                              : std::optional(statistics::Interval{number("low"), number("high")});
    section.table.add_row({label_of(rival), same ? "yes" : "no", rival.at("cases").dump(),
                           rival.at("failures").dump(), ratio_text(number("median")), interval_text(interval),
                           ratio_text(number("least")), ratio_text(number("most"))});
  }
  section.remarks.emplace_back(
      "The same polygons, as the records tell: on every case that both solved as many polygons, holes and "
      "vertices, and area and L2 equal to within 1e-9 of the larger one. Of all methods with the same "
      "polygons the one with the least median stands here" +
      std::string(any_same ? "." : ", but there is none in this run."));
  if (!does_more.empty()) section.remarks.push_back(does_more);
  return section;
}

/// How long a method takes that has not been warmed up, where the records say it.
std::optional<table::TableSection> cold_table(const TableContext& context) {
  if (!context.measurements.has_times()) return std::nullopt;
  table::TableSection section{
      "cold",
      "First call in a fresh process: time of equal work, ms",
      table::TextTable({"Method", "Cases", "First call", "Warmed up", "First / warmed up", "least", "most"}),
      {}};
  for (const Line& line : lines_of(context, context.measurements.cases())) {
    std::vector<double> cold;
    std::vector<double> warm;
    std::vector<double> ratios;
    for (const record::RunRecord& run : context.measurements.runs()) {
      if (Line{run.method, run.protocol} != line || !run.cold_time_ns || !is_measured(run)) continue;
      cold.push_back(static_cast<double>(*run.cold_time_ns));
      warm.push_back(statistics::median(run.time_ns));
      if (warm.back() > 0) ratios.push_back(cold.back() / warm.back());
    }
    if (ratios.empty()) continue;
    const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
    section.table.add_row({label(context, line), std::to_string(cold.size()),
                           milliseconds(statistics::median(std::span<const double>(cold))),
                           milliseconds(statistics::median(std::span<const double>(warm))),
                           three_digits(statistics::median(std::span<const double>(ratios))),
                           three_digits(*least), three_digits(*most)});
  }
  if (section.table.empty()) return std::nullopt;
  section.remarks.emplace_back(
      "Of methods that compile while they run, which all other tables show warmed up: medians of the cases "
      "on "
      "which they succeeded, and of the cases' ratios.");
  return section;
}

bool is_steps_shape(const Case& which) {
  const json& steps = paper().at("steps");
  return steps.at("dataset") == which.dataset && steps.at("holes") == which.holes;
}

std::vector<std::string> measured_steps(const TableContext& context, const Line& line, const Case& which) {
  const auto runs = context.measurements.find(line.method, line.protocol, which);
  if (runs.empty() || first_failure(runs) != nullptr) return {};
  std::vector<std::string> result = {row_label(context, line, {which})};
  for (const PaperStep& step : paper_steps()) {
    const std::vector<std::int64_t> values = all_step_times(runs, step);
    result.push_back(values.empty() ? kNothing : milliseconds(statistics::median(values)));
  }
  for (const Boundary boundary : {Boundary::kPaper, Boundary::kEqualWork}) {
    const std::vector<std::int64_t> values = all_times(runs, boundary);
    result.push_back(values.empty() ? kNothing : milliseconds(statistics::median(values)));
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
std::optional<table::TableSection> steps_table(const TableContext& context) {
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
  table::TableSection section{
      kStepsTable,
      shape_title(context, *chosen) + ", n = " + std::to_string(chosen->n) + ": time of the steps, ms",
      table::TextTable(std::move(header)),
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

std::optional<table::TableSection> claims_table(TableContext& context) {
  const bool times = context.measurements.has_times();
  std::vector<std::string> header = {"Claim", "Paper", "Here", "Verdict"};
  if (times) header.insert(header.end() - 1, "Equal work");
  table::TableSection section{
      "claims", "The paper's claims beside ours", table::TextTable(std::move(header)), {}};
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
    const json& verdict = claim.at("verdict");
    cells.push_back(verdict.is_null() ? kNothing : verdict.get<std::string>());
    section.table.add_row(std::move(cells));
  }
  if (section.table.empty()) return std::nullopt;
  section.remarks.emplace_back(
      "Larger, smaller: than a number that the paper gives, by more than the band round it that the note "
      "says. "
      "Refuted: of a claim without a number.");
  return section;
}

/// Whether the paper's claims and step times can be put beside this report at all.
bool is_papers_experiment(const TableContext& context) {
  const json& datasets = paper().at("claims").at("datasets");
  const auto& runs = context.measurements.runs();
  return std::any_of(runs.begin(), runs.end(), [&](const record::RunRecord& run) {
    return paper().at("protocol") == run.protocol &&
           std::find(datasets.begin(), datasets.end(), run.dataset) != datasets.end();
  });
}

void add(table::Document& document, std::optional<table::TableSection> section) {
  if (section) document.tables.push_back(std::move(*section));
}

void add_all(table::Document& document, std::vector<table::TableSection> sections) {
  std::move(sections.begin(), sections.end(), std::back_inserter(document.tables));
}

}  // namespace

table::Document make_document(const json& report) {
  TableContext context{report, Measurements(report), {}};
  table::Document document;
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
  if (!has_axis) {
    add(document, headline_table(context));
    add(document, cold_table(context));
  }
  if (!has_axis && is_papers_experiment(context)) {
    add(document, steps_table(context));
    add(document, claims_table(context));
  }
  for (table::TableSection& section : document.tables) section.id = name + "_" + section.id;
  document.notes = context.notes.marked();
  for (auto& note : run_notes(report, context.measurements)) document.notes.push_back(std::move(note));
  document.common_notes = common_notes(report, context.measurements);
  return document;
}

}  // namespace hullbench::report
