#include "benchmarks/tune/analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::tune {
namespace {

constexpr std::array kProtocols = {"paper", "default", "auto", "tuned", "oracle"};

/// Where the error crosses `limit` between an evaluation below and its neighbour above it, as a logarithm.
double crossing(const SearchPoint& below, const SearchPoint& above, double limit) {
  const double from = std::log2(below.position);
  if (is_infinitely_bad(above.error)) return from;
  const double share = (limit - below.error) / (above.error - below.error);
  return from + share * (std::log2(above.position) - from);
}

/// The error at a grid position, that of a failure where it was not evaluated.
double error_at(const MethodOnCase& found, double position) {
  const Evaluation* evaluation = evaluation_at(found, position);
  return evaluation == nullptr ? kInfinitelyBad : error_of(*evaluation);
}

double best_error(const MethodOnCase& found) {
  const Evaluation* best = best_evaluation(found);
  return best == nullptr ? kInfinitelyBad : error_of(*best);
}

/// The error of what a protocol chose on a case; none when it has nothing to say there.
std::optional<double> error_with(const MethodTuning& method, const MethodOnCase& found,
                                 const std::string& protocol, const std::optional<TunedValue>& tuned) {
  if (protocol == "oracle") return method.axis ? std::optional(best_error(found)) : std::nullopt;
  if (protocol == "tuned") {
    if (!tuned || found.sweep.empty()) return std::nullopt;
    return error_at(found, tuned->position);
  }
  const auto place = found.protocols.find(protocol);
  return place == found.protocols.end() ? std::nullopt : std::optional(error_of(place->second));
}

/// Values by base shape, for intervals.
class Clusters {
 public:
  void add(const std::string& shape, double value) {
    by_shape_[shape].push_back(value);
    all_.push_back(value);
  }
  bool empty() const { return all_.empty(); }
  double middle() const { return statistics::median(std::span<const double>(all_)); }
  std::optional<statistics::Interval> interval() const {
    std::vector<std::vector<double>> clusters;
    for (const auto& [shape, values] : by_shape_) clusters.push_back(values);
    return statistics::clustered_median_interval(clusters);
  }

 private:
  std::map<std::string, std::vector<double>> by_shape_;
  std::vector<double> all_;
};

std::optional<ProtocolScore> score_of(const Tuning& tuning, const MethodTuning& method,
                                      const std::string& protocol, bool test_only,
                                      const std::optional<TunedValue>& tuned) {
  ProtocolScore score;
  score.protocol = protocol;
  score.test_only = test_only;
  Clusters errors;
  Clusters regrets;
  for (std::size_t i = 0; i < tuning.cases.size(); ++i) {
    const TuningCase& one = tuning.cases[i];
    if (test_only && one.side != Side::kTest) continue;
    const auto error = error_with(method, method.cases[i], protocol, tuned);
    if (!error) continue;
    ++score.cases;
    if (is_infinitely_bad(*error)) ++score.failed;
    errors.add(one.shape, *error);
    const double best = best_error(method.cases[i]);
    if (method.axis && !is_infinitely_bad(best)) regrets.add(one.shape, *error - best);
  }
  if (errors.empty()) return std::nullopt;
  score.l2_median = errors.middle();
  score.l2_interval = errors.interval();
  if (!regrets.empty()) {
    score.regret_median = regrets.middle();
    score.regret_interval = regrets.interval();
  }
  return score;
}

}  // namespace

std::optional<double> tolerance_octaves(std::vector<SearchPoint> points) {
  std::sort(points.begin(), points.end(),
            [](const SearchPoint& a, const SearchPoint& b) { return a.position < b.position; });
  const auto best = std::min_element(points.begin(), points.end(),
                                     [](const auto& a, const auto& b) { return a.error < b.error; });
  if (best == points.end() || is_infinitely_bad(best->error)) return std::nullopt;
  const double limit = kToleratedError * best->error;
  auto low = best;
  while (low != points.begin() && std::prev(low)->error <= limit) --low;
  auto high = best;
  while (std::next(high) != points.end() && std::next(high)->error <= limit) ++high;
  const double from =
      low == points.begin() ? std::log2(low->position) : crossing(*low, *std::prev(low), limit);
  const double to =
      std::next(high) == points.end() ? std::log2(high->position) : crossing(*high, *std::next(high), limit);
  return to - from;
}

std::optional<double> tolerance_octaves(const MethodOnCase& found) {
  std::vector<SearchPoint> points;
  points.reserve(found.sweep.size());
  for (const SweepEvaluation& one : found.sweep)
    points.push_back({one.position, error_of(one.evaluation), one.on_grid});
  return tolerance_octaves(std::move(points));
}

std::optional<TunedValue> choose_tuned(const Tuning& tuning, const MethodTuning& method) {
  if (!method.axis) return std::nullopt;
  std::vector<const MethodOnCase*> training;
  for (std::size_t i = 0; i < tuning.cases.size(); ++i) {
    if (tuning.cases[i].side == Side::kTraining && !method.cases[i].sweep.empty())
      training.push_back(&method.cases[i]);
  }
  if (training.empty()) return std::nullopt;
  const std::vector<double> positions = grid(*method.axis, kGridPoints);
  TunedValue best = {0, kInfinitelyBad, training.size(), false};
  for (const double position : positions) {
    std::vector<double> errors;
    errors.reserve(training.size());
    for (const MethodOnCase* found : training) errors.push_back(error_at(*found, position));
    const double middle = statistics::median(std::span<const double>(errors));
    if (middle >= best.training_median) continue;
    best.training_median = middle;
    best.position = position;
  }
  if (is_infinitely_bad(best.training_median)) return std::nullopt;
  best.at_end = best.position == positions.front() || best.position == positions.back();
  return best;
}

Quartiles quartiles_of(const std::vector<double>& values) {
  const std::span<const double> all(values);
  return {statistics::quantile(all, 0.25), statistics::median(all), statistics::quantile(all, 0.75)};
}

std::vector<ProtocolScore> protocol_scores(const Tuning& tuning, const MethodTuning& method,
                                           const std::optional<TunedValue>& tuned) {
  std::vector<ProtocolScore> scores;
  for (const bool test_only : {true, false}) {
    for (const std::string protocol : kProtocols) {
      if (protocol == "tuned" && !test_only) continue;
      if (auto score = score_of(tuning, method, protocol, test_only, tuned))
        scores.push_back(std::move(*score));
    }
  }
  return scores;
}

std::vector<CurvePoint> sensitivity_curve(const Tuning& tuning, const MethodTuning& method) {
  std::vector<CurvePoint> curve;
  if (!method.axis) return curve;
  for (const double position : grid(*method.axis, kGridPoints)) {
    CurvePoint point;
    point.position = position;
    std::vector<double> errors;
    std::vector<double> relative;
    for (std::size_t i = 0; i < tuning.cases.size(); ++i) {
      const MethodOnCase& found = method.cases[i];
      const double best = best_error(found);
      if (found.sweep.empty() || is_infinitely_bad(best)) continue;
      const double error = error_at(found, position);
      if (is_infinitely_bad(error)) ++point.failed;
      errors.push_back(error);
      const double ratio = best > 0 ? error / best : kInfinitelyBad;
      relative.push_back(error == best ? 1 : std::min(ratio, kInfinitelyBad));
    }
    if (errors.empty()) continue;
    point.cases = errors.size();
    point.l2 = quartiles_of(errors);
    point.relative = quartiles_of(relative);
    curve.push_back(point);
  }
  return curve;
}

}  // namespace hullbench::tune
