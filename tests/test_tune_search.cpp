// The search and what is made of it, on invented errors: axes, the search itself, the split, tuned values,
// tolerance, regret, curves and the plan with the chosen parameters.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/tune/analysis.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/tune/search_axis.hpp"
#include "benchmarks/tune/split.hpp"
#include "benchmarks/tune/tuned_plan.hpp"
#include "benchmarks/tune/tuner.hpp"
#include "benchmarks/tune/tuning_report.hpp"
#include "datasets/datasets.hpp"

namespace hullbench {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

SearchAxis length_axis() {
  return *search_axis(method_with({parameter("reach", "length", 0, kInfinity)}));
}

TEST(SearchAxisTest, LengthsShareOneAxisWhateverTheirPower) {
  const SearchAxis length = length_axis();
  EXPECT_EQ(length.parameter, "reach");
  EXPECT_TRUE(length.spacings);
  EXPECT_EQ(length.low, 0.125);
  EXPECT_EQ(length.high, 32);
  const SearchAxis area = *search_axis(method_with({parameter("alpha", "length^2", 0, kInfinity)}));
  EXPECT_EQ(grid(area, kGridPoints), grid(length, kGridPoints));
  EXPECT_DOUBLE_EQ(value_at(length, 1.5, 10), 15);
  EXPECT_DOUBLE_EQ(value_at(area, 1.5, 10), 225);
}

TEST(SearchAxisTest, OtherParametersHaveTheirOwnRange) {
  const SearchAxis ratio = *search_axis(method_with({parameter("ratio", "ratio", 0, 1)}));
  EXPECT_FALSE(ratio.spacings);
  EXPECT_EQ(ratio.high, 1);
  EXPECT_EQ(ratio.low, 1.0 / 256);
  EXPECT_EQ(value_at(ratio, 0.5, 1000), 0.5);
  const SearchAxis number = *search_axis(method_with({parameter("c", "1", 0, kInfinity)}));
  EXPECT_EQ(number.low, 0.125);
  EXPECT_EQ(number.high, 32);
  const SearchAxis narrow = *search_axis(method_with({parameter("c", "1", 2, 5)}));
  EXPECT_EQ(narrow.low, 2);
  EXPECT_EQ(narrow.high, 5);
  const SearchAxis above = *search_axis(method_with({parameter("c", "1", 1, kInfinity)}));
  EXPECT_EQ(above.low, 1);
  EXPECT_EQ(above.high, 256);
}

TEST(SearchAxisTest, CountsAreWholeAndEachIsThereOnce) {
  const SearchAxis axis = *search_axis(method_with({parameter("k", "count", 3, kInfinity)}));
  const std::vector<double> positions = grid(axis, kGridPoints);
  EXPECT_EQ(positions.front(), 3);
  EXPECT_EQ(positions.back(), 768);
  for (const double position : positions) EXPECT_EQ(position, std::round(position));
  EXPECT_TRUE(std::adjacent_find(positions.begin(), positions.end(), std::greater_equal<>()) ==
              positions.end());
}

TEST(SearchAxisTest, TakesTheFirstNumberAndALengthBeforeARatio) {
  EXPECT_EQ(
      search_axis(method_with({parameter("holes", "switch", 0, 1, 0), parameter("c", "1", 0, kInfinity, 2),
                               parameter("reach", "length", 0, kInfinity, 0)}))
          ->parameter,
      "c");
  EXPECT_EQ(
      search_axis(method_with({parameter("ratio", "ratio", 0, 1, 1), parameter("holes", "switch", 0, 1, 0),
                               parameter("reach", "length", 0, kInfinity, kInfinity)}))
          ->parameter,
      "reach");
  EXPECT_FALSE(search_axis(method_with({})));
  EXPECT_FALSE(search_axis(method_with({parameter("holes", "switch", 0, 1, 0)})));
  EXPECT_FALSE(search_axis(method_with({parameter("c", "1", -1, 1)}))) << "there is no logarithm";
  EXPECT_FALSE(search_axis(method_with({parameter("a", "length", 0, 1), parameter("b", "length", 0, 1)})))
      << "the other one is required";
}

TEST(SearchAxisTest, SwitchesForHolesAreSetWhereTheMethodHasHoles) {
  const std::vector<ParameterInfo> parameters = {parameter("allow_holes", "switch", 0, 1, 0),
                                                 parameter("fast", "switch", 0, 1, 0)};
  EXPECT_EQ(fixed_parameters(method_with(parameters)), (Parameters{{"allow_holes", 1}}));
  EXPECT_EQ(fixed_parameters(method_with(parameters, false)), Parameters());
}

TEST(SearchTest, FindsTheBestOfAUnimodalError) {
  for (const double best : {0.15, 0.9, 1.37, 7.7, 29.0}) {
    const auto points = search(length_axis(), [&](double position) {
      return Trial{0.1 + std::pow(std::log2(position / best), 2), false};
    });
    ASSERT_EQ(points.size(), static_cast<std::size_t>(kGridPoints + kRefinements));
    const auto found = std::min_element(points.begin(), points.end(),
                                        [](const auto& a, const auto& b) { return a.error < b.error; });
    // Two thirds of an octave, shortened 7 times by the golden ratio.
    EXPECT_NEAR(std::log2(found->position / best), 0, 2.0 / 3 * std::pow(0.6181, 7)) << best;
    EXPECT_FALSE(found->on_grid);
  }
}

TEST(SearchTest, AsksForNoPositionTwice) {
  const SearchAxis counts = *search_axis(method_with({parameter("k", "count", 3, kInfinity)}));
  std::set<double> asked;
  search(counts, [&](double position) {
    EXPECT_TRUE(asked.insert(position).second) << position;
    EXPECT_EQ(position, std::round(position));
    return Trial{std::abs(position - 11), false};
  });
  EXPECT_TRUE(asked.contains(11));
}

TEST(SearchTest, FailuresAreInfinitelyBadAndTimeoutsEndTheSweep) {
  const auto all_fail = search(length_axis(), [](double) { return Trial{}; });
  EXPECT_EQ(all_fail.size(), static_cast<std::size_t>(kGridPoints)) << "nothing to refine";
  // Good only where nobody would look after failures.
  const auto one = search(length_axis(), [](double position) {
    return position > 20 ? Trial{0.5, false} : Trial{};
  });
  EXPECT_TRUE(std::any_of(one.begin(), one.end(), [](const auto& point) { return point.error == 0.5; }));
  const auto slow = search(length_axis(), [](double position) {
    return position < 1 ? Trial{0.5, false} : Trial{kInfinitelyBad, true};
  });
  const auto tried = std::count_if(slow.begin(), slow.end(), [](const auto& point) {
    return point.on_grid && point.error == kInfinitelyBad;
  });
  EXPECT_EQ(tried, kMostTimeouts);
}

std::vector<SearchPoint> curve(const std::vector<std::pair<double, double>>& values) {
  std::vector<SearchPoint> points;
  for (const auto& [position, error] : values) points.push_back({position, error, true});
  return points;
}

TEST(ToleranceTest, IsTheWidthOfTheRangeWithinTenPercent) {
  // Flat from 1 to 4: two octaves, and nothing outside, where it jumps at once.
  EXPECT_NEAR(*tolerance_octaves(curve({{0.999999, 9}, {1, 1}, {2, 1}, {4, 1}, {4.000001, 9}})), 2, 1e-5);
  // A tent in the logarithm, from 1 at 2 to 2 an octave away on both sides: a tenth of an octave each way.
  EXPECT_NEAR(*tolerance_octaves(curve({{4, 2}, {1, 2}, {2, 1}})), 0.2, 1e-12);
  // It ends where the error leaves the range for the first time.
  EXPECT_NEAR(*tolerance_octaves(curve({{1, 1}, {2, 2}, {4, 1}, {8, 1}})), 0.1, 1e-12);
  // At the axis' ends it is cut, and beside a failure it ends at the last good evaluation.
  EXPECT_NEAR(*tolerance_octaves(curve({{1, 1}, {2, 1.05}})), 1, 1e-12);
  EXPECT_NEAR(*tolerance_octaves(curve({{0.5, kInfinitelyBad}, {1, 1}, {2, 1.05}, {4, kInfinitelyBad}})), 1,
              1e-12);
  EXPECT_EQ(*tolerance_octaves(curve({{1, kInfinitelyBad}, {2, 0}, {4, kInfinitelyBad}})), 0);
  EXPECT_FALSE(tolerance_octaves(curve({{1, kInfinitelyBad}})));
  EXPECT_FALSE(tolerance_octaves(std::vector<SearchPoint>()));
}

TEST(SplitTest, IsFixedBySeedAndName) {
  // These must not change: recorded results are of these sides.
  std::string sides;
  for (const char* shape : {"ca", "hi", "letter_a", "letter_b", "letter_c", "star-1", "star-2", "comb-1"})
    sides += side_of(shape, 1) == Side::kTest ? 'e' : 'r';
  EXPECT_EQ(sides, "eeeerrre");
  int tests = 0;
  int moved = 0;
  for (int i = 1; i <= 1000; ++i) {
    const std::string shape = "star-" + std::to_string(i);
    if (side_of(shape, 1) == Side::kTest) ++tests;
    if (side_of(shape, 1) != side_of(shape, 2)) ++moved;
  }
  // Within five standard deviations of a fair coin's 500.
  EXPECT_NEAR(tests, 500, 80);
  EXPECT_NEAR(moved, 500, 80);
}

/// A search over `count` shapes with an error that `error_of(shape, position)` invents.
class InventedTuning {
 public:
  explicit InventedTuning(const MethodInfo& info, int count = 40) {
    tuning.split_seed = 1;
    MethodTuning& method = tuning.methods.emplace_back();
    method.name = method.title = info.name;
    method.info = info;
    method.axis = search_axis(info);
    for (int i = 1; i <= count; ++i) {
      TuningCase& one = tuning.cases.emplace_back();
      one.plan_case = {"star-" + std::to_string(i), false, 500};
      one.seed = 1;
      one.name = one.plan_case.dataset + "/n:500/holes:0";
      one.shape = base_shape(one.plan_case.dataset);
      one.side = side_of(one.shape, 1);
      one.n = 500;
      one.spacing = 1;
      one.dataset_sha256 = std::string(64, '0');
    }
  }

