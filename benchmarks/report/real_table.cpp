#include "benchmarks/report/real_table.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "benchmarks/base/words.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

/// What a table shows, in per cent.
struct Measure {
  const char* id;
  const char* caption;
  const char* metric;
  const char* short_title;  ///< above its column in the table of all sets; null: none is better than another
};

constexpr std::array kMeasures = {
    Measure{"covered", "Points in the hull or on its edge, %", "points_covered", "Covered, %"},
    Measure{"area", "Area of the hull, % of the convex hull's", "convex_hull_share", nullptr},
    Measure{"halves", "Agreement (IoU) of the hulls of two random halves of the points, %",
            "agreement_halves", "Halves agree, %"},
    Measure{"subsamples", "Agreement (IoU) of the hulls of 90 % and of all points, %", "agreement_subsamples",
            "90 % agree, %"},
    Measure{"window", "Agreement (IoU) with the window in which the points were looked for, %", "window_iou",
            nullptr}};

/// A result that is believed and that has an area.
bool has_hull(const record::RunRecord& run) {
  return is_measured(run) && metric(run, "polygons") != 0.0;
}

/// Why the cell has no number.
std::string no_hull_word(const record::RunRecord& run) {
  if (run.status == record::Status::kNotInstalled) return table::kNothing;
  return is_measured(run) ? "empty" : failure_name(run);
}

table::Number percent(double share) {
  const double value = 100 * share;
  return {value, value < 100 ? 1 : 0};
}

table::Cell measure_cell(const record::RunRecord& run, const Measure& measure) {
  if (!has_hull(run)) return no_hull_word(run);
  const auto value = metric(run, measure.metric);
  return value ? table::Cell(percent(*value)) : table::Cell();
}

/// "2" parts, or "2, 3 holes".
table::Cell parts_cell(const record::RunRecord& run) {
  if (!has_hull(run)) return no_hull_word(run);
  const auto count = [&](const char* name) {
    return std::to_string(static_cast<std::size_t>(metric(run, name).value_or(0)));
  };
  const std::string holes = count("holes");
  return count("polygons") + (holes == "0" ? "" : ", " + holes + (holes == "1" ? " hole" : " holes"));
}

table::Column percent_column(std::string title) {
  return {std::move(title), "%"};
}

/// The tables with a row a set and a column a method.
class SetTables {
 public:
  explicit SetTables(TableContext& context)
      : context_(context), lines_(lines_of(context, context.measurements.cases())) {}

  /// `column` of a method's label; without `all_sets`, only the sets that `read` gives a number of.
  template <typename Read>
  table::Table make(const std::string& id, const std::string& caption, const Read& read,
                    table::Column (*column)(std::string), bool all_sets) {
    table::Table table{id, caption, {table::words("Points")}};
    for (const Line& line : lines_) table.columns.push_back(column(label(context_, line)));
    for (const Case& which : context_.measurements.cases()) {
      std::vector<table::Cell> cells = {name(which)};
      bool any = false;
      for (const Line& line : lines_) {
        const auto runs = context_.measurements.find(line, which);
        cells.push_back(runs.empty() ? table::Cell() : read(*runs.front()));
        any = any || cells.back().value;
      }
      if (const Runs runs = all_runs(which); is_missing(runs)) {
        say_not_installed(cells);
        cells[0].notes = {context_.notes.number(sentence(runs.front()->detail))};
      }
      if (any || all_sets) table.add_row(std::move(cells));
    }
    return table;
  }

 private:
  table::Cell name(const Case& which) const {
    return shape_title(context_, which) + (which.n > 0 ? ", " + std::to_string(which.n) : "");
  }

  Runs all_runs(const Case& which) const {
    Runs runs;
    for (const Line& line : lines_) {
      for (const record::RunRecord* run : context_.measurements.find(line, which)) runs.push_back(run);
    }
    return runs;
  }

  TableContext& context_;
  std::vector<Line> lines_;
};

