#include "benchmarks/report/collection_tables.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/group_values.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

using nlohmann::json;

/// From so many shapes on nobody wants a row for each.
constexpr std::size_t kTooManyForRows = 60;

const std::vector<std::string> kErrorColumns = {"L2 mean, %", "std", "max"};
const std::vector<std::string> kTimeColumns = {"Time mean, ms", "std", "max", "Equal work mean, ms"};

bool has_prefix(const json& entry, const std::string& dataset) {
  const json& prefixes = entry.at("dataset_prefixes");
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const json& prefix) { return dataset.starts_with(prefix.get<std::string>()); });
}

/// Whether the paper's entry is about a case like this one.
bool is_about(const json& entry, const Case& which) {
  return has_prefix(entry, which.dataset) && (!entry.contains("n") || entry.at("n") == which.n);
}

/// What the paper published of shapes like these at this size, or null.
const json& published_collection(const std::vector<Shape>& shapes) {
  static const json none;
  for (const json& collection : paper().at("collections")) {
    const bool all = std::all_of(shapes.begin(), shapes.end(),
                                 [&](const Shape& shape) { return is_about(collection, shape.front()); });
    if (all) return collection;
  }
  return none;
}

std::vector<Case> cases_of(const std::vector<Shape>& shapes) {
  std::vector<Case> cases;
  for (const Shape& shape : shapes) cases.insert(cases.end(), shape.begin(), shape.end());
  return cases;
}

/// "n = 2000", or of shapes with their own points "83012 points on average".
std::string size_text(const std::vector<Case>& cases) {
  double sum = 0;
  bool same = true;
  for (const Case& which : cases) {
    sum += static_cast<double>(which.n);
    same = same && which.n == cases.front().n;
  }
  if (same) return "n = " + std::to_string(cases.front().n);
  return fixed(sum / static_cast<double>(cases.size()), 0) + " points on average";
}

void append(std::vector<std::string>& cells, const std::vector<std::string>& more) {
  cells.insert(cells.end(), more.begin(), more.end());
}

/// What the columns of values hold, for a caption.
std::string values_text(const TableContext& context) {
  return context.measurements.has_times() ? "error (of the result's area) and time as the paper took them"
                                          : "error (of the result's area) as the paper took it";
}

void append_value_columns(const TableContext& context, std::vector<std::string>& header) {
  append(header, kErrorColumns);
  if (context.measurements.has_times()) append(header, kTimeColumns);
}

void append_values(const TableContext& context, std::vector<std::string>& cells, const GroupValues& values) {
  append(cells, percent_cells(values.error));
  if (!context.measurements.has_times()) return;
  append(cells, millisecond_cells(values.time));
  cells.push_back(values.equal_work ? three_digits(values.equal_work->mean) : kNothing);
}

void append_published(const TableContext& context, std::vector<std::string>& cells, const json& published) {
  const bool times = context.measurements.has_times();
  for (const char* quantity : {"l2_percent", "milliseconds"}) {
    if (quantity == std::string_view("milliseconds") && !times) return;
    for (const json& value : published.at(quantity)) cells.push_back(fixed(value.get<double>(), 1));
  }
  cells.emplace_back(kNothing);
}

std::string paper_label(const Line& line) {
  return paper().at("methods").value(line.method, line.method) + ", in the paper";
}

/// The marks of every failure of a line, each kind once a shape.
std::string group_failure_marks(TableContext& context, const Line& line, const std::vector<Case>& cases) {
  std::string marks;
  for (const Case& which : cases) {
    const std::string mark = failure_marks(context, line, {which});
    if (marks.find(mark) == std::string::npos) marks += mark;
  }
  return marks;
}

std::vector<CaseGroup> family_groups(const TableContext& context, const std::vector<Case>& cases) {
  std::vector<CaseGroup> groups;
  for (const Case& which : cases) {
    const std::string title = family_title(context.report, which.dataset);
    const auto found = std::find_if(groups.begin(), groups.end(),
                                    [&](const CaseGroup& group) { return group.title == title; });
    if (found == groups.end()) {
      groups.push_back({title, {which}, json()});
    } else {
      found->cases.push_back(which);
    }
  }
  return groups;
}

/// "comb, spiral and walk": the groups' titles in small letters.
std::string kinds_text(const std::vector<CaseGroup>& groups) {
  std::string text;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    std::string title = groups[i].title;
    if (!title.empty() && title[0] >= 'A' && title[0] <= 'Z')
      title[0] = static_cast<char>(title[0] - 'A' + 'a');
    text += (i == 0 ? "" : (i + 1 == groups.size() ? " and " : ", ")) + title;
  }
  return text;
}

/// Which cases the means of a table are of, where some failed.
constexpr const char* kMeansRemark =
    "Means, deviations and maxima are of the same cases for all methods: those that each of them solved, as "
    "many as \"Shapes\" says. A method that solved less than half as many as another one is left out of them "
    "and has none. Failed: cases without a valid result.";