  template <typename Error>
  InventedTuning& with(Error error_of) {
    MethodTuning& method = tuning.methods.front();
    method.cases.clear();
    for (const TuningCase& one : tuning.cases) {
      MethodOnCase& found = method.cases.emplace_back();
      for (const SearchPoint& point : search(*method.axis, [&](double position) {
             return Trial{error_of(one, position), false};
           })) {
        found.sweep.push_back({point.position, point.on_grid, evaluation(one, point.position, point.error)});
      }
    }
    return *this;
  }

  Evaluation evaluation(const TuningCase& one, double position, double error) const {
    const MethodTuning& method = tuning.methods.front();
    Evaluation result;
    result.case_name = one.name;
    result.method = method.name;
    result.method_version = "1";
    result.program = std::string(64, '1');
    result.dataset = one.plan_case.dataset;
    result.dataset_sha256 = one.dataset_sha256;
    result.n = one.n;
    result.seed = one.seed;
    result.parameters = fixed_parameters(*method.info);
    result.parameters[method.axis->parameter] = value_at(*method.axis, position, one.spacing);
    if (is_infinitely_bad(error)) {
      result.status = Status::kCrash;
      result.detail = "SIGSEGV";
    } else {
      result.l2 = error;
    }
    result.id = evaluation_identity(result);
    return result;
  }

