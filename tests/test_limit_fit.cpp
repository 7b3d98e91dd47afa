// Fitting the numbers of the core's automatic limit: errors by sums of triangles beside those by GEOS of the
// polygons, the cases, and a small search.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/triangle_areas.hpp"
#include "benchmarks/tune/limit_fit.hpp"
#include "benchmarks/tune/split.hpp"
#include "datasets/datasets.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"

namespace hullbench {
namespace {

/// l2 of the core's hull, by GEOS.
double error_by_polygons(const PointSet& set, const polylidar::Options& options = {}) {
  const auto hull = polylidar::to_coordinates(polylidar::concave_hull(set.points, options), set.points);
  return metrics::area_scores(hull, set.ground_truth).l2.value();
}

// The area of triangles in a shape.

TEST(AreasWithin, OfTrianglesInsideAcrossAndOutside) {
  const MultiPolygon square_with_hole = {
      {{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{{4, 4}, {4, 6}, {6, 6}, {6, 4}}}}};
  const std::vector<std::array<Point, 3>> triangles = {{{{1, 1}, {3, 1}, {1, 3}}},
                                                       {{{-1, 1}, {1, 1}, {-1, 3}}},
                                                       {{{20, 1}, {30, 1}, {20, 3}}},
                                                       {{{4, 4}, {6, 4}, {4, 6}}},
                                                       {{{0, 0}, {8, 0}, {8, 8}}}};
  const std::vector<double> areas = metrics::areas_within(triangles, square_with_hole);
  ASSERT_EQ(areas.size(), 5U);
  EXPECT_DOUBLE_EQ(areas[0], 2);
  EXPECT_DOUBLE_EQ(areas[1], 0.5);
  EXPECT_EQ(areas[2], 0);
  EXPECT_NEAR(areas[3], 0, 1e-12);
  EXPECT_NEAR(areas[4], 30, 1e-12);
}

// Errors.

TEST(LimitCase, ErrorsAreThoseOfThePolygons) {
  for (const char* name : {"ca~gradient:16", "nested-1~outliers:3", "letter_b~quantised:0.5"}) {
    const PointSet set = make_point_set(name, false, 700, 3);
    tune::LimitCase one(set.points, set.ground_truth);
    EXPECT_NEAR(one.error({}), error_by_polygons(set), 1e-9) << name;
  }
}

TEST(LimitCase, TheBestLimitIsTheBestOfAllThatThereAre) {
  const PointSet set = make_point_set("letter_a", false, 300, 1);
  const tune::LimitCase one(set.points, set.ground_truth);
  const polylidar::Triangulation mesh = polylidar::delaunay(set.points);
  double least = 1;
  for (std::size_t e = 0; e < mesh.triangles.size(); e += 3) {
    double perimeter = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point& from = set.points[mesh.triangles[e + k]];
      const Point& to = set.points[mesh.triangles[e + (k + 1) % 3]];
      perimeter += std::hypot(to.x - from.x, to.y - from.y);
    }
    least = std::min(least, error_by_polygons(set, {.max_perimeter = perimeter * (1 + 1e-12)}));
  }
  EXPECT_NEAR(one.best_error_of_one_limit(), least, 1e-9);
}

TEST(LimitCase, TheFormerDefaultIsGoodWhereDensityIsTheSameEverywhere) {
  const PointSet even = make_point_set("letter_a", false, 2000, 1);
  tune::LimitCase of_even(even.points, even.ground_truth);
  EXPECT_LT(of_even.error_of_former_default(), 1.5 * of_even.best_error_of_one_limit());
  const PointSet spot = make_point_set("letter_a~hotspot:12", false, 2000, 1);
  tune::LimitCase of_spot(spot.points, spot.ground_truth);
  EXPECT_GT(of_spot.error_of_former_default(), of_spot.error({}));
}

TEST(LimitCase, PointsWithoutATriangleAreNoCase) {
  const PointSet set = make_point_set("letter_a", false, 10, 1);
  EXPECT_THROW(tune::LimitCase({}, set.ground_truth), std::invalid_argument);
}

// The cases.

TEST(LimitCases, AreOnTheirSideOfTheSplitAndEachIsThereOnce) {
  std::set<std::tuple<std::string, bool, std::size_t>> seen;
  const auto look = [&](const std::vector<tune::LimitCaseName>& names, tune::Side side) {
    std::set<std::string> samplings;
    for (const tune::LimitCaseName& name : names) {
      EXPECT_EQ(tune::side_of(name.dataset), side) << name.dataset;
      EXPECT_TRUE(seen.emplace(name.dataset, name.holes, name.n).second) << name.dataset;
      for (const std::string& sampler : tune::samplers_of(name.dataset)) samplings.insert(sampler);
    }
    return samplings;
  };
  const auto training = look(tune::training_limit_cases(), tune::Side::kTraining);
  const auto test = look(tune::test_limit_cases(2000), tune::Side::kTest);
  for (const tune::SplitRow& sampler : tune::sampler_split()) {
    EXPECT_EQ(training.contains(sampler.name), sampler.side == tune::Side::kTraining) << sampler.name;
    EXPECT_TRUE(test.contains(sampler.name)) << sampler.name;
  }
}

// The fit.

TEST(LimitFit, ConstantsAreSetAsTheCodeHasThem) {
  for (const tune::LimitKnob& knob : tune::limit_knobs()) {
    tune::AutomaticConstants constants;
    const double in_the_code = knob.value(constants);
    knob.set(constants, in_the_code);
    EXPECT_EQ(knob.value(constants), in_the_code)
        << knob.name << " has three digits at most and is within its range";
    knob.set(constants, std::numeric_limits<double>::infinity());
    EXPECT_EQ(knob.value(constants), knob.most) << knob.name;
  }
}

TEST(LimitFit, TheScoreIsTheMeanOverWaysToSampleOfLogarithms) {
  auto cases = tune::make_limit_cases(
      {{"star-1", false, 500}, {"star-2", false, 500}, {"star-1~gradient:16", false, 500}}, {});
  const std::vector<double> errors = tune::limit_errors(cases, {}, {});
  const auto loss = [&](std::size_t i) { return std::log(errors[i] / cases[i].best_of_one_limit); };
  ASSERT_LT(std::max({loss(0), loss(1), loss(2)}), 1.5);
  EXPECT_NEAR(tune::limit_score(cases, {}, {}), (1.5 * (loss(0) + loss(1)) / 2 + loss(2)) / 2.5, 1e-12);
  EXPECT_LT(tune::limit_score(cases, {.usual = 1e-6, .pull = 1e6}, {}), 1.5 + 1e-12);
}

TEST(LimitFit, ASmallFitGivesTheSameEveryTimeAndFindsLittleToImprove) {
  std::vector<tune::LimitCaseName> names;
  for (const char* name : {"star-1", "county-1", "fashion-2", "parts-1", "walk-1", "han-1"}) {
    for (const char* sampling : {"", "~gradient:16", "~outliers:3", "~noise:0.5", "~clusters:8"})
      names.push_back({std::string(name) + sampling, false, 1500});
  }
  auto cases = tune::make_limit_cases(names, {});
  const auto climbs = tune::fit_limit(cases, 8, 5, {});
  ASSERT_EQ(climbs.size(), 3U);
  const auto again = tune::fit_limit(cases, 8, 5, {0, 0});
  const auto other = tune::fit_limit(cases, 8, 6, {});
  bool is_other = false;
  for (std::size_t i = 0; i < climbs.size(); ++i) {
    EXPECT_LE(climbs[i].score_to, climbs[i].score_from);
    EXPECT_EQ(climbs[i].score_to, again[i].score_to);
    EXPECT_EQ(climbs[i].score_to, tune::limit_score(cases, climbs[i].to, {}));
    for (const tune::LimitKnob& knob : tune::limit_knobs()) {
      EXPECT_EQ(knob.value(climbs[i].to), knob.value(again[i].to)) << climbs[i].start << " " << knob.name;
      is_other |= knob.value(climbs[i].to) != knob.value(other[i].to);
    }
  }
  EXPECT_TRUE(is_other) << "another seed tries others";
  EXPECT_EQ(climbs[0].score_from, tune::limit_score(cases, {}, {}));
  // So few cases have best constants of their own, but not far from those in the code.
  EXPECT_LT(climbs[0].score_from, climbs[0].score_to + 0.02);
  for (const double factor : {0.6, 1.8}) {
    tune::AutomaticConstants changed;
    changed.usual *= factor;
    EXPECT_GT(tune::limit_score(cases, changed, {}), climbs[0].score_to + 0.02) << factor;
  }
  // A single random start may suit these few cases.
  const double of_random_starts =
      (climbs[1].score_from + climbs[2].score_from + other[1].score_from + other[2].score_from) / 4;
  EXPECT_LT(climbs[0].score_from + 0.02, of_random_starts);
}

TEST(LimitFit, EachWayToSampleIsLeftOutOnce) {
  const std::vector<tune::LimitCaseName> names = {{"star-1~gradient:16", false, 1000},
                                                  {"star-1", false, 1000},
                                                  {"county-1", false, 1000},
                                                  {"star-1~noise:0.5", false, 1000}};
  auto cases = tune::make_limit_cases(names, {});
  const auto ways = tune::cross_validate_limit(cases, 30, 1, {});
  ASSERT_EQ(ways.size(), 3U);
  const std::vector<std::string> samplings = {"gradient:16", "noise:0.5", "uniform"};
  bool is_other = false;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    EXPECT_EQ(ways[i].sampling, samplings[i]);
    is_other |= ways[i].score_of_found != ways[i].score_of_code;
  }
  EXPECT_TRUE(is_other) << "what a search found on the others was taken";
  EXPECT_EQ(cases.size(), names.size()) << "and all are put back";
  auto uniform = tune::make_limit_cases({names[1], names[2]}, {});
  EXPECT_EQ(ways[2].score_of_code, tune::limit_score(uniform, {}, {}));
}

