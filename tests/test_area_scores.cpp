// Area scores and validity: shapes with known answers, invalid shapes, and Boost.Geometry's answers on random
// ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/metrics/area.hpp"
#include "benchmarks/metrics/validity.hpp"
#include "datasets/datasets.hpp"
#include "tests/boost_checks.hpp"
#include "tests/boxes.hpp"
#include "tests/complaint.hpp"
#include "tests/infinity.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

using polylidar::testing::Random;

TEST(AreaScores, OfTheGroundTruthItselfArePerfect) {
  const metrics::AreaScores scores = metrics::area_scores(kUnitSquare, kUnitSquare);
  EXPECT_TRUE(scores.valid);
  EXPECT_EQ(scores.invalid_reason, "");
  EXPECT_EQ(scores.area, 1);
  EXPECT_EQ(scores.ground_truth_area, 1);
  EXPECT_EQ(scores.symmetric_difference_area, 0);
  EXPECT_EQ(scores.l2, 0);
  EXPECT_EQ(scores.l2_paper, 0);
  EXPECT_EQ(scores.iou, 1);
}

// GEOS is what refuses an invalid ground truth in a run.
TEST(AreaScores, EveryDataSetIsValidAndPerfectAgainstItself) {
  const std::vector<DatasetInfo> infos = datasets();
  ASSERT_FALSE(infos.empty());
  for (const DatasetInfo& info : infos) {
    // Of a family a first member, one in the middle and the last one.
    const std::set<std::size_t> numbers = {1, 1 + info.members / 2, std::max<std::size_t>(1, info.members)};
    for (const std::size_t number : numbers) {
      const std::string name = info.members == 0 ? info.name : info.name + "-" + std::to_string(number);
      const MultiPolygon shape = make_ground_truth(name, info.has_holes_variant);
      if (shape.empty()) continue;  // points without a shape
      const metrics::AreaScores scores = metrics::area_scores(shape, shape);
      EXPECT_TRUE(scores.valid) << name << ": " << scores.invalid_reason;
      EXPECT_EQ(scores.l2, 0) << name;
      EXPECT_GT(scores.ground_truth_convexity, 0) << name;
      EXPECT_LE(scores.ground_truth_convexity, 1) << name;
    }
  }
}

TEST(AreaScores, NoShapeIsMoreThanConvex) {
  for (int corners = 3; corners < 100; ++corners) {
    MultiPolygon shape(1);
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.283 * i / corners;
      shape[0].shell.push_back({1000 + std::cos(angle), 2000 + std::sin(angle)});
    }
    const double convexity = metrics::area_scores(shape, shape).ground_truth_convexity;
    EXPECT_LE(convexity, 1) << corners;
    EXPECT_GT(convexity, 1 - 1e-9) << corners;
  }
}

// Which area divides is what tells l2 from the paper's.
TEST(AreaScores, DivideByTheRightArea) {
  const MultiPolygon wide = {{box(0, 0, 4, 1), {}}};
  const metrics::AreaScores too_small = metrics::area_scores(kUnitSquare, wide);
  EXPECT_EQ(too_small.symmetric_difference_area, 3);
  EXPECT_EQ(too_small.l2, 0.75);
  EXPECT_EQ(too_small.l2_paper, 3);
  EXPECT_EQ(too_small.iou, 0.25);
  EXPECT_EQ(too_small.omission, 0.75);
  EXPECT_EQ(too_small.commission, 0);
  EXPECT_EQ(too_small.area_bias, -0.75);
  EXPECT_EQ(too_small.perimeter_ratio, 0.4);
  const metrics::AreaScores too_large = metrics::area_scores(wide, kUnitSquare);
  EXPECT_EQ(too_large.l2, 3);
  EXPECT_EQ(too_large.l2_paper, 0.75);
  EXPECT_EQ(too_large.iou, 0.25);
  EXPECT_EQ(too_large.omission, 0);
  EXPECT_EQ(too_large.commission, 3);
  EXPECT_EQ(too_large.area_bias, 3);
  EXPECT_EQ(too_large.perimeter_ratio, 2.5);
}

