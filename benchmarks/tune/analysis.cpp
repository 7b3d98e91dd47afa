#include "benchmarks/tune/analysis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "benchmarks/record/protocols.hpp"
#include "benchmarks/statistics/statistics.hpp"
#include "benchmarks/tune/halving.hpp"

namespace hullbench::tune {
namespace {

/// Where the error crosses `limit` between an evaluation below and its neighbour above it, as a logarithm.
double crossing(const SearchPoint& below, const SearchPoint& above, double limit) {
  const double from = std::log2(below.position);
  if (is_infinitely_bad(above.error)) return from;
  const double share = (limit - below.error) / (above.error - below.error);
  return from + share * (std::log2(above.position) - from);
}

double best_error(const MethodOnCase& found) {
  const record::RunRecord* best = best_evaluation(found);
  return best == nullptr ? kInfinitelyBad : error_of(*best);
}

/// The error of what a protocol chose on a case; none when it has nothing to say there.
std::optional<double> error_with(const MethodTuning& method, const MethodOnCase& found,
                                 const std::string& protocol, const std::optional<TunedValue>& tuned) {
  if (protocol == "oracle") return method.axis ? std::optional(best_error(found)) : std::nullopt;
  if (protocol == "tuned") {
    if (!tuned || found.sweep.empty()) return std::nullopt;
    return error_at(found, tuned->position, tuned->holes);
  }
  const auto place = found.protocols.find(protocol);
  return place == found.protocols.end() ? std::nullopt : std::optional(error_of(place->second));
}

std::optional<ProtocolScore> score_of(const Tuning& tuning, const MethodTuning& method,
                                      const std::string& protocol, const std::optional<TunedValue>& tuned) {
  ProtocolScore score;
  score.protocol = protocol;
  WeighedValues errors;
  WeighedValues regrets;
  for (std::size_t i = 0; i < tuning.cases.size(); ++i) {
    const TuningCase& one = tuning.cases[i];
    if (one.side() != Side::kTest) continue;
    const auto error = error_with(method, method.cases[i], protocol, tuned);
    if (!error) continue;
    ++score.cases;
    if (is_infinitely_bad(*error)) ++score.failed;
    errors.add(one.membership(), *error);
    const double best = best_error(method.cases[i]);
    if (method.axis && !is_infinitely_bad(best)) regrets.add(one.membership(), *error - best);
  }
  if (errors.empty()) return std::nullopt;
  score.l2_median = errors.median();
  score.l2_interval = errors.median_interval();
  if (!regrets.empty()) {
    score.regret_median = regrets.median();
    score.regret_interval = regrets.median_interval();
  }
  return score;
}

/// The least of `count` of the errors, ascending, taken at random: the median over all choices.
double median_of_least(const std::vector<double>& errors, std::size_t count) {
  const auto size = static_cast<double>(errors.size());
  double none_yet = 1;  // probability that all that were taken lie behind place i
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double left = size - static_cast<double>(i);
    none_yet *= std::max(0.0, left - static_cast<double>(count)) / left;
    if (none_yet <= 0.5) return errors[i];
  }
  return errors.back();
}

/// What the search with holes had found on a case after 1, 2, ... evaluations. The tuned value is tried there
/// too, but not by the search.
std::vector<double> errors_reached(const MethodTuning& method, const MethodOnCase& found) {
  const auto tuned = choose_tuned(method);
  std::vector<double> swept;
  std::vector<double> refined;
  for (const SweepEvaluation& one : found.sweep) {
    if (!one.holes) continue;
    if (one.on_grid) {
      swept.push_back(error_of(one.evaluation));
    } else if (!tuned || one.position != tuned->position) {
      refined.push_back(error_of(one.evaluation));
    }
  }
  swept.resize(std::max(swept.size(), grid(*method.axis, kSweepPoints).size()), kInfinitelyBad);
  std::ranges::sort(swept);
  std::vector<double> reached;
  for (std::size_t count = 1; count <= swept.size(); ++count)
    reached.push_back(median_of_least(swept, count));
  for (const double error : refined) reached.push_back(std::min(reached.back(), error));
  reached.resize(kSweepPoints + kRefinements, reached.back());
  return reached;
}

/// What a sensitivity curve is of.
struct CurveCases {
  std::vector<std::size_t> places;
  std::vector<double> positions;
};

CurveCases curve_cases(const Tuning& tuning, const MethodTuning& method) {
  CurveCases cases = {training_order(tuning.cases), grid(*method.axis, kGridPoints)};
  if (!cases.places.empty()) {
    cases.places.resize(round_ends(cases.places.size()).front());
    return cases;
  }
  cases.places.resize(tuning.cases.size());
  std::iota(cases.places.begin(), cases.places.end(), std::size_t{0});
  cases.positions = grid(*method.axis, kSweepPoints);
  return cases;
}

}  // namespace

