// Scores of a case: hand-made shapes with known answers for every metric, and relations that hold for all.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "benchmarks/metrics/anchors.hpp"
#include "benchmarks/metrics/metric_table.hpp"
#include "benchmarks/metrics/metrics.hpp"
#include "benchmarks/metrics/segment_tree.hpp"
#include "datasets/datasets.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/boost_checks.hpp"
#include "tests/boxes.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace hullbench::testing {
namespace {

using polylidar::testing::core_hull;
using polylidar::testing::kConvexHull;
using polylidar::testing::Random;

const MultiPolygon kSquare = {{box(0, 0, 10, 10), {}}};
const MultiPolygon kBowTie = {{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}};

/// The centres of the unit cells of the 10 x 10 square, the first `count` of them: with as many points as the
/// truth has area, h is 1.
std::vector<Point> cell_centres(std::size_t count = 100) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = i / 10;
    points.push_back({0.5 + static_cast<double>(i % 10), 0.5 + static_cast<double>(row)});
  }
  return points;
}

metrics::Metrics score_on_square(const MultiPolygon& result) {
  return metrics::CaseScorer(cell_centres(), kSquare).score(result);
}

/// A share of boundary is off by at most half of the distance between two places, for every place where the
/// tolerance is crossed.
double share_error(int crossings, double length) {
  return crossings * metrics::sample_spacing(1, length) / 2 / length;
}

TEST(BoundaryScores, OfAShiftedSquare) {
  const metrics::Metrics metrics = score_on_square({{box(2, 0, 12, 10), {}}});
  EXPECT_EQ(metrics.spacing, 1);
  ASSERT_TRUE(metrics.boundary);
  const metrics::BoundaryScores& scores = *metrics.boundary;
  EXPECT_EQ(scores.hausdorff_to_truth->distance, 2);
  EXPECT_EQ(scores.hausdorff_to_result->distance, 2);
  EXPECT_EQ(scores.hausdorff, 2);
  // The right side is 2 away all along, the left one rises to 2 and falls again, above and below 2 stick out.
  EXPECT_DOUBLE_EQ(*scores.mean, (20.0 + 16 + 2 + 2) / 40);
  EXPECT_EQ(scores.p95, 2);
  // Of the left side 1 at each end, of the upper and lower side 9 each.
  EXPECT_NEAR(scores.f_score_1h, 0.5, share_error(4, 40));
  EXPECT_EQ(scores.f_score_2h, 1);
  EXPECT_EQ(scores.f_score_4h, 1);
  // Bands of width 2, 64 large, share 8 + 16 + 8.
  EXPECT_DOUBLE_EQ(*metrics.boundary_iou, 32.0 / (64 + 64 - 32));
}

TEST(BoundaryScores, OfAMissedHole) {
  const MultiPolygon truth = {{box(0, 0, 10, 10), {reversed(box(4, 4, 6, 6))}}};
  const metrics::Metrics metrics = metrics::CaseScorer(cell_centres(96), truth).score(kSquare);
  const metrics::BoundaryScores& scores = *metrics.boundary;
  EXPECT_EQ(scores.hausdorff_to_truth->distance, 0);
  EXPECT_EQ(scores.hausdorff_to_result->distance, 4);
  EXPECT_EQ(scores.hausdorff, 4);
  EXPECT_DOUBLE_EQ(*scores.mean, 8.0 * 4 / (40 + 48));
  EXPECT_EQ(scores.p95, 4);  // 8 of 48 is more than a twentieth
  const double recall = 40.0 / 48;
  EXPECT_DOUBLE_EQ(scores.f_score_1h, 2 * recall / (1 + recall));
  EXPECT_DOUBLE_EQ(scores.f_score_2h, 2 * recall / (1 + recall));
  EXPECT_EQ(scores.f_score_4h, 1);
  // The result's band is 100 - 36, the truth's has round the hole an 8 x 8 square with rounded corners less
  // the hole; those corners are chords, which lie within 1 % of the width 2.
  const double round_hole = 4 + 4 * 2 * 2 + 3.14159265358979 * 4 - 4;
  EXPECT_NEAR(*metrics.boundary_iou, 64 / (64 + round_hole), 0.003);
  EXPECT_EQ(metrics.counts.holes_error, -1);
  EXPECT_EQ(metrics.holes.precision, 0);
  EXPECT_EQ(metrics.holes.recall, 0);
  EXPECT_EQ(metrics.holes.f1, 0);
}

