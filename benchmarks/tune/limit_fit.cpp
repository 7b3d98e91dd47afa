#include "benchmarks/tune/limit_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "benchmarks/base/parallel.hpp"
#include "benchmarks/tune/split.hpp"
#include "datasets/datasets.hpp"
#include "datasets/random.hpp"

namespace hullbench::tune {
namespace {

constexpr std::uint64_t kSampleSeed = 1;
constexpr double kLargestLoss = 1.5;
constexpr int kOtherStarts = 2;
/// The first of limit_knobs(). `region` and `wide` hardly change an error: they are chosen so that chance
/// leaves no parts and holes, which fit_default counts. `smoothed_from` is a number of blocks that no set of
/// the fit is near, `step` is of points on outlines, which the fit has none of, and `valley` was chosen with
/// the other numbers of outliers.cpp.
constexpr std::size_t kFittedKnobs = 12;

double weight_of(const std::string& sampling) {
  return sampling == "uniform" ? 1.5 : 1;
}

double rounded_to_three_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 2);
  // Divided by a whole number where there is one, which gives the double that the digits are read as.
  return unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit;
}

/// From `least` to `most`, evenly in the logarithm for lengths and shares.
double draw(const LimitKnob& knob, Random& random) {
  if (knob.count != nullptr) return random.between(knob.least - 0.5, knob.most + 0.5);
  return std::exp(random.between(std::log(knob.least), std::log(knob.most)));
}

/// A step changes the logarithm by an eighth of the range at most.
double neighbour(const LimitKnob& knob, double value, Random& random) {
  if (knob.count != nullptr) return draw(knob, random);
  return value * std::exp(random.between(-0.125, 0.125) * std::log(knob.most / knob.least));
}

LimitClimb climb(std::vector<MadeLimitCase>& cases, std::string start, const AutomaticConstants& from,
                 int tries, Random random, const std::vector<int>& cores) {
  LimitClimb result = {std::move(start), from, limit_score(cases, from, cores), 0};
  result.score_to = result.score_from;
  for (int k = 0; k < tries; ++k) {
    AutomaticConstants tried = result.to;
    for (std::uint64_t changes = 1 + random.below(2); changes > 0; --changes) {
      const LimitKnob& knob = limit_knobs()[random.below(kFittedKnobs)];
      knob.set(tried, neighbour(knob, knob.value(tried), random));
    }
    const double score = limit_score(cases, tried, cores);
    if (score >= result.score_to) continue;
    result.to = tried;
    result.score_to = score;
  }
  return result;
}

std::vector<LimitCaseName> cases_of_test_shapes(const std::vector<std::string>& samplings, std::size_t n) {
  std::vector<LimitCaseName> names;
  for (const std::string& sampling : samplings) {
    for (const char* shape : {"ca", "hi", "letter_a", "letter_b", "letter_g", "letter_m", "letter_s",
                              "letter_x", "country-1", "country-7", "country-13", "country-25", "clipart-2",
                              "clipart-8", "clipart-14", "symbol-1", "symbol-6", "symbol-11"}) {
      names.push_back({shape + sampling, false, n});
    }
  }
  return names;
}

}  // namespace

std::string sampling_of(const std::string& dataset) {
  const std::size_t mark = dataset.find('~');
  return mark == std::string::npos ? "uniform" : dataset.substr(mark + 1);
}

std::vector<LimitCaseName> training_limit_cases() {
  const std::vector<std::string> few = {"", "~gradient:16~outliers:3"};
  const std::vector<std::string> all = {
      "",           "~gradient:16", "~gradient:64", "~outliers:3", "~outliers:15", "~gradient:16~outliers:3",
      "~noise:0.5", "~poisson:0.7", "~airborne:3",  "~airborne:8", "~clusters:8",  "~clusters:16",
      "~cascade:2", "~cascade:3"};
  std::vector<LimitCaseName> names;
  for (const SplitRow& source : shape_split()) {
    if (source.side != Side::kTraining) continue;
    for (const std::string& sampling : all) {
      for (const std::size_t n : {500U, 2000U}) {
        names.push_back({source.name + "-1" + sampling, false, n});
        names.push_back({source.name + "-2" + sampling, false, n});
      }
      names.push_back({source.name + "-1" + sampling, false, 8000});
    }
    for (const std::string& sampling : few) names.push_back({source.name + "-1" + sampling, false, 32000});
  }
  // Else nothing would cost a rule that fills every hole: few shapes have small ones of their own.
  for (const std::string& sampling : all) {
    for (const char* star : {"star-3", "star-4", "star-5"}) names.push_back({star + sampling, true, 2000});
    names.push_back({"star-3" + sampling, true, 8000});
  }
  return names;
}