  const MethodTuning& method() const { return tuning.methods.front(); }
  std::optional<TunedValue> tuned() const { return choose_tuned(tuning, method()); }

  Tuning tuning;
};

MethodInfo usual_method() {
  return method_with({parameter("reach", "length", 0, kInfinity, kInfinity)});
}

/// 0.1 at `best`, and more away from it.
double valley(double position, double best) {
  return 0.1 + std::abs(std::log2(position / best));
}

const ProtocolScore* score_of(const std::vector<ProtocolScore>& scores, const std::string& protocol,
                              bool test_only) {
  for (const ProtocolScore& score : scores) {
    if (score.protocol == protocol && score.test_only == test_only) return &score;
  }
  return nullptr;
}

TEST(TunedTest, IsTheTrainingShapesBestAndNeverSeesATestShape) {
  // Three training shapes among many test shapes, which would have the say if they were heard.
  InventedTuning invented(usual_method());
  int training = 0;
  std::erase_if(invented.tuning.cases,
                [&](const TuningCase& one) { return one.side == Side::kTraining && ++training > 3; });
  const auto tuned_with = [&](double best_of_tests) {
    return *invented
                .with([&](const TuningCase& one, double position) {
                  return valley(position, one.side == Side::kTraining ? 2 : best_of_tests);
                })
                .tuned();
  };
  const TunedValue here = tuned_with(2);
  EXPECT_NEAR(std::log2(here.position / 2), 0, 1.0 / 6) << "the grid's next position";
  EXPECT_EQ(here.training_cases, 3U);
  for (const double elsewhere : {0.3, 16.0}) {
    const TunedValue there = tuned_with(elsewhere);
    EXPECT_EQ(there.position, here.position);
    EXPECT_EQ(there.training_median, here.training_median);
    EXPECT_EQ(there.training_cases, here.training_cases);
  }
  EXPECT_FALSE(here.at_end);
  EXPECT_TRUE(InventedTuning(usual_method())
                  .with([](const TuningCase&, double position) { return valley(position, 1000); })
                  .tuned()
                  ->at_end);
}

TEST(TunedTest, FailuresAreInfinitelyBadButAFewDoNotRuleAValueOut) {
  int count = 0;
  InventedTuning invented(usual_method());
  for (const TuningCase& one : invented.tuning.cases) count += one.side == Side::kTraining ? 1 : 0;
  ASSERT_GE(count, 8);
  int fails = 0;
  std::map<std::string, bool> failing;
  for (const TuningCase& one : invented.tuning.cases)
    failing[one.shape] = one.side == Side::kTraining && fails++ < count / 4;
  invented.with([&](const TuningCase& one, double position) {
    return failing[one.shape] ? kInfinitelyBad : valley(position, 2);
  });
  EXPECT_NEAR(std::log2(invented.tuned()->position / 2), 0, 1.0 / 6);
  invented.with([](const TuningCase&, double) { return kInfinitelyBad; });
  EXPECT_FALSE(invented.tuned());
  InventedTuning nothing(usual_method(), 0);
  EXPECT_FALSE(nothing.tuned()) << "no training shape";
}

TEST(ProtocolTest, TheOracleIsTheBestAndRegretIsWhatTheOthersAddToIt) {
  InventedTuning invented(usual_method());
  invented.with([](const TuningCase&, double position) { return valley(position, 2); });
  for (std::size_t i = 0; i < invented.tuning.cases.size(); ++i) {
    MethodOnCase& found = invented.tuning.methods[0].cases[i];
    found.protocols.emplace("default", invented.evaluation(invented.tuning.cases[i], 32, 0.75));
    for (const SweepEvaluation& one : found.sweep)
      EXPECT_LE(best_evaluation(found)->error(), one.evaluation.error());
  }
  const auto scores = protocol_scores(invented.tuning, invented.method(), invented.tuned());
  const ProtocolScore* oracle = score_of(scores, "oracle", false);
  ASSERT_NE(oracle, nullptr);
  EXPECT_EQ(oracle->regret_median, 0);
  EXPECT_NEAR(oracle->l2_median, 0.1, 0.03);
  const ProtocolScore* left_alone = score_of(scores, "default", false);
  ASSERT_NE(left_alone, nullptr);
  EXPECT_DOUBLE_EQ(left_alone->l2_median, 0.75);
  EXPECT_DOUBLE_EQ(*left_alone->regret_median, 0.75 - oracle->l2_median);
  EXPECT_EQ(left_alone->cases, invented.tuning.cases.size());
  EXPECT_EQ(score_of(scores, "tuned", false), nullptr) << "on test shapes only";
  const ProtocolScore* tuned = score_of(scores, "tuned", true);
  ASSERT_NE(tuned, nullptr);
  const auto tests = std::count_if(invented.tuning.cases.begin(), invented.tuning.cases.end(),
                                   [](const TuningCase& one) { return one.side == Side::kTest; });
  EXPECT_EQ(tuned->cases, static_cast<std::size_t>(tests));
  EXPECT_EQ(score_of(scores, "paper", true), nullptr);
}

TEST(ProtocolTest, ABetterDefaultIsTheOracle) {
  InventedTuning invented(usual_method(), 1);
  invented.with([](const TuningCase&, double position) { return valley(position, 2); });
  MethodOnCase& found = invented.tuning.methods[0].cases[0];
  found.protocols.emplace("default", invented.evaluation(invented.tuning.cases[0], 50, 0.01));
  EXPECT_EQ(best_evaluation(found), &found.protocols.at("default"));
}

TEST(ProtocolTest, FailedCasesCountAsInfinitelyBad) {
  InventedTuning invented(usual_method());
  invented.with([](const TuningCase&, double position) { return valley(position, 2); });
  for (std::size_t i = 0; i < invented.tuning.cases.size(); ++i) {
    invented.tuning.methods[0].cases[i].protocols.emplace(
        "default", invented.evaluation(invented.tuning.cases[i], 32, kInfinitelyBad));
  }
  const auto scores = protocol_scores(invented.tuning, invented.method(), invented.tuned());
  const ProtocolScore* failing = score_of(scores, "default", false);
  EXPECT_EQ(failing->failed, invented.tuning.cases.size());
  EXPECT_TRUE(is_infinitely_bad(failing->l2_median));
  EXPECT_TRUE(is_infinitely_bad(*failing->regret_median));
}

TEST(CurveTest, IsRelativeToEachCasesOwnBest) {
  InventedTuning invented(usual_method());
  // Twice as hard on every second shape, which must not show in the relative curve.
  invented.with([](const TuningCase& one, double position) {
    const double hardness = one.shape.back() % 2 == 0 ? 2 : 1;
    return position > 20 ? kInfinitelyBad : hardness * valley(position, 2);
  });
  const auto curve = sensitivity_curve(invented.tuning, invented.method());
  ASSERT_EQ(curve.size(), static_cast<std::size_t>(kGridPoints));
  for (const CurvePoint& point : curve) {
    if (point.position > 20) {
      EXPECT_EQ(point.failed, point.cases);
      EXPECT_TRUE(is_infinitely_bad(point.relative.median));
      continue;
    }
    EXPECT_EQ(point.failed, 0U);
    EXPECT_GE(point.relative.q1, 1);
    EXPECT_NEAR(point.relative.q1, point.relative.q3, 1e-9);
    EXPECT_GT(point.l2.q3, point.l2.q1);
  }
}

/// The plan whose cases the invented search has.
Plan star_plan(const std::string& methods) {
  return parse_plan(
      R"({"name": "stars", "cases": [{"dataset": "star", "members": 40, "n": [500]}], "methods": )" +
          methods + "}",
      "test");
}

TEST(TunedPlanTest, HasTheChosenParametersOnTheRightCases) {
  MethodInfo info = method_with(
      {parameter("alpha", "length^2", 0, kInfinity), parameter("allow_holes", "switch", 0, 1, 0)});
  InventedTuning invented(info);
  invented.with(
      [](const TuningCase& one, double position) { return valley(position, one.shape == "star-7" ? 5 : 2); });
  const Plan plan = star_plan(R"([{"method": "made_up", "protocol": "paper", "parameters": {"alpha": 3}},
                                  {"method": "polylidar", "protocol": "default"}])");
  const Plan chosen = tuned_plan(plan, invented.tuning);
  EXPECT_EQ(chosen.name, "stars-tuned");
  std::map<std::string, const PlanMethod*> entries;
  for (const PlanMethod& entry : chosen.methods) {
    EXPECT_EQ(entry.method, "made_up");
    entries[entry.protocol] = &entry;
  }
  EXPECT_EQ(chosen.methods.size(), 3U) << "paper, tuned and oracle; alpha is required, so no default";
  const TunedValue tuned = *invented.tuned();
  std::vector<polylidar::Point> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};  // 4 points, spacing 1
  const RuleInput input = {square, 1, false, {}};
  for (std::size_t i = 0; i < invented.tuning.cases.size(); ++i) {
    const TuningCase& one = invented.tuning.cases[i];
    EXPECT_EQ(applies(*entries.at("tuned"), one.plan_case), one.side == Side::kTest) << one.name;
    ASSERT_TRUE(applies(*entries.at("oracle"), one.plan_case)) << one.name;
    EXPECT_EQ(choose_parameters(*entries.at("oracle"), one.plan_case, input),
              best_evaluation(invented.method().cases[i])->parameters);
    EXPECT_EQ(choose_parameters(*entries.at("tuned"), one.plan_case, input),
              (Parameters{{"alpha", tuned.position * tuned.position}, {"allow_holes", 1}}));
  }
  const std::string text = plan_to_json(chosen).dump();
  EXPECT_EQ(plan_to_json(parse_plan(text, "written")), plan_to_json(chosen));
}

