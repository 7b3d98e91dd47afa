#include "benchmarks/tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/claims.hpp"
#include "benchmarks/labels.hpp"
#include "benchmarks/measurements.hpp"
#include "benchmarks/number_format.hpp"
#include "benchmarks/report_notes.hpp"
#include "benchmarks/statistics.hpp"
#include "benchmarks/text_table.hpp"

namespace hullbench {
namespace {

using nlohmann::json;

constexpr std::array kProtocolOrder = {"paper", "default", "auto", "tuned", "oracle"};
constexpr const char* kNothing = "–";

/// A line of a table: protocols never share one.
struct Line {
  std::string method;
  std::string protocol;
  bool operator==(const Line&) const = default;
};

/// What the printing functions share.
struct Context {
  const json& report;
  Measurements measurements;
  Notes notes;
};

std::string label(const Context& context, const Line& line) {
  return method_label(context.report, line.method, line.protocol);
}

std::string shape_title(const Context& context, const Case& which) {
  return hullbench::shape_title(context.report, which.dataset, which.holes);
}

std::string milliseconds(double nanoseconds) {
  return three_digits(nanoseconds / 1e6);
}

/// "41.4 ±0.3": median and median absolute deviation in milliseconds, with the median's number of decimals.
std::string time_cell(const std::vector<std::int64_t>& nanoseconds) {
  if (nanoseconds.empty()) return kNothing;
  const double middle = median(nanoseconds) / 1e6;
  const int decimals = decimals_of(middle);
  return fixed(middle, decimals) + " ±" + fixed(median_absolute_deviation(nanoseconds) / 1e6, decimals);
}

std::string percent(const std::vector<double>& values) {
  if (values.empty()) return kNothing;
  const double value = 100 * median(std::span<const double>(values));
  return fixed(value, value < 10 ? 2 : 1);
}

std::vector<std::int64_t> all_times(const std::vector<const RunRecord*>& runs, Boundary boundary) {
  std::vector<std::int64_t> result;
  for (const RunRecord* run : runs) {
    const auto repetitions = times(*run, boundary);
    result.insert(result.end(), repetitions.begin(), repetitions.end());
  }
  return result;
}

std::vector<double> all_values(const std::vector<const RunRecord*>& runs, const std::string& name) {
  std::vector<double> result;
  for (const RunRecord* run : runs) {
    if (const auto value = metric(*run, name)) result.push_back(*value);
  }
  return result;
}

/// How a run that gave no result to be believed is called in a cell. A result that is not a valid
/// multipolygon is one, whatever its time.
std::string failure_name(const RunRecord& run) {
  return run.status == Status::kOk || run.status == Status::kInvalidOutput ? "invalid"
                                                                           : to_string(run.status);
}

const RunRecord* first_failure(const std::vector<const RunRecord*>& runs) {
  const auto found =
      std::find_if(runs.begin(), runs.end(), [](const RunRecord* run) { return !is_measured(*run); });
  return found == runs.end() ? nullptr : *found;
}

enum class Quantity { kEqualWork, kPaperBoundary, kError };

std::string cell(const std::vector<const RunRecord*>& runs, Quantity quantity) {
  if (runs.empty()) return kNothing;
  if (const RunRecord* failure = first_failure(runs)) return failure_name(*failure);
  switch (quantity) {
    case Quantity::kEqualWork:
      return time_cell(all_times(runs, Boundary::kEqualWork));
    case Quantity::kPaperBoundary:
      return time_cell(all_times(runs, Boundary::kPaper));
    case Quantity::kError:
      return percent(all_values(runs, "l2")) + " (" + percent(all_values(runs, "l2_paper")) + ")";
  }
  return kNothing;
}

/// One shape: the cases of one data set, with or without holes, that differ in n only.
using Shape = std::vector<Case>;

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

/// The lines that have a run of `shape`: in the order of the report's methods, then of the protocols.
std::vector<Line> lines_of(const Context& context, const Shape& shape) {
  std::vector<std::string> methods;
  for (const json& method : context.report.at("methods"))
    methods.push_back(method.at("name").get<std::string>());
  for (const RunRecord& run : context.measurements.runs()) {
    if (std::find(methods.begin(), methods.end(), run.method) == methods.end()) methods.push_back(run.method);
  }
  std::vector<Line> result;
  for (const std::string& method : methods) {
    for (const char* protocol : kProtocolOrder) {
      const bool occurs = std::any_of(shape.begin(), shape.end(), [&](const Case& which) {
        return !context.measurements.find(method, protocol, which).empty();
      });
      if (occurs) result.push_back({method, protocol});
    }
  }
  return result;
}

/// What happened to the runs of a line on one shape that failed in the same way.
std::string failure_text(const Context& context, const Line& line, const std::string& name,
                         const std::vector<const RunRecord*>& runs) {
  const RunRecord& first = *runs.front();
  if (first.status == Status::kNotInstalled) {
    return not_installed_text(context.report, label(context, line), line.method, first.detail);
  }
  std::string sizes;
  for (const RunRecord* run : runs) sizes += (sizes.empty() ? "" : ", ") + std::to_string(run->n);
  const std::string shape = hullbench::shape_title(context.report, first.dataset, first.holes);
  return label(context, line) + " on " + shape + ", n = " + sizes + ": " + name + ", " +
         sentence(first.detail);
}

/// The notes that explain a line's failures on a shape, one a kind of failure: " [1] [3]".
std::string failure_marks(Context& context, const Line& line, const Shape& shape) {
  std::vector<std::pair<std::string, std::vector<const RunRecord*>>> kinds;  // by name, in the order of n
  for (const Case& which : shape) {
    const RunRecord* failure = first_failure(context.measurements.find(line.method, line.protocol, which));
    if (failure == nullptr) continue;
    const std::string name = failure_name(*failure);
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.first == name; });
    if (found == kinds.end()) {
      kinds.push_back({name, {failure}});
    } else {
      found->second.push_back(failure);
    }
  }
  std::string marks;
  for (const auto& [name, runs] : kinds) {
    marks += ' ' + context.notes.mark(failure_text(context, line, name, runs));
  }
  return marks;
}

