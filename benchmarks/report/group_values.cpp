#include "benchmarks/report/group_values.hpp"

#include <algorithm>

#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::report {
namespace {

std::optional<Spread> spread_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Spread{statistics::mean(values), statistics::standard_deviation(values),
                *std::ranges::max_element(values)};
}

template <typename Show>
std::vector<table::Cell> cells_of(const std::optional<Spread>& spread, const Show& show) {
  if (!spread) return std::vector<table::Cell>(3);
  return {show(spread->mean), spread->deviation ? show(*spread->deviation) : table::Cell(),
          show(spread->maximum)};
}

/// Counts a case of these runs; whether it was solved.
bool count_case(const Runs& runs, GroupValues& values) {
  if (runs.empty()) return false;
  const record::RunRecord* failure = first_failure(runs);
  if (failure == nullptr) {
    ++values.solved;
    return true;
  }
  if (failure->status != record::Status::kNotInstalled) ++values.failed;
  if (is_invalid(*failure)) ++values.invalid;
  return false;
}

void add_spreads(const TableContext& context, const Line& line, const std::vector<Case>& cases,
                 GroupValues& values) {
  std::vector<double> errors;
  std::vector<double> times;
  std::vector<double> equal_work;
  for (const Case& which : cases) {
    const auto runs = context.measurements.find(line, which);
    const std::vector<double> of_case = all_values(runs, error_kind(context).metric);
    if (!of_case.empty()) errors.push_back(statistics::median(of_case));
    if (!context.measurements.has_times()) continue;
    times.push_back(statistics::median(all_times(runs, Boundary::kPaper)) / 1e6);
    equal_work.push_back(statistics::median(all_times(runs, Boundary::kEqualWork)) / 1e6);
  }
  values.cases = cases.size();
  values.error = spread_of(errors);
  values.time = spread_of(times);
  values.equal_work = spread_of(equal_work);
}

}  // namespace

std::vector<GroupValues> group_values(const TableContext& context, const std::vector<Line>& lines,
                                      const std::vector<Case>& cases) {
  std::vector<GroupValues> all(lines.size());
  std::vector<std::vector<bool>> solved(lines.size(), std::vector<bool>(cases.size()));  // by line, then case
  std::size_t most = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t k = 0; k < cases.size(); ++k)
      solved[i][k] = count_case(context.measurements.find(lines[i], cases[k]), all[i]);
    most = std::max(most, all[i].solved);
  }
  const auto has_enough = [&](std::size_t i) { return all[i].solved > 0 && 2 * all[i].solved >= most; };
  std::vector<Case> common;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    bool by_all = true;
    for (std::size_t i = 0; i < lines.size(); ++i) by_all = by_all && (solved[i][k] || !has_enough(i));
    if (by_all) common.push_back(cases[k]);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (has_enough(i)) add_spreads(context, lines[i], common, all[i]);
  }
  return all;
}

std::vector<table::Cell> percent_cells(const std::optional<Spread>& fractions) {
  return cells_of(fractions, [](double value) -> table::Cell { return table::Number(100 * value, 1); });
}

std::vector<table::Cell> millisecond_cells(const std::optional<Spread>& milliseconds) {
  return cells_of(milliseconds, [](double value) -> table::Cell { return table::Number(value); });
}

}  // namespace hullbench::report
