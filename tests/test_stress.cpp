// Ways to draw points that are not uniform: exact counts, the same bits everywhere, and the property that
// each is named for. Statistical bounds are five standard deviations of what is measured; the samples never
// change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "datasets/datasets.hpp"
#include "datasets/point_locator.hpp"
#include "datasets/sampling.hpp"
#include "datasets/stress.hpp"
#include "tests/boost_checks.hpp"

namespace hullbench {
namespace {

using polylidar::MultiPolygon;
using polylidar::Point;
using polylidar::Polygon;
using polylidar::Ring;

const std::vector<std::string> kShapes = {"ca", "letter_b", "star-1", "nested-1", "parts-1"};

std::vector<Point> points_of(const std::string& name, std::size_t n) {
  return make_point_set(name, false, n, 1).points;
}

std::vector<Point> sample(const std::string& kind, const MultiPolygon& shape, std::size_t n, double level) {
  const auto& kinds = stress_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const StressKind& one) { return one.name == kind; });
  return found->sample(shape, n, level, 7);
}

/// Of 100 squared units.
MultiPolygon square() {
  return {{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}}};
}

double spacing(const std::string& shape, std::size_t n) {
  return std::sqrt(polylidar::area(make_ground_truth(shape, false)) / static_cast<double>(n));
}

double distance(const Point& a, const Point& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

std::vector<double> nearest_distances(const std::vector<Point>& points) {
  std::vector<double> result(points.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (i != j) result[i] = std::min(result[i], distance(points[i], points[j]));
    }
  }
  return result;
}

TEST(Stress, NamesAreTakenApartInOnePlace) {
  EXPECT_FALSE(split_stress("ca")->second);
  const auto noise = split_stress("star-17~noise:0.25");
  ASSERT_TRUE(noise && noise->second);
  EXPECT_EQ(noise->first, "star-17");
  EXPECT_EQ(noise->second->kind->name, "noise");
  EXPECT_EQ(noise->second->level, 0.25);
  // A level has one spelling, so that a data set has one name.
  for (const char* name : {"ca~", "ca~noise", "ca~noise:", "ca~noise:.5", "ca~noise:0.50", "ca~noise:5e-1",
                           "ca~noise:-1", "ca~noise:11", "ca~noise:nan", "ca~noise:1 ", "ca~fog:1",
                           "ca~noise:1~noise:1", "ca~noise:01", "ca~lattice:0.6"}) {
    EXPECT_EQ(split_stress(name), std::nullopt) << name;
  }
}

TEST(Stress, EveryKindIsCompleteAndNamedOnce) {
  std::set<std::string> names;
  for (const StressKind& kind : stress_kinds()) {
    EXPECT_TRUE(names.insert(kind.name).second) << kind.name;
    EXPECT_FALSE(kind.title.empty() || kind.meaning.empty()) << kind.name;
    EXPECT_LT(kind.least, kind.most) << kind.name;
  }
  EXPECT_EQ(names, (std::set<std::string>{"boundary", "clusters", "gradient", "lattice", "noise", "outliers",
                                          "poisson"}));
}

TEST(Stress, AnyShapeCanBeSampledWithAnyKind) {
  const std::vector<DatasetInfo> infos = datasets();
  EXPECT_EQ(find_dataset(infos, "ca~noise:0.5")->name, "ca");
  EXPECT_EQ(find_dataset(infos, "star-17~outliers:5")->name, "star");
  for (const char* name :
       {"ca~noise:99", "star~noise:1", "floor-1~noise:1", "degenerate_one~noise:1", "~noise:1"})
    EXPECT_EQ(find_dataset(infos, name), nullptr) << name;
  EXPECT_EQ(make_point_set("hi~noise:1", true, 50, 1).ground_truth, make_ground_truth("hi", true));
  EXPECT_EQ(make_ground_truth("ca~outliers:5", false), make_ground_truth("ca", false));
}

TEST(Stress, UnknownStressIsRefusedWithTheKnownOnes) {
  try {
    make_point_set("ca~noise:99", false, 10, 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("there is no data set 'ca~noise:99'; choose one of: ca, hi, ")) << text;
    EXPECT_NE(text.find("one of: ~noise:LEVEL (0 to 10) ~outliers:LEVEL (0 to 90)"), std::string::npos)
        << text;
  }
}

