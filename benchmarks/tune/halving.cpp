#include "benchmarks/tune/halving.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "benchmarks/tune/search.hpp"

namespace hullbench::tune {
namespace {

/// The weighted median over those of these cases that were searched; a failure where none was.
double score_of(const Tuning& tuning, const MethodTuning& method, const std::vector<std::size_t>& places,
                double position, bool holes) {
  WeighedValues errors;
  for (const std::size_t place : places) {
    const MethodOnCase& found = method.cases[place];
    if (!found.sweep.empty()) errors.add(tuning.cases[place].membership(), error_at(found, position, holes));
  }
  return errors.empty() ? kInfinitelyBad : errors.median();
}

}  // namespace

std::vector<std::size_t> training_order(const std::vector<TuningCase>& cases) {
  // By (turn, group): a case's turn is how many of its group came before it.
  std::map<std::pair<std::string, std::string>, std::size_t> taken;
  std::set<std::pair<std::pair<std::size_t, std::pair<std::string, std::string>>, std::size_t>> order;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (cases[i].side() != Side::kTraining) continue;
    const std::string& dataset = cases[i].plan_case.dataset;
    const std::pair group = {source_of(dataset), sampler_of(dataset)};
    order.insert({{taken[group]++, group}, i});
  }
  std::vector<std::size_t> places;
  places.reserve(order.size());
  for (const auto& [key, place] : order) places.push_back(place);
  return places;
}

std::vector<std::size_t> round_ends(std::size_t cases) {
  if (cases == 0) return {};
  return {(cases + 3) / 4, (cases + 1) / 2, cases};
}

std::vector<double> better_half(const std::vector<double>& positions, const std::vector<double>& scores) {
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return scores[a] < scores[b]; });
  order.resize((order.size() + 1) / 2);
  std::vector<double> kept;
  kept.reserve(order.size());
  for (const std::size_t place : order) kept.push_back(positions[place]);
  std::ranges::sort(kept);
  return kept;
}

std::vector<double> positions_of_round(const MethodTuning& method, std::size_t round) {
  if (round == 0) return grid(*method.axis, kGridPoints);
  const HalvingRound& before = method.rounds[round - 1];
  std::vector<double> scores = before.scores;
  for (std::size_t k = 0; k < before.scores_without_holes.size(); ++k)
    scores[k] = std::min(scores[k], before.scores_without_holes[k]);
  return better_half(before.positions, scores);
}

std::vector<TrainingItem> items_of_round(const Tuning& tuning, std::size_t round) {
  const std::vector<std::size_t> order = training_order(tuning.cases);
  const std::vector<std::size_t> ends = round_ends(order.size());
  std::vector<TrainingItem> items;
  for (std::size_t k = round == 0 ? 0 : ends[round - 1]; k < ends[round]; ++k) {
    for (std::size_t m = 0; m < tuning.methods.size(); ++m) {
      const MethodTuning& method = tuning.methods[m];
      items.push_back({order[k], m, method.axis ? positions_of_round(method, round) : std::vector<double>()});
    }
  }
  return items;
}

void end_round(Tuning& tuning, std::size_t round) {
  std::vector<std::size_t> places = training_order(tuning.cases);
  places.resize(round_ends(places.size())[round]);
  for (MethodTuning& method : tuning.methods) {
    if (!method.axis) continue;
    const auto tried =
        std::ranges::count_if(places, [&](std::size_t place) { return !method.cases[place].sweep.empty(); });
    HalvingRound added = {static_cast<std::size_t>(tried), positions_of_round(method, round), {}, {}};
    for (const bool holes : choices_of_holes(*method.info)) {
      std::vector<double>& scores = holes ? added.scores : added.scores_without_holes;
      for (const double position : added.positions)
        scores.push_back(score_of(tuning, method, places, position, holes));
    }
    method.rounds.push_back(std::move(added));
  }
}

}  // namespace hullbench::tune