TEST(BoundaryScores, WitnessTheirDistances) {
  const metrics::Metrics metrics =
      score_on_square({{{{0, 0}, {10, 0}, {10, 4}, {13, 5}, {10, 6}, {10, 10}, {0, 10}}, {}}});
  EXPECT_EQ(metrics.boundary->hausdorff_to_truth->distance, 3);
  EXPECT_EQ(metrics.boundary->hausdorff_to_truth->place, (Point{13, 5}));
  EXPECT_NEAR(metrics.boundary->hausdorff_to_result->distance, 3 / std::sqrt(10), 1e-12);
  EXPECT_EQ(metrics.boundary->hausdorff_to_result->place, (Point{10, 5}));
  const json row = metrics::metrics_to_json(metrics);
  EXPECT_EQ(row["hausdorff"], 3.0);
  EXPECT_EQ(row["hausdorff_to_truth_x"], 13.0);
  EXPECT_EQ(row["hausdorff_to_truth_y"], 5.0);
  EXPECT_EQ(row["hausdorff_to_result_x"], 10.0);
  EXPECT_EQ(row["hausdorff_to_result_y"], 5.0);
}

TEST(BoundaryScores, TellPrecisionFromRecall) {
  // Of the result, half as long as the truth's boundary, 6 are on it; of the truth's, the same 6.
  const metrics::Metrics metrics = score_on_square({{box(0, 3, 5, 8), {}}});
  // Left side on the truth; at tolerance 1 another 1 of the upper and lower side each.
  const double precision = 7.0 / 20;
  const double recall = 7.0 / 40;
  EXPECT_NEAR(metrics.boundary->f_score_1h, 2 * precision * recall / (precision + recall),
              share_error(2, 20) + share_error(2, 40));
}

TEST(BoundaryScores, PercentileIsThatOfTheLength) {
  // A bump of 2 x 2: of the result's 44, 2.2 are more than 1.9 away, on its far side and the ends of the
  // others.
  const metrics::Metrics metrics =
      score_on_square({{{{0, 0}, {10, 0}, {10, 4}, {12, 4}, {12, 6}, {10, 6}, {10, 10}, {0, 10}}, {}}});
  EXPECT_NEAR(*metrics.boundary->p95, 1.9, 0.125);  // h / 8
}