TEST(Stress, BaseShapesAndLevelsAreToldFromTheName) {
  const std::map<std::string, std::string> bases{{"ca", "ca"},
                                                 {"ca~noise:0.5", "ca"},
                                                 {"star-17", "star-17"},
                                                 {"star-17~outliers:5", "star-17"},
                                                 {"channel-4", "channel"},
                                                 {"channel-4~noise:1", "channel"},
                                                 {"degenerate_one", "degenerate_one"},
                                                 {"what~ever", "what~ever"}};
  for (const auto& [name, base] : bases) EXPECT_EQ(base_shape(name), base) << name;
  using Levels = std::map<std::string, double>;
  EXPECT_EQ(levels_of("ca"), Levels());
  EXPECT_EQ(levels_of("star-17"), Levels());
  EXPECT_EQ(levels_of("ca~noise:0.5"), (Levels{{"noise", 0.5}}));
  EXPECT_EQ(levels_of("squares-3"), (Levels{{"gap", 3}}));
  EXPECT_EQ(levels_of("channel-4~noise:1"), (Levels{{"noise", 1}, {"width", 4}}));
}

// The levels of a stress share their random numbers, and the one that changes nothing is the plain sample.
TEST(Stress, NoStressIsTheUniformSample) {
  for (const std::string& shape : kShapes) {
    const std::vector<Point> plain = points_of(shape, 300);
    for (const char* stress : {"~noise:0", "~outliers:0", "~gradient:1", "~boundary:0"})
      EXPECT_EQ(points_of(shape + stress, 300), plain) << shape << stress;
  }
}

TEST(Stress, CountsAreExact) {
  for (const std::string& shape : kShapes) {
    for (const char* stress : {"noise:2", "outliers:20", "gradient:16", "clusters:16", "poisson:0.7",
                               "lattice:0", "lattice:0.25", "boundary:100", "boundary:33"}) {
      for (const std::size_t n : {7U, 500U, 2000U})
        EXPECT_EQ(points_of(shape + "~" + stress, n).size(), n) << shape << "~" << stress;
    }
  }
}

TEST(Stress, PointsLieInTheShapeWhereTheyMust) {
  for (const std::string& shape : kShapes) {
    const PointLocator locator(make_ground_truth(shape, false));
    for (const char* stress : {"gradient:16", "clusters:16", "poisson:0.7", "lattice:0", "lattice:0.5"}) {
      const std::vector<Point> points = points_of(shape + "~" + stress, 1000);
      EXPECT_TRUE(std::all_of(points.begin(), points.end(),
                              [&](const Point& point) { return locator.contains(point); }))
          << shape << "~" << stress;
    }
  }
}

TEST(Stress, NoiseIsGaussianOfItsStandardDeviation) {
  constexpr std::size_t kPoints = 4000;
  const std::vector<Point> plain = points_of("ca", kPoints);
  const std::vector<Point> noisy = points_of("ca~noise:0.5", kPoints);
  const double deviation = 0.5 * spacing("ca", kPoints);
  double sum = 0;
  double squares = 0;
  double within = 0;
  for (std::size_t i = 0; i < kPoints; ++i) {
    for (const double move : {noisy[i].x - plain[i].x, noisy[i].y - plain[i].y}) {
      sum += move / deviation;
      squares += move / deviation * (move / deviation);
      within += std::abs(move) < deviation ? 1 : 0;
    }
  }
  constexpr double kMoves = 2 * kPoints;
  EXPECT_NEAR(sum / kMoves, 0, 5 / std::sqrt(kMoves));
  EXPECT_NEAR(squares / kMoves, 1, 5 * std::sqrt(2 / kMoves));
  EXPECT_NEAR(within / kMoves, 0.6827, 5 * std::sqrt(0.6827 * 0.3173 / kMoves));
}