std::vector<LimitCaseName> test_limit_cases(std::size_t n) {
  std::vector<LimitCaseName> names = cases_of_test_shapes({"",
                                                           "~gradient:16",
                                                           "~gradient:64",
                                                           "~hotspot:12",
                                                           "~outliers:3",
                                                           "~outliers:15",
                                                           "~gradient:16~outliers:3",
                                                           "~noise:0.5",
                                                           "~poisson:0.7",
                                                           "~lattice:0.2",
                                                           "~quantised:0.5",
                                                           "~airborne:3",
                                                           "~zigzag:4",
                                                           "~rotating:5",
                                                           "~depthcamera:2",
                                                           "~depthcamera:5",
                                                           "~tracks:5",
                                                           "~transcripts:3",
                                                           "~boundary:20",
                                                           "~clusters:8",
                                                           "~clusters:16",
                                                           "~cascade:2",
                                                           "~outline:0.1",
                                                           "~water:20"},
                                                          n);
  for (const char* sampling : {"", "~gradient:16"}) {
    for (const char* shape : {"ca", "hi"}) names.push_back({std::string(shape) + sampling, true, n});
  }
  return names;
}

std::vector<LimitCaseName> large_limit_cases(std::size_t n) {
  return cases_of_test_shapes(
      {"~gradient:4", "~gradient:16", "~gradient:64", "~gradient:16~outliers:3", "~airborne:2", "~airborne:3",
       "~airborne:5", "~airborne:3~outliers:3", "~zigzag:4", "~clusters:8"},
      n);
}

std::vector<MadeLimitCase> make_limit_cases(const std::vector<LimitCaseName>& names,
                                            const std::vector<int>& cores) {
  std::vector<MadeLimitCase> cases(names.size());
  for_each_in_parallel(names.size(), cores, [&](std::size_t i) {
    const PointSet set = make_point_set(names[i].dataset, names[i].holes, names[i].n, kSampleSeed);
    cases[i] = {names[i], std::make_unique<LimitCase>(set.points, set.ground_truth)};
    cases[i].best_of_one_limit = cases[i].triangles->best_error_of_one_limit();
  });
  return cases;
}

std::vector<double> limit_errors(std::vector<MadeLimitCase>& cases, const AutomaticConstants& constants,
                                 const std::vector<int>& cores) {
  std::vector<double> errors(cases.size());
  for_each_in_parallel(cases.size(), cores,
                       [&](std::size_t i) { errors[i] = cases[i].triangles->error(constants); });
  return errors;
}

double limit_score(std::vector<MadeLimitCase>& cases, const AutomaticConstants& constants,
                   const std::vector<int>& cores) {
  struct Sum {
    double losses = 0;
    double count = 0;
  };
  const std::vector<double> errors = limit_errors(cases, constants, cores);
  std::map<std::string, Sum> sums;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Sum& sum = sums[sampling_of(cases[i].name.dataset)];
    sum.losses += std::clamp(std::log(errors[i] / cases[i].best_of_one_limit), -kLargestLoss, kLargestLoss);
    ++sum.count;
  }
  double score = 0;
  double weights = 0;
  for (const auto& [sampling, sum] : sums) {
    score += weight_of(sampling) * sum.losses / sum.count;
    weights += weight_of(sampling);
  }
  return score / weights;
}

double LimitKnob::value(const AutomaticConstants& constants) const {
  return count != nullptr ? static_cast<double>(constants.*count) : constants.*length;
}

void LimitKnob::set(AutomaticConstants& constants, double value) const {
  const double kept = std::clamp(value, least, most);
  if (count != nullptr) {
    constants.*count = static_cast<std::size_t>(std::lround(kept));
  } else {
    constants.*length = rounded_to_three_digits(kept);
  }
}