TEST(AreaScores, CountWhatIsMissingAndWhatIsTooMuch) {
  const metrics::AreaScores scores = metrics::area_scores({{box(0.5, 0, 1.5, 1), {}}}, kUnitSquare);
  EXPECT_EQ(scores.symmetric_difference_area, 1);
  EXPECT_EQ(scores.l2, 1);
  EXPECT_EQ(scores.iou, 0.5 / 1.5);
  EXPECT_EQ(scores.omission, 0.5);
  EXPECT_EQ(scores.commission, 0.5);
  EXPECT_EQ(scores.area_bias, 0);
  EXPECT_EQ(scores.perimeter_ratio, 1);
}

TEST(AreaScores, OfDisjointShapes) {
  const metrics::AreaScores scores = metrics::area_scores({{box(5, 5, 7, 7), {}}}, kUnitSquare);
  EXPECT_EQ(scores.symmetric_difference_area, 5);
  EXPECT_EQ(scores.l2, 5);
  EXPECT_EQ(scores.l2_paper, 1.25);
  EXPECT_EQ(scores.iou, 0);
}

TEST(AreaScores, SeeHolesAndSeveralPolygons) {
  const MultiPolygon truth = {{box(0, 0, 10, 10), {reversed(box(2, 2, 4, 4))}}, {box(20, 0, 30, 10), {}}};
  const MultiPolygon result = {{box(0, 0, 10, 10), {reversed(box(2, 2, 4, 4)), reversed(box(6, 6, 7, 8))}},
                               {box(20, 0, 30, 10), {reversed(box(22, 2, 25, 5))}}};
  const metrics::AreaScores scores = metrics::area_scores(result, truth);
  EXPECT_TRUE(scores.valid) << scores.invalid_reason;
  EXPECT_EQ(scores.area, 185);
  EXPECT_EQ(scores.ground_truth_area, 196);
  EXPECT_EQ(scores.symmetric_difference_area, 11);
  EXPECT_EQ(scores.l2, 11.0 / 196);
  EXPECT_EQ(scores.l2_paper, 11.0 / 185);
  EXPECT_EQ(scores.iou, 185.0 / 196);
  EXPECT_EQ(scores.omission, 11.0 / 196);
  EXPECT_EQ(scores.commission, 0);
  EXPECT_EQ(scores.perimeter_ratio, (88.0 + 6 + 12) / 88);
}

TEST(AreaScores, DoNotDependOnTheWayRingsRun) {
  const MultiPolygon truth = {{box(0, 0, 10, 10), {reversed(box(2, 2, 4, 4))}}};
  const MultiPolygon turned = {{reversed(box(0, 0, 10, 10)), {box(2, 2, 4, 4)}}};
  EXPECT_EQ(metrics::area_scores(turned, truth).l2, 0);
  EXPECT_EQ(metrics::area_scores(turned, truth).area, 96);
}

TEST(AreaScores, AllowPolygonsAndRingsThatTouchInAPoint) {
  EXPECT_EQ(metrics::invalid_reason({{box(0, 0, 1, 1), {}}, {box(1, 1, 2, 2), {}}}), "");
  EXPECT_EQ(metrics::invalid_reason({{box(0, 0, 4, 4), {{{0, 2}, {1, 3}, {2, 2}, {1, 1}}}}}), "");
}

TEST(AreaScores, OfNothingAreAllMissing) {
  const metrics::AreaScores scores = metrics::area_scores({}, kUnitSquare);
  EXPECT_TRUE(scores.valid);
  EXPECT_EQ(scores.area, 0);
  EXPECT_EQ(scores.symmetric_difference_area, 1);
  EXPECT_EQ(scores.l2, 1);
  EXPECT_EQ(scores.l2_paper, std::nullopt);
  EXPECT_EQ(scores.iou, 0);
  EXPECT_EQ(scores.omission, 1);
  EXPECT_EQ(scores.commission, 0);
  EXPECT_EQ(scores.area_bias, -1);
  EXPECT_EQ(scores.perimeter_ratio, 0);
}