TEST(Stress, OutliersHaveTheirShareAndPlace) {
  constexpr std::size_t kPoints = 2000;
  const std::vector<Point> plain = points_of("ca", kPoints);
  const std::vector<Point> points = points_of("ca~outliers:10", kPoints);
  EXPECT_TRUE(std::equal(points.begin(), points.begin() + 1800, plain.begin()));
  const PointLocator locator(make_ground_truth("ca", false));
  const auto& box = locator.bounds();
  const double side = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  std::size_t inside = 0;
  std::size_t outside_box = 0;
  for (std::size_t i = 1800; i < kPoints; ++i) {
    const Point& point = points[i];
    EXPECT_TRUE(point.x >= box.min.x - side / 10 && point.x <= box.max.x + side / 10);
    EXPECT_TRUE(point.y >= box.min.y - side / 10 && point.y <= box.max.y + side / 10);
    inside += locator.contains(point) ? 1U : 0U;
    outside_box +=
        point.x < box.min.x || point.x > box.max.x || point.y < box.min.y || point.y > box.max.y ? 1U : 0U;
  }
  const double grown = (box.max.x - box.min.x + side / 5) * (box.max.y - box.min.y + side / 5);
  const auto expect_share = [](std::size_t count, double share) {
    EXPECT_NEAR(static_cast<double>(count) / 200, share, 5 * std::sqrt(share * (1 - share) / 200));
  };
  expect_share(inside, polylidar::area(make_ground_truth("ca", false)) / grown);
  expect_share(outside_box, 1 - (box.max.x - box.min.x) * (box.max.y - box.min.y) / grown);
}

TEST(Stress, GradientFallsFromLeftToRight) {
  // Density 4 at the left, 2.5 in the middle, 1 at the right: 3.25 to 1.75 in the halves.
  const std::vector<Point> points = sample("gradient", square(), 4000, 4);
  const auto left =
      std::count_if(points.begin(), points.end(), [](const Point& point) { return point.x < 5; });
  EXPECT_NEAR(static_cast<double>(left) / 4000, 0.65, 5 * std::sqrt(0.65 * 0.35 / 4000));
}

TEST(Stress, ClustersAreThomass) {
  // Ripley's K of a Thomas process with clusters of m points and standard deviation s, in squared spacings:
  // K(r) = pi r^2 + m (1 - exp(-r^2 / (4 s^2))), here for r = 2, s = 1: 12.57 + 0.632 m. Counted round the
  // points that are 2 spacings or more from the boundary. The tolerance is five times the spread that ten
  // seeds of a simulation with another generator had, 0.15 (m = 4) and 0.62 (m = 16).
  constexpr std::size_t kPoints = 10'000;
  const std::map<double, double> tolerances{{4, 0.75}, {16, 3.1}};
  for (const auto& [level, tolerance] : tolerances) {
    const std::vector<Point> points = sample("clusters", square(), kPoints, level);
    double pairs = 0;
    double centres = 0;
    for (const Point& centre : points) {
      if (std::min({centre.x, centre.y, 10 - centre.x, 10 - centre.y}) < 0.2) continue;
      centres += 1;
      for (const Point& other : points) pairs += &other != &centre && distance(centre, other) < 0.2 ? 1 : 0;
    }
    EXPECT_NEAR(pairs / centres, 12.566 + 0.6321 * level, tolerance) << level;
  }
}

TEST(Stress, PoissonDisksKeepTheirDistance) {
  for (const std::string& shape : kShapes) {
    const std::vector<double> nearest = nearest_distances(points_of(shape + "~poisson:0.7", 1000));
    const double h = spacing(shape, 1000);
    EXPECT_GE(*std::min_element(nearest.begin(), nearest.end()), 0.7 * h) << shape;
  }
  EXPECT_EQ(sample("poisson", square(), 1000, 0.75).size(), 1000U);
}

TEST(Stress, LatticeHasItsSide) {
  const std::vector<Point> points = points_of("ca~lattice:0", 1000);
  const double h = spacing("ca", 1000);
  std::vector<double> nearest = nearest_distances(points);
  for (const double one : nearest) EXPECT_GE(one, h * (1 - 1e-9));  // rounding of coordinates up to 1000 h
  const auto at_one_side =
      std::count_if(nearest.begin(), nearest.end(), [&](double one) { return one <= h * (1 + 1e-9); });
  EXPECT_GE(at_one_side, 990);  // a point may stand alone in a corner of the shape
  // Not along the axes, where its rows would fall on edges of the shape.
  const std::set<double> heights = [&] {
    std::set<double> result;
    for (const Point& point : points) result.insert(std::round(point.y / h * 1e6));
    return result;
  }();
  EXPECT_GT(heights.size(), 900U);
}

