#include "benchmarks/report/overview_tables.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "benchmarks/report/labels.hpp"
#include "benchmarks/report/table_context.hpp"

namespace hullbench::report {
namespace {

table::Cell yes_or_no(const json& method, const char* capability) {
  const json& capabilities = method.at("capabilities");
  if (method.at("version").get<std::string>().empty() || !capabilities.contains(capability)) return {};
  return capabilities.at(capability).get<bool>() ? "yes" : "no";
}

table::Cell text_or_nothing(const json& method, const char* key) {
  const std::string text = method.at(key).get<std::string>();
  return text.empty() ? table::Cell() : text;
}

/// Which values of a plan a column shows.
struct Column {
  const json* report = nullptr;
  std::string dataset;  ///< empty: the values are the same for all
  std::string title;
};

bool is_given_by_case(const json& parameter) {
  return parameter.is_object() && parameter.contains("cases");
}

/// The data sets that any parameter of the plan has values for, without their variants with holes.
std::vector<std::string> datasets_with_values(const json& plan) {
  std::set<std::string> names;
  for (const json& method : plan.at("methods")) {
    const json parameters = method.value("parameters", json::object());
    for (const auto& [name, parameter] : parameters.items()) {
      if (!is_given_by_case(parameter)) continue;
      for (const auto& [key, unused] : parameter.at("cases").items()) {
        // Values for one number of points each are the oracle's; nobody reads hundreds of them in a table.
        if (key.find("/n:") == std::string::npos) names.insert(key.substr(0, key.find('/')));
      }
    }
  }
  return {names.begin(), names.end()};
}

bool has_run_on(const json& report, const std::string& dataset) {
  const json& runs = report.at("runs");
  return std::ranges::any_of(runs, [&](const json& run) { return run.at("dataset") == dataset; });
}

std::vector<Column> columns_of(const std::vector<json>& reports) {
  std::vector<Column> columns;
  for (const json& report : reports) {
    const json& plan = report.at("plan");
    const std::vector<std::string> datasets = datasets_with_values(plan);
    if (datasets.empty())
      columns.push_back({&report, "", plan.value("title", plan.value("name", std::string()))});
    for (const std::string& dataset : datasets) {
      if (has_run_on(report, dataset)) columns.push_back({&report, dataset, family_title(report, dataset)});
    }
  }
  return columns;
}

std::string number_text(const json& value) {
  if (value.is_null()) return "no limit";
  std::ostringstream text;
  text << value.get<double>();
  return text.str();
}

/// "1.5 √(A_hull/n)", squared "(1.5)² A_hull/n".
std::string scaled_text(const json& parameter) {
  const std::string factor = number_text(parameter.at("scaled"));
  return parameter.value("power", 1) == 2 ? "(" + factor + ")² A_hull/n" : factor + " √(A_hull/n)";
}

/// "2.0", "2.0; 1.25 with holes", "1.5 √(A_hull/n)", or a rule's formula.
std::string value_text(const Column& column, const json& parameter) {
  if (parameter.is_object() && parameter.contains("rule")) {
    const std::string rule = parameter.at("rule").get<std::string>();
    return column.report->value("rules", json::object()).value(rule, rule);
  }
  if (parameter.is_object() && parameter.contains("scaled")) return scaled_text(parameter);
  if (!is_given_by_case(parameter)) return number_text(parameter);
  const json& cases = parameter.at("cases");
  if (std::any_of(cases.items().begin(), cases.items().end(),
                  [](const auto& item) { return item.key().find("/n:") != std::string::npos; }))
    return "case by case";
  const auto plain = cases.find(column.dataset);
  const auto holes = cases.find(column.dataset + "/holes");
  if (plain == cases.end() && holes == cases.end()) return "";
  if (plain == cases.end()) return number_text(*holes) + " with holes";
  if (holes == cases.end() || *holes == *plain) return number_text(*plain);
  return number_text(*plain) + "; " + number_text(*holes) + " with holes";
}

/// Whether the report has a run of the line: a plan may name methods that are measured on request only.
bool has_run(const json& report, const Line& line) {
  const json& runs = report.at("runs");
  return std::ranges::any_of(runs, [&](const json& run) {
    return run.at("method") == line.method && run.at("protocol") == line.protocol;
  });
}

/// What a column gives a method's parameter; empty when the method is not in it.
std::string cell_text(const Column& column, const Line& line, const std::string& parameter) {
  if (!has_run(*column.report, line)) return "";
  for (const json& method : column.report->at("plan").at("methods")) {
    if (method.at("method") != line.method || method.at("protocol") != line.protocol) continue;
    const json keeps_to = method.value("datasets", json::array());
    const bool excluded = !column.dataset.empty() && !keeps_to.empty() &&
                          std::find(keeps_to.begin(), keeps_to.end(), column.dataset) == keeps_to.end();
    const json parameters = method.value("parameters", json::object());
    if (!excluded && parameters.contains(parameter)) return value_text(column, parameters.at(parameter));
  }
  return "";
}

/// Method, protocol and parameter of every line, in the order of the plans.
std::vector<std::pair<Line, std::string>> parameter_lines(const std::vector<json>& reports) {
  std::vector<std::pair<Line, std::string>> lines;
  for (const json& report : reports) {
    for (const json& method : report.at("plan").at("methods")) {
      const Line line = {method.at("method").get<std::string>(), method.at("protocol").get<std::string>()};
      if (!has_run(report, line)) continue;
      const json parameters = method.value("parameters", json::object());
      for (const auto& [name, unused] : parameters.items()) {
        const std::pair<Line, std::string> entry = {line, name};
        if (std::ranges::find(lines, entry) == lines.end()) lines.push_back(entry);
      }
    }
  }
  std::ranges::stable_sort(lines, [](const auto& a, const auto& b) {
    return std::pair(a.first.method, a.first.protocol) < std::pair(b.first.method, b.first.protocol);
  });
  return lines;
}

}  // namespace

table::Table methods_table(const std::vector<json>& reports) {
  table::Table table{"methods",
                     "Methods: what each returns",
                     {table::words("Method"), table::words("The library returns"), table::words("Holes"),
                      table::words("Several polygons"), "Version", table::words("Licence")}};
  std::set<std::string> seen;
  for (const json& report : reports) {
    for (const json& method : report.at("methods")) {
      if (!seen.insert(method.at("name").get<std::string>()).second) continue;
      table.add_row({method.at("title").get<std::string>(), text_or_nothing(method, "native_output"),
                     yes_or_no(method, "holes"), yes_or_no(method, "several_polygons"),
                     text_or_nothing(method, "version"), text_or_nothing(method, "licence")});
    }
  }
  return table;
}

table::Table parameters_table(const std::vector<json>& reports) {
  const std::vector<Column> columns = columns_of(reports);
  table::Table table{
      "parameters", "Parameters of the experiments", {table::words("Method"), table::words("Parameter")}};
  for (const Column& column : columns) table.columns.emplace_back(column.title);
  for (const auto& [line, parameter] : parameter_lines(reports)) {
    std::vector<table::Cell> cells = {method_label(reports, line.method, line.protocol), parameter};
    for (const Column& column : columns) cells.emplace_back(cell_text(column, line, parameter));
    table.add_row(std::move(cells));
  }
  table.remarks.emplace_back(
      "A is the area of the ground truth, n the number of points, A_hull the area of a convex hull: of the "
      "ground truth for target_percent, else of the points. S is the median of the sizes that the core "
      "chooses from the points. A cell without text: the method is not in that experiment.");
  return table;
}

}  // namespace hullbench::report