std::optional<double> tolerance_octaves(std::vector<SearchPoint> points) {
  std::ranges::sort(points,
                    [](const SearchPoint& a, const SearchPoint& b) { return a.position < b.position; });
  const auto best =
      std::ranges::min_element(points, [](const auto& a, const auto& b) { return a.error < b.error; });
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
  for (const SweepEvaluation& one : found.sweep) {
    if (one.holes) points.push_back({one.position, error_of(one.evaluation), one.on_grid});
  }
  return tolerance_octaves(std::move(points));
}

std::optional<TunedValue> choose_tuned(const MethodTuning& method) {
  if (method.rounds.empty()) return std::nullopt;
  const HalvingRound& last = method.rounds.back();
  const std::vector<double> all = grid(*method.axis, kGridPoints);
  TunedValue tuned = {.training_median = kInfinitelyBad, .training_cases = last.cases};
  const auto consider = [&](const std::vector<double>& scores, bool holes) {
    const auto best = std::ranges::min_element(scores);
    if (best == scores.end() || !(*best < tuned.training_median)) return;
    tuned.position = last.positions[static_cast<std::size_t>(best - scores.begin())];
    tuned.training_median = *best;
    tuned.holes = holes;
  };
  consider(last.scores, true);
  consider(last.scores_without_holes, false);
  if (is_infinitely_bad(tuned.training_median)) return std::nullopt;
  tuned.at_end = tuned.position == all.front() || tuned.position == all.back();
  return tuned;
}

Quartiles quartiles_of(const std::vector<double>& values) {
  return {statistics::quantile(values, 0.25), statistics::median(values), statistics::quantile(values, 0.75)};
}

std::vector<ProtocolScore> protocol_scores(const Tuning& tuning, const MethodTuning& method,
                                           const std::optional<TunedValue>& tuned) {
  std::vector<ProtocolScore> scores;
  for (const record::Protocol& protocol : record::protocols()) {
    if (auto score = score_of(tuning, method, protocol.name, tuned)) scores.push_back(std::move(*score));
  }
  return scores;
}

std::vector<SearchCost> search_costs(const Tuning& tuning, const MethodTuning& method) {
  std::vector<SearchCost> costs;
  if (!method.axis) return costs;
  std::vector<WeighedValues> errors(kSweepPoints + kRefinements);
  for (std::size_t i = 0; i < tuning.cases.size(); ++i) {
    if (tuning.cases[i].side() != Side::kTest || method.cases[i].sweep.empty()) continue;
    const std::vector<double> reached = errors_reached(method, method.cases[i]);
    for (std::size_t k = 0; k < errors.size(); ++k) errors[k].add(tuning.cases[i].membership(), reached[k]);
  }
  if (errors.front().empty()) return costs;
  for (std::size_t k = 0; k < errors.size(); ++k)
    costs.push_back({k + 1, errors[k].size(), errors[k].median(), errors[k].median_interval()});
  return costs;
}

std::vector<CurvePoint> sensitivity_curve(const Tuning& tuning, const MethodTuning& method) {
  std::vector<CurvePoint> curve;
  if (!method.axis) return curve;
  const CurveCases cases = curve_cases(tuning, method);
  for (const double position : cases.positions) {
    CurvePoint point;
    point.position = position;
    std::vector<double> errors;
    std::vector<double> relative;
    for (const std::size_t i : cases.places) {
      const MethodOnCase& found = method.cases[i];
      double best = kInfinitelyBad;
      for (const double other : cases.positions) best = std::min(best, error_at(found, other));
      if (is_infinitely_bad(best)) continue;
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
