#include "benchmarks/report/collection_tables.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"
#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/group_values.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

/// From so many shapes on nobody wants a row for each.
constexpr std::size_t kTooManyForRows = 60;

const std::vector<table::Column> kErrorColumns = {table::with_unit("L2 mean", "%"), table::Column("std", "%"),
                                                  table::Column("max", "%")};
const std::vector<table::Column> kTimeColumns = {table::with_unit("Time mean", "ms"),
                                                 table::Column("std", "ms"), table::Column("max", "ms"),
                                                 table::with_unit("Equal work mean", "ms")};

bool has_prefix(const json& entry, const std::string& dataset) {
  const json& prefixes = entry.at("dataset_prefixes");
  return std::ranges::any_of(
      prefixes, [&](const json& prefix) { return dataset.starts_with(prefix.get<std::string>()); });
}

/// Whether the paper's entry is about a case like this one.
bool is_about(const json& entry, const Case& which) {
  return has_prefix(entry, which.dataset) && (!entry.contains("n") || entry.at("n") == which.n);
}

/// The shapes of a collection of the paper's at this size, and all others.
struct SplitShapes {
  json published;  ///< what the paper published of the first; null when there are none
  std::vector<Shape> papers_own;
  std::vector<Shape> others;
};

SplitShapes split(const std::vector<Shape>& shapes) {
  for (const json& collection : paper().at("collections")) {
    SplitShapes parts{collection, {}, {}};
    for (const Shape& shape : shapes) {
      (is_about(collection, shape.front()) ? parts.papers_own : parts.others).push_back(shape);
    }
    if (!parts.papers_own.empty()) return parts;
  }
  return {{}, {}, shapes};
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

template <typename Entry>
void append(std::vector<Entry>& entries, const std::vector<Entry>& more) {
  entries.insert(entries.end(), more.begin(), more.end());
}

/// What the columns of values hold, for a caption.
std::string values_text(const TableContext& context) {
  const ErrorKind kind = error_kind(context);
  const bool is_papers = kind.metric == std::string("l2_paper");
  const std::string error = std::string("error (") + kind.area + ")";
  if (!context.measurements.has_times()) return error + (is_papers ? " as the paper took it" : "");
  return error + " and time as the paper took " + (is_papers ? "them" : "it");
}

void append_value_columns(const TableContext& context, std::vector<table::Column>& columns) {
  append(columns, kErrorColumns);
  if (context.measurements.has_times()) append(columns, kTimeColumns);
}

void append_values(const TableContext& context, const GroupValues& values, std::vector<table::Cell>& cells) {
  append(cells, percent_cells(values.error));
  if (!context.measurements.has_times()) return;
  append(cells, millisecond_cells(values.time));
  cells.push_back(values.equal_work ? table::Number(values.equal_work->mean) : table::Cell());
}

void append_published(const TableContext& context, const json& published, std::vector<table::Cell>& cells) {
  const auto append_all = [&](const json& values) {
    for (const json& value : values) cells.emplace_back(table::Number(value.get<double>(), 1));
  };
  append_all(published.at("l2_percent"));
  if (!context.measurements.has_times()) return;
  append_all(published.at("milliseconds"));
  cells.emplace_back();
}

std::string paper_label(const Line& line) {
  return paper().at("methods").value(line.method, line.method) + ", in the paper";
}

/// A line's label with the notes of all its failures, each kind once a shape.
table::Cell label_with_failures(TableContext& context, const Line& line, const std::vector<Case>& cases) {
  table::Cell cell = row_label(context, line, cases);
  for (const Case& which : cases) {
    for (const std::size_t note : failure_notes(context, line, {which})) {
      if (std::ranges::find(cell.notes, note) == cell.notes.end()) cell.notes.push_back(note);
    }
  }
  return cell;
}

std::vector<CaseGroup> family_groups(const TableContext& context, const std::vector<Case>& cases) {
  std::vector<CaseGroup> groups;
  for (const Case& which : cases) {
    const std::string title = family_title(context.report, which.dataset);
    const auto found =
        std::ranges::find_if(groups, [&](const CaseGroup& group) { return group.title == title; });
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
  std::vector<std::string> titles;
  for (const CaseGroup& group : groups) {
    std::string& title = titles.emplace_back(group.title);
    if (!title.empty() && title[0] >= 'A' && title[0] <= 'Z')
      title[0] = static_cast<char>(title[0] - 'A' + 'a');
  }
  return join_words(titles);
}

/// Which cases the means of a table are of, where some failed.
constexpr const char* kMeansRemark =
    "Means, deviations and maxima are of the same cases for all methods: those that each of them solved, as "
    "many as \"Shapes\" says. A method that solved less than half as many as another one is left out of them "
    "and has none. Failed: cases without a valid result.";

/// What the rows of a table hold that a remark must explain.
struct Held {
  bool failures = false;
  bool published = false;
};

/// Adds the rows of a group: a line each, and beneath it what the paper published. `by_class`: the group's
/// title and the number of invalid results have columns.
Held add_rows(TableContext& context, const CaseGroup& group, bool by_class, table::Table& table) {
  Held held;
  const std::vector<Line> lines = lines_of(context, group.cases);
  const std::vector<GroupValues> all = group_values(context, lines, group.cases);
  std::vector<table::Cell> begin;
  if (by_class) begin.emplace_back(group.title);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<table::Cell> cells = begin;
    append(cells, {label_with_failures(context, lines[i], group.cases), all[i].cases, all[i].failed});
    if (by_class) cells.emplace_back(all[i].invalid);
    append_values(context, all[i], cells);
    table.add_row(std::move(cells));
    held.failures = held.failures || all[i].failed > 0;
    const json theirs = published_values(group, lines[i]);
    if (theirs.is_null()) continue;
    held.published = true;
    cells = begin;
    const bool has_count = group.published.contains("shapes");
    append(cells, {paper_label(lines[i]),
                   has_count ? table::Cell(group.published.at("shapes").get<int>()) : table::Cell(),
                   {}});
    if (by_class) cells.emplace_back();
    append_published(context, theirs, cells);
    table.add_row(std::move(cells));
  }
  return held;
}

table::Table summary_table(TableContext& context, const std::string& id, const std::vector<Case>& cases,
                           const json& published) {
  table::Table table{id, "", {table::words("Method"), "Shapes", "Failed"}};
  append_value_columns(context, table.columns);
  const std::vector<CaseGroup> kinds = family_groups(context, cases);
  // Shapes that are no family have each a title of its own.
  const std::string kind = kinds.size() < cases.size() ? " (" + kinds_text(kinds) + ")" : "";
  table.caption =
      std::to_string(cases.size()) + " shapes" + kind + ", " + size_text(cases) + ": " + values_text(context);
  if (add_rows(context, {"", cases, published}, false, table).failures)
    table.remarks.emplace_back(kMeansRemark);
  if (!published.is_null()) {
    table.remarks.push_back("The paper's values are from its " + published.at("where").get<std::string>() +
                            "; " + published.at("remark").get<std::string>() + ".");
  }
  return table;
}

table::Cell error_cell(const TableContext& context, const Line& line, const Case& which,
                       const json& published) {
  const auto runs = context.measurements.find(line, which);
  if (const record::RunRecord* failure = first_failure(runs)) {
    return failure->status == record::Status::kNotInstalled ? "" : failure_name(*failure);
  }
  const auto errors = all_values(runs, error_kind(context).metric);
  if (errors.empty()) return {};
  table::Cell cell = table::Number(100 * statistics::median(errors), 1);
  cell.sign = hull_sign(runs);
  if (!published.is_null() && paper().at("protocol") == line.protocol) {
    const json value = published.value("by_shape", json::object())
                           .value(which.dataset, json::object())
                           .value(line.method, json());
    if (value.is_number()) cell.other = {value.get<double>(), 1};
  }
  return cell;
}

table::Table shape_table(const TableContext& context, const std::string& id, const std::vector<Case>& cases,
                         const json& published) {
  table::Table table{
      id, std::string("Error L2 of every shape, % ") + error_kind(context).area, {table::words("Shape")}};
  const std::vector<Line> lines = lines_of(context, cases);
  for (const Line& line : lines) table.columns.emplace_back(label(context, line), "%");
  bool has_brackets = false;
  for (const Case& which : cases) {
    std::vector<table::Cell> cells = {shape_title(context, which)};
    for (const Line& line : lines) {
      cells.push_back(error_cell(context, line, which, published));
      has_brackets = has_brackets || cells.back().other;
    }
    table.add_row(std::move(cells));
  }
  if (has_brackets) table.caption += " (in brackets the paper's)";
  explain_hull_sign(table);
  return table;
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
  const bool published = !cases.empty() && std::ranges::all_of(cases, [&](const Case& which) {
    return is_about(classes, which);
  });
  for (std::size_t i = 0; published && i < classes.at("rows").size(); ++i) {
    groups[i].published = {{"methods", {{classes.at("method"), classes.at("rows")[i]}}}};
  }
  std::erase_if(groups, [](const CaseGroup& group) { return group.cases.empty(); });
  return groups;
}

table::Table group_table(TableContext& context, const std::string& id, const std::string& caption,
                         const std::string& first_column, const std::vector<CaseGroup>& groups) {
  table::Table table{
      id, caption, {table::words(first_column), table::words("Method"), "Shapes", "Failed", "Invalid"}};
  append_value_columns(context, table.columns);
  Held any;
  for (const CaseGroup& group : groups) {
    const Held held = add_rows(context, group, true, table);
    any = {any.failures || held.failures, any.published || held.published};
  }
  if (any.failures) table.remarks.emplace_back(kMeansRemark);
  if (any.published) {
    const json& classes = paper().at("convexity_classes");
    table.remarks.push_back("The paper's values are from its " + classes.at("where").get<std::string>() +
                            ", " + classes.at("shapes").dump() + " polygons; " +
                            classes.at("remark").get<std::string>() + ".");
  }
  return table;
}

/// Adds to `table` how many results of all its groups GEOS found to be invalid.
void say_validity(const TableContext& context, const std::vector<Case>& cases, table::Table& table) {
  const std::vector<Line> lines = lines_of(context, cases);
  const std::vector<GroupValues> all = group_values(context, lines, cases);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    table.remarks.push_back(
        label(context, lines[i]) + ": of " + std::to_string(all[i].solved + all[i].invalid) +
        " results, each checked by GEOS, " + std::to_string(all[i].invalid) + " are invalid.");
  }
}