TEST(BoundaryScores, SpacingIsBounded) {
  EXPECT_EQ(metrics::sample_spacing(1, 100), 0.25);
  EXPECT_EQ(metrics::sample_spacing(4, 100), 1);
  EXPECT_EQ(metrics::sample_spacing(1, 262'144e3), 1000);
  // A result a thousand million h away is scored all the same.
  const metrics::Metrics metrics = score_on_square({{box(1e9, 0, 2e9, 1e9), {}}});
  EXPECT_NEAR(metrics.boundary->hausdorff_to_result->distance, 1e9, 10);
}

TEST(TopologyScores, MatchHolesOneToOne) {
  const MultiPolygon truth = {{box(0, 0, 10, 10), {reversed(box(1, 1, 3, 3)), reversed(box(5, 1, 9, 3))}}};
  // The first one matches, the second one shares a half only, the third one is too much.
  const MultiPolygon result = {
      {box(0, 0, 10, 10), {reversed(box(1, 6, 2, 7)), reversed(box(5, 1, 7, 3)), reversed(box(1, 1, 3, 3))}}};
  const metrics::Metrics metrics = metrics::CaseScorer(cell_centres(88), truth).score(result);
  EXPECT_EQ(metrics.spacing, 1);
  EXPECT_DOUBLE_EQ(*metrics.holes.precision, 1.0 / 3);
  EXPECT_EQ(metrics.holes.recall, 0.5);
  EXPECT_EQ(metrics.holes.f1, 0.4);
  EXPECT_EQ(metrics.counts.holes_error, 1);
  EXPECT_EQ(metrics.counts.polygons_error, 0);
  EXPECT_EQ(metrics.counts.slivers, 1);  // 1 h^2; those of 4 h^2 are none
  EXPECT_EQ(metrics.hole_count, 3U);
}

TEST(TopologyScores, AHoleHasOnePartnerOnlyEvenWhereHolesNest) {
  const MultiPolygon truth = {{box(0, 0, 10, 10), {reversed(box(1.3, 1.3, 8.7, 8.7))}}};
  const MultiPolygon result = {{box(0, 0, 10, 10), {reversed(box(1, 1, 9, 9))}},
                               {box(1.2, 1.2, 8.8, 8.8), {reversed(box(1.4, 1.4, 8.6, 8.6))}}};
  ASSERT_EQ(metrics::invalid_reason(result), "");
  const metrics::Metrics metrics = metrics::CaseScorer(cell_centres(), truth).score(result);
  EXPECT_EQ(metrics.holes.precision, 0.5);
  EXPECT_EQ(metrics.holes.recall, 1);
  const metrics::Metrics turned_round = metrics::CaseScorer(cell_centres(), result).score(truth);
  EXPECT_EQ(turned_round.holes.precision, 1);
  EXPECT_EQ(turned_round.holes.recall, 0.5);
}

TEST(TopologyScores, AHalfIsNotEnough) {
  const MultiPolygon truth = {{box(0, 0, 10, 10), {reversed(box(5, 1, 8, 3))}}};
  const MultiPolygon shifted = {
      {box(0, 0, 10, 10), {reversed(box(6, 1, 9, 3))}}};  // 4 of 6 shared: IoU 4 / 8
  EXPECT_EQ(metrics::CaseScorer(cell_centres(), truth).score(shifted).holes.f1, 0);
  const MultiPolygon nearer = {{box(0, 0, 10, 10), {reversed(box(5.875, 1, 8.875, 3))}}};
  EXPECT_EQ(metrics::CaseScorer(cell_centres(), truth).score(nearer).holes.f1, 1);
}

TEST(TopologyScores, WithoutHolesAreNone) {
  const metrics::Metrics metrics = score_on_square(kSquare);
  EXPECT_EQ(metrics.holes.precision, std::nullopt);
  EXPECT_EQ(metrics.holes.recall, std::nullopt);
  EXPECT_EQ(metrics.holes.f1, std::nullopt);
  const metrics::Metrics spurious = score_on_square({{box(0, 0, 10, 10), {reversed(box(4, 4, 6, 6))}}});
  EXPECT_EQ(spurious.holes.precision, 0);
  EXPECT_EQ(spurious.holes.recall, 0);
  EXPECT_EQ(spurious.holes.f1, 0);
}

TEST(TopologyScores, CountPolygons) {
  const MultiPolygon three = {{box(0, 0, 4, 10), {}}, {box(5, 0, 10, 5), {}}, {box(6, 6, 7, 7), {}}};
  const metrics::Metrics metrics = score_on_square(three);
  EXPECT_EQ(metrics.counts.polygons_error, 2);
  EXPECT_EQ(metrics.counts.slivers, 1);
  EXPECT_EQ(metrics.polygon_count, 3U);
  EXPECT_EQ(metrics.vertex_count, 12U);
  EXPECT_EQ(metrics::CaseScorer(cell_centres(), three).score(kSquare).counts.polygons_error, -2);
}

TEST(ContractScores, OfCoverage) {
  EXPECT_EQ(score_on_square({{box(0, 0, 5, 10), {}}}).contract.points_covered, 0.5);
  // The outermost points lie on the boundary, which counts.
  EXPECT_EQ(score_on_square({{box(0.5, 0.5, 9.5, 9.5), {}}}).contract.points_covered, 1);
  EXPECT_EQ(score_on_square({{box(0, 0, 10, 10), {reversed(box(1, 1, 3, 3))}}}).contract.points_covered,
            0.96);
  EXPECT_EQ(
      score_on_square({{box(0, 0, 10, 10), {reversed(box(0.5, 0.5, 2.5, 2.5))}}}).contract.points_covered,
      0.99);
}

/// Of the square from (0, 0) to (10, 10), by the largest coordinate of which the rounding goes, the coverage
/// of one point.
double coverage_of(const Point& point) {
  return metrics::InputPoints(std::vector<Point>{point}).score(kSquare).points_covered.value();
}

TEST(ContractScores, CoverageForgivesRoundingAndNoMore) {
  const double bound = 10 * metrics::kRoundingOfText;
  for (const double inside : {0.5, 0.9}) {
    EXPECT_EQ(coverage_of({5, -inside * bound}), 1) << inside;
    EXPECT_EQ(coverage_of({10 + std::ceil(inside * 40) * 0x1p-49, 5}), 1) << inside;
  }
  for (const double outside : {1.1, 2.0, 3.0, 1e6}) {
    EXPECT_EQ(coverage_of({5, -outside * bound}), 0) << outside;
    EXPECT_EQ(coverage_of({-outside * bound, -outside * bound}), 0) << outside;
  }
  // An empty shape and one too small for the squares of its distances cover what they did.
  const metrics::InputPoints corner(std::vector<Point>{{0, 0}});
  EXPECT_EQ(corner.score({}).points_covered, 0);
  EXPECT_EQ(corner.score({{box(1e-200, 1e-200, 2e-200, 2e-200), {}}}).points_covered, 0);
}

TEST(ContractScores, TextOf15DigitsLosesNoPointAndTextOf14Does) {
  std::size_t lost = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Random random(seed);
    const double scale = std::pow(10, static_cast<double>(seed % 15) - 7);
    const Point centre = {random.between(-9, 9) * scale, random.between(-9, 9) * scale};
    std::vector<Point> points;
    points.reserve(100);
    for (int i = 0; i < 100; ++i)
      points.push_back({centre.x + scale * random.between(-1, 1), centre.y + scale * random.between(-1, 1)});
    const MultiPolygon hull = core_hull(points, kConvexHull);
    const auto covered_by_text_of = [&](int digits) {
      MultiPolygon text = hull;
      for (Point& vertex : text.at(0).shell) {
        for (double* coordinate : {&vertex.x, &vertex.y}) {
          std::ostringstream out;
          out << std::setprecision(digits) << *coordinate;
          *coordinate = std::stod(out.str());
        }
      }
      return metrics::InputPoints(points).score(text).points_covered.value();
    };
    EXPECT_EQ(covered_by_text_of(17), 1) << seed;
    EXPECT_EQ(covered_by_text_of(15), 1) << seed;
    lost += covered_by_text_of(14) < 1 ? 1U : 0U;
  }
  EXPECT_GT(lost, 15U);  // of 60, near half of them
}

TEST(ContractScores, OfVertices) {
  EXPECT_EQ(score_on_square(kSquare).contract.vertices_from_input, 0);
  const Ring ring = {{0.5, 0.5}, {9.5, 0.5}, {9.5, 9.5}, {0, 10}};
  EXPECT_EQ(score_on_square({{ring, {}}}).contract.vertices_from_input, 0.75);
  const double next = std::nextafter(0.5, 1);
  EXPECT_EQ(
      score_on_square({{{{next, 0.5}, {9.5, 0.5}, {9.5, 9.5}, {0.5, 9.5}}, {}}}).contract.vertices_from_input,
      0.75);
}

TEST(ContractScores, OfOrientation) {
  EXPECT_EQ(score_on_square(kSquare).contract.oriented, true);
  EXPECT_EQ(score_on_square({{reversed(box(0, 0, 10, 10)), {}}}).contract.oriented, false);
  EXPECT_EQ(score_on_square({{box(0, 0, 10, 10), {reversed(box(1, 1, 3, 3))}}}).contract.oriented, true);
  EXPECT_EQ(score_on_square({{box(0, 0, 10, 10), {box(1, 1, 3, 3)}}}).contract.oriented, false);
}

/// An L of three unit cells, and the lattice points on it: 8 points.
const MultiPolygon kCorner = {{{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, {}}};
const std::vector<Point> kCornerPoints = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}};

