#include "benchmarks/report/table_context.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "benchmarks/base/words.hpp"
#include "benchmarks/record/protocols.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

/// Median and, of three or more times, median absolute deviation, with the median's number of decimals.
table::Cell time_cell(const std::vector<std::int64_t>& nanoseconds) {
  constexpr std::size_t kFewest = 3;
  table::Cell cell = median_cell(nanoseconds);
  if (cell.value && nanoseconds.size() >= kFewest)
    cell.spread = {statistics::median_absolute_deviation(nanoseconds) / 1e6, cell.value->decimals};
  return cell;
}

std::optional<table::Number> percent(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const double value = 100 * statistics::median(values);
  return table::Number(value, value < 10 ? 2 : 1);
}

table::Cell error_cell(const Runs& runs) {
  table::Cell cell;
  cell.value = percent(all_values(runs, "l2"));
  cell.other = percent(all_values(runs, "l2_paper"));
  cell.sign = hull_sign(runs);
  return cell;
}

template <typename Times>
std::vector<std::int64_t> collect(const Runs& runs, const Times& times_of) {
  std::vector<std::int64_t> result;
  for (const record::RunRecord* run : runs) {
    const std::vector<std::int64_t> some = times_of(*run);
    result.insert(result.end(), some.begin(), some.end());
  }
  return result;
}

/// What happened to the runs of a line on one shape that failed in the same way.
std::string failure_text(const TableContext& context, const Line& line, const std::string& name,
                         const Runs& runs) {
  const record::RunRecord& first = *runs.front();
  if (first.status == record::Status::kNotInstalled) {
    return not_installed_text(context.report, label(context, line), line.method, first.detail);
  }
  const std::string sizes = joined(runs, ", ", [](const auto* run) { return std::to_string(run->n); });
  const std::string shape = hullbench::report::shape_title(context.report, first.dataset, first.holes);
  return label(context, line) + " on " + shape + ", n = " + sizes + ": " + name + ", " +
         sentence(first.detail);
}

}  // namespace

std::string label(const TableContext& context, const Line& line) {
  return method_label(context.report, line.method, line.protocol);
}

std::string shape_title(const TableContext& context, const Case& which) {
  return hullbench::report::shape_title(context.report, which.dataset, which.holes);
}

table::Number milliseconds(double nanoseconds) {
  return table::Number(nanoseconds / 1e6);
}

table::Cell median_cell(const std::vector<std::int64_t>& nanoseconds) {
  return nanoseconds.empty() ? table::Cell() : milliseconds(statistics::median(nanoseconds));
}

std::vector<std::int64_t> all_times(const Runs& runs, Boundary boundary) {
  return collect(runs, [&](const record::RunRecord& run) { return times(run, boundary); });
}

std::vector<std::int64_t> all_step_times(const Runs& runs, const PaperStep& step) {
  return collect(runs, [&](const record::RunRecord& run) { return step_times(run, step.parts); });
}

std::string failure_name(const record::RunRecord& run) {
  return run.status == record::Status::kOk || run.status == record::Status::kInvalidOutput
             ? "invalid"
             : to_string(run.status);
}

ErrorKind error_kind(const TableContext& context) {
  const bool is_of_paper = !context.report.at("plan").value("paper", std::string()).empty();
  return is_of_paper ? ErrorKind{"l2_paper", "of the result's area"}
                     : ErrorKind{"l2", "of the ground truth's area"};
}

table::Cell cell(const Runs& runs, Quantity quantity) {
  if (runs.empty()) return {};
  if (const record::RunRecord* failure = first_failure(runs)) return failure_name(*failure);
  switch (quantity) {
    case Quantity::kEqualWork:
      return time_cell(all_times(runs, Boundary::kEqualWork));
    case Quantity::kPaperBoundary:
      return time_cell(all_times(runs, Boundary::kPaper));
    case Quantity::kError:
      return error_cell(runs);
  }
  return {};
}