struct InvalidCase {
  std::string name;
  MultiPolygon shape;
  std::string reason = {};  // how our sentence begins; empty: GEOS's words, which differ between its versions
};

std::vector<InvalidCase> invalid_cases() {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return {
      {"bow-tie", {{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}}},
      {"hole outside its shell", {{box(0, 0, 1, 1), {box(3, 3, 4, 4)}}}},
      {"hole across its shell", {{box(0, 0, 2, 2), {box(1, 1, 3, 3)}}}},
      {"nested holes", {{box(0, 0, 9, 9), {box(1, 1, 8, 8), box(3, 3, 4, 4)}}}},
      {"overlapping polygons", {{box(0, 0, 2, 2), {}}, {box(1, 1, 3, 3), {}}}},
      {"polygon within another", {{box(0, 0, 9, 9), {}}, {box(1, 1, 2, 2), {}}}},
      {"the same polygon twice", {kUnitSquare[0], kUnitSquare[0]}},
      {"polygons that share an edge", {{box(0, 0, 1, 1), {}}, {box(1, 0, 2, 1), {}}}},
      {"interior cut apart", {{box(0, 0, 4, 4), {{{0, 2}, {2, 3}, {4, 2}, {2, 1}}}}}},
      {"ring that passes a point twice", {{{{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}, {1, 1}}, {}}}},
      {"spike", {{{{0, 0}, {2, 0}, {2, 2}, {2, 5}, {2, 2}, {0, 2}}, {}}}},
      {"all points equal", {{{{1, 1}, {1, 1}, {1, 1}}, {}}}},
      {"shell of two points", {{{{0, 0}, {1, 1}}, {}}}, "Too few points in ring[0 0]"},
      {"hole of one point", {{box(0, 0, 1, 1), {{{0.5, 0.5}}}}}, "Too few points in ring[0.5 0.5]"},
      {"shell without points", {{{}, {}}}, "Ring without points"},
      {"NaN", {{{{0, 0}, {kNan, 0}, {0, 1}}, {}}}, "Invalid Coordinate["},
      {"infinity", {{box(0, 0, 1, kInfinity), {}}}, "Invalid Coordinate["},
  };
}

TEST(AreaScores, OfInvalidShapesSayWhyAndLeaveRatiosOpen) {
  for (const InvalidCase& invalid : invalid_cases()) {
    SCOPED_TRACE(invalid.name);
    const metrics::AreaScores scores = metrics::area_scores(invalid.shape, kUnitSquare);
    EXPECT_FALSE(scores.valid);
    EXPECT_TRUE(scores.invalid_reason.starts_with(invalid.reason)) << scores.invalid_reason;
    EXPECT_FALSE(scores.invalid_reason.empty());
    EXPECT_EQ(scores.invalid_reason, metrics::invalid_reason(invalid.shape));
    EXPECT_TRUE(std::isfinite(scores.area));
    EXPECT_EQ(scores.ground_truth_area, 1);
    EXPECT_EQ(scores.symmetric_difference_area, std::nullopt);
    EXPECT_EQ(scores.l2, std::nullopt);
    EXPECT_EQ(scores.l2_paper, std::nullopt);
    EXPECT_EQ(scores.iou, std::nullopt);
    EXPECT_EQ(scores.omission, std::nullopt);
    EXPECT_EQ(scores.commission, std::nullopt);
    EXPECT_EQ(scores.area_bias, std::nullopt);
    EXPECT_EQ(scores.perimeter_ratio, std::nullopt);
  }
}

TEST(AreaScores, OfInvalidShapesKeepTheArea) {
  const metrics::AreaScores scores =
      metrics::area_scores({{box(0, 0, 2, 2), {}}, {box(1, 1, 3, 3), {}}}, kUnitSquare);
  EXPECT_EQ(scores.area, 8);
  Ring larger = box(0, 0, 2, 2);
  std::ranges::reverse(larger);
  EXPECT_EQ(metrics::area_scores({{box(0, 0, 1, 1), {larger}}}, kUnitSquare).area, 0)
      << "of a hole that is larger than its shell";
}