TEST(Skill, IsAnchoredByTheConvexHullAndTheBestTriangles) {
  const metrics::CaseScorer scorer(kCornerPoints, kCorner);
  const MultiPolygon hull = {{{{0, 0}, {2, 0}, {2, 1}, {1, 2}, {0, 2}}, {}}};
  const metrics::Metrics of_hull = scorer.score(hull);
  EXPECT_DOUBLE_EQ(of_hull.l2_convex_hull, 0.5 / 3);
  EXPECT_EQ(of_hull.l2_best_triangles, 0);
  EXPECT_NEAR(*of_hull.skill, 0, 1e-12);  // two overlays of the same shapes
  EXPECT_EQ(scorer.score(kCorner).skill, 1);
  EXPECT_DOUBLE_EQ(*scorer.score({}).skill, (0.5 / 3 - 1) / (0.5 / 3));
}

TEST(Skill, IsNotDefinedWhereThereIsNothingToGain) {
  EXPECT_EQ(score_on_square(kSquare).skill, std::nullopt);
  EXPECT_DOUBLE_EQ(score_on_square(kSquare).l2_convex_hull, 0.19);
  // The difference of the anchors against 1 / n.
  EXPECT_EQ(metrics::skill(0.0, {0.5, 0.25}, 4), std::nullopt);
  EXPECT_EQ(metrics::skill(0.0, {0.5, 0.25}, 5), 2);
  EXPECT_EQ(metrics::skill(0.25, {0.5, 0.25}, 5), 1);
  EXPECT_EQ(metrics::skill(0.5, {0.5, 0.25}, 5), 0);
  EXPECT_EQ(metrics::skill(0.5, {0.25, 0.5}, 5), std::nullopt);
  EXPECT_EQ(metrics::skill(std::nullopt, {0.5, 0.25}, 5), std::nullopt);
}

