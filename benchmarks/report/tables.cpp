#include "benchmarks/report/tables.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/collection_tables.hpp"
#include "benchmarks/report/curve_table.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/report/ratios.hpp"
#include "benchmarks/report/real_table.hpp"
#include "benchmarks/report/report_notes.hpp"
#include "benchmarks/report/table_context.hpp"
#include "benchmarks/report/zoo_table.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

/// "ca_holes"
std::string shape_id(const Case& which) {
  return which.dataset + (which.holes ? "_holes" : "");
}

std::vector<table::Table> shape_tables(TableContext& context, const Shape& shape) {
  struct Kind {
    Quantity quantity;
    const char* id;
    const char* unit;
    const char* caption;
  };
  constexpr std::array<Kind, 3> kKinds = {
      {{Quantity::kEqualWork, "time", "ms", "time of equal work, ms"},
       {Quantity::kPaperBoundary, "paper_time", "ms", "time as the paper took it, ms"},
       {Quantity::kError, "error", "%",
        "error L2, % of the ground truth's area (as the paper divides it: of the result's area)"}}};
  const std::vector<Line> lines = lines_of(context, shape);
  std::vector<table::Table> tables;
  for (const Kind& kind : kKinds) {
    if (kind.quantity != Quantity::kError && !context.measurements.has_times()) continue;
    table::Table table{shape_id(shape.front()) + "_" + kind.id,
                       shape_title(context, shape.front()) + ": " + kind.caption,
                       {table::words("Number of points")}};
    for (const Case& which : shape) table.columns.emplace_back(std::to_string(which.n), kind.unit);
    for (const Line& line : lines) table.add_row(row(context, line, shape, kind.quantity));
    explain_hull_sign(table);
    tables.push_back(std::move(table));
  }
  return tables;
}

/// Median, interval, least and largest as cells.
std::vector<table::Cell> ratio_cells(const Ratios& ratios) {
  if (!ratios.median) return std::vector<table::Cell>(4);
  return {table::Number(*ratios.median), table::range_cell(ratios.interval), table::Number(ratios.least),
          table::Number(ratios.most)};
}

/// The medians of the times and errors of the cases with holes over those without, of one line. A case with
/// holes on which it failed is infinitely bad.
std::vector<table::Cell> holes_cells(const TableContext& context, const Line& line,
                                     const std::vector<Case>& cases) {
  std::vector<double> times;
  std::vector<double> errors;
  for (const Case& which : cases) {
    if (!which.holes) continue;
    const auto with = context.measurements.find(line, which);
    const auto without = context.measurements.find(line, {which.dataset, false, which.n});
    if (with.empty() || without.empty() || first_failure(without) != nullptr) continue;
    const bool failed = first_failure(with) != nullptr;
    const auto add = [&](std::vector<double>& ratios, auto values) {
      if (failed) return ratios.push_back(kInfinity);
      const double by = values(without);
      if (by > 0) ratios.push_back(values(with) / by);
    };
    if (context.measurements.has_times())
      add(times, [](const auto& runs) { return statistics::median(all_times(runs, Boundary::kEqualWork)); });
    add(errors, [](const auto& runs) {
      const std::vector<double> values = all_values(runs, "l2");
      return values.empty() ? 0 : statistics::median(values);
    });
  }
  const auto ratio_cell = [](const std::vector<double>& ratios) {
    return ratios.empty() ? table::Cell() : table::Number(statistics::median(ratios));
  };
  if (!context.measurements.has_times()) return {ratio_cell(errors)};
  return {ratio_cell(times), ratio_cell(errors)};
}

std::vector<table::Column> ratio_columns(bool times) {
  std::vector<table::Column> columns = {table::words("Method")};
  for (const char* title : times ? std::vector{"Solved", "Time", "95 %", "least", "most", "L2", "least",
                                               "most", "Holes: time", "L2"}
                                 : std::vector{"Solved", "L2", "least", "most", "Holes: L2"})
    columns.emplace_back(title);
  return columns;
}

