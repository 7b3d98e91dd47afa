// The search and what is made of it, on invented errors: axes, the search itself, the split, tuned values,
// tolerance, regret, curves and the plan with the chosen parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/tune/analysis.hpp"
#include "benchmarks/tune/halving.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/tune/search_axis.hpp"
#include "benchmarks/tune/split.hpp"
#include "benchmarks/tune/strata.hpp"
#include "benchmarks/tune/tuned_plan.hpp"
#include "benchmarks/tune/tuner.hpp"
#include "datasets/datasets.hpp"
#include "datasets/stress.hpp"
#include "tests/infinity.hpp"

namespace hullbench::testing {
namespace {

ParameterInfo parameter(const std::string& name, const std::string& unit, double minimum, double maximum,
                        std::optional<double> default_value = std::nullopt) {
  return {name, unit, "Of a test.", minimum, maximum, default_value};
}

MethodInfo method_with(std::vector<ParameterInfo> parameters, bool holes = true) {
  MethodInfo info;
  info.name = info.title = "made_up";
  info.version = "1";
  info.parameters = std::move(parameters);
  info.capabilities.holes = holes;
  return info;
}

tune::SearchAxis length_axis() {
  return *tune::search_axis(method_with({parameter("reach", "length", 0, kInfinity)}));
}

TEST(SearchAxisTest, LengthsShareOneAxisWhateverTheirPower) {
  const tune::SearchAxis length = length_axis();
  EXPECT_EQ(length.parameter, "reach");
  EXPECT_TRUE(length.spacings);
  EXPECT_EQ(length.low, 0.125);
  EXPECT_EQ(length.high, 32);
  const tune::SearchAxis area =
      *tune::search_axis(method_with({parameter("alpha", "length^2", 0, kInfinity)}));
  EXPECT_EQ(tune::grid(area, tune::kGridPoints), tune::grid(length, tune::kGridPoints));
  EXPECT_DOUBLE_EQ(tune::value_at(length, 1.5, 10), 15);
  EXPECT_DOUBLE_EQ(tune::value_at(area, 1.5, 10), 225);
}

TEST(SearchAxisTest, OtherParametersHaveTheirOwnRange) {
  const tune::SearchAxis ratio = *tune::search_axis(method_with({parameter("ratio", "ratio", 0, 1)}));
  EXPECT_FALSE(ratio.spacings);
  EXPECT_EQ(ratio.high, 1);
  EXPECT_EQ(ratio.low, 1.0 / 256);
  EXPECT_EQ(tune::value_at(ratio, 0.5, 1000), 0.5);
  const tune::SearchAxis number = *tune::search_axis(method_with({parameter("c", "1", 0, kInfinity)}));
  EXPECT_EQ(number.low, 0.125);
  EXPECT_EQ(number.high, 32);
  const tune::SearchAxis narrow = *tune::search_axis(method_with({parameter("c", "1", 2, 5)}));
  EXPECT_EQ(narrow.low, 2);
  EXPECT_EQ(narrow.high, 5);
  const tune::SearchAxis above = *tune::search_axis(method_with({parameter("c", "1", 1, kInfinity)}));
  EXPECT_EQ(above.low, 1);
  EXPECT_EQ(above.high, 256);
}

TEST(SearchAxisTest, CountsAreWholeAndEachIsThereOnce) {
  const tune::SearchAxis axis = *tune::search_axis(method_with({parameter("k", "count", 3, kInfinity)}));
  const std::vector<double> positions = tune::grid(axis, tune::kGridPoints);
  EXPECT_EQ(positions.front(), 3);
  EXPECT_EQ(positions.back(), 768);
  for (const double position : positions) EXPECT_EQ(position, std::round(position));
  EXPECT_TRUE(std::adjacent_find(positions.begin(), positions.end(), std::greater_equal<>()) ==
              positions.end());
}

TEST(SearchAxisTest, TakesTheFirstNumberAndALengthBeforeARatio) {
  EXPECT_EQ(tune::search_axis(
                method_with({parameter("holes", "switch", 0, 1, 0), parameter("c", "1", 0, kInfinity, 2),
                             parameter("reach", "length", 0, kInfinity, 0)}))
                ->parameter,
            "c");
  EXPECT_EQ(tune::search_axis(
                method_with({parameter("ratio", "ratio", 0, 1, 1), parameter("holes", "switch", 0, 1, 0),
                             parameter("reach", "length", 0, kInfinity, kInfinity)}))
                ->parameter,
            "reach");
  EXPECT_FALSE(tune::search_axis(method_with({})));
  EXPECT_FALSE(tune::search_axis(method_with({parameter("holes", "switch", 0, 1, 0)})));
  EXPECT_FALSE(tune::search_axis(method_with({parameter("c", "1", -1, 1)}))) << "there is no logarithm";
  EXPECT_FALSE(
      tune::search_axis(method_with({parameter("a", "length", 0, 1), parameter("b", "length", 0, 1)})))
      << "the other one is required";
}

TEST(SearchAxisTest, SwitchesForHolesAreSetWhereTheMethodHasHoles) {
  const std::vector<ParameterInfo> parameters = {parameter("allow_holes", "switch", 0, 1, 0),
                                                 parameter("fast", "switch", 0, 1, 0)};
  EXPECT_EQ(tune::fixed_parameters(method_with(parameters)), (Parameters{{"allow_holes", 1}}));
  EXPECT_EQ(tune::fixed_parameters(method_with(parameters, false)), Parameters());
}

TEST(SearchTest, FindsTheBestOfAUnimodalError) {
  for (const double best : {0.15, 0.9, 1.37, 7.7, 29.0}) {
    const auto points = tune::search(length_axis(), [&](double position) {
      return tune::Trial{0.1 + std::pow(std::log2(position / best), 2), false};
    });
    ASSERT_EQ(points.size(), static_cast<std::size_t>(tune::kSweepPoints + tune::kRefinements));
    const auto found =
        std::ranges::min_element(points, [](const auto& a, const auto& b) { return a.error < b.error; });
    // Two octaves, shortened 5 times by the golden ratio.
    EXPECT_NEAR(std::log2(found->position / best), 0, 2 * std::pow(0.6181, 5)) << best;
    EXPECT_FALSE(found->on_grid);
  }
}

TEST(SearchTest, AsksForNoPositionTwice) {
  const tune::SearchAxis counts = *tune::search_axis(method_with({parameter("k", "count", 3, kInfinity)}));
  std::set<double> asked;
  tune::search(counts, [&](double position) {
    EXPECT_TRUE(asked.insert(position).second) << position;
    EXPECT_EQ(position, std::round(position));
    return tune::Trial{std::abs(position - 11), false};
  });
  EXPECT_TRUE(asked.contains(11));
}

TEST(SearchTest, FailuresAreInfinitelyBadAndTimeoutsEndTheSweep) {
  const auto all_fail = tune::search(length_axis(), [](double) { return tune::Trial{}; });
  EXPECT_EQ(all_fail.size(), static_cast<std::size_t>(tune::kSweepPoints)) << "nothing to refine";
  // Good only where nobody would look after failures.
  const auto one = tune::search(length_axis(), [](double position) {
    return position > 20 ? tune::Trial{0.5, false} : tune::Trial{};
  });
  EXPECT_TRUE(std::ranges::any_of(one, [](const auto& point) { return point.error == 0.5; }));
  const auto slow = tune::search(length_axis(), [](double position) {
    return position < 1 ? tune::Trial{0.5, false} : tune::Trial{tune::kInfinitelyBad, true};
  });
  const auto tried = std::ranges::count_if(
      slow, [](const auto& point) { return point.on_grid && point.error == tune::kInfinitelyBad; });
  EXPECT_EQ(tried, tune::kMostTimeouts);
}

std::vector<tune::SearchPoint> curve(const std::vector<std::pair<double, double>>& values) {
  std::vector<tune::SearchPoint> points;
  points.reserve(values.size());
  for (const auto& [position, error] : values) points.push_back({position, error, true});
  return points;
}

TEST(ToleranceTest, IsTheWidthOfTheRangeWithinTenPercent) {
  // Flat from 1 to 4: two octaves, and nothing outside, where it jumps at once.
  EXPECT_NEAR(*tune::tolerance_octaves(curve({{0.999999, 9}, {1, 1}, {2, 1}, {4, 1}, {4.000001, 9}})), 2,
              1e-5);
  // A tent in the logarithm, from 1 at 2 to 2 an octave away on both sides: a tenth of an octave each way.
  EXPECT_NEAR(*tune::tolerance_octaves(curve({{4, 2}, {1, 2}, {2, 1}})), 0.2, 1e-12);
  // It ends where the error leaves the range for the first time.
  EXPECT_NEAR(*tune::tolerance_octaves(curve({{1, 1}, {2, 2}, {4, 1}, {8, 1}})), 0.1, 1e-12);
  // At the axis' ends it is cut, and beside a failure it ends at the last good evaluation.
  EXPECT_NEAR(*tune::tolerance_octaves(curve({{1, 1}, {2, 1.05}})), 1, 1e-12);
  EXPECT_NEAR(*tune::tolerance_octaves(
                  curve({{0.5, tune::kInfinitelyBad}, {1, 1}, {2, 1.05}, {4, tune::kInfinitelyBad}})),
              1, 1e-12);
  EXPECT_EQ(*tune::tolerance_octaves(curve({{1, tune::kInfinitelyBad}, {2, 0}, {4, tune::kInfinitelyBad}})),
            0);
  EXPECT_FALSE(tune::tolerance_octaves(curve({{1, tune::kInfinitelyBad}})));
  EXPECT_FALSE(tune::tolerance_octaves(std::vector<tune::SearchPoint>()));
}

std::ptrdiff_t count_rows(const std::vector<tune::SplitRow>& rows, const std::string& name) {
  return std::ranges::count_if(rows, [&](const tune::SplitRow& row) { return row.name == name; });
}

TEST(SplitTest, EverySourceOfShapesAndEverySamplerHasItsSideAndAReason) {
  for (const DatasetInfo& info : datasets()) {
    const std::string name = info.members == 0 ? info.name : info.name + "-1";
    const std::string source = tune::source_of(name);
    EXPECT_EQ(count_rows(tune::shape_split(), source), 1)
        << name << ": give it a row in benchmarks/tune/split.cpp";
  }
  for (const StressKind& kind : stress_kinds()) {
    EXPECT_EQ(count_rows(tune::sampler_split(), kind.name), 1)
        << kind.name << ": give it a row in benchmarks/tune/split.cpp";
  }
  for (const auto& rows : {tune::shape_split(), tune::sampler_split()}) {
    for (const tune::SplitRow& row : rows) EXPECT_TRUE(row.reason.ends_with(".")) << row.name;
  }
  for (const tune::SplitRow& row : tune::sampler_split())
    EXPECT_NE(row.side, tune::Side::kNeither) << row.name;
}

TEST(SplitTest, WhatThePaperReportsIsForTests) {
  for (const std::string plan_name : {"states", "alphabet", "rgbd"}) {
    for (const plan::PlanCase& one : plan::load_plan(plan_name, HULLBENCH_PLAN_FOLDER).expanded_cases)
      EXPECT_EQ(tune::side_of(one.dataset), tune::Side::kTest) << one.dataset;
  }
}

TEST(SplitTest, ACaseIsTrainingWhereShapeAndAllSamplersAre) {
  EXPECT_EQ(tune::side_of("star-17"), tune::Side::kTraining);
  EXPECT_EQ(tune::side_of("star-17~gradient:4~outliers:1~noise:0.5"), tune::Side::kTraining);
  EXPECT_EQ(tune::side_of("star-17~gradient:4~quantised:0.5"), tune::Side::kNeither);
  EXPECT_EQ(tune::side_of("country-17"), tune::Side::kTest);
  EXPECT_EQ(tune::side_of("country-17~quantised:0.5"), tune::Side::kTest);
  EXPECT_EQ(tune::side_of("country-17~noise:0.5"), tune::Side::kTest);
  EXPECT_EQ(tune::side_of("channel-4~noise:0.5"), tune::Side::kTest);
  EXPECT_EQ(tune::side_of("degenerate_tiny"), tune::Side::kNeither);
  EXPECT_EQ(tune::side_of("zoo-geos-754"), tune::Side::kNeither);
  EXPECT_EQ(tune::side_of("somebody's-1"), tune::Side::kNeither) << "which the split does not know";
  EXPECT_FALSE(tune::has_unseen_sampler("country-17~noise:0.5"));
  EXPECT_TRUE(tune::has_unseen_sampler("country-17~noise:0.5~quantised:1"));
  EXPECT_FALSE(tune::has_unseen_sampler("country-17"));
  EXPECT_TRUE(tune::has_unseen_sampler("floor-1")) << "seen by a depth camera";
  EXPECT_EQ(tune::side_of("towns-be"), tune::Side::kTest);
  EXPECT_TRUE(tune::has_unseen_sampler("towns-be"));
}

/// The name of the i-th invented shape, from 1: odd ones are training shapes, even ones are test shapes.
std::string invented_shape(int i) {
  return (i % 2 == 1 ? "star-" : "country-") + std::to_string(i);
}

/// A search over `count` shapes with an error that `error_of(shape, position)` invents.
class InventedTuning {
 public:
  explicit InventedTuning(const MethodInfo& info, int count = 40) {
    tune::MethodTuning& method = tuning.methods.emplace_back();
    method.name = method.title = info.name;
    method.info = info;
    method.axis = tune::search_axis(info);
    for (int i = 1; i <= count; ++i) {
      tune::TuningCase& one = tuning.cases.emplace_back();
      one.plan_case = {invented_shape(i), false, 500};
      one.seed = 1;
      one.spacing = 1;
    }
  }