TEST(Skill, OfTooFewPoints) {
  for (const std::vector<Point>& points : {std::vector<Point>{},
                                           {{1, 1}},
                                           {{1, 1}, {2, 2}},
                                           {{1, 1}, {2, 2}, {3, 3}},
                                           {{1, 1}, {1, 1}, {1, 1}}}) {
    const metrics::CaseScorer scorer(points, kSquare);
    const metrics::Metrics metrics = scorer.score(kSquare);
    EXPECT_EQ(metrics.l2_convex_hull, 1);
    EXPECT_EQ(metrics.l2_best_triangles, 1);
    EXPECT_EQ(metrics.skill, std::nullopt);
    EXPECT_EQ(metrics.area.l2, 0);
    const double count = static_cast<double>(std::max<std::size_t>(1, points.size()));
    EXPECT_DOUBLE_EQ(metrics.spacing, 10 / std::sqrt(count));
    EXPECT_EQ(metrics.contract.points_covered.has_value(), !points.empty());
  }
}

TEST(Agreement, OfHalvesAndQuarters) {
  const MultiPolygon left = {{box(0, 0, 5, 10), {}}};
  const MultiPolygon middle = {{box(2.5, 0, 7.5, 10), {}}};
  const MultiPolygon right = {{box(5, 0, 10, 10), {}}};
  EXPECT_EQ(metrics::intersection_over_union(kSquare, kSquare), 1);
  EXPECT_DOUBLE_EQ(metrics::intersection_over_union(kSquare, left).value(), 0.5);
  EXPECT_DOUBLE_EQ(metrics::intersection_over_union(left, middle).value(), 1.0 / 3);
  EXPECT_EQ(metrics::intersection_over_union(left, right), 0);
  EXPECT_EQ(metrics::intersection_over_union(left, {}), 0);
  EXPECT_EQ(metrics::intersection_over_union({}, {}), std::nullopt);
  EXPECT_EQ(metrics::intersection_over_union(kSquare, kBowTie), std::nullopt);
}

TEST(Agreement, StabilityIsTheMeanOfTheDrawsAndAFailureIsZero) {
  const MultiPolygon left = {{box(0, 0, 5, 10), {}}};
  const std::vector<metrics::PartResults> good = {{kSquare, kSquare, left}, {left, kSquare, kSquare}};
  EXPECT_DOUBLE_EQ(metrics::stability(kSquare, good).value().halves, 0.75);
  EXPECT_DOUBLE_EQ(metrics::stability(kSquare, good).value().subsamples, 0.75);
  const std::vector<metrics::PartResults> failed = {{kSquare, std::nullopt, std::nullopt}};
  const std::vector<metrics::PartResults> empty = {{MultiPolygon{}, MultiPolygon{}, MultiPolygon{}}};
  const std::vector<metrics::PartResults> invalid = {{kBowTie, kBowTie, kBowTie}};
  for (const auto& draws : {failed, empty, invalid}) {
    EXPECT_EQ(metrics::stability(kSquare, draws).value().halves, 0);
    EXPECT_EQ(metrics::stability(kSquare, draws).value().subsamples, 0);
  }
  EXPECT_FALSE(metrics::stability(kSquare, {}).has_value());
  EXPECT_FALSE(metrics::stability(kBowTie, good).has_value());
}

TEST(Agreement, WithoutATruthOfAConvexHullAllPointsAreCovered) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    const double scale = std::pow(10, random.between(-9, 9));
    const Point centre = {scale * random.between(-1e4, 1e4), scale * random.between(-1e4, 1e4)};
    std::vector<Point> points;
    points.reserve(200);
    for (int i = 0; i < 200; ++i)
      points.push_back({centre.x + scale * random.between(0, 1), centre.y + scale * random.between(0, 1)});
    const MultiPolygon hull = core_hull(points, kConvexHull);
    const metrics::Metrics metrics = metrics::describe(points, hull, hull, {});
    EXPECT_EQ(metrics.contract.points_covered, 1) << seed;
    EXPECT_DOUBLE_EQ(metrics.convex_hull_share.value(), 1) << seed;
    EXPECT_NEAR(metrics.window_iou.value(), 1, 1e-9) << seed;
    EXPECT_FALSE(metrics.stability.has_value());
  }
}

