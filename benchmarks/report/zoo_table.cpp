#include "benchmarks/report/zoo_table.hpp"

#include <utility>
#include <vector>

#include "datasets/zoo/zoo.hpp"

namespace hullbench::report {
namespace {

/// The largest L2 that is like the shape, and how much worse than the convex hull's it may be.
constexpr double kLargestError = 0.5;
constexpr double kWorseThanHull = 0.1;

bool is_wrong(const record::RunRecord& run) {
  const auto error = metric(run, "l2");
  const auto of_hull = metric(run, "l2_convex_hull");
  return error && (*error > kLargestError || (of_hull && *error > *of_hull + kWorseThanHull));
}

/// Whether the points of a case have an area. Of a case that this build does not know: whether their convex
/// hull has one.
bool has_area(const TableContext& context, const Case& which) {
  if (const zoo::Case* known = zoo::find_case(which.dataset)) return known->answer != zoo::Answer::kEmpty;
  const auto runs = context.measurements.find({"convex_hull", "default"}, which);
  return runs.empty() || metric(*runs.front(), "polygons") != 0.0;
}

}  // namespace

std::string zoo_word(const record::RunRecord& run, bool has_area) {
  using record::Status;
  switch (run.status) {
    case Status::kNotInstalled:
      return table::kNothing;
    case Status::kTimeout:
      return "time-out";
    case Status::kMemory:
      return "no memory";
    case Status::kCrash:
      return "crash";
    case Status::kError:
    case Status::kUnsupported:
      return has_area ? "error" : "ok";
    case Status::kInvalidOutput:
      return "invalid";
    case Status::kOk:
      break;
  }
  if (is_invalid(run)) return "invalid";
  const bool is_empty = metric(run, "polygons") == 0.0;
  if (!has_area) return is_empty ? "ok" : "wrong";
  if (is_empty) return "empty";
  if (metric(run, "points_covered").value_or(1) < zoo::kCovered) return "lost points";
  return is_wrong(run) ? "wrong" : "ok";
}

table::Table zoo_table(const TableContext& context) {
  const std::vector<Line> lines = lines_of(context, context.measurements.cases());
  table::Table table{"cases",
                     "How each method answers what broke somebody",
                     {table::words("Data set"), table::words("Points")}};
  for (const Line& line : lines) table.columns.push_back(table::words(label(context, line)));
  std::vector<std::size_t> right(lines.size());
  for (const Case& which : context.measurements.cases()) {
    std::vector<table::Cell> cells = {which.dataset, shape_title(context, which)};
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto runs = context.measurements.find(lines[i], which);
      const std::string word =
          runs.empty() ? table::kNothing : zoo_word(*runs.front(), has_area(context, which));
      if (word == "ok") ++right[i];
      cells.emplace_back(word);
    }
    table.add_row(std::move(cells));
  }
  std::vector<table::Cell> totals = {"ok, of " + std::to_string(context.measurements.cases().size()), ""};
  for (const std::size_t count : right) totals.emplace_back(std::to_string(count));
  table.add_row(std::move(totals));
  table.remarks = {
      "Invalid: no valid multipolygon. Empty: no polygon, though the points have an area. Lost points: fewer "
      "than nine tenths of the points are in the result or on its edge. Wrong: L2 is more than 50 %, or by "
      "10 points more than that of the points' convex hull; or a polygon of points that have no area. Of "
      "such points an empty result, or an error that says why, is ok. A dash: not installed, or not run.",
      "datasets/zoo/README.md says which issue each case is made after."};
  return table;
}

}  // namespace hullbench::report