TEST(AreaScores, RefuseAGroundTruthThatIsNone) {
  EXPECT_THROW(metrics::area_scores(kUnitSquare, {}), std::runtime_error);
  for (const InvalidCase& invalid : invalid_cases()) {
    SCOPED_TRACE(invalid.name);
    expect_complaint([&] { metrics::area_scores(kUnitSquare, invalid.shape); }, invalid.reason);
  }
}

// `value` to a millionth: exact arithmetic on few digits is fast enough for a test.
double short_double(double value) {
  return std::round(value * 0x1p20) * 0x1p-20;
}

// A star-shaped ring: simple, and with `spread` > 0 concave.
Ring star(Random& random, Point centre, double radius, double spread, std::size_t corners) {
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle =
        6.283185307179586 * (static_cast<double>(i) + 0.8 * random.unit()) / static_cast<double>(corners);
    const double distance = radius * (1 - spread * random.unit());
    ring.push_back({short_double(centre.x + distance * std::cos(angle)),
                    short_double(centre.y + distance * std::sin(angle))});
  }
  return ring;
}

// A star with holes inside the radius that every star keeps clear of, so that the polygon is valid.
Polygon star_with_holes(Random& random, Point centre, double spread, std::size_t corners, std::size_t holes) {
  Polygon polygon{star(random, centre, 10, spread, corners), {}};
  for (std::size_t h = 0; h < holes; ++h) {
    const double angle = 6.283185307179586 * static_cast<double>(h) / static_cast<double>(holes);
    const Point middle{centre.x + 2.5 * std::cos(angle), centre.y + 2.5 * std::sin(angle)};
    polygon.holes.push_back(reversed(star(random, middle, 1, 0.6, 9)));
  }
  return polygon;
}

TEST(AreaScoresAgainstBoost, AgreeOnRandomPolygons) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double spread = seed % 3 == 0 ? 0 : random.between(0.1, 0.55);  // every third one nearly round
    const std::size_t corners = 12 + random.below(60);
    const std::size_t holes = seed % 2 == 0 ? 0 : 1 + random.below(5);
    MultiPolygon truth = {star_with_holes(random, {0, 0}, spread, corners, holes)};
    MultiPolygon result = {
        star_with_holes(random, {random.between(-3, 3), random.between(-3, 3)}, spread, corners, holes)};
    if (seed % 5 == 0) {
      truth.push_back(star_with_holes(random, {40, 0}, spread, corners, holes));
      result.push_back(star_with_holes(random, {41, 1}, spread, corners, holes));
    }
    ASSERT_EQ(boost_fault_in_detail(truth), "");
    const metrics::AreaScores scores = metrics::area_scores(result, truth);
    ASSERT_TRUE(scores.valid) << scores.invalid_reason;
    // GEOS places crossings in double arithmetic, each within some ulps of a coordinate; a few hundred of
    // them move an area by far less than 1e-9 of it.
    const double tolerance = 1e-9 * scores.ground_truth_area;
    EXPECT_NEAR(*scores.symmetric_difference_area, boost_symmetric_difference_area(truth, result), tolerance);
    EXPECT_NEAR(scores.area, boost_area(result), tolerance);
    EXPECT_NEAR(*scores.iou,
                (scores.area + scores.ground_truth_area - *scores.symmetric_difference_area) /
                    (scores.area + scores.ground_truth_area + *scores.symmetric_difference_area),
                1e-9);
    // What is not missing of the difference is too much; exact overlays are slow.
    if (seed % 6 == 0) {
      const double missing = boost_difference_area(truth, result);
      EXPECT_NEAR(*scores.omission * scores.ground_truth_area, missing, tolerance);
      EXPECT_NEAR(*scores.commission * scores.ground_truth_area, *scores.symmetric_difference_area - missing,
                  tolerance);
    }
    EXPECT_NEAR(*scores.perimeter_ratio, boost_perimeter(result) / boost_perimeter(truth),
                1e-12);  // sums of a few hundred lengths
  }
}

}  // namespace
}  // namespace hullbench::testing