TEST(Agreement, OfAWindowIsTheIoUWithIt) {
  const MultiPolygon left = {{box(0, 0, 5, 10), {}}};
  const metrics::Metrics metrics = metrics::describe(cell_centres(), left, kSquare, {});
  EXPECT_DOUBLE_EQ(metrics.window_iou.value(), 0.5);
  EXPECT_DOUBLE_EQ(metrics.convex_hull_share.value(), 50.0 / 81);
  EXPECT_FALSE(metrics::describe(cell_centres(), left).window_iou.has_value());
  EXPECT_FALSE(metrics::describe(cell_centres(), kBowTie, kSquare).convex_hull_share.has_value());
}

// Points on an outline only make triangles so flat that the sign of their area is one of rounding.
TEST(Anchors, OfSlivers) {
  for (const char* name : {"ca~boundary:100", "hi~boundary:100"}) {
    const PointSet set = make_point_set(name, false, 2000, 1);
    EXPECT_TRUE(metrics::CaseScorer(set.points, set.ground_truth).score({}).area.valid);
  }
}

TEST(Metrics, OfNothing) {
  const MultiPolygon truth = {{box(0, 0, 10, 10), {reversed(box(4, 4, 6, 6))}}};
  const metrics::Metrics metrics = metrics::CaseScorer(cell_centres(), truth).score({});
  EXPECT_TRUE(metrics.area.valid);
  EXPECT_EQ(metrics.area.l2, 1);
  ASSERT_TRUE(metrics.boundary);
  EXPECT_FALSE(metrics.boundary->hausdorff || metrics.boundary->hausdorff_to_truth);
  EXPECT_FALSE(metrics.boundary->hausdorff_to_result || metrics.boundary->mean || metrics.boundary->p95);
  EXPECT_EQ(metrics.boundary->f_score_1h, 0);
  EXPECT_EQ(metrics.boundary->f_score_4h, 0);
  EXPECT_EQ(metrics.boundary_iou, 0);
  EXPECT_EQ(metrics.counts.polygons_error, -1);
  EXPECT_EQ(metrics.counts.holes_error, -1);
  EXPECT_EQ(metrics.counts.slivers, 0);
  EXPECT_EQ(metrics.holes.f1, 0);
  EXPECT_EQ(metrics.contract.points_covered, 0);
  EXPECT_EQ(metrics.contract.vertices_from_input, std::nullopt);
  EXPECT_EQ(metrics.contract.oriented, std::nullopt);
}

TEST(Metrics, OfAnInvalidShapeAreWhatNeedsNoOverlay) {
  const metrics::Metrics metrics = score_on_square(kBowTie);
  EXPECT_FALSE(metrics.area.valid);
  EXPECT_EQ(metrics.area.invalid_reason, metrics::invalid_reason(kBowTie));
  EXPECT_FALSE(metrics.boundary || metrics.boundary_iou || metrics.skill || metrics.holes.f1);
  EXPECT_EQ(metrics.vertex_count, 4U);
  EXPECT_EQ(metrics.counts.polygons_error, 0);
  EXPECT_EQ(metrics.contract.points_covered, 0.04);  // (0.5, 0.5), (1.5, 0.5) and above these, on its edges
  EXPECT_TRUE(metrics.contract.oriented);
}

TEST(Metrics, OfCoordinatesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const metrics::Metrics metrics =
        score_on_square({{{{0.5, 0.5}, {bad, 0.5}, {0.5, bad}, {1.5, 1.5}}, {}}});
    EXPECT_FALSE(metrics.area.valid);
    EXPECT_EQ(metrics.contract.points_covered, std::nullopt);
    EXPECT_EQ(metrics.contract.vertices_from_input, 0.5);
  }
  EXPECT_FALSE(score_on_square({{{}, {}}}).area.valid);
  EXPECT_FALSE(score_on_square({{{{1, 1}}, {}}}).area.valid);
}