TEST(LimitFit, EveryPartOfTheRuleCanBeTakenOut) {
  // Growth is bounded where many outliers make blocks of their own.
  std::vector<tune::LimitCaseName> names = {
      {"star-3", true, 2000}, {"star-4~airborne:3", true, 2000}, {"county-1~outliers:10", false, 4000}};
  for (const char* shape : {"county-1", "parts-1", "star-1"}) {
    for (const char* sampling : {"~gradient:16~outliers:3", "~noise:0.5", "~clusters:8"})
      names.push_back({std::string(shape) + sampling, false, 2000});
  }
  names.push_back({"county-1~outline:0.1", false, 2000});
  auto cases = tune::make_limit_cases(names, {});
  const auto ablations = tune::limit_ablations();
  ASSERT_EQ(ablations.size(), 11U);
  const std::vector<double> whole = tune::limit_errors(cases, {}, {});
  EXPECT_EQ(tune::limit_errors(cases, ablations[0].constants, {}), whole);
  for (std::size_t k = 1; k < ablations.size(); ++k)
    EXPECT_NE(tune::limit_errors(cases, ablations[k].constants, {}), whole) << ablations[k].name;
  for (const tune::LimitVariant& one : tune::limit_sensitivities(0.8)) {
    std::size_t different = 0;
    for (const tune::LimitKnob& knob : tune::limit_knobs())
      different += knob.value(one.constants) != knob.value({}) ? 1U : 0U;
    EXPECT_EQ(different, 1U) << one.name;
  }
}

}  // namespace
}  // namespace hullbench