/// How many of the cases that it has the line solved, failures of the reference's included.
table::Cell solved_cell(const TableContext& context, const Line& line, const std::vector<Case>& cases) {
  std::size_t tried = 0;
  std::size_t solved = 0;
  for (const Case& which : cases) {
    const Runs runs = context.measurements.find(line, which);
    if (is_missing(runs)) continue;
    ++tried;
    solved += first_failure(runs) == nullptr ? 1U : 0U;
  }
  table::Cell cell = solved;
  cell.of = {static_cast<double>(tried), 0};
  return cell;
}

/// What the paper's text says of its figure in one table: every method beside Polylidar, and what holes
/// change.
std::optional<table::Table> ratio_table(const TableContext& context, const std::vector<Case>& cases) {
  const Line reference = reference_line();
  const std::vector<Line> lines = lines_of(context, cases);
  if (std::ranges::find(lines, reference) == lines.end() || lines.size() < 2) return std::nullopt;
  const bool times = context.measurements.has_times();
  table::Table table{"ratios",
                     "All cases together: ratios to " + label(context, reference) +
                         ", and of the cases with holes to those without",
                     ratio_columns(times)};
  for (const Line& line : lines) {
    const Ratios errors = metric_ratios(context.measurements, line, reference, cases, "l2");
    const Ratios slower = time_ratios(context.measurements, line, reference, cases);
    std::vector<table::Cell> cells = {label(context, line), solved_cell(context, line, cases)};
    const auto append = [&](const std::vector<table::Cell>& more) {
      cells.insert(cells.end(), more.begin(), more.end());
    };
    if (times) append(ratio_cells(slower));
    std::vector<table::Cell> error_cells = ratio_cells(errors);
    error_cells.erase(error_cells.begin() + 1);
    append(error_cells);
    append(holes_cells(context, line, cases));
    table.add_row(std::move(cells));
  }
  table.remarks.push_back(
      (times ? "Ratios of the times of equal work, and of the errors as a part of the ground truth's area. "
             : "Ratios of the errors as a part of the ground truth's area. ") +
      std::string("Cases are a shape, with or without holes, at a number of points. The ") +
      (times ? "last two columns" : "last column") + ": with holes over without, the median of the cases.");
  return table;
}

/// The rivals that are quoted (headline.hpp).
std::optional<table::Table> headline_table(const TableContext& context) {
  const json& headline = context.report.at("summary").at("headline");
  if (headline.is_null()) return std::nullopt;
  const auto label_of = [&](const json& line) {
    return label(context, {line.at("method").get<std::string>(), line.at("protocol").get<std::string>()});
  };
  const std::string reference = label_of(headline.at("reference"));
  table::Table table{"headline",
                     context.report.at("plan").at("title").get<std::string>() +
                         ": the fastest rival with the same polygons, time over that of " + reference,
                     {table::words("Method"), table::words("Same polygons"), "Cases", "Failed", "Time",
                      "95 %", "least", "most"}};
  bool any_same = false;
  bool any_tie = false;
  std::string does_more;
  for (const json& rival : headline.at("rivals")) {
    const bool same = rival.at("same_polygons").get<bool>();
    any_tie = any_tie || (any_same && same && !rival.contains("does_more"));
    any_same = any_same || same;
    does_more = rival.value("does_more", does_more);
    const auto number = [&](const char* name) {
      return rival.at(name).is_null() ? kInfinity : rival.at(name).get<double>();
    };
    const auto interval = rival.at("low").is_null()
                              ? std::nullopt
                              : std::optional(statistics::Interval{number("low"), number("high")});
    table.add_row({label_of(rival), same ? "yes" : "no", rival.at("cases").get<std::size_t>(),
                   rival.at("failures").get<std::size_t>(), table::Number(number("median")),
                   table::range_cell(interval), table::Number(number("least")),
                   table::Number(number("most"))});
  }
  table.remarks.emplace_back(
      "The same polygons, as the records tell: on every case that both solved as many polygons, holes and "
      "vertices, and area and L2 equal to within 1e-9 of the larger one. Of all methods with the same "
      "polygons the one with the least median stands here" +
      std::string(any_same ? "." : ", but there is none in this run."));
  if (any_tie)
    table.remarks.emplace_back(
        "The others with the same polygons are not distinguishable from the first: no 95 % interval of the "
        "ratio of their times to its times lies above 1.");
  if (!does_more.empty()) table.remarks.push_back(does_more);
  return table;
}