std::vector<table::Table> class_tables(TableContext& context, const std::vector<Case>& cases) {
  std::vector<Case> papers_own;
  std::vector<Case> others;
  for (const Case& which : cases) {
    (is_about(paper().at("convexity_classes"), which) ? papers_own : others).push_back(which);
  }
  std::vector<table::Table> tables;
  for (const auto& [id, part] :
       {std::pair{"convexity", &papers_own}, std::pair{"convexity_others", &others}}) {
    if (part->empty()) continue;
    const std::vector<CaseGroup> kinds = family_groups(context, *part);
    const std::string caption = std::to_string(part->size()) + " shapes (" + kinds_text(kinds) + "), " +
                                size_text(*part) + ", by convexity: " + values_text(context);
    tables.push_back(group_table(context, id, caption, "Convexity", convexity_groups(context, *part)));
    say_validity(context, *part, tables.back());
    if (kinds.size() > 1) {
      tables.push_back(group_table(context, "kinds", "The same by kind", "Kind", kinds));
    }
  }
  return tables;
}

}  // namespace

bool is_collection(const std::vector<Shape>& shapes) {
  constexpr std::size_t kMany = 10;
  const bool one_size = std::ranges::all_of(shapes, [](const Shape& shape) { return shape.size() == 1; });
  if (shapes.empty() || !one_size) return false;
  return shapes.size() >= kMany || !split(shapes).papers_own.empty();
}