TEST(Stress, JitteredLatticeMovesEveryPointByAtMostItsLevel) {
  // Neighbours along a row come nearer by at most two moves of a quarter.
  const std::vector<double> nearest = nearest_distances(points_of("ca~lattice:0.25", 1000));
  const double h = spacing("ca", 1000);
  EXPECT_GE(*std::min_element(nearest.begin(), nearest.end()), 0.5 * h * (1 - 1e-9));
  EXPECT_LT(*std::min_element(nearest.begin(), nearest.end()), 0.7 * h);
}

TEST(Stress, BoundaryPointsLieOnTheRings) {
  const MultiPolygon shape = make_ground_truth("annulus-8", false);
  const std::vector<Point> points = points_of("annulus-8~boundary:100", 2000);
  double on_hole = 0;
  for (const Point& point : points) {
    const double to_shell = testing::boost_distance(point, shape[0].shell);
    const double to_hole = testing::boost_distance(point, shape[0].holes[0]);
    EXPECT_LE(std::min(to_shell, to_hole), 1e-13);  // coordinates up to 27, rounded to 1.8e-15 a few times
    on_hole += to_hole < to_shell ? 1 : 0;
  }
  const double outer = std::hypot(shape[0].shell[0].x, shape[0].shell[0].y);
  const double share = 8 / (8 + outer);
  EXPECT_NEAR(on_hole / 2000, share, 5 * std::sqrt(share * (1 - share) / 2000));

  const std::vector<Point> half = points_of("annulus-8~boundary:50", 2000);
  const std::vector<Point> plain = points_of("annulus-8", 2000);
  EXPECT_TRUE(std::equal(half.begin(), half.begin() + 1000, plain.begin()));
}

TEST(Stress, SeedChangesThePoints) {
  for (const StressKind& kind : stress_kinds()) {
    EXPECT_NE(kind.sample(square(), 50, kind.most / 2, 1), kind.sample(square(), 50, kind.most / 2, 2))
        << kind.name;
    EXPECT_EQ(kind.sample(square(), 50, kind.most / 2, 1), kind.sample(square(), 50, kind.most / 2, 1))
        << kind.name;
  }
}

TEST(Stress, GoldenSamples) {
  // Hashes of what this code gave when it was written: a change of any bit of any point shows here, and makes
  // results incomparable with those recorded before.
  const std::map<std::string, std::string> expected{
      {"ca~boundary:100", "45409de926de8399e3fe18bc70e64ebb5028230cfaf6c172545e04d91e104b8c"},
      {"ca~clusters:4", "6a528cd51bfc82e0e5878024461d1fec4741d5abcb78f64359e8720b59ba4fb3"},
      {"ca~gradient:4", "843054ed0c363bde8cb0f00089cbbe3c6d404794667b1717950e6c10d4581618"},
      {"ca~lattice:0", "0c6c440c982acc508d1f99cdc4abb88f3948aae44f9379bac10795d0777d6275"},
      {"ca~lattice:0.25", "97827e7be4da705dd13e46c9274e271ce825a560cbe3b410925472c67940724b"},
      {"ca~noise:0.5", "f10570ebf6130c7ebaede85d96120414847bf2c9257dbe85522eb4b3ecc1755c"},
      {"ca~outliers:5", "2ad8783a3c8e1fc7779f3ab0a7c5c625492fc43ccffd09fd87f836043de48e7e"},
      {"ca~poisson:0.7", "6ba4749c7204f8b3a3d179e0338872c381de4d7b3872176fbf775e585124bbfd"},
      {"nested-1~boundary:100", "005f5d0c9b01a24c6be2212c227bfeea884430efe241959ad027a8f8ba3122ac"},
      {"nested-1~clusters:16", "f9691e4289edf305cb460eb3299a1a3e37f2b8c3165ba5a811b7c49d95a50d58"},
      {"nested-1~noise:2", "ed1cd89ea09af1a21f2450218de9c266da1f0f042594be6223a3f219086f7e33"},
      {"parts-1~poisson:0.7", "acfa8b243a202c061468953e15afe2f2d76ab692356e4af886ee0ab12c0706be"},
      {"channel-4~outliers:20", "0dab43b3bc5f22fcbdb3cb8706053234c0ce1b9bb7c3858fb3caa6afe4deefc7"},
  };
  for (const auto& [name, sha256] : expected)
    EXPECT_EQ(make_point_set(name, false, 1000, 1).sha256, sha256) << name;
}

}  // namespace
}  // namespace hullbench