/// How long a method takes that has not been warmed up, where the records say it.
std::optional<table::Table> cold_table(const TableContext& context) {
  if (!context.measurements.has_times()) return std::nullopt;
  table::Table table{"cold",
                     "First call in a fresh process: time of equal work, ms",
                     {table::words("Method"), "Cases", table::Column("First call", "ms"),
                      table::Column("Warmed up", "ms"), "First / warmed up", "least", "most"}};
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
    const auto [least, most] = std::ranges::minmax_element(ratios);
    table.add_row({label(context, line), cold.size(), milliseconds(statistics::median(cold)),
                   milliseconds(statistics::median(warm)), table::Number(statistics::median(ratios)),
                   table::Number(*least), table::Number(*most)});
  }
  if (table.rows.empty()) return std::nullopt;
  table.remarks.emplace_back(
      "Of methods that compile while they run: the first call of a process beside the calls of the same row "
      "after the "
      "warm-up, which all other tables show. Medians of the cases on which they succeeded, and of the cases' "
      "ratios.");
  return table;
}

bool is_steps_shape(const Case& which) {
  const json& steps = paper().at("steps");
  return steps.at("dataset") == which.dataset && steps.at("holes") == which.holes;
}

std::vector<table::Cell> measured_steps(const TableContext& context, const Line& line, const Case& which) {
  const auto runs = context.measurements.find(line, which);
  if (runs.empty() || first_failure(runs) != nullptr) return {};
  std::vector<table::Cell> result = {row_label(context, line, {which})};
  for (const PaperStep& step : paper_steps()) result.push_back(median_cell(all_step_times(runs, step)));
  for (const Boundary boundary : {Boundary::kPaper, Boundary::kEqualWork})
    result.push_back(median_cell(all_times(runs, boundary)));
  return result;
}

/// The paper's values of the method whose steps `line` tells: under the method itself only where no other one
/// of `lines` tells them.
std::vector<table::Cell> published_steps(const Line& line, const std::vector<Line>& lines) {
  std::string method = line.method;
  const std::string teller = teller_of(method);
  const auto tells = [&](const Line& other) { return other.method == teller; };
  if (teller != method && std::ranges::any_of(lines, tells)) return {};
  for (const auto& [told, by] : paper().at("steps").at("told_by").items()) {
    if (by == json(line.method)) method = told;
  }
  const json& published = paper().at("steps").at("milliseconds");
  if (!published.contains(method)) return {};
  std::vector<table::Cell> result = {paper().at("methods").value(method, method) + ", in the paper"};
  const auto add = [&](const json& value) {
    result.push_back(value.is_number() ? table::Number(value.get<double>(), 1) : table::Cell());
  };
  for (const PaperStep& step : paper_steps()) add(published.at(method).at(step.name));
  add(published.at(method).at("total"));
  result.emplace_back();
  return result;
}