  template <typename Error>
  InventedTuning& with(Error error_of) {
    tune::MethodTuning& method = tuning.methods.front();
    method.cases.assign(tuning.cases.size(), {});
    method.rounds.clear();
    evaluations = 0;
    const auto add = [&](std::size_t i, double position, bool on_grid) {
      const tune::TuningCase& one = tuning.cases[i];
      const double error = error_of(one, position);
      method.cases[i].sweep.push_back({position, on_grid, true, evaluation(one, position, error)});
      ++evaluations;
      return tune::Trial{error, false};
    };
    const auto order = tune::training_order(tuning.cases);
    for (std::size_t round = 0; round < tune::round_ends(order.size()).size(); ++round) {
      for (const tune::TrainingItem& item : tune::items_of_round(tuning, round)) {
        for (const double position : item.positions) add(item.which_case, position, true);
      }
      tune::end_round(tuning, round);
    }
    const auto tuned_value = tuned();
    for (std::size_t i = 0; i < tuning.cases.size(); ++i) {
      if (tuning.cases[i].side() != tune::Side::kTest) continue;
      const auto points =
          tune::search(*method.axis, [&](double position) { return add(i, position, false); });
      for (std::size_t k = 0; k < points.size(); ++k) method.cases[i].sweep[k].on_grid = points[k].on_grid;
      if (tuned_value) add(i, tuned_value->position, false);
    }
    return *this;
  }

