#include "benchmarks/micro/core_verdicts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/table/document.hpp"
#include "benchmarks/table/text_table.hpp"

namespace hullbench::micro {
namespace {

using Names = std::vector<std::string>;

enum class Quantity {
  kTimeRatio,         ///< all of `of`, added, over `over`
  kTimeAPointRatio,   ///< the same of times a point
  kTimeAPointSpread,  ///< the largest over the smallest time a point of all of `of`
  kPeakBytes          ///< of the one in `of`
};

struct Goal {
  std::string what;
  Quantity quantity = Quantity::kTimeRatio;
  Names of = {};
  std::string over = {};
  std::optional<double> at_most = {}, at_least = {};  ///< at most one of the two; none: information
  std::optional<double> hoped_for = {};               ///< a stricter `at_most`
};

std::string name(const std::string& function, const std::string& points) {
  return function + "/" + points;
}

Goal ratio(const std::string& of, const std::string& over, const std::string& points) {
  return {.what = of + " / " + over + ", " + points, .of = {name(of, points)}, .over = name(over, points)};
}

void add_single_thread_goals(std::vector<Goal>& goals) {
  for (const char* set : {"ca/", "uniform/"}) {
    for (const char* n : {"2000", "8000", "64000", "1000000"}) {
      Goal goal = ratio("concave_hull", "cgal_delaunay", std::string(set) + n);
      goal.at_most = 0.40;
      goal.hoped_for = 0.30;
      goals.push_back(std::move(goal));
    }
  }
  for (const char* set : {"ca/", "uniform/"}) {
    goals.push_back(ratio("concave_hull_once", "concave_hull", std::string(set) + "64000"));
    goals.back().at_most = 1.3;
  }
  for (const char* set : {"ca/", "uniform/"}) {
    for (const char* n : {"64000", "1000000"}) {
      const std::string points = std::string(set) + n;
      goals.push_back({.what = "(regions + polygons) / concave_hull, " + points,
                       .of = {name("regions", points), name("polygons", points)},
                       .over = name("concave_hull", points),
                       .at_most = 0.20});
    }
  }
}

// What it costs to choose the limit from the points. The shape is another one than with the paper's alpha,
// and so is its outline.
void add_automatic_goals(std::vector<Goal>& goals) {
  for (const char* points : {"ca/2000", "ca/8000", "ca/64000", "ca/1000000", "uniform/2000", "uniform/8000",
                             "uniform/64000", "uniform/1000000"}) {
    goals.push_back(ratio("concave_hull_automatic", "concave_hull", points));
    goals.back().at_most = 1.05;
  }
}

// Inputs that are harder, or not what others are made for, against uniform points.
void add_input_goals(std::vector<Goal>& goals) {
  const std::pair<const char*, const char*> degenerate[] = {{"lattice/64000", "uniform/64000"},
                                                            {"lattice/1000000", "uniform/1000000"},
                                                            {"rgbd/64000", "uniform/64000"},
                                                            {"rgbd/101760", "uniform/100000"},
                                                            {"rgbd/1000000", "uniform/1000000"}};
  for (const auto& [points, uniform] : degenerate) {
    goals.push_back({.what = std::string("time a point, ") + points + " / " + uniform,
                     .quantity = Quantity::kTimeAPointRatio,
                     .of = {name("concave_hull", points)},
                     .over = name("concave_hull", uniform),
                     .at_most = 1.5});
  }
  goals.push_back({.what = "4000 regions / 1 with as long an outline, 1000000 points",
                   .of = {"concave_hull/islands/1000000"},
                   .over = "concave_hull/sieve/1000000",
                   .at_most = 1.0});
  goals.push_back({.what = "islands/1000000 / uniform/1000000",
                   .of = {"concave_hull/islands/1000000"},
                   .over = "concave_hull/uniform/1000000"});
  goals.push_back({.what = "n log n: a point, uniform/10000000 / uniform/1000",
                   .quantity = Quantity::kTimeAPointRatio,
                   .of = {"concave_hull/uniform/10000000"},
                   .over = "concave_hull/uniform/1000",
                   .at_most = std::log(1e7) / std::log(1e3)});
  Names sizes;
  for (const char* n : {"1000", "10000", "100000", "1000000", "10000000"}) {
    sizes.push_back(std::string("concave_hull/uniform/") + n);
  }
  goals.push_back({.what = "growth: a point, uniform, slowest / fastest size",
                   .quantity = Quantity::kTimeAPointSpread,
                   .of = std::move(sizes)});
}

void add_memory_goals(std::vector<Goal>& goals) {
  for (const char* points : {"ca/1000000", "ca/10000000", "uniform/1000000", "uniform/10000000"}) {
    goals.push_back({.what = std::string("peak bytes a point, ") + points,
                     .quantity = Quantity::kPeakBytes,
                     .of = {name("concave_hull", points)},
                     .at_most = 120});
  }
}

void add_thread_goals(std::vector<Goal>& goals) {
  for (const char* set : {"ca/", "uniform/"}) {
    for (const auto& [n, least] : {std::pair{"64000", 1.6}, {"1000000", 1.8}, {"10000000", 1.8}}) {
      goals.push_back(ratio("concave_hull", "concave_hull_2_threads", std::string(set) + n));
      goals.back().what = std::string("one thread / 2 threads, ") + set + n;
      goals.back().at_least = least;
    }
  }
}

void add_information(std::vector<Goal>& goals) {
  for (const char* points : {"ca/64000", "uniform/64000"}) {
    for (const char* other :
         {"cgal_alpha_shape", "geos_delaunay", "geos_concave_hull", "geos_concave_hull_with_holes"}) {
      goals.push_back(ratio(other, "concave_hull", points));
      goals.back().what = std::string(other) + " / ours, " + points;
    }
  }
}

std::vector<Goal> all_goals() {
  std::vector<Goal> goals;
  add_single_thread_goals(goals);
  add_automatic_goals(goals);
  add_input_goals(goals);
  add_memory_goals(goals);
  add_thread_goals(goals);
  add_information(goals);
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

void fill_in_times(const Goal& goal, const Measurements& measurements, VerdictLine& line) {
  std::size_t repetitions = std::numeric_limits<std::size_t>::max();
  for (const std::string& benchmark : benchmarks_of(goal)) {
    const auto found = measurements.find(benchmark);
    if (found == measurements.end() || found->second.times.empty()) return;
    repetitions = std::min(repetitions, found->second.times.size());
  }
  line.value = time_quantity(goal, [&](const std::string& benchmark) {
    return statistics::median(std::span<const double>(measurements.at(benchmark).times));
  });
  for (std::size_t repetition = 0; repetition < repetitions; ++repetition) {
    const double value = time_quantity(
        goal, [&](const std::string& benchmark) { return measurements.at(benchmark).times[repetition]; });
    line.smallest = std::min(value, line.smallest.value_or(value));
    line.largest = std::max(value, line.largest.value_or(value));
  }
}

bool meets(const Goal& goal, double value) {
  return goal.at_most ? value <= *goal.at_most : value >= *goal.at_least;
}

Verdict verdict_of(const Goal& goal, const VerdictLine& line) {
  if (!goal.at_most && !goal.at_least) return Verdict::kInformation;
  if (meets(goal, *line.value)) return Verdict::kMet;
  const bool one_meets = line.smallest && (meets(goal, *line.smallest) || meets(goal, *line.largest));
  return one_meets ? Verdict::kUndecided : Verdict::kMissed;
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
    line.remark = *line.value <= *goal.hoped_for ? hoped_for + " too" : "not " + hoped_for;
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
  return static_cast<std::size_t>(std::count_if(
      lines.begin(), lines.end(), [=](const VerdictLine& line) { return line.verdict == verdict; }));
}

}  // namespace

std::set<std::string> benchmarks_of_goals() {
  std::set<std::string> benchmarks;
  for (const Goal& goal : all_goals()) {
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
  table::TextTable table({"ratio of medians", "value", "repetitions", "goal", "verdict"});
  for (const VerdictLine& line : lines) {
    const std::string spread =
        line.smallest ? three_digits(*line.smallest) + " to " + three_digits(*line.largest) : "";
    table.add_row(
        {line.what, line.value ? three_digits(*line.value) : "", spread, line.goal, verdict_text(line)});
  }
  table::print_markdown(table, out);
  out << "\n"
      << count(lines, Verdict::kMet) << " goals met, " << count(lines, Verdict::kMissed) << " missed, "
      << count(lines, Verdict::kUndecided) << " undecided, " << count(lines, Verdict::kNotMeasured)
      << " not measured\n";
}

void print_measurements(const Measurements& measurements, std::ostream& out) {
  table::TextTable table({"benchmark", "median ms", "repetitions", "ns a point", "peak bytes a point"});
  for (const auto& [benchmark, measured] : measurements) {
    if (measured.times.empty()) continue;
    const double middle = statistics::median(std::span<const double>(measured.times));
    const auto [least, most] = std::minmax_element(measured.times.begin(), measured.times.end());
    table.add_row({benchmark, three_digits(middle / 1e6),
                   three_digits(*least / 1e6) + " to " + three_digits(*most / 1e6),
                   three_digits(middle / points_of(benchmark)),
                   measured.peak_bytes ? three_digits(*measured.peak_bytes) : ""});
  }
  if (!table.empty()) table::print_markdown(table, out);
}

double points_of(const std::string& benchmark) {
  return std::stod(benchmark.substr(benchmark.rfind('/') + 1));
}

}  // namespace hullbench::micro