const std::vector<LimitKnob>& limit_knobs() {
  using C = AutomaticConstants;
  static const std::vector<LimitKnob> knobs = {{"quantile", &C::quantile, nullptr, 0.3, 0.8},
                                               {"growth", &C::growth, nullptr, 2, 40},
                                               {"reach", &C::reach, nullptr, 2, 30},
                                               {"noise", &C::noise, nullptr, 0.03, 0.4},
                                               {"usual", &C::usual, nullptr, 0.5, 1.2},
                                               {"pull", &C::pull, nullptr, 2, 120},
                                               {"even", &C::even, nullptr, 0.2, 0.5},
                                               {"doubt", &C::doubt, nullptr, 5, 500},
                                               {"still", &C::still, nullptr, 0.0003, 0.1},
                                               {"below", nullptr, &C::below, 3, 10},
                                               {"above", nullptr, &C::above, 1, 8},
                                               {"spike", &C::spike, nullptr, 0.8, 3},
                                               {"region", &C::region, nullptr, 0.25, 8},
                                               {"wide", &C::wide, nullptr, 2, 16},
                                               {"smoothed_from", nullptr, &C::smoothed_from, 4, 64},
                                               {"step", &C::step, nullptr, 0.5, 8},
                                               {"valley", &C::valley, nullptr, 1, 8}};
  return knobs;
}

std::vector<LimitClimb> fit_limit(std::vector<MadeLimitCase>& cases, int tries, std::uint64_t seed,
                                  const std::vector<int>& cores) {
  std::vector<LimitClimb> climbs;
  climbs.push_back(climb(cases, "the code", {}, tries, Random(derive_seed(seed, "code")), cores));
  for (int k = 1; k <= kOtherStarts; ++k) {
    Random random(derive_seed(seed, "start " + std::to_string(k)));
    AutomaticConstants start;
    for (std::size_t i = 0; i < kFittedKnobs; ++i) {
      limit_knobs()[i].set(start, draw(limit_knobs()[i], random));
    }
    climbs.push_back(climb(cases, "random " + std::to_string(k), start, tries, random, cores));
  }
  return climbs;
}

std::vector<HeldOutWay> cross_validate_limit(std::vector<MadeLimitCase>& cases, int tries, std::uint64_t seed,
                                             const std::vector<int>& cores) {
  std::set<std::string> samplings;
  for (const MadeLimitCase& one : cases) samplings.insert(sampling_of(one.name.dataset));
  std::vector<HeldOutWay> ways;
  for (const std::string& sampling : samplings) {
    const auto held = std::stable_partition(cases.begin(), cases.end(), [&](const MadeLimitCase& one) {
      return sampling_of(one.name.dataset) != sampling;
    });
    std::vector<MadeLimitCase> held_out(std::make_move_iterator(held), std::make_move_iterator(cases.end()));
    cases.erase(held, cases.end());
    const LimitClimb found =
        climb(cases, "the code", {}, tries, Random(derive_seed(seed, "without " + sampling)), cores);
    ways.push_back({sampling, limit_score(held_out, {}, cores), limit_score(held_out, found.to, cores)});
    std::move(held_out.begin(), held_out.end(), std::back_inserter(cases));
  }
  return ways;
}

std::vector<LimitVariant> limit_ablations() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();
  std::vector<LimitVariant> variants = {{"whole rule", {}},
                                        {"growth not bounded", {.growth = kInfinity}},
                                        {"not smoothed", {.smoothed_from = kNever}},
                                        {"outliers not told by their density", {.valley = kInfinity}},
                                        {"scatter not looked at", {.doubt = 0}},
                                        {"not shrunk to the median", {.noise = 0, .smoothed_from = kNever}},
                                        {"one block: one limit for all", {.noise = kInfinity}},
                                        {"spikes stay", {.spike = kInfinity}},
                                        {"small regions stay", {.region = 0}},
                                        {"small holes stay", {.wide = -kInfinity}},
                                        {"outlines not filled", {.step = kInfinity}}};
  return variants;
}

std::vector<LimitVariant> limit_sensitivities(double factor) {
  std::vector<LimitVariant> variants;
  for (const LimitKnob& knob : limit_knobs()) {
    LimitVariant one = {knob.name, {}};
    const double value = factor * knob.value(one.constants);
    if (knob.count != nullptr) {
      one.constants.*knob.count = static_cast<std::size_t>(std::lround(value));
    } else {
      one.constants.*knob.length = value;
    }
    variants.push_back(one);
  }
  return variants;
}

}  // namespace hullbench::tune