table::TableSection summary_table(TableContext& context, const std::vector<Line>& lines,
                                  const std::vector<Case>& cases, const json& published) {
  std::vector<std::string> header = {"Method", "Shapes", "Failed"};
  append_value_columns(context, header);
  table::TableSection section{"summary", "", table::TextTable(std::move(header)), {}};
  const std::vector<CaseGroup> kinds = family_groups(context, cases);
  // Shapes that are no family have each a title of its own.
  const std::string kind = kinds.size() < cases.size() ? " (" + kinds_text(kinds) + ")" : "";
  section.caption =
      std::to_string(cases.size()) + " shapes" + kind + ", " + size_text(cases) + ": " + values_text(context);
  bool any_failed = false;
  const std::vector<GroupValues> all = group_values(context, lines, cases);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    std::vector<std::string> cells = {
        row_label(context, line, cases) + group_failure_marks(context, line, cases),
        std::to_string(all[i].cases), std::to_string(all[i].failed)};
    any_failed = any_failed || all[i].failed > 0;
    append_values(context, cells, all[i]);
    section.table.add_row(std::move(cells));
    const json theirs = published_values({"", {}, published}, line);
    if (theirs.is_null()) continue;
    cells = {paper_label(line), published.at("shapes").dump(), kNothing};
    append_published(context, cells, theirs);
    section.table.add_row(std::move(cells));
  }
  if (any_failed) section.remarks.emplace_back(kMeansRemark);
  if (!published.is_null()) {
    section.remarks.push_back("The paper's values are from its " + published.at("where").get<std::string>() +
                              "; " + published.at("remark").get<std::string>() + ".");
  }
  return section;
}

std::string error_cell(const TableContext& context, const Line& line, const Case& which,
                       const json& published) {
  const auto runs = context.measurements.find(line.method, line.protocol, which);
  if (const record::RunRecord* failure = first_failure(runs)) {
    return failure->status == record::Status::kNotInstalled ? "" : failure_name(*failure);
  }
  const auto errors = all_values(runs, "l2_paper");
  if (errors.empty()) return kNothing;
  std::string text = fixed(100 * statistics::median(std::span<const double>(errors)), 1);
  if (!published.is_null() && paper().at("protocol") == line.protocol) {
    const json value = published.value("by_shape", json::object())
                           .value(which.dataset, json::object())
                           .value(line.method, json());
    if (value.is_number()) text += " (" + fixed(value.get<double>(), 1) + ")";
  }
  return text + hull_mark(runs);
}

table::TableSection shape_table(const TableContext& context, const std::vector<Line>& lines,
                                const std::vector<Case>& cases, const json& published) {
  std::vector<std::string> header = {"Shape"};
  for (const Line& line : lines) header.push_back(label(context, line));
  table::TableSection section{
      "shapes", "Error L2 of every shape, % of the result's area", table::TextTable(std::move(header)), {}};
  bool has_brackets = false;
  for (const Case& which : cases) {
    std::vector<std::string> cells = {shape_title(context, which)};
    for (const Line& line : lines) {
      cells.push_back(error_cell(context, line, which, published));
      has_brackets = has_brackets || cells.back().find('(') != std::string::npos;
    }
    section.table.add_row(std::move(cells));
  }
  if (has_brackets) section.caption += " (in brackets the paper's)";
  explain_hull_mark(section);
  return section;
}

/// The convexity of a case's ground truth, from any run that was scored.
std::map<Case, double> convexities(const TableContext& context) {
  std::map<Case, double> result;
  for (const record::RunRecord& run : context.measurements.runs()) {
    if (const auto convexity = metric(run, "ground_truth_convexity")) {
      result.emplace(Case{run.dataset, run.holes, run.n}, *convexity);
    }
  }
  return result;
}

/// `cases` in the paper's classes of convexity; the last group is of those that no run was scored on.
std::vector<CaseGroup> convexity_groups(const TableContext& context, const std::vector<Case>& cases) {
  const json& classes = paper().at("convexity_classes");
  const std::map<Case, double> convexity = convexities(context);
  std::vector<CaseGroup> groups;
  for (const json& one : classes.at("rows"))
    groups.push_back({one.at("title").get<std::string>(), {}, json()});
  groups.push_back({"not known", {}, json()});
  for (const Case& which : cases) {
    std::size_t place = 0;
    const auto known = convexity.find(which);
    while (place + 1 < groups.size() &&
           (known == convexity.end() ||
            known->second < classes.at("rows")[place].at("at_least").get<double>())) {
      ++place;
    }
    groups[place].cases.push_back(which);
  }
  const bool published = !cases.empty() && std::all_of(cases.begin(), cases.end(), [&](const Case& which) {
    return is_about(classes, which);
  });
  for (std::size_t i = 0; published && i < classes.at("rows").size(); ++i) {
    groups[i].published = {{"methods", {{classes.at("method"), classes.at("rows")[i]}}}};
  }
  std::erase_if(groups, [](const CaseGroup& group) { return group.cases.empty(); });
  return groups;
}

