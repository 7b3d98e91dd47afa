#include "benchmarks/report/readme.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "benchmarks/base/configuration_error.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/report/table_context.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::report {
namespace {

constexpr std::string_view kBegin = "<!-- results: begin -->\n";
constexpr std::string_view kEnd = "<!-- results: end -->";

/// Time and error of the paper's methods with its parameters, and of the rivals that are quoted first, on the
/// shape whose steps the paper timed, at the least and the largest number of points. None of a report without
/// that shape.
std::optional<table::Table> methods_table(const json& report) {
  const TableContext context{report, Measurements(report), {}};
  Shape shape;
  for (const Shape& one : shapes(context.measurements.cases())) {
    if (paper().at("steps").at("dataset") == one.front().dataset) shape = one;
  }
  if (shape.empty()) return std::nullopt;
  if (shape.size() > 2) shape = {shape.front(), shape.back()};
  const bool times = context.measurements.has_times();
  table::Table table{"paper_methods",
                     shape_title(context, shape.front()) + (times ? ": time and error" : ": error") +
                         " of the paper's methods and of the fastest other method with the same polygons",
                     {table::words("Method")}};
  for (const Case& which : shape) {
    const std::string points = std::to_string(which.n) + " points";
    if (times) table.columns.push_back(table::with_unit(points, "ms"));
    table.columns.push_back(table::with_unit(times ? "error" : points, "%"));
  }
  const json& headline = report.at("summary").at("headline");
  const json rivals = headline.is_null() ? json::array() : headline.at("rivals");
  for (const Line& line : lines_of(context, shape)) {
    const bool is_papers =
        paper().at("methods").contains(line.method) && paper().at("protocol") == line.protocol;
    const bool is_rival = std::ranges::any_of(rivals, [&](const json& rival) {
      return rival.at("method") == line.method && rival.at("protocol") == line.protocol;
    });
    if (!is_papers && !is_rival) continue;
    std::vector<table::Cell> cells = {row_label(context, line, shape)};
    for (const Case& which : shape) {
      const auto runs = context.measurements.find(line, which);
      if (times) cells.push_back(cell(runs, Quantity::kEqualWork));
      cells.push_back(cell(runs, Quantity::kError));
    }
    say_not_installed_once(cells);
    table.add_row(std::move(cells));
  }
  table.remarks.emplace_back(
      "Error: the symmetric difference, % of the ground truth's area (in brackets as in the paper, of the "
      "result's area). (paper): with the paper's parameters, computed from the ground truth; SpatiaLite's is "
      "a number that the paper chose.");
  if (times)
    table.remarks.emplace_back(
        "Time: from points in memory to a valid multipolygon in memory, median ± median absolute deviation.");
  explain_hull_sign(table);
  return table;
}

std::size_t place_of(const std::string& text, std::string_view mark) {
  const std::size_t place = text.find(mark);
  if (place == std::string::npos || text.find(mark, place + 1) != std::string::npos) {
    throw std::runtime_error("the README must have the line " + std::string(mark.substr(0, mark.find('\n'))) +
                             " once; put it where the results are to stand");
  }
  return place;
}

}  // namespace

std::string readme_results(const std::vector<json>& reports, const std::string& folder) {
  if (reports.empty()) throw ConfigurationError("there is no run in " + folder + " yet; measure it first");
  std::size_t runs = 0;
  std::set<std::string> dates;
  for (const json& report : reports) {
    runs += report.at("runs").size();
    dates.insert(report.at("created").get<std::string>().substr(0, 10));
  }
  std::ostringstream out;
  out << "The numbers below are those of the reference run in\n[" << folder << "](" << folder
      << "), begun on " << join_words({dates.begin(), dates.end()}) << ": " << runs << " runs, "
      << reports.size() << (reports.size() == 1 ? " experiment" : " experiments")
      << ".\nAll of its tables, and how to read them, are in [" << folder << "/tables.md](" << folder
      << "/tables.md).\n";
  for (const json& report : reports) {
    const auto table = methods_table(report);
    if (!table) continue;
    out << "\n### " << table->caption << "\n\n";
    table::print_markdown(*table, out);
    out << '\n';
    for (const std::string& remark : table->remarks) table::print_item(remark, out);
    const std::string why_no_times = Measurements(report).why_no_times();
    if (!why_no_times.empty()) table::print_item(why_no_times, out);
    break;
  }
  return out.str();
}

std::string with_results(const std::string& readme, const std::string& results) {
  const std::size_t begin = place_of(readme, kBegin) + kBegin.size();
  const std::size_t end = place_of(readme, kEnd);
  if (end < begin)
    throw std::runtime_error("the README's marks of the results stand in the wrong order; swap them");
  return readme.substr(0, begin) + results + readme.substr(end);
}

}  // namespace hullbench::report
