#include "benchmarks/report/curve_table.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

#include "benchmarks/report/labels.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

/// Where a row stands on a plan's axis: a number, or for the axis "sampling" the stress in words ("noise
/// 0.5"; "uniform" without one). Null when it has no place there.
json place_on_axis(const json& axis, const record::RunRecord& row) {
  const std::string of = axis.at("of").get<std::string>();
  if (of == "n") return row.n;
  if (of == "sampling") {
    const std::size_t mark = row.dataset.find('~');
    if (mark == std::string::npos) return "uniform";
    return stress_title(row.dataset.substr(mark + 1));
  }
  const auto level = row.levels.find(of);
  return level == row.levels.end() ? json() : json(level->second);
}

struct Place {
  json at;                  ///< on the axis
  std::vector<Case> cases;  ///< there
};

/// The places on the axis, from the least number on, or in the order in which they occur.
std::vector<Place> places_of(const TableContext& context, const json& axis) {
  std::vector<Place> places;
  for (const record::RunRecord& row : context.measurements.runs()) {
    const json at = place_on_axis(axis, row);
    if (at.is_null()) continue;
    auto found = std::ranges::find_if(places, [&](const Place& place) { return place.at == at; });
    if (found == places.end()) found = places.insert(places.end(), {at, {}});
    const Case which = {row.dataset, row.holes, row.n};
    if (std::ranges::find(found->cases, which) == found->cases.end()) {
      found->cases.push_back(which);
    }
  }
  std::ranges::stable_sort(places, [](const Place& one, const Place& other) {
    return one.at.is_number() && other.at.is_number() && one.at.get<double>() < other.at.get<double>();
  });
  return places;
}

struct Errors {
  std::vector<double> values;  ///< L2 of every case; infinity where the run failed or has none
  std::size_t failures = 0;
};

Errors errors_of(const TableContext& context, const Line& line, const std::vector<Case>& cases) {
  Errors errors;
  for (const Case& which : cases) {
    const auto runs = context.measurements.find(line, which);
    if (is_missing(runs)) continue;
    const std::vector<double> values = all_values(runs, "l2");
    const bool failed = first_failure(runs) != nullptr || values.empty();
    errors.failures += failed ? 1 : 0;
    errors.values.push_back(failed ? std::numeric_limits<double>::infinity() : statistics::median(values));
  }
  return errors;
}

table::Cell error_cell(const std::vector<double>& errors) {
  if (errors.empty()) return {};
  return table::Number(100 * statistics::median(errors));
}

std::string place_text(const json& at) {
  if (at.is_string()) return at.get<std::string>();
  std::ostringstream text;
  text << at.get<double>();
  return text.str();
}

std::vector<table::Column> columns_of(const json& axis, const std::vector<Place>& places) {
  const std::string title = axis.at("title").get<std::string>();
  const std::string unit = axis.at("unit").get<std::string>();
  std::vector<table::Column> columns = {table::words(title + (unit.empty() ? "" : ", " + unit))};
  for (const Place& place : places) columns.emplace_back(place_text(place.at), "%");
  columns.emplace_back("Failed");
  return columns;
}

}  // namespace

table::Table curve_table(TableContext& context) {
  const json& axis = context.report.at("plan").at("axis");
  const std::vector<Place> places = places_of(context, axis);
  table::Table table{"curves", "Error L2 along the axis, % of the ground truth's area, median of the cases",
                     columns_of(axis, places)};
  for (const Line& line : lines_of(context, context.measurements.cases())) {
    std::vector<table::Cell> cells = {label(context, line)};
    cells.front().notes = failure_notes(context, line, context.measurements.cases());
    std::size_t failures = 0;
    for (const Place& place : places) {
      const Errors errors = errors_of(context, line, place.cases);
      failures += errors.failures;
      cells.push_back(error_cell(errors.values));
    }
    cells.emplace_back(failures);
    table.add_row(std::move(cells));
  }
  table.remarks.emplace_back(
      "A failed run counts as infinitely bad; ∞: half of the runs failed, or more. A dash: not run.");
  return table;
}

}  // namespace hullbench::report