/// The steps of the methods on the paper's shape, at the paper's size with the paper's values beside them, or
/// at the largest size there is without.
std::optional<table::Table> steps_table(const TableContext& context) {
  if (!context.measurements.has_times()) return std::nullopt;
  const json& steps = paper().at("steps");
  const Case* chosen = nullptr;
  for (const Case& which : context.measurements.cases()) {
    if (is_steps_shape(which) && (chosen == nullptr || chosen->n != steps.at("n"))) chosen = &which;
  }
  if (chosen == nullptr) return std::nullopt;
  const bool comparable = chosen->n == steps.at("n");
  table::Table table{
      kStepsTable,
      shape_title(context, *chosen) + ", n = " + std::to_string(chosen->n) + ": time of the steps, ms",
      {table::words("Method")}};
  for (const PaperStep& step : paper_steps()) table.columns.emplace_back(step.name, "ms");
  for (const char* title : {"as the paper took it", "equal work"}) table.columns.emplace_back(title, "ms");
  std::set<std::string> compared;
  const std::vector<Line> lines = lines_of(context, {*chosen});
  for (const Line& line : lines) {
    std::vector<table::Cell> ours = measured_steps(context, line, *chosen);
    if (!ours.empty()) table.add_row(std::move(ours));
    if (!comparable || paper().at("protocol") != line.protocol || !compared.insert(line.method).second)
      continue;
    if (auto theirs = published_steps(line, lines); !theirs.empty()) table.add_row(std::move(theirs));
  }
  const std::string where = steps.at("where").get<std::string>();
  table.remarks.push_back(
      comparable
          ? "Medians; the paper's values are from its " + where + ", each the " +
                steps.at("statistic").get<std::string>() + ". A dash: the method does not tell the step."
          : "Medians. The paper's " + where + " is for n = " + steps.at("n").dump() +
                ", which was not measured here. A dash: the method does not tell the step.");
  return table;
}

std::optional<table::Table> claims_table(TableContext& context) {
  const bool times = context.measurements.has_times();
  table::Table table{"claims", "The paper's claims beside ours", {table::words("Claim"), "Paper", "Here"}};
  if (times) table.columns.emplace_back("Equal work");
  table.columns.push_back(table::words("Verdict"));
  const json& known = paper().at("claims").at("list");
  const auto known_claim = [&](const json& id) {
    return *std::ranges::find_if(known, [&](const json& claim) { return claim.at("id") == id; });
  };
  for (const json& claim : context.report.at("summary").at("claims")) {
    // Of an experiment on one case only the claims about a single case can be judged; the others need its
    // neighbours.
    const json checked = known_claim(claim.at("id"));
    if (context.measurements.cases().size() == 1 && !checked.at("check").contains("only")) continue;
    if (is_about_time(checked) && !times) continue;
    const auto text = [&](const char* key) {
      const json& value = claim.at(key);
      return value.is_null() ? table::Cell() : value.get<std::string>();
    };
    std::vector<table::Cell> cells = {text("claim"), text("paper"), text("ours")};
    cells.front().notes = {context.notes.number(claim.at("where").get<std::string>() + ": " +
                                                claim.at("detail").get<std::string>())};
    if (times) cells.push_back(text("equal_work"));
    cells.push_back(text("verdict"));
    table.add_row(std::move(cells));
  }
  if (table.rows.empty()) return std::nullopt;
  table.remarks.emplace_back(
      "Larger, smaller: than a number that the paper gives, by more than the band round it that the note "
      "says. Refuted: of a claim without a number. Undecided: the 95 % interval of the ratio is on both "
      "sides of the limit.");
  return table;
}

/// Whether the paper's claims and step times can be put beside this report at all.
bool is_papers_experiment(const TableContext& context) {
  const json& datasets = paper().at("claims").at("datasets");
  const auto& runs = context.measurements.runs();
  return std::ranges::any_of(runs, [&](const record::RunRecord& run) {
    return paper().at("protocol") == run.protocol &&
           std::find(datasets.begin(), datasets.end(), run.dataset) != datasets.end();
  });
}

void add(table::Document& document, std::optional<table::Table> table) {
  if (table) document.tables.push_back(std::move(*table));
}

void add_all(table::Document& document, std::vector<table::Table> tables) {
  std::move(tables.begin(), tables.end(), std::back_inserter(document.tables));
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
  } else if (name == "zoo") {
    document.tables.push_back(zoo_table(context));
  } else if (name == "real") {
    add_all(document, real_tables(context));
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
  for (table::Table& table : document.tables) table.id = name + "_" + table.id;
  document.notes = context.notes.marked();
  for (auto& note : run_notes(report, context.measurements)) document.notes.push_back(std::move(note));
  document.common_notes = common_notes(report, context.measurements);
  return document;
}

}  // namespace hullbench::report
