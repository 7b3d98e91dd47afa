#include "benchmarks/report/paper_comparison.hpp"

#include <algorithm>
#include <set>

#include "benchmarks/report/claims.hpp"
#include "benchmarks/report/collection_tables.hpp"
#include "benchmarks/report/group_values.hpp"
#include "benchmarks/report/labels.hpp"
#include "benchmarks/report/table_context.hpp"
#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

constexpr const char* kError = "error";
constexpr const char* kTime = "time";

void compare_groups(const TableContext& context, std::vector<Comparison>& comparisons) {
  const std::vector<Shape> all_shapes = shapes(context.measurements.cases());
  for (const CaseGroup& group : published_groups(context, all_shapes)) {
    // The paper's methods only: where another one fails, the means here are still of all these cases.
    std::vector<Line> lines = lines_of(context, group.cases);
    std::erase_if(lines, [&](const Line& line) { return published_values(group, line).is_null(); });
    const std::vector<GroupValues> all = group_values(context, lines, group.cases);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Line& line = lines[i];
      const GroupValues& ours = all[i];
      const json theirs = published_values(group, line);
      const bool one_row = group.published.contains("where");
      const json& where = (one_row ? group.published : paper().at("convexity_classes")).at("where");
      Comparison comparison = {where.get<std::string>(), one_row ? "" : group.title, line.method, "", 0, {}};
      comparison.quantity = kError;
      comparison.published = theirs.at("l2_percent").at(0).get<double>();
      if (ours.error) comparison.measured = 100 * ours.error->mean;
      comparisons.push_back(comparison);
      if (!context.measurements.has_times()) continue;
      comparison.quantity = kTime;
      comparison.published = theirs.at("milliseconds").at(0).get<double>();
      comparison.measured.reset();
      if (ours.time) comparison.measured = ours.time->mean;
      comparisons.push_back(comparison);
    }
  }
}

/// Median milliseconds of a step, or of the whole within the paper's boundary, of a method on the paper's
/// case.
std::optional<double> step_time(const TableContext& context, const std::string& method, const Case& which,
                                const PaperStep* step) {
  const auto runs = context.measurements.find({method, paper().at("protocol").get<std::string>()}, which);
  if (runs.empty() || first_failure(runs) != nullptr) return std::nullopt;
  const std::vector<std::int64_t> values =
      step == nullptr ? all_times(runs, Boundary::kPaper) : all_step_times(runs, *step);
  if (values.empty()) return std::nullopt;
  return statistics::median(values) / 1e6;
}

void compare_steps(const TableContext& context, std::vector<Comparison>& comparisons) {
  const json& steps = paper().at("steps");
  const Case which = {steps.at("dataset").get<std::string>(), steps.at("holes").get<bool>(),
                      steps.at("n").get<std::int64_t>()};
  if (!context.measurements.has_times()) return;
  const auto& cases = context.measurements.cases();
  // A run of many cases has the paper's one by the way; its figures are those of the experiment on this case
  // alone.
  if (cases.size() != 1 || cases.front() != which) return;
  for (const auto& [method, published] : steps.at("milliseconds").items()) {
    const std::string teller = teller_of(method);
    const auto compare = [&](const std::string& quantity, const std::string& measured_method,
                             const PaperStep* step, const json& theirs) {
      const std::string protocol = paper().at("protocol").get<std::string>();
      if (!theirs.is_number() || context.measurements.find({measured_method, protocol}, which).empty())
        return;
      const auto ours = step_time(context, measured_method, which, step);
      comparisons.push_back(
          {steps.at("where").get<std::string>(), "", measured_method, quantity, theirs.get<double>(), ours});
    };
    for (const PaperStep& step : paper_steps()) compare(step.name, teller, &step, published.at(step.name));
    compare(kTime, method, nullptr, published.at("total"));
  }
}

std::string value_text(const json& report, const Comparison& comparison) {
  std::string text = comparison.where + ", ";
  if (!comparison.row.empty()) text += comparison.row + ", ";
  text += method_title(report, comparison.method) + ": ";
  if (comparison.quantity == kError) return text + "L2 mean, %";
  if (comparison.quantity == kTime) return text + "time, ms";
  return text + comparison.quantity + ", ms";
}

}  // namespace

bool Comparison::is_large() const {
  const double limit = paper().at("differences").at("large_from").get<double>();
  return ratio() >= limit || ratio() <= 1 / limit;
}

std::vector<Comparison> compare_with_paper(const json& report) {
  const TableContext context{report, Measurements(report), {}};
  std::vector<Comparison> comparisons;
  compare_groups(context, comparisons);
  compare_steps(context, comparisons);
  return comparisons;
}

std::optional<std::string> reason_of(const Comparison& comparison) {
  for (const json& reason : paper().at("differences").at("reasons")) {
    const auto matches = [&](const char* key, const std::string& value) {
      if (!reason.contains(key)) return true;
      const json& wanted = reason.at(key);
      return wanted.is_array() ? std::find(wanted.begin(), wanted.end(), value) != wanted.end()
                               : wanted == value;
    };
    const bool direction =
        !reason.contains("we_are") || (reason.at("we_are") == "lower") == (comparison.ratio() < 1);
    const bool measured =
        !reason.contains("measured") || reason.at("measured") == comparison.measured.has_value();
    if (direction && measured && matches("where", comparison.where) && matches("method", comparison.method) &&
        matches("quantity", comparison.quantity)) {
      return reason.at("reason").get<std::string>();
    }
  }
  return std::nullopt;
}

table::Table differences_table(const std::vector<json>& reports) {
  table::Table table{"differences",
                     "What differs from the paper and why",
                     {table::words("Value"), "Paper", "Here", "Here / paper", "Reason"}};
  table::Notes reasons;
  // Reports of one machine and build each are still of several in this one table.
  std::set<std::string> machines;
  std::set<std::string> builds;
  for (const json& report : reports) {
    machines.merge(machines_of(report));
    builds.merge(builds_of(report));
  }
  const std::string why_no_times = no_times_sentence(machines, builds);
  for (const json& report : reports) {
    for (const Comparison& comparison : compare_with_paper(report)) {
      if (comparison.quantity != kError && !why_no_times.empty()) continue;
      table::Cell why;
      if (comparison.is_large()) {
        const auto reason = reason_of(comparison);
        why.words = reason ? "" : "not known";
        if (reason) why.notes = {reasons.number(*reason)};
      }
      table::Cell here;
      table::Cell ratio;
      if (comparison.measured) {
        here = table::Number(*comparison.measured);
        ratio = table::Number(comparison.ratio());
      }
      table.add_row(
          {value_text(report, comparison), table::Number(comparison.published, 1), here, ratio, why});
    }
  }
  const json& limit = paper().at("differences").at("large_from");
  table.remarks.push_back((why_no_times.empty() ? "Times are as the paper took them." : why_no_times) +
                          " A reason stands where a value is " + limit.dump() +
                          " times the paper's or more, or the paper's is " + limit.dump() +
                          " times ours or more, and where nothing was measured. The paper's Figure 8 has no "
                          "numbers to compare; what its text says of it is among the claims. Means here are "
                          "over the cases that all of the paper's methods solved.");
  for (std::string& reason : reasons.marked()) table.remarks.push_back(std::move(reason));
  return table;
}

}  // namespace hullbench::report