TEST(TunedPlanTest, AnOracleWithoutALimitStaysWithoutOne) {
  InventedTuning invented(usual_method());
  invented.with([](const TuningCase&, double position) { return valley(position, 2); });
  Evaluation unlimited = invented.evaluation(invented.tuning.cases[0], 2, 0.001);
  unlimited.parameters["reach"] = kInfinity;
  invented.tuning.methods[0].cases[0].protocols.emplace("default", unlimited);
  const Plan chosen =
      tuned_plan(star_plan(R"([{"method": "made_up", "protocol": "default"}])"), invented.tuning);
  const Plan read = parse_plan(plan_to_json(chosen).dump(), "written");
  EXPECT_EQ(choose_parameters(read.methods.back(), invented.tuning.cases[0].plan_case, {}).at("reach"),
            kInfinity);
}

TEST(TuningCasesTest, VariantsOfAShapeAreOnOneSideAndACaseOfTwoPlansIsThereOnce) {
  const auto plan_of = [](const std::string& name, const std::string& cases) {
    return parse_plan(
        R"({"name": ")" + name + R"(", "cases": )" + cases +
            R"(, "methods": [{"method": "polylidar", "protocol": "paper", "parameters": {"alpha": 3}},
                                           {"method": "polylidar", "protocol": "oracle", "parameters": {"alpha": 2}}]})",
        "test");
  };
  const auto cases =
      tuning_cases({plan_of("a", R"([{"dataset": ["ca", "hi"], "holes": [false, true], "n": [500, 2000]}])"),
                    plan_of("b", R"([{"dataset": "ca", "n": [2000, 4000]}])")},
                   1);
  EXPECT_EQ(cases.size(), 9U);
  std::map<std::string, std::set<Side>> sides;
  for (const TuningCase& one : cases) {
    sides[one.plan_case.dataset].insert(one.side);
    ASSERT_EQ(one.entries.size(), 1U) << "the oracle is chosen here, and the other is there once";
    EXPECT_EQ(one.entries[0].protocol, "paper");
  }
  EXPECT_EQ(sides.at("ca").size(), 1U);
  EXPECT_EQ(sides.at("hi").size(), 1U);
}

}  // namespace
}  // namespace hullbench