TEST(Metrics, OfTheTruthItselfArePerfect) {
  for (const auto& [name, holes] : {std::pair<const char*, bool>{"ca", true},
                                    {"hi", false},
                                    {"letter_b", false},
                                    {"star-7", true},
                                    {"parts-3", false}}) {
    SCOPED_TRACE(name);
    const MultiPolygon truth = make_ground_truth(name, holes);
    const metrics::Metrics metrics =
        metrics::CaseScorer(make_point_set(name, holes, 2000, 1).points, truth).score(truth);
    EXPECT_EQ(metrics.area.l2, 0);
    EXPECT_LT(*metrics.boundary->hausdorff, 1e-12);  // places between vertices are rounded
    EXPECT_LT(*metrics.boundary->mean, 1e-12);
    EXPECT_EQ(metrics.boundary->f_score_1h, 1);
    EXPECT_NEAR(*metrics.boundary_iou, 1, 1e-9);  // areas of overlays
    EXPECT_EQ(metrics.counts.polygons_error, 0);
    EXPECT_EQ(metrics.counts.holes_error, 0);
    EXPECT_EQ(metrics.holes.f1.value_or(1), 1);
    EXPECT_EQ(metrics.contract.points_covered, 1);
    EXPECT_EQ(metrics.area.perimeter_ratio, 1);
    EXPECT_GT(metrics.skill.value_or(2), 1);
  }
}

struct SampleCase {
  std::vector<Point> points;
  MultiPolygon truth;
  MultiPolygon result;
};

/// A star of the random polygons with its holes, 1500 points and their concave hull.
SampleCase star_case(std::size_t number) {
  const PointSet set = make_point_set("star-" + std::to_string(number), true, 1500, 1);
  const double alpha = 2 * std::sqrt(set.ground_truth_area / 1500);
  return {set.points, set.ground_truth, core_hull(set.points, {.alpha = alpha})};
}

TEST(SegmentTree, AgreesWithBoost) {
  for (const std::size_t number : {1U, 4000U, 9000U}) {
    const SampleCase sample = star_case(number);
    const metrics::SegmentTree tree(sample.truth);
    Random random(number);
    for (int i = 0; i < 300; ++i) {
      const Point& near = sample.points[random.below(sample.points.size())];
      const Point point = {near.x + random.between(-30, 30), near.y + random.between(-30, 30)};
      const double expected = boost_distance(point, sample.truth);
      // Rounding of coordinates of some hundred.
      EXPECT_NEAR(tree.distance(point), expected, 1e-11);
      EXPECT_EQ(tree.distance(point, expected * 1.5), tree.distance(point));
    }
  }
  EXPECT_EQ(metrics::SegmentTree({}).distance({1, 1}), std::numeric_limits<double>::infinity());
}

/// The largest distance from the edges of `from` to `to`, looked for at places h / 512 apart.
double dense_distance(const MultiPolygon& from, const MultiPolygon& to, double h) {
  const metrics::SegmentTree tree(to);
  double largest = 0;
  for (const Polygon& polygon : from) {
    std::vector<Ring> rings = polygon.holes;
    rings.push_back(polygon.shell);
    for (const Ring& ring : rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point& a = ring[i];
        const Point& b = ring[(i + 1) % ring.size()];
        const auto pieces = static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.y - a.y) / h * 512));
        for (int piece = 0; piece < pieces; ++piece) {
          const double t = static_cast<double>(piece) / pieces;
          largest = std::max(largest, tree.distance({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}));
        }
      }
    }
  }
  return largest;
}

TEST(BoundaryScores, AreAsNearToTheLargestDistanceAsStated) {
  for (const std::size_t number : {100U, 5000U}) {
    const SampleCase sample = star_case(number);
    const metrics::Metrics metrics = metrics::CaseScorer(sample.points, sample.truth).score(sample.result);
    const double h = metrics.spacing;
    const double to_truth = dense_distance(sample.result, sample.truth, h);
    const double to_result = dense_distance(sample.truth, sample.result, h);
    // The dense places are themselves up to h / 1024 short.
    EXPECT_LE(metrics.boundary->hausdorff_to_truth->distance, to_truth + h / 1024);
    EXPECT_GE(metrics.boundary->hausdorff_to_truth->distance, to_truth - h / 8);
    EXPECT_LE(metrics.boundary->hausdorff_to_result->distance, to_result + h / 1024);
    EXPECT_GE(metrics.boundary->hausdorff_to_result->distance, to_result - h / 8);
  }
}