/// A line's cells. A method that is not installed says so once instead of in every column.
std::vector<std::string> row(Context& context, const Line& line, const Shape& shape, Quantity quantity) {
  std::vector<std::string> result = {label(context, line) + failure_marks(context, line, shape)};
  for (const Case& which : shape) {
    result.push_back(cell(context.measurements.find(line.method, line.protocol, which), quantity));
  }
  const std::string missing = to_string(Status::kNotInstalled);
  if (std::all_of(result.begin() + 1, result.end(),
                  [&](const std::string& text) { return text == missing; })) {
    std::fill(result.begin() + 1, result.end(), "");
    result[1] = "not installed";
  }
  return result;
}

void print_shape(Context& context, const Shape& shape, std::ostream& out) {
  const std::array<std::pair<Quantity, const char*>, 3> tables = {
      {{Quantity::kEqualWork, "time of equal work, ms"},
       {Quantity::kPaperBoundary, "time as the paper took it, ms"},
       {Quantity::kError,
        "error L2, % of the ground truth's area (as the paper divides it: of the result's area)"}}};
  const std::vector<Line> lines = lines_of(context, shape);
  for (const auto& [quantity, caption] : tables) {
    out << "### " << shape_title(context, shape.front()) << ": " << caption << "\n\n";
    std::vector<std::string> header = {"Number of points"};
    for (const Case& which : shape) header.push_back(std::to_string(which.n));
    TextTable table(std::move(header));
    for (const Line& line : lines) table.add_row(row(context, line, shape, quantity));
    table.print(out);
    out << '\n';
  }
}

bool is_steps_shape(const Case& which) {
  const json& steps = paper().at("steps");
  return which.dataset == steps.at("dataset") && which.holes == steps.at("holes");
}