std::size_t usual_repetitions(const Measurements& measurements) {
  std::map<std::size_t, std::size_t, std::greater<>> rows;  // by number of repetitions, the largest first
  for (const record::RunRecord& run : measurements.runs()) {
    if (!run.time_ns.empty()) ++rows[run.time_ns.size()];
  }
  if (rows.empty()) return 0;
  return std::ranges::max_element(rows, [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::string row_label(const TableContext& context, const Line& line, const std::vector<Case>& cases) {
  const std::size_t usual = usual_repetitions(context.measurements);
  std::size_t least = usual;
  std::size_t most = usual;
  bool any = false;
  for (const Case& which : cases) {
    for (const record::RunRecord* run : context.measurements.find(line, which)) {
      const std::size_t count = run->time_ns.size();
      if (count == 0) continue;
      least = any ? std::min(least, count) : count;
      most = any ? std::max(most, count) : count;
      any = true;
    }
  }
  std::string text = label(context, line);
  if (least == usual && most == usual) return text;
  text += ", " + std::to_string(least) + (least == most ? "" : " to " + std::to_string(most));
  return text + (most == 1 ? " repetition" : " repetitions");
}

std::string hull_sign(const Runs& runs) {
  const bool worse =
      std::ranges::any_of(runs, [](const record::RunRecord* run) { return is_worse_than_convex_hull(*run); });
  return worse ? table::kSign : "";
}

void explain_hull_sign(table::Table& table) {
  const bool any = std::ranges::any_of(table.rows, [](const auto& cells) {
    return std::ranges::any_of(cells, [](const table::Cell& cell) { return cell.sign == table::kSign; });
  });
  if (any)
    table.remarks.push_back(
        std::string(table::kSign).append(": the error is above that of the points' convex hull."));
}

std::vector<Shape> shapes(const std::vector<Case>& cases) {
  std::vector<Shape> result;
  for (const Case& which : cases) {
    if (result.empty() || result.back().front().dataset != which.dataset ||
        result.back().front().holes != which.holes) {
      result.emplace_back();
    }
    result.back().push_back(which);
  }
  return result;
}

std::vector<Line> lines_of(const TableContext& context, const Shape& shape) {
  std::vector<std::string> methods;
  for (const json& method : context.report.at("methods"))
    methods.push_back(method.at("name").get<std::string>());
  for (const record::RunRecord& run : context.measurements.runs()) {
    if (std::ranges::find(methods, run.method) == methods.end()) methods.push_back(run.method);
  }
  std::vector<Line> result;
  for (const std::string& method : methods) {
    for (const record::Protocol& protocol : record::protocols()) {
      const bool occurs = std::ranges::any_of(shape, [&](const Case& which) {
        return !context.measurements.find({method, protocol.name}, which).empty();
      });
      if (occurs) result.push_back({method, protocol.name});
    }
  }
  return result;
}

std::vector<std::size_t> failure_notes(TableContext& context, const Line& line, const Shape& shape) {
  std::vector<std::pair<std::string, Runs>> kinds;  // by name, in the order of n
  for (const Case& which : shape) {
    const record::RunRecord* failure = first_failure(context.measurements.find(line, which));
    if (failure == nullptr) continue;
    const std::string name = failure_name(*failure);
    const auto found = std::ranges::find_if(kinds, [&](const auto& kind) { return kind.first == name; });
    if (found == kinds.end()) {
      kinds.push_back({name, {failure}});
    } else {
      found->second.push_back(failure);
    }
  }
  std::vector<std::size_t> notes;
  notes.reserve(kinds.size());
  for (const auto& [name, runs] : kinds)
    notes.push_back(context.notes.number(failure_text(context, line, name, runs)));
  return notes;
}

std::vector<table::Cell> row(TableContext& context, const Line& line, const Shape& shape, Quantity quantity) {
  const bool is_time = quantity != Quantity::kError;
  std::vector<table::Cell> result = {is_time ? row_label(context, line, shape) : label(context, line)};
  result.front().notes = failure_notes(context, line, shape);
  for (const Case& which : shape) {
    result.push_back(cell(context.measurements.find(line, which), quantity));
  }
  say_not_installed_once(result);
  return result;
}

void say_not_installed(std::vector<table::Cell>& cells) {
  std::fill(cells.begin() + 1, cells.end(), table::Cell(""));
  cells[1] = "not installed";
}

void say_not_installed_once(std::vector<table::Cell>& cells) {
  const std::string missing = to_string(record::Status::kNotInstalled);
  const auto says_it = [&](const table::Cell& one) { return one.words == missing; };
  if (std::all_of(cells.begin() + 1, cells.end(), says_it)) say_not_installed(cells);
}

}  // namespace hullbench::report
