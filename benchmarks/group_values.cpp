#include "benchmarks/group_values.hpp"

#include <algorithm>
#include <span>

#include "benchmarks/number_format.hpp"
#include "benchmarks/statistics.hpp"

namespace hullbench {
namespace {

std::optional<Spread> spread_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return Spread{mean(std::span<const double>(values)), standard_deviation(std::span<const double>(values)),
                *std::max_element(values.begin(), values.end())};
}

template <typename Text>
std::vector<std::string> cells_of(const std::optional<Spread>& spread, const Text& text) {
  if (!spread) return {kNothing, kNothing, kNothing};
  return {text(spread->mean), spread->deviation ? text(*spread->deviation) : kNothing, text(spread->maximum)};
}

}  // namespace

GroupValues group_values(const TableContext& context, const Line& line, const std::vector<Case>& cases) {
  GroupValues values;
  std::vector<double> errors;
  std::vector<double> times;
  std::vector<double> equal_work;
  for (const Case& which : cases) {
    const auto runs = context.measurements.find(line.method, line.protocol, which);
    if (runs.empty()) continue;
    if (const RunRecord* failure = first_failure(runs)) {
      if (is_invalid(*failure)) ++values.invalid;
      continue;
    }
    ++values.measured;
    const std::vector<double> of_case = all_values(runs, "l2_paper");
    if (!of_case.empty()) errors.push_back(median(std::span<const double>(of_case)));
    if (!context.measurements.has_times()) continue;
    times.push_back(median(all_times(runs, Boundary::kPaper)) / 1e6);
    equal_work.push_back(median(all_times(runs, Boundary::kEqualWork)) / 1e6);
  }
  values.error = spread_of(errors);
  values.time = spread_of(times);
  values.equal_work = spread_of(equal_work);
  return values;
}

std::vector<std::string> percent_cells(const std::optional<Spread>& fractions) {
  return cells_of(fractions, [](double value) { return fixed(100 * value, 1); });
}

std::vector<std::string> millisecond_cells(const std::optional<Spread>& milliseconds) {
  return cells_of(milliseconds, [](double value) { return three_digits(value); });
}

}  // namespace hullbench