TEST(Metrics, AreTheSameFromSeveralThreads) {
  const SampleCase sample = star_case(8000);
  const metrics::CaseScorer scorer(sample.points, sample.truth);
  const std::vector<MultiPolygon> results = {sample.result, sample.truth, {}, kBowTie};
  std::vector<json> expected;
  expected.reserve(results.size());
  for (const MultiPolygon& result : results)
    expected.push_back(metrics::metrics_to_json(scorer.score(result)));
  std::vector<json> seen(16);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    threads.emplace_back(
        [&, i] { seen[i] = metrics::metrics_to_json(scorer.score(results[i % results.size()])); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], expected[i % results.size()]) << i;
}

TEST(Metrics, HaveTheAreaScoresThatSearchesUse) {
  const SampleCase sample = star_case(300);
  const metrics::CaseScorer scorer(sample.points, sample.truth);
  const metrics::AreaScores all = scorer.score(sample.result).area;
  for (const metrics::AreaScores& scores :
       {scorer.area_scores(sample.result), metrics::area_scores(sample.result, sample.truth)}) {
    EXPECT_EQ(scores.l2, all.l2);
    EXPECT_EQ(scores.iou, all.iou);
    EXPECT_EQ(scores.perimeter_ratio, all.perimeter_ratio);
  }
}

TEST(Metrics, DoNotDependOnOriginUnitOrQuarterTurns) {
  struct Motion {
    const char* name;
    double unit;  ///< lengths grow by so much
    std::function<Point(const Point&)> move;
  };
  const std::vector<Motion> motions = {{"translated", 1,
                                        [](const Point& p) {
                                          return Point{p.x + 512, p.y - 256};
                                        }},
                                       {"scaled", 4,
                                        [](const Point& p) {
                                          return Point{4 * p.x, 4 * p.y};
                                        }},
                                       {"turned", 1, [](const Point& p) {
                                          return Point{-p.y, p.x};
                                        }}};
  const SampleCase sample = star_case(6000);
  const auto moved_ring = [](Ring ring, const Motion& motion) {
    std::ranges::transform(ring, ring.begin(), motion.move);
    return ring;
  };
  const auto moved = [&](MultiPolygon shape, const Motion& motion) {
    for (Polygon& polygon : shape) {
      polygon.shell = moved_ring(polygon.shell, motion);
      for (Ring& hole : polygon.holes) hole = moved_ring(hole, motion);
    }
    return shape;
  };
  const metrics::Metrics before = metrics::CaseScorer(sample.points, sample.truth).score(sample.result);
  for (const Motion& motion : motions) {
    SCOPED_TRACE(motion.name);
    const metrics::CaseScorer scorer(moved_ring(sample.points, motion), moved(sample.truth, motion));
    const metrics::Metrics after = scorer.score(moved(sample.result, motion));
    for (const metrics::MetricInfo& metric : metrics::metric_table()) {
      SCOPED_TRACE(metric.name);
      const metrics::MetricValue a = metric.value(before);
      const metrics::MetricValue b = metric.value(after);
      ASSERT_EQ(a.index(), b.index());
      if (!std::holds_alternative<double>(a)) {
        EXPECT_EQ(a, b);
        continue;
      }
      if (metric.name.ends_with("_x") || metric.name.ends_with("_y")) continue;  // places, they move
      const double unit = metric.unit == "length"     ? motion.unit
                          : metric.unit == "length^2" ? motion.unit * motion.unit
                                                      : 1;
      // Overlays place crossings within some ulps; the arcs of a band are laid out from the axes, but a
      // quarter turn and the simplification that goes with them keep to 1e-3 of a band.
      const double tolerance = metric.name == "boundary_iou" ? 1e-3 : 1e-9;
      EXPECT_NEAR(std::get<double>(b), unit * std::get<double>(a),
                  tolerance * std::abs(unit * std::get<double>(a)) + 1e-12);
    }
  }
}

TEST(Metrics, AResultIsScoredWhereTheBufferOfItIsInvalid) {
  const PointSet set = make_point_set("country-2~lattice:0", false, 2000, 1258990650);
  const MultiPolygon result = core_hull(set.points, {.alpha = 1.1550034993241562});
  const metrics::Metrics metrics = metrics::CaseScorer(set.points, set.ground_truth).score(result);
  EXPECT_TRUE(metrics.area.valid);
  ASSERT_TRUE(metrics.boundary_iou);
  EXPECT_GT(*metrics.boundary_iou, 0.1);
  EXPECT_LT(*metrics.boundary_iou, 1);
}

}  // namespace
}  // namespace hullbench::testing