/// The median over all sets that were tried; a set without a hull counts as 0.
table::Cell median_of(const Runs& runs, const char* name) {
  std::vector<double> values;
  bool any = false;
  for (const record::RunRecord* run : runs) {
    const auto value = has_hull(*run) ? metric(*run, name) : std::nullopt;
    any = any || value;
    values.push_back(value.value_or(0));
  }
  return any ? table::Cell(percent(statistics::median(values))) : table::Cell();
}

table::Table methods_table(const TableContext& context) {
  table::Table table{"methods", "What the methods make of all sets", {table::words("Method"), "Sets"}};
  for (const Measure& measure : kMeasures) {
    if (measure.short_title != nullptr) table.columns.emplace_back(measure.short_title, "%");
  }
  for (const Line& line : lines_of(context, context.measurements.cases())) {
    Runs runs;
    for (const Case& which : context.measurements.cases()) {
      for (const record::RunRecord* run : context.measurements.find(line, which)) {
        if (run->status != record::Status::kNotInstalled) runs.push_back(run);
      }
    }
    if (runs.empty()) continue;
    const auto good =
        std::ranges::count_if(runs, [](const record::RunRecord* run) { return has_hull(*run); });
    std::vector<table::Cell> cells = {label(context, line), static_cast<std::size_t>(good)};
    cells.back().of = {static_cast<double>(runs.size()), 0};
    for (const Measure& measure : kMeasures) {
      if (measure.short_title != nullptr) cells.push_back(median_of(runs, measure.metric));
    }
    table.add_row(std::move(cells));
  }
  table.remarks = {
      "Sets: those with a valid hull that has an area, of those that were tried. Medians over the sets that "
      "were tried, of which one without such a hull counts as 0. They do not say who is right: the convex "
      "hull covers all points and changes least."};
  return table;
}

table::Table sources_table(const TableContext& context) {
  table::Table table{"sources",
                     "Where the points are from",
                     {table::words("Points"), "Number", table::words("Source"), table::words("Licence"),
                      table::words("SHA-256 of the points")}};
  for (const Case& which : context.measurements.cases()) {
    std::vector<table::Cell> cells = {shape_title(context, which), static_cast<std::size_t>(which.n)};
    const std::optional<std::string> family = family_of(context.report, which.dataset);
    for (const json& set : context.report.at("datasets")) {
      const std::string name = set.value("name", "");
      if ((name == which.dataset || name == family) && cells.size() == 2) {
        cells.emplace_back(set.value("source", ""));
        cells.emplace_back(set.value("licence", ""));
      }
    }
    cells.resize(4);
    for (const record::RunRecord& run : context.measurements.runs()) {
      if (run.dataset == which.dataset && run.n == which.n && cells.size() == 4)
        cells.emplace_back(run.n > 0 ? run.dataset_sha256 : "");
    }
    table.add_row(std::move(cells));
  }
  return table;
}

}  // namespace

std::vector<table::Table> real_tables(TableContext& context) {
  std::vector<table::Table> tables = {methods_table(context)};
  SetTables sets(context);
  const auto add = [&](const Measure& measure, bool all_sets) {
    const auto read = [&](const record::RunRecord& run) { return measure_cell(run, measure); };
    tables.push_back(sets.make(measure.id, measure.caption, read, percent_column, all_sets));
  };
  add(kMeasures[0], true);
  tables.push_back(sets.make("parts", "Parts of the hull, and holes", parts_cell, table::words, true));
  for (std::size_t i = 1; i + 1 < kMeasures.size(); ++i) add(kMeasures[i], true);
  add(kMeasures.back(), false);
  tables.back().remarks = {
      "The window is where the points could have been, not their shape: a hull of points that keep to a part "
      "of it is right to leave the rest out."};
  if (tables.back().rows.empty()) tables.pop_back();
  tables.push_back(sources_table(context));
  return tables;
}

}  // namespace hullbench::report