std::vector<std::string> measured_steps(const Context& context, const Line& line, const Case& which) {
  const auto runs = context.measurements.find(line.method, line.protocol, which);
  if (runs.empty() || first_failure(runs) != nullptr) return {};
  std::vector<std::string> result = {label(context, line)};
  for (const PaperStep& step : paper_steps()) {
    std::vector<std::int64_t> values;
    for (const RunRecord* run : runs) {
      const auto repetitions = step_times(*run, step.parts);
      values.insert(values.end(), repetitions.begin(), repetitions.end());
    }
    result.push_back(values.empty() ? kNothing : milliseconds(median(values)));
  }
  for (const Boundary boundary : {Boundary::kPaper, Boundary::kEqualWork}) {
    const std::vector<std::int64_t> values = all_times(runs, boundary);
    result.push_back(values.empty() ? kNothing : milliseconds(median(values)));
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
  result.push_back(kNothing);
  return result;
}

/// The steps of the methods on the paper's shape, at the paper's size with the paper's values beside them, or
/// at the largest size there is without.
void print_steps(const Context& context, std::ostream& out) {
  const json& steps = paper().at("steps");
  const Case* chosen = nullptr;
  for (const Case& which : context.measurements.cases()) {
    if (is_steps_shape(which) && (chosen == nullptr || chosen->n != steps.at("n"))) chosen = &which;
  }
  if (chosen == nullptr) return;
  const bool comparable = chosen->n == steps.at("n");
  std::vector<std::string> header = {"Method"};
  for (const PaperStep& step : paper_steps()) header.push_back(step.name);
  header.insert(header.end(), {"as the paper took it", "equal work"});
  TextTable table(std::move(header));
  std::set<std::string> compared;
  for (const Line& line : lines_of(context, {*chosen})) {
    std::vector<std::string> ours = measured_steps(context, line, *chosen);
    if (!ours.empty()) table.add_row(std::move(ours));
    if (!comparable || line.protocol != paper().at("protocol") || !compared.insert(line.method).second)
      continue;
    if (auto theirs = published_steps(line.method); !theirs.empty()) table.add_row(std::move(theirs));
  }
  out << "### " << shape_title(context, *chosen) << ", n = " << chosen->n << ": time of the steps, ms\n\n";
  table.print(out);
  out << '\n';
  const std::string where = steps.at("where").get<std::string>();
  print_item(comparable ? "Medians; the paper's values are from its " + where + ", each the " +
                              steps.at("statistic").get<std::string>() +
                              ". A dash: the method does not tell the step."
                        : "Medians. The paper's " + where + " is for n = " + steps.at("n").dump() +
                              ", which was not measured here. A dash: the method does not tell the step.",
             out);
  out << '\n';
}

std::string holds_text(const json& holds) {
  if (!holds.is_boolean()) return kNothing;
  return holds.get<bool>() ? "yes" : "no";
}

void print_claims(Context& context, std::ostream& out) {
  TextTable table({"Claim", "Paper", "Here", "Equal work", "Holds"});
  for (const json& claim : context.report.at("summary").at("claims")) {
    const std::string mark = context.notes.mark(claim.at("where").get<std::string>() + ": " +
                                                claim.at("detail").get<std::string>());
    const json& equal_work = claim.at("equal_work");
    table.add_row({claim.at("claim").get<std::string>() + " " + mark, claim.at("paper").get<std::string>(),
                   claim.at("ours").get<std::string>(),
                   equal_work.is_string() ? equal_work.get<std::string>() : kNothing,
                   holds_text(claim.at("holds"))});
  }
  if (table.empty()) return;
  out << "### The paper's claims beside ours\n\n";
  table.print(out);
  out << '\n';
}

/// Whether the paper's claims and step times can be put beside this report at all.
bool is_papers_experiment(const Context& context) {
  const json& datasets = paper().at("claims").at("datasets");
  const auto& runs = context.measurements.runs();
  return std::any_of(runs.begin(), runs.end(), [&](const RunRecord& run) {
    return run.protocol == paper().at("protocol") &&
           std::find(datasets.begin(), datasets.end(), run.dataset) != datasets.end();
  });
}

}  // namespace

void print_tables(const json& report, std::ostream& out) {
  Context context{report, Measurements(report), {}};
  out << "## " << report.at("plan").value("title", std::string("Benchmark run")) << "\n\n";
  for (const Shape& shape : shapes(context.measurements.cases())) print_shape(context, shape, out);
  if (is_papers_experiment(context)) {
    print_steps(context, out);
    print_claims(context, out);
  }
  out << "### Notes\n\n";
  context.notes.print(out);
  print_report_notes(report, context.measurements.runs(), out);
}

}  // namespace hullbench