table::TableSection group_table(TableContext& context, const std::string& id, const std::string& caption,
                                const std::string& first_column, const std::vector<CaseGroup>& groups) {
  std::vector<std::string> header = {first_column, "Method", "Shapes", "Failed", "Invalid"};
  append_value_columns(context, header);
  table::TableSection section{id, caption, table::TextTable(std::move(header)), {}};
  bool has_published = false;
  bool any_failed = false;
  for (const CaseGroup& group : groups) {
    const std::vector<Line> lines = lines_of(context, group.cases);
    const std::vector<GroupValues> all = group_values(context, lines, group.cases);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Line& line = lines[i];
      std::vector<std::string> cells = {
          group.title,
          row_label(context, line, group.cases) + group_failure_marks(context, line, group.cases),
          std::to_string(all[i].cases), std::to_string(all[i].failed), std::to_string(all[i].invalid)};
      any_failed = any_failed || all[i].failed > 0;
      append_values(context, cells, all[i]);
      section.table.add_row(std::move(cells));
      const json theirs = published_values(group, line);
      if (theirs.is_null()) continue;
      has_published = true;
      cells = {group.title, paper_label(line), kNothing, kNothing, kNothing};
      append_published(context, cells, theirs);
      section.table.add_row(std::move(cells));
    }
  }
  if (any_failed) section.remarks.emplace_back(kMeansRemark);
  if (has_published) {
    const json& classes = paper().at("convexity_classes");
    section.remarks.push_back("The paper's values are from its " + classes.at("where").get<std::string>() +
                              ", " + classes.at("shapes").dump() + " polygons; " +
                              classes.at("remark").get<std::string>() + ".");
  }
  return section;
}

/// Adds to `section` how many results of all its groups GEOS found to be invalid.
void say_validity(const TableContext& context, const std::vector<Case>& cases, table::TableSection& section) {
  const std::vector<Line> lines = lines_of(context, cases);
  const std::vector<GroupValues> all = group_values(context, lines, cases);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    section.remarks.push_back(
        label(context, lines[i]) + ": of " + std::to_string(all[i].solved + all[i].invalid) +
        " results, each checked by GEOS, " + std::to_string(all[i].invalid) + " are invalid.");
  }
}

std::vector<table::TableSection> class_tables(TableContext& context, const std::vector<Case>& cases) {
  std::vector<Case> papers_own;
  std::vector<Case> others;
  for (const Case& which : cases) {
    (is_about(paper().at("convexity_classes"), which) ? papers_own : others).push_back(which);
  }
  std::vector<table::TableSection> sections;
  for (const auto& [id, part] :
       {std::pair{"convexity", &papers_own}, std::pair{"convexity_others", &others}}) {
    if (part->empty()) continue;
    const std::vector<CaseGroup> kinds = family_groups(context, *part);
    const std::string caption = std::to_string(part->size()) + " shapes (" + kinds_text(kinds) + "), " +
                                size_text(*part) + ", by convexity: " + values_text(context);
    sections.push_back(group_table(context, id, caption, "Convexity", convexity_groups(context, *part)));
    say_validity(context, *part, sections.back());
    if (kinds.size() > 1) {
      sections.push_back(group_table(context, "kinds", "The same by kind", "Kind", kinds));
    }
  }
  return sections;
}

}  // namespace

bool is_collection(const std::vector<Shape>& shapes) {
  constexpr std::size_t kMany = 10;
  const bool one_size =
      std::all_of(shapes.begin(), shapes.end(), [](const Shape& shape) { return shape.size() == 1; });
  if (shapes.empty() || !one_size) return false;
  return shapes.size() >= kMany || !published_collection(shapes).is_null();
}

std::vector<table::TableSection> collection_tables(TableContext& context, const std::vector<Shape>& shapes) {
  const std::vector<Case> cases = cases_of(shapes);
  if (cases.size() > kTooManyForRows) return class_tables(context, cases);
  const std::vector<Line> lines = lines_of(context, cases);
  const json& published = published_collection(shapes);
  return {summary_table(context, lines, cases, published), shape_table(context, lines, cases, published)};
}

std::vector<CaseGroup> published_groups(const TableContext& context, const std::vector<Shape>& shapes) {
  if (!is_collection(shapes)) return {};
  const std::vector<Case> cases = cases_of(shapes);
  if (cases.size() <= kTooManyForRows) {
    const json& published = published_collection(shapes);
    if (published.is_null()) return {};
    return {{"mean of the shapes", cases, published}};
  }
  std::vector<Case> papers_own;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(papers_own),
               [](const Case& which) { return is_about(paper().at("convexity_classes"), which); });
  return convexity_groups(context, papers_own);
}

json published_values(const CaseGroup& group, const Line& line) {
  if (group.published.is_null() || paper().at("protocol") != line.protocol) return {};
  return group.published.at("methods").value(line.method, json());
}

}  // namespace hullbench::report