std::vector<table::Table> collection_tables(TableContext& context, const std::vector<Shape>& shapes) {
  const std::vector<Case> cases = cases_of(shapes);
  if (cases.size() > kTooManyForRows) return class_tables(context, cases);
  std::vector<table::Table> tables;
  const SplitShapes parts = split(shapes);
  const auto add = [&](const std::string& suffix, const std::vector<Shape>& part, const json& published) {
    if (part.empty()) return;
    tables.push_back(summary_table(context, "summary" + suffix, cases_of(part), published));
    tables.push_back(shape_table(context, "shapes" + suffix, cases_of(part), published));
  };
  add("", parts.papers_own, parts.published);
  add(parts.papers_own.empty() ? "" : "_others", parts.others, json());
  return tables;
}

std::vector<CaseGroup> published_groups(const TableContext& context, const std::vector<Shape>& shapes) {
  if (!is_collection(shapes)) return {};
  const std::vector<Case> cases = cases_of(shapes);
  if (cases.size() <= kTooManyForRows) {
    const SplitShapes parts = split(shapes);
    if (parts.papers_own.empty()) return {};
    return {{"mean of the shapes", cases_of(parts.papers_own), parts.published}};
  }
  std::vector<Case> papers_own;
  std::ranges::copy_if(cases, std::back_inserter(papers_own),
                       [](const Case& which) { return is_about(paper().at("convexity_classes"), which); });
  return convexity_groups(context, papers_own);
}

json published_values(const CaseGroup& group, const Line& line) {
  if (group.published.is_null() || paper().at("protocol") != line.protocol) return {};
  return group.published.at("methods").value(line.method, json());
}

}  // namespace hullbench::report
