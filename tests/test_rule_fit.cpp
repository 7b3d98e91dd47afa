// Fitting the shares of rules: the score by hand, the training cases, and a small fit beside the shares that
// stand in the code.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "adapters/adapter.hpp"
#include "benchmarks/metrics/area.hpp"
#include "benchmarks/plan/parameter_rules.hpp"
#include "benchmarks/tune/fit_score.hpp"
#include "benchmarks/tune/rule_fit.hpp"
#include "benchmarks/tune/search.hpp"
#include "benchmarks/tune/split.hpp"
#include "datasets/datasets.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/hull_input.hpp"

namespace hullbench::testing {
namespace {

plan::Plan plan_of(const std::string& cases, const std::string& more = "") {
  return plan::parse_plan(R"({"name": "small", "seed": 5, )" + more + R"("cases": )" + cases +
                              R"(, "methods": [{"method": "polylidar", "protocol": "default"}]})",
                          "here");
}

/// Some training shapes, several of each of some sources: "star-1", "county-1" ...
std::vector<std::string> training_shapes(std::size_t count) {
  std::vector<std::string> shapes;
  for (int k = 1; shapes.size() < count; ++k) {
    for (const char* source : {"star", "county", "fashion", "han"})
      shapes.push_back(std::string(source) + "-" + std::to_string(k));
  }
  shapes.resize(count);
  return shapes;
}

// The score.

TEST(FitScore, EveryShapeCountsTheSameAndErrorsCountByTheirRatio) {
  // Geometric means: 0.2 of a's two cases, 0.8 of b's one.
  EXPECT_NEAR(tune::fit_score({"a", "b", "a"}, {0.1, 0.8, 0.4}), std::sqrt(0.2 * 0.8), 1e-12);
  EXPECT_EQ(tune::fit_score({}, {}), 0);
}

TEST(FitScore, NoErrorIsBeyondItsRange) {
  EXPECT_NEAR(tune::fit_score({"a"}, {0}) / tune::kLeastError, 1, 1e-12);  // rounding only
  EXPECT_NEAR(tune::fit_score({"a"}, {tune::kInfinitelyBad}) / tune::kMostError, 1, 1e-12);
}

TEST(FitScore, TheCurveHasEveryCandidateAndTheBestIsTheFirstOfTheLeast) {
  const tune::ErrorTable table = {
      {1, 2, 3, 4},
      {"a", "a", "b"},
      {{0.4, 0.1, 0.1, 0.2}, {0.4, 0.2, 0.2, 0.1}, {0.4, 0.1, 0.1, tune::kInfinitelyBad}}};
  const auto curve = tune::score_curve(table);
  ASSERT_EQ(curve.size(), 4U);
  EXPECT_EQ(curve[0].candidate, 1);
  EXPECT_NEAR(curve[0].score, 0.4, 1e-12);
  EXPECT_EQ(curve[1].median, 0.1);
  EXPECT_EQ(curve[3].failures, 1U);
  EXPECT_EQ(tune::best_of(curve).candidate, 2);
}

TEST(FitScore, OneCandidateForSeveralUsesHasTheLeastProduct) {
  const auto curve = [](double a, double b, double c) {
    return std::vector<tune::CandidateScore>{
        {.candidate = 1, .score = a}, {.candidate = 2, .score = b}, {.candidate = 3, .score = c}};
  };
  EXPECT_EQ(tune::best_for_all({curve(0.5, 0.4, 0.3)}), 2U);
  EXPECT_EQ(tune::best_for_all({curve(0.1, 0.12, 0.3), curve(0.9, 0.6, 0.5)}), 1U);
}

// The cases.

TEST(TrainingCases, AreOfTrainingShapesOnlyAndEachIsThereOnce) {
  const auto cases = tune::training_cases({plan::load_plan("alphabet", HULLBENCH_PLAN_FOLDER),
                                           plan_of(R"([{"dataset": "star", "members": 5, "n": [2000]}])"),
                                           plan::load_plan("stress_sampling", HULLBENCH_PLAN_FOLDER),
                                           plan::load_plan("stress_noise", HULLBENCH_PLAN_FOLDER)},
                                          1, 0);
  std::set<std::string> keys;
  std::set<std::pair<std::string, std::uint64_t>> samples;
  for (const tune::FitCase& one : cases) {
    EXPECT_TRUE(samples.emplace(one.plan_case.key(), one.seed).second) << one.plan_case.key();
    keys.insert(one.plan_case.key());
    EXPECT_EQ(tune::side_of(one.plan_case.dataset), tune::Side::kTraining) << one.plan_case.dataset;
  }
  for (int k = 1; k <= 5; ++k) {
    const std::string star = "star-" + std::to_string(k);
    EXPECT_TRUE(keys.contains(star + "/n:2000"));
    EXPECT_TRUE(keys.contains(star + "~noise:0.5/n:2000")) << "which no plan has";
    EXPECT_FALSE(keys.contains(star + "~noise:0.5/n:4000"));
    EXPECT_FALSE(keys.contains(star + "~lattice:0/n:2000")) << "which training does not know";
  }
}

TEST(TrainingCases, CanHaveMoreSamplesAndOtherNumbersOfPoints) {
  const plan::Plan plan = plan_of(R"([{"dataset": "star-1", "n": [500, 600]}])");
  const auto cases = tune::training_cases({plan}, 3, 0);
  ASSERT_EQ(cases.size(), 6U);
  EXPECT_EQ(cases[0].seed, 5U);
  EXPECT_EQ(cases[2].seed, 7U);
  const auto larger = tune::training_cases({plan}, 1, 8000);
  ASSERT_EQ(larger.size(), 1U) << "the two are one now";
  EXPECT_EQ(larger[0].plan_case.n, 8000);
}

TEST(TrainingCases, LeaveOutPointsThatComeWithTheirShapeAndPlansThatAcceptFailures) {
  EXPECT_TRUE(tune::training_cases({plan_of(R"([{"dataset": "floor", "members": 11}])")}, 1, 0).empty());
  const std::string star = R"([{"dataset": "star-1", "n": [500]}])";
  EXPECT_EQ(tune::training_cases({plan_of(star)}, 1, 0).size(), 1U);
  EXPECT_TRUE(tune::training_cases({plan_of(star, R"("accepted": ["error"], )")}, 1, 0).empty());
}

// A small fit.

/// Eight training shapes, uniform, denser on one side and noisy.
std::vector<tune::FitCase> small_fit_cases() {
  std::string names;
  for (const std::string& shape : training_shapes(8)) names += (names.empty() ? "\"" : ", \"") + shape + "\"";
  return tune::training_cases({plan_of(R"([{"dataset": [)" + names + R"(], "n": [600]},
                                     {"dataset": [)" +
                                       names + R"(], "n": [600], "stress": ["gradient:4", "noise:0.5"]}])")},
                              1, 0);
}

TEST(RuleFit, TheConstantsInTheCodeAreAboutTheBestOfASmallFit) {
  const std::vector<tune::FitCase> cases = small_fit_cases();
  ASSERT_EQ(cases.size(), 24U);
  const std::vector<tune::RuleUse> uses = tune::rule_uses();
  const tune::FitTables tables =
      tune::measure_fit(cases, uses, {0.3, plan::kCircumradiusShare, 1, plan::kEdgeShare, 2, 3}, {});
  for (std::size_t u = 0; u < uses.size(); ++u) {
    SCOPED_TRACE(uses[u].rule + " of " + uses[u].method);
    const auto curve = tune::score_curve(tables.uses[u]);
    const auto in_the_code = std::ranges::find_if(curve, [&](const tune::CandidateScore& one) {
      return std::abs(one.candidate - uses[u].share) < 1e-9;
    });
    ASSERT_NE(in_the_code, curve.end()) << uses[u].share;
    // So few cases have a best share of their own; the curves are flat about it.
    EXPECT_LT(in_the_code->score, 1.15 * tune::best_of(curve).score);
    EXPECT_GT(curve.front().score, 1.15 * tune::best_of(curve).score) << "a bad one costs more";
  }
  const double core = tune::fit_score(tables.shapes, tables.core_errors);
  for (const tune::ErrorTable& table : tables.uses)
    EXPECT_LT(core, 1.15 * tune::best_of(tune::score_curve(table)).score);
}

// What the fitted rules are for.

MultiPolygon hull_of(const std::string& method, const std::vector<Point>& points,
                     const Parameters& parameters) {
  return testing::hull_of(*find_adapter(method)->make(), points, parameters);
}

TEST(RuleFit, OneCircumradiusGivesPolylidarAndCgalTheSamePolygons) {
  for (const char* name : {"ca", "letter_b~gradient:4"}) {
    const PointSet set = make_point_set(name, false, 800, 1);
    const MultiPolygon ours =
        hull_of("polylidar", set.points, {{"alpha", plan::auto_circumradius({set.points})}});
    const MultiPolygon theirs =
        hull_of("cgal_alpha_shape", set.points, {{"alpha", plan::auto_circumradius_squared({set.points})}});
    ASSERT_FALSE(ours.empty());
    EXPECT_EQ(ours.size(), theirs.size());
    EXPECT_EQ(metrics::area_scores(ours, theirs).l2, 0) << name;
  }
}

}  // namespace
}  // namespace hullbench::testing