  record::RunRecord evaluation(const tune::TuningCase& one, double position, double error) const {
    const tune::MethodTuning& method = tuning.methods.front();
    record::RunRecord result;
    result.parameters = tune::fixed_parameters(*method.info);
    result.parameters[method.axis->parameter] = tune::value_at(*method.axis, position, one.spacing);
    if (tune::is_infinitely_bad(error)) {
      result.status = record::Status::kCrash;
    } else {
      result.metrics["l2"] = error;
    }
    return result;
  }

  const tune::MethodTuning& method() const { return tuning.methods.front(); }
  std::optional<tune::TunedValue> tuned() const { return tune::choose_tuned(method()); }

  tune::Tuning tuning;
  std::size_t evaluations = 0;  ///< of the last search
};

MethodInfo usual_method() {
  return method_with({parameter("reach", "length", 0, kInfinity, kInfinity)});
}

/// 0.1 at `best`, and more away from it.
double valley(double position, double best) {
  return 0.1 + std::abs(std::log2(position / best));
}

const tune::ProtocolScore* score_of(const std::vector<tune::ProtocolScore>& scores,
                                    const std::string& protocol) {
  for (const tune::ProtocolScore& score : scores) {
    if (score.protocol == protocol) return &score;
  }
  return nullptr;
}

TEST(TunedTest, IsTheTrainingShapesBestAndNeverSeesATestShape) {
  // Three training shapes among many test shapes, which would have the say if they were heard.
  InventedTuning invented(usual_method());
  int training = 0;
  std::erase_if(invented.tuning.cases, [&](const tune::TuningCase& one) {
    return one.side() == tune::Side::kTraining && ++training > 3;
  });
  const auto tuned_with = [&](double best_of_tests) {
    return *invented
                .with([&](const tune::TuningCase& one, double position) {
                  return valley(position, one.side() == tune::Side::kTraining ? 2 : best_of_tests);
                })
                .tuned();
  };
  const tune::TunedValue here = tuned_with(2);
  EXPECT_NEAR(std::log2(here.position / 2), 0, 1.0 / 6) << "the grid's next position";
  EXPECT_EQ(here.training_cases, 3U);
  for (const double elsewhere : {0.3, 16.0}) {
    const tune::TunedValue there = tuned_with(elsewhere);
    EXPECT_EQ(there.position, here.position);
    EXPECT_EQ(there.training_median, here.training_median);
    EXPECT_EQ(there.training_cases, here.training_cases);
  }
  EXPECT_FALSE(here.at_end);
  EXPECT_TRUE(InventedTuning(usual_method())
                  .with([](const tune::TuningCase&, double position) { return valley(position, 1000); })
                  .tuned()
                  ->at_end);
}

TEST(TunedTest, FailuresAreInfinitelyBadButAFewDoNotRuleAValueOut) {
  int count = 0;
  InventedTuning invented(usual_method());
  for (const tune::TuningCase& one : invented.tuning.cases)
    count += one.side() == tune::Side::kTraining ? 1 : 0;
  ASSERT_GE(count, 8);
  int seen = 0;
  std::map<std::string, bool> failing;
  for (const tune::TuningCase& one : invented.tuning.cases)
    failing[one.shape()] = one.side() == tune::Side::kTraining && seen++ % 4 == 0;
  invented.with([&](const tune::TuningCase& one, double position) {
    return failing[one.shape()] ? tune::kInfinitelyBad : valley(position, 2);
  });
  EXPECT_NEAR(std::log2(invented.tuned()->position / 2), 0, 1.0 / 6);
  invented.with([](const tune::TuningCase&, double) { return tune::kInfinitelyBad; });
  EXPECT_FALSE(invented.tuned());
  InventedTuning nothing(usual_method(), 0);
  EXPECT_FALSE(nothing.tuned()) << "no training shape";
}

TEST(HalvingTest, RoundsAreAQuarterAHalfAndAll) {
  EXPECT_EQ(tune::round_ends(0), std::vector<std::size_t>());
  EXPECT_EQ(tune::round_ends(1), (std::vector<std::size_t>{1, 1, 1}));
  EXPECT_EQ(tune::round_ends(172), (std::vector<std::size_t>{43, 86, 172}));
  EXPECT_EQ(tune::better_half({1, 2, 3, 4, 5}, {0.5, 0.1, 0.3, 0.1, 0.4}), (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(tune::better_half({1, 2, 3, 4}, {0.1, 0.1, 0.1, 0.1}), (std::vector<double>{1, 2}));
}

TEST(HalvingTest, EveryRoundHasEverySourceAndSampler) {
  std::vector<tune::TuningCase> cases;
  for (const char* name : {"star-1", "star-2", "star-3", "star-4", "star-1~noise:1", "star-2~noise:1", "ca",
                           "han-1", "han-2", "star-3~gradient:4~noise:1"}) {
    tune::TuningCase& one = cases.emplace_back();
    one.plan_case.dataset = name;
  }
  std::vector<std::string> names;
  for (const std::size_t place : tune::training_order(cases)) names.push_back(cases[place].plan_case.dataset);
  EXPECT_EQ(names, (std::vector<std::string>{"han-1", "star-1~noise:1", "star-3~gradient:4~noise:1", "star-1",
                                             "han-2", "star-2~noise:1", "star-2", "star-3", "star-4"}));
}

TEST(HalvingTest, FindsTheWinnerOfTheWholeSearchForHalfOfItsCost) {
  // Every shape's best is elsewhere, about 1.7; of their medians the whole grid has a known best.
  InventedTuning invented(usual_method(), 160);
  const auto error_of = [](const tune::TuningCase& one, double position) {
    const double turns = 0.618 * std::stod(one.shape().substr(one.shape().find('-') + 1));
    return valley(position, 1.7 * std::exp2(turns - std::floor(turns) - 0.5)) *
           (one.shape().back() == '1' ? 3 : 1);
  };
  invented.with(error_of);
  double best_score = tune::kInfinitelyBad;
  double best = 0;
  std::size_t training = 0;
  for (const double position : tune::grid(length_axis(), tune::kGridPoints)) {
    std::vector<double> errors;
    for (const tune::TuningCase& one : invented.tuning.cases) {
      if (one.side() == tune::Side::kTraining) errors.push_back(error_of(one, position));
    }
    training = errors.size();
    std::ranges::sort(errors);
    if (errors[39] + errors[40] >= best_score) continue;
    best_score = errors[39] + errors[40];
    best = position;
  }
  ASSERT_EQ(training, 80U);
  EXPECT_EQ(invented.tuned()->position, best);
  const auto& rounds = invented.method().rounds;
  ASSERT_EQ(rounds.size(), 3U);
  EXPECT_EQ(rounds[0].positions.size(), 25U);
  EXPECT_EQ(rounds[1].positions.size(), 13U);
  EXPECT_EQ(rounds[2].positions.size(), 7U);
  const std::size_t of_tests = std::size_t{80} * (tune::kSweepPoints + tune::kRefinements + 1);
  EXPECT_EQ(invented.evaluations - of_tests, 20U * 25 + 20 * 13 + 40 * 7);
  EXPECT_LE(invented.evaluations - of_tests, training * 25 * 55 / 100);
}

TEST(StrataTest, EveryStratumCountsTheSameAndInItEveryShape) {
  EXPECT_EQ(tune::kind_of_shape(1, 0), "simple");
  EXPECT_EQ(tune::kind_of_shape(1, 3), "holes");
  EXPECT_EQ(tune::kind_of_shape(2, 3), "several parts");
  EXPECT_EQ(tune::kind_of_shape(2, 0), "several parts");
  EXPECT_EQ(tune::sampler_of("ca"), "uniform");
  EXPECT_EQ(tune::sampler_of("ca~noise:1"), "noise");
  EXPECT_EQ(tune::sampler_of("ca~gradient:4~noise:1"), "several");
  const auto weights = tune::case_weights({{"a", "x"}, {"a", "x"}, {"a", "y"}, {"b", "x"}});
  EXPECT_EQ(weights, (std::vector<double>{0.125, 0.125, 0.25, 0.5}));
}

TEST(StrataTest, AShapeWithManyCasesDoesNotHaveTheSay) {
  // One training shape of many cases is best at 8, three others at 2.
  InventedTuning invented(usual_method(), 0);
  for (int i = 0; i < 12; ++i) {
    tune::TuningCase& one = invented.tuning.cases.emplace_back();
    one.plan_case = {"star-" + std::to_string(std::min(i + 1, 4)), false, 500 + i};
    one.spacing = 1;
  }
  invented.with([](const tune::TuningCase& one, double position) {
    return valley(position, one.shape() == "star-4" ? 8 : 2);
  });
  EXPECT_EQ(invented.tuned()->position, 2);
}

TEST(ProtocolTest, TheOracleIsTheBestAndRegretIsWhatTheOthersAddToIt) {
  InventedTuning invented(usual_method());
  invented.with([](const tune::TuningCase&, double position) { return valley(position, 2); });
  for (std::size_t i = 0; i < invented.tuning.cases.size(); ++i) {
    tune::MethodOnCase& found = invented.tuning.methods[0].cases[i];
    found.protocols.emplace("default", invented.evaluation(invented.tuning.cases[i], 32, 0.75));
    for (const tune::SweepEvaluation& one : found.sweep)
      EXPECT_LE(tune::error_of(*tune::best_evaluation(found)), tune::error_of(one.evaluation));
  }
  const auto scores = tune::protocol_scores(invented.tuning, invented.method(), invented.tuned());
  const tune::ProtocolScore* oracle = score_of(scores, "oracle");
  ASSERT_NE(oracle, nullptr);
  EXPECT_EQ(oracle->regret_median, 0);
  EXPECT_NEAR(oracle->l2_median, 0.1, 0.03);
  const tune::ProtocolScore* left_alone = score_of(scores, "default");
  ASSERT_NE(left_alone, nullptr);
  EXPECT_DOUBLE_EQ(left_alone->l2_median, 0.75);
  EXPECT_DOUBLE_EQ(*left_alone->regret_median, 0.75 - oracle->l2_median);
  EXPECT_EQ(left_alone->cases, invented.tuning.cases.size() / 2) << "test cases only";
  const tune::ProtocolScore* tuned = score_of(scores, "tuned");
  ASSERT_NE(tuned, nullptr);
  const auto tests = std::ranges::count_if(
      invented.tuning.cases, [](const tune::TuningCase& one) { return one.side() == tune::Side::kTest; });
  EXPECT_EQ(tuned->cases, static_cast<std::size_t>(tests));
  EXPECT_EQ(score_of(scores, "paper"), nullptr);
}

TEST(ProtocolTest, ABetterDefaultIsTheOracle) {
  InventedTuning invented(usual_method(), 1);
  invented.with([](const tune::TuningCase&, double position) { return valley(position, 2); });
  tune::MethodOnCase& found = invented.tuning.methods[0].cases[0];
  found.protocols.emplace("default", invented.evaluation(invented.tuning.cases[0], 50, 0.01));
  EXPECT_EQ(tune::best_evaluation(found), &found.protocols.at("default"));
}

TEST(ProtocolTest, FailedCasesCountAsInfinitelyBad) {
  InventedTuning invented(usual_method());
  invented.with([](const tune::TuningCase&, double position) { return valley(position, 2); });
  for (std::size_t i = 0; i < invented.tuning.cases.size(); ++i) {
    invented.tuning.methods[0].cases[i].protocols.emplace(
        "default", invented.evaluation(invented.tuning.cases[i], 32, tune::kInfinitelyBad));
  }
  const auto scores = tune::protocol_scores(invented.tuning, invented.method(), invented.tuned());
  const tune::ProtocolScore* failing = score_of(scores, "default");
  EXPECT_EQ(failing->failed, failing->cases);
  EXPECT_TRUE(tune::is_infinitely_bad(failing->l2_median));
  EXPECT_TRUE(tune::is_infinitely_bad(*failing->regret_median));
}

TEST(SearchCostTest, IsWhatTheSearchHasFoundByThen) {
  InventedTuning invented(usual_method(), 1);
  invented.with([](const tune::TuningCase&, double) { return 1; });
  tune::MethodTuning& method = invented.tuning.methods[0];
  for (std::size_t i = 0; i < invented.tuning.cases.size(); ++i) {
    invented.tuning.cases[i].plan_case.dataset = invented_shape(2);
    method.cases[i].sweep.clear();
    const auto add = [&](double position, double error, bool on_grid) {
      method.cases[i].sweep.push_back(
          {position, on_grid, true, invented.evaluation(invented.tuning.cases[i], position, error)});
    };
    const std::vector<double> positions = tune::grid(*method.axis, tune::kSweepPoints);
    // Four of the nine positions were given up: they are failures.
    for (int k = 0; k < 5; ++k) add(positions.at(static_cast<std::size_t>(k)), 0.1 * (k + 1), true);
    add(1.01, 0.3, false);
    add(1.02, 0.05, false);
  }
  const auto costs = tune::search_costs(invented.tuning, method);
  ASSERT_EQ(costs.size(), static_cast<std::size_t>(tune::kSweepPoints + tune::kRefinements));
  const auto reached = [&](std::size_t evaluations) { return costs.at(evaluations - 1).l2_median; };
  EXPECT_DOUBLE_EQ(reached(1), 0.5) << "the fifth of nine";
  EXPECT_DOUBLE_EQ(reached(2), 0.3) << "of 36 pairs 21 have one of the first three, 15 one of the first two";
  EXPECT_DOUBLE_EQ(reached(9), 0.1);
  EXPECT_DOUBLE_EQ(reached(10), 0.1) << "a worse refinement takes nothing away";
  EXPECT_DOUBLE_EQ(reached(11), 0.05);
  EXPECT_DOUBLE_EQ(reached(15), 0.05) << "the search ended";
  EXPECT_EQ(costs.front().cases, invented.tuning.cases.size());
}

TEST(CurveTest, IsRelativeToEachCasesOwnBest) {
  InventedTuning invented(usual_method());
  // Twice as hard on every second shape, which must not show in the relative curve.
  invented.with([](const tune::TuningCase& one, double position) {
    const double hardness = one.shape().back() % 4 == 1 ? 2 : 1;
    return position > 20 ? tune::kInfinitelyBad : hardness * valley(position, 2);
  });
  const auto curve = tune::sensitivity_curve(invented.tuning, invented.method());
  ASSERT_EQ(curve.size(), static_cast<std::size_t>(tune::kGridPoints));
  for (const tune::CurvePoint& point : curve) {
    if (point.position > 20) {
      EXPECT_EQ(point.failed, point.cases);
      EXPECT_TRUE(tune::is_infinitely_bad(point.relative.median));
      continue;
    }
    EXPECT_EQ(point.failed, 0U);
    EXPECT_GE(point.relative.q1, 1);
    EXPECT_NEAR(point.relative.q1, point.relative.q3, 1e-9);
    EXPECT_GT(point.l2.q3, point.l2.q1);
  }
}

/// The plan whose cases the invented search has.
plan::Plan star_plan(const std::string& methods) {
  std::string names;
  for (int i = 1; i <= 40; ++i) names += (i == 1 ? "\"" : ", \"") + invented_shape(i) + "\"";
  return plan::parse_plan(R"({"name": "stars", "cases": [{"dataset": [)" + names +
                              R"(], "n": [500]}], "methods": )" + methods + "}",
                          "test");
}

TEST(TunedPlanTest, HasTheChosenParametersOnTheRightCases) {
  MethodInfo info = method_with(
      {parameter("alpha", "length^2", 0, kInfinity), parameter("allow_holes", "switch", 0, 1, 0)});
  InventedTuning invented(info);
  invented.with([](const tune::TuningCase& one, double position) {
    return valley(position, one.shape() == "star-7" ? 5 : 2);
  });
  const plan::Plan plan =
      star_plan(R"([{"method": "made_up", "protocol": "paper", "parameters": {"alpha": 3}},
                                  {"method": "polylidar", "protocol": "default"}])");
  const plan::Plan chosen = tune::tuned_plan(plan, invented.tuning);
  plan::Plan accepting = plan;
  accepting.accepted = {"error"};
  EXPECT_EQ(chosen.name, "stars-tuned");
  std::map<std::string, const plan::PlanMethod*> entries;
  for (const plan::PlanMethod& entry : chosen.methods) {
    EXPECT_EQ(entry.method, "made_up");
    entries[entry.protocol] = &entry;
  }
  EXPECT_EQ(chosen.methods.size(), 3U) << "paper, tuned and oracle; alpha is required, so no default";
  EXPECT_EQ(chosen.expanded_cases.size(), 20U);
  for (const plan::PlanCase& one : chosen.expanded_cases)
    EXPECT_EQ(tune::side_of(one.dataset), tune::Side::kTest) << one.dataset;
  EXPECT_EQ(tune::tuned_plan(accepting, invented.tuning).expanded_cases.size(), 40U);
  const tune::TunedValue tuned = *invented.tuned();
  std::vector<Point> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};  // 4 points, spacing 1
  const plan::RuleInput input = {square, 1, false, {}};
  for (std::size_t i = 0; i < invented.tuning.cases.size(); ++i) {
    const tune::TuningCase& one = invented.tuning.cases[i];
    if (one.side() != tune::Side::kTest) continue;
    ASSERT_TRUE(plan::applies(*entries.at("oracle"), one.plan_case)) << one.plan_case.name();
    EXPECT_EQ(plan::choose_parameters(*entries.at("oracle"), one.plan_case, input),
              tune::best_evaluation(invented.method().cases[i])->parameters);
    EXPECT_EQ(plan::choose_parameters(*entries.at("tuned"), one.plan_case, input),
              (Parameters{{"alpha", tuned.position * tuned.position}, {"allow_holes", 1}}));
  }
  const std::string text = plan::plan_to_json(chosen).dump();
  EXPECT_EQ(plan::plan_to_json(plan::parse_plan(text, "written")), plan::plan_to_json(chosen));
}

TEST(TunedPlanTest, AnOracleWithoutALimitStaysWithoutOne) {
  InventedTuning invented(usual_method());
  invented.with([](const tune::TuningCase&, double position) { return valley(position, 2); });
  record::RunRecord unlimited = invented.evaluation(invented.tuning.cases[1], 2, 0.001);
  unlimited.parameters["reach"] = kInfinity;
  invented.tuning.methods[0].cases[1].protocols.emplace("default", unlimited);
  const plan::Plan chosen =
      tune::tuned_plan(star_plan(R"([{"method": "made_up", "protocol": "default"}])"), invented.tuning);
  const plan::Plan read = plan::parse_plan(plan::plan_to_json(chosen).dump(), "written");
  EXPECT_EQ(plan::choose_parameters(read.methods.back(), invented.tuning.cases[1].plan_case, {}).at("reach"),
            kInfinity);
}

TEST(TuningCasesTest, VariantsOfAShapeAreOnOneSideAndACaseOfTwoPlansIsThereOnce) {
  const auto plan_of = [](const std::string& name, const std::string& cases) {
    return plan::parse_plan(
        R"({"name": ")" + name + R"(", "cases": )" + cases +
            R"(, "methods": [{"method": "polylidar", "protocol": "paper", "parameters": {"alpha": 3}},
                                           {"method": "polylidar", "protocol": "oracle", "parameters": {"alpha": 2}}]})",
        "test");
  };
  const auto cases = tune::tuning_cases(
      {plan_of("a", R"([{"dataset": ["ca", "hi"], "holes": [false, true], "n": [500, 2000]}])"),
       plan_of("b", R"([{"dataset": ["ca", "star-1~lattice:0"], "n": [2000, 4000]}])")});
  EXPECT_EQ(cases.size(), 9U);
  std::map<std::string, std::set<tune::Side>> sides;
  for (const tune::TuningCase& one : cases) {
    sides[one.plan_case.dataset].insert(one.side());
    ASSERT_EQ(one.entries.size(), 1U) << "the oracle is chosen here, and the other is there once";
    EXPECT_EQ(one.entries[0].protocol, "paper");
  }
  EXPECT_EQ(sides.at("ca").size(), 1U);
  EXPECT_EQ(sides.at("hi").size(), 1U);
}

}  // namespace
}  // namespace hullbench::testing
