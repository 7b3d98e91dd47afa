#include "benchmarks/micro/core_verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "benchmarks/base/names.hpp"
#include "benchmarks/base/number_format.hpp"
#include "benchmarks/statistics/judge.hpp"
#include "benchmarks/statistics/sign_test.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/table/writers.hpp"

namespace hullbench::micro {
namespace {

constexpr const char* kGoalsFile = HULLBENCH_GOALS_FILE;

using Names = std::vector<std::string>;

enum class Quantity { kTimeRatio, kTimeAPointRatio, kTimeAPointSpread, kPeakBytes };

/// One goal of goals.json, which says what its members mean.
struct Goal {
  std::string what;
  Quantity quantity = Quantity::kTimeRatio;
  Names of;
  std::string over;
  std::optional<double> at_most, at_least, hoped_for;
};

Quantity quantity_of(const std::string& name) {
  static const std::map<std::string, Quantity> quantities = {
      {"time_ratio", Quantity::kTimeRatio},
      {"time_a_point_ratio", Quantity::kTimeAPointRatio},
      {"time_a_point_spread", Quantity::kTimeAPointSpread},
      {"peak_bytes", Quantity::kPeakBytes}};
  const auto found = quantities.find(name);
  if (found == quantities.end()) throw std::invalid_argument("\"" + name + "\" is no quantity of a goal");
  return found->second;
}

/// `text` with `points` in the place of {points}.
std::string with_points(std::string text, const std::string& points) {
  const std::string mark = "{points}";
  const std::size_t place = text.find(mark);
  return place == std::string::npos ? text : text.replace(place, mark.size(), points);
}

Goal read_goal(const json& entry, const std::string& points) {
  const auto number = [&](const char* key) {
    return entry.contains(key) ? std::optional(entry[key].get<double>()) : std::nullopt;
  };
  Goal goal;
  goal.what = with_points(entry.at("what"), points);
  goal.quantity = quantity_of(entry.at("quantity"));
  for (const json& benchmark : entry.at("of")) goal.of.push_back(with_points(benchmark, points));
  goal.over = with_points(entry.value("over", ""), points);
  goal.at_most = number("at_most");
  goal.at_least = number("at_least");
  goal.hoped_for = number("hoped_for");
  return goal;
}

const std::vector<Goal>& all_goals() {
  static const std::vector<Goal> goals = [] {
    std::ifstream in(kGoalsFile);
    if (!in) throw std::runtime_error(std::string("cannot read the goals in ") + kGoalsFile);
    const json document = json::parse(in);
    std::vector<Goal> result;
    for (const json& entry : document.at("goals")) {
      for (const json& limits : entry.value("limits", json::array({json::object()}))) {
        json one = entry;
        one.update(limits);
        for (const json& points : one.value("points", json::array({""}))) {
          result.push_back(read_goal(one, points));
        }
      }
    }
    return result;
  }();
  return goals;
}

Names benchmarks_of(const Goal& goal) {
  Names names = goal.of;
  if (!goal.over.empty()) names.push_back(goal.over);
  return names;
}

/// The goal's quantity with the time that `time` has for each benchmark.
double time_quantity(const Goal& goal, const std::function<double(const std::string&)>& time) {
  const auto a_point = [&](const std::string& benchmark) { return time(benchmark) / points_of(benchmark); };
  double sum = 0;
  double sum_a_point = 0;
  double fastest = std::numeric_limits<double>::infinity();
  double slowest = 0;
  for (const std::string& benchmark : goal.of) {
    sum += time(benchmark);
    sum_a_point += a_point(benchmark);
    fastest = std::min(fastest, a_point(benchmark));
    slowest = std::max(slowest, a_point(benchmark));
  }
  switch (goal.quantity) {
    case Quantity::kTimeRatio:
      return sum / time(goal.over);
    case Quantity::kTimeAPointRatio:
      return sum_a_point / a_point(goal.over);
    case Quantity::kTimeAPointSpread:
      return slowest / fastest;
    case Quantity::kPeakBytes:
      break;
  }
  throw std::logic_error("memory is not a time");
}

/// Of the median of the repetitions' values.
statistics::Interval interval_of(const std::vector<double>& values) {
  constexpr double kConfidence = 0.98;
  const statistics::Interval interval = statistics::sign_interval(values, kConfidence);
  if (std::isfinite(interval.low)) return interval;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}

void fill_in_times(const Goal& goal, const Measurements& measurements, VerdictLine& line) {
  std::size_t repetitions = std::numeric_limits<std::size_t>::max();
  for (const std::string& benchmark : benchmarks_of(goal)) {
    const auto found = measurements.find(benchmark);
    if (found == measurements.end() || found->second.times.empty()) return;
    repetitions = std::min(repetitions, found->second.times.size());
  }
  std::vector<double> values;
  for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
    values.push_back(time_quantity(
        goal, [&](const std::string& benchmark) { return measurements.at(benchmark).times[repetition]; }));
  }
  line.value = statistics::median(values);
  line.interval = interval_of(values);
}

Verdict verdict_of(const Goal& goal, const VerdictLine& line) {
  if (!goal.at_most && !goal.at_least) return Verdict::kInformation;
  // The limit itself meets a goal of either kind, so that what misses one begins beyond it.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double limit =
      goal.at_most ? std::nextafter(*goal.at_most, kInfinity) : std::nextafter(*goal.at_least, -kInfinity);
  const statistics::Side side =
      statistics::side_of(line.interval.value_or(statistics::Interval{*line.value, *line.value}), limit);
  if (side == statistics::Side::kUndecided) return Verdict::kUndecided;
  return (side == statistics::Side::kBelow) == goal.at_most.has_value() ? Verdict::kMet : Verdict::kMissed;
}

/// A limit as it was set: no digits that say nothing, at most three that do.
std::string limit_text(double limit) {
  std::string text = three_digits(limit);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

VerdictLine evaluate(const Goal& goal, const Measurements& measurements) {
  VerdictLine line;
  line.what = goal.what;
  if (goal.at_most) line.goal = "<= " + limit_text(*goal.at_most);
  if (goal.at_least) line.goal = ">= " + limit_text(*goal.at_least);
  if (goal.quantity != Quantity::kPeakBytes) {
    fill_in_times(goal, measurements, line);
  } else if (const auto found = measurements.find(goal.of.front()); found != measurements.end()) {
    line.value = found->second.peak_bytes;
  }
  if (!line.value) return line;
  line.verdict = verdict_of(goal, line);
  if (goal.hoped_for) {
    const std::string hoped_for = limit_text(*goal.hoped_for);
    const bool is_met = goal.at_least ? *line.value >= *goal.hoped_for : *line.value <= *goal.hoped_for;
    line.remark = is_met ? hoped_for + " too" : "not " + hoped_for;
  }
  return line;
}

std::string verdict_text(const VerdictLine& line) {
  switch (line.verdict) {
    case Verdict::kMet:
      return line.remark.empty() ? "met" : "met, " + line.remark;
    case Verdict::kMissed:
      return "MISSED";
    case Verdict::kUndecided:
      return "undecided: too noisy";
    case Verdict::kNotMeasured:
      return "not measured";
    case Verdict::kInformation:
      break;
  }
  return "";
}

std::size_t count(const std::vector<VerdictLine>& lines, Verdict verdict) {
  return static_cast<std::size_t>(
      std::ranges::count_if(lines, [=](const VerdictLine& line) { return line.verdict == verdict; }));
}

}  // namespace

std::set<std::string> benchmarks_of_goals() {
  std::set<std::string> benchmarks;
  for (const Goal& goal : all_goals()) {
    for (std::string& benchmark : benchmarks_of(goal)) benchmarks.insert(std::move(benchmark));
  }
  return benchmarks;
}

std::set<std::string> benchmarks_of_undecided_goals(const Measurements& measurements) {
  std::set<std::string> benchmarks;
  for (const Goal& goal : all_goals()) {
    if (evaluate(goal, measurements).verdict != Verdict::kUndecided) continue;
    for (std::string& benchmark : benchmarks_of(goal)) benchmarks.insert(std::move(benchmark));
  }
  return benchmarks;
}

std::vector<VerdictLine> core_verdicts(const Measurements& measurements) {
  std::vector<VerdictLine> lines;
  for (const Goal& goal : all_goals()) lines.push_back(evaluate(goal, measurements));
  return lines;
}

ExitCode exit_code(const std::vector<VerdictLine>& lines) {
  if (count(lines, Verdict::kMissed) > 0) return kExitRegression;
  if (count(lines, Verdict::kNotMeasured) > 0) return kExitNothing;
  return count(lines, Verdict::kUndecided) > 0 ? kExitInconclusive : kExitOk;
}

void print_verdicts(const std::vector<VerdictLine>& lines, std::ostream& out) {
  table::Table table{"verdicts",
                     "The core's goals",
                     {table::words("median ratio"), "value", "interval", "goal", table::words("verdict")}};
  for (const VerdictLine& line : lines) {
    table.add_row({line.what, line.value ? table::Number(*line.value) : table::Cell(""),
                   line.interval ? table::range_cell(line.interval) : "", line.goal, verdict_text(line)});
  }
  table::print_markdown(table, out);
  out << "\n"
      << count(lines, Verdict::kMet) << " goals met, " << count(lines, Verdict::kMissed) << " missed, "
      << count(lines, Verdict::kUndecided) << " undecided, " << count(lines, Verdict::kNotMeasured)
      << " not measured\n";
}

void print_measurements(const Measurements& measurements, std::ostream& out) {
  table::Table table{
      "measurements",
      "What was measured",
      {table::words("benchmark"), table::Column("median ms", "ms"), table::Column("repetitions", "ms"),
       table::Column("ns a point", "ns"), table::Column("peak bytes a point", "B")}};
  for (const auto& [benchmark, measured] : measurements) {
    if (measured.times.empty()) continue;
    const double middle = statistics::median(measured.times);
    const auto [least, most] = std::ranges::minmax_element(measured.times);
    table.add_row({benchmark, table::Number(middle / 1e6),
                   table::Range{table::Number(*least / 1e6), table::Number(*most / 1e6)},
                   table::Number(middle / points_of(benchmark)),
                   measured.peak_bytes ? table::Number(*measured.peak_bytes) : table::Cell("")});
  }
  if (!table.rows.empty()) table::print_markdown(table, out);
}

double points_of(const std::string& benchmark) {
  return std::stod(benchmark.substr(benchmark.rfind('/') + 1));
}

}  // namespace hullbench::micro
