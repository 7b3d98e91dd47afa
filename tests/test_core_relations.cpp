// Relations between inputs: points in general position, and where ties abound or magnitudes are extreme.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "polylidar/check.hpp"
#include "polylidar/concave_hull.hpp"
#include "polylidar/delaunay.hpp"
#include "tests/checked_hull.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/point_sets.hpp"

namespace polylidar {
namespace {

using testing::canonical;
using testing::checked_hull;
using testing::Exponents;
using testing::kLargestSpan;
using testing::kUnitCells;
using testing::lattice;
using testing::PointSet;
using testing::Random;
using testing::scaled;

// x -> sign * 2^exponent * x + offset for each axis, after which the axes may change places. Exact for the
// integers used here: there `exponent` is not 0 only where `offset` is.
struct LatticeMotion {
  double sign_x = 1;
  double sign_y = 1;
  int exponent = 0;
  Point offset = {};
  bool swaps_axes = false;

  Point operator()(const Point& p) const {
    const Point moved = {std::ldexp(sign_x * p.x, exponent) + offset.x,
                         std::ldexp(sign_y * p.y, exponent) + offset.y};
    return swaps_axes ? Point{moved.y, moved.x} : moved;
  }
  bool mirrors() const { return (sign_x * sign_y < 0) != swaps_axes; }

  static LatticeMotion random(Random& random) {
    LatticeMotion motion;
    if (random.below(2) == 0) motion.sign_x = -1;
    if (random.below(2) == 0) motion.sign_y = -1;
    motion.swaps_axes = random.below(2) == 0;
    if (random.below(2) == 0) {
      motion.exponent = static_cast<int>(random.integer(490));
    } else {
      motion.offset = {random.integer(std::int64_t{1} << random.below(50)),
                       random.integer(std::int64_t{1} << random.below(50))};
    }
    return motion;
  }
};

std::ostream& operator<<(std::ostream& out, const LatticeMotion& motion) {
  return out << "signs " << motion.sign_x << ' ' << motion.sign_y << ", exponent " << motion.exponent
             << ", offset " << motion.offset.x << ' ' << motion.offset.y
             << (motion.swaps_axes ? ", axes swapped" : "");
}

std::vector<Point> moved(std::vector<Point> points, const LatticeMotion& motion) {
  for (Point& point : points) point = motion(point);
  return points;
}

MultiPolygon moved(MultiPolygon shape, const LatticeMotion& motion) {
  const auto move_ring = [&](Ring& ring) {
    ring = moved(ring, motion);
    if (motion.mirrors()) std::reverse(ring.begin(), ring.end());
  };
  for (Polygon& polygon : shape) {
    move_ring(polygon.shell);
    for (Ring& hole : polygon.holes) move_ring(hole);
  }
  return shape;
}

// Points whose Delaunay triangulation is the only one, so that a relation has one right answer.
std::vector<Point> points_in_general_position(std::uint64_t seed) {
  std::vector<Point> points = testing::integer_points(150 + 5 * seed, seed, 1 << 20);
  EXPECT_TRUE(testing::is_unique(points, delaunay(points))) << "seed " << seed;
  return points;
}

class ConcaveHullRelations : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  const std::vector<Point> points_ = points_in_general_position(GetParam());
  const std::vector<Options> options_ = testing::clear_options(points_, delaunay(points_));
};

TEST_P(ConcaveHullRelations, MotionsMoveTheShapeAlong) {
  const std::vector<LatticeMotion> motions = {{.sign_x = -1},
                                              {.sign_y = -1},
                                              {.swaps_axes = true},
                                              {.sign_y = -1, .swaps_axes = true},  // a quarter turn
                                              {.offset = {0x1p30, -0x1p27}},
                                              {.exponent = 3},
                                              {.exponent = 300},
                                              {.exponent = -300}};
  for (const Options& options : options_) {
    SCOPED_TRACE(testing::describe(options));
    const MultiPolygon shape = checked_hull(points_, options);
    for (const LatticeMotion& motion : motions) {
      SCOPED_TRACE(::testing::PrintToString(motion));
      EXPECT_EQ(
          canonical(checked_hull(moved(points_, motion), scaled(options, std::ldexp(1.0, motion.exponent)))),
          canonical(moved(shape, motion)));
    }
  }
}

TEST_P(ConcaveHullRelations, TheOrderOfPointsDoesNotMatter) {
  for (const Options& options : options_) {
    SCOPED_TRACE(testing::describe(options));
    const MultiPolygon shape = canonical(checked_hull(points_, options));
    for (std::uint64_t order = 0; order < 3; ++order) {
      EXPECT_EQ(canonical(checked_hull(testing::shuffled(points_, order), options)), shape)
          << "order " << order;
    }
  }
}

TEST_P(ConcaveHullRelations, RepeatedPointsDoNotMatter) {
  Random random(GetParam());
  std::vector<Point> repeated = points_;
  for (int i = 0; i < 100; ++i) repeated.push_back(repeated[random.below(repeated.size())]);
  for (const Options& options : options_) {
    SCOPED_TRACE(testing::describe(options));
    const MultiPolygon shape = canonical(checked_hull(points_, options));
    EXPECT_EQ(canonical(checked_hull(repeated, options)), shape);
    EXPECT_EQ(canonical(checked_hull(testing::shuffled(repeated, GetParam()), options)), shape);
  }
}

// A larger limit keeps all triangles that a smaller one keeps.
TEST_P(ConcaveHullRelations, LargerLimitsGiveLargerShapes) {
  for (const auto which : {&Options::alpha, &Options::max_edge_length, &Options::max_perimeter}) {
    double before = 0;
    for (int k = 0; k < 44; ++k) {
      Options options;
      options.*which = 0x1p10 * std::pow(1.25, k);  // up to 2^24
      const double now = area(checked_hull(points_, options));
      EXPECT_GE(now, before) << testing::describe(options);
      before = now;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ConcaveHullRelations, ::testing::Range(std::uint64_t{0}, std::uint64_t{20}));

// The same points, some of them repeated, in another order.
std::vector<Point> disarranged(std::vector<Point> points, Random& random) {
  if (points.empty()) return points;
  for (std::size_t i = random.below(points.size()); i > 0; --i)
    points.push_back(points[random.below(points.size())]);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
  return points;
}

class CoreRelations : public ::testing::TestWithParam<std::uint64_t> {};

// Order, repetition and motion at once.
TEST_P(CoreRelations, LatticesWithGapsKeepTheirShape) {
  Random random(GetParam());
  const double density = random.between(0.4, 1);
  std::vector<Point> points;
  for (const Point& point : lattice(20, 20, 1, {-7, -9})) {
    if (random.unit() < density) points.push_back(point);
  }
  const MultiPolygon shape = checked_hull(points, kUnitCells);
  for (int i = 0; i < 10; ++i) {
    const LatticeMotion motion = LatticeMotion::random(random);
    SCOPED_TRACE(::testing::PrintToString(motion));
    const std::vector<Point> other = moved(disarranged(points, random), motion);
    EXPECT_EQ(canonical(checked_hull(other, scaled(kUnitCells, std::ldexp(1.0, motion.exponent)))),
              canonical(moved(shape, motion)));
  }
}

// The convex hull does not depend on ties either: it has every point of its boundary as a vertex.
TEST_P(CoreRelations, SmallIntegersKeepTheirConvexHull) {
  Random random(GetParam());
  const auto side = static_cast<std::int64_t>(2 + random.below(12));
  const std::vector<Point> points = testing::integer_points(3 + random.below(60), GetParam(), side);
  const Options all{.detail = 1e-6};
  const MultiPolygon shape = checked_hull(points, all);
  for (int i = 0; i < 10; ++i) {
    const LatticeMotion motion = LatticeMotion::random(random);
    SCOPED_TRACE(::testing::PrintToString(motion));
    EXPECT_EQ(canonical(checked_hull(moved(disarranged(points, random), motion), all)),
              canonical(moved(shape, motion)));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, CoreRelations, ::testing::Range(std::uint64_t{0}, std::uint64_t{60}));

// A power of two changes no bit of any coordinate, so the same triangles come out in the same order.
TEST(PowersOfTwo, ChangeNoIndexOfAnyShape) {
  Extractor extractor;
  for (const PointSet& set : testing::nasty_point_sets()) {
    SCOPED_TRACE(set.name);
    const auto range = testing::exponents(set.points);
    if (!range || range->least < -200 || range->greatest > 200) continue;
    const std::vector<Options> all = testing::clear_options(set.points, delaunay(set.points));
    std::vector<IndexedMultiPolygon> shapes(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) shapes[i] = concave_hull(set.points, all[i]);
    for (int exponent = -490; exponent <= 490; exponent += 70) {
      SCOPED_TRACE("exponent " + std::to_string(exponent));
      const std::vector<Point> points = scaled(set.points, exponent, exponent);
      const auto options = [&](std::size_t i) { return scaled(all[i], std::ldexp(1.0, exponent)); };
      // Triangulated once for all limits, and once more for one of them.
      extractor.triangulate(points);
      for (std::size_t i = 0; i < all.size(); ++i) {
        extractor.extract_regions(options(i));
        EXPECT_EQ(extractor.extract_polygons(), shapes[i]) << testing::describe(all[i]);
      }
      if (all.empty()) continue;
      const std::size_t turn = static_cast<std::size_t>(exponent + 490) / 70 % all.size();
      EXPECT_EQ(concave_hull(points, options(turn)), shapes[turn]) << testing::describe(all[turn]);
    }
  }
}

// Each axis with a magnitude of its own, from 1e-150 to 1e150: what is not refused is right, and the same as
// at a size that needs no scaling inside.
TEST(Magnitudes, MixedAreEitherRightOrRefused) {
  const std::vector<std::vector<Point>> sets = {
      testing::uniform_points(60, 50), testing::integer_points(60, 51, 16), lattice(8, 8, 1, {-3, -3}),
      testing::circle(40, 1), testing::rotated(lattice(30, 1, 1, {1, 0}), 0.3)};
  std::size_t right = 0;
  std::size_t refused = 0;
  for (const std::vector<Point>& set : sets) {
    for (int exponent_x = -498; exponent_x <= 498; exponent_x += 83) {
      for (int exponent_y = -498; exponent_y <= 498; exponent_y += 83) {
        SCOPED_TRACE("exponents " + std::to_string(exponent_x) + " and " + std::to_string(exponent_y));
        const std::vector<Point> points = scaled(set, exponent_x, exponent_y);
        const Exponents range = testing::exponents(points).value();
        if (range.greatest - range.least > kLargestSpan) {
          ++refused;
          hullbench::testing::expect_complaint<std::invalid_argument>([&] { concave_hull(points); },
                                                                      "magnitude");
          continue;
        }
        ++right;
        EXPECT_EQ(check_triangulation(points, delaunay(points)), "");
        const int to_middle = 149 - range.greatest;
        for (const Options& options : testing::clear_options(points, delaunay(points))) {
          SCOPED_TRACE(testing::describe(options));
          const IndexedMultiPolygon shape = concave_hull(points, options);
          EXPECT_EQ(check_polygon(points, shape), "");
          EXPECT_EQ(
              concave_hull(scaled(points, to_middle, to_middle), scaled(options, std::ldexp(1.0, to_middle))),
              shape);
        }
      }
    }
  }
  EXPECT_GT(right, 100U);
  EXPECT_GT(refused, 100U);
}

// Magnitudes mixed point by point, up to the last span that is allowed and the first that is not.
TEST(Magnitudes, MixedWithinAnAxisAreEitherRightOrRefused) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto span = static_cast<int>(random.below(300));
    const auto least = static_cast<int>(random.integer(498));
    const auto coordinate = [&](int exponent) {
      return std::ldexp((1 + random.unit()) * (random.below(2) == 0 ? -1 : 1), exponent);
    };
    std::vector<Point> points = {{coordinate(least), coordinate(least + span)}};
    for (int i = 0; i < 40; ++i) {
      points.push_back(
          {coordinate(least + static_cast<int>(random.below(static_cast<std::size_t>(span) + 1))),
           coordinate(least + static_cast<int>(random.below(static_cast<std::size_t>(span) + 1)))});
    }
    if (span > kLargestSpan) {
      EXPECT_THROW(delaunay(points), std::invalid_argument);
    } else {
      EXPECT_EQ(check_triangulation(points, delaunay(points)), "");
      checked_hull(points, {.alpha = std::ldexp(1.0, least + span / 2)});
    }
  }
}

TEST(Magnitudes, TheWidestSpanIsRightAndTheNextIsRefused) {
  for (const int least : {-700, -300, -116, 0, 300, 700}) {
    SCOPED_TRACE("least exponent " + std::to_string(least));
    const double small = std::ldexp(1.0, least);
    const double large = std::ldexp(1.999, least + kLargestSpan);
    std::vector<Point> points = {{small, small}, {large, small}, {small, large}, {-large, -3 * small}};
    EXPECT_EQ(check_triangulation(points, delaunay(points)), "");
    EXPECT_EQ(checked_hull(points, testing::kConvexHull).size(), 1U);
    points[1].x = std::ldexp(1.0, least + kLargestSpan + 1);
    EXPECT_THROW(delaunay(points), std::invalid_argument);
    EXPECT_THROW(concave_hull(points), std::invalid_argument);
  }
}

// The whole range of doubles, subnormal ones included, is too wide only for sets that span it.
TEST(Magnitudes, TheExtremesOfDoublesAreRight) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  for (const double unit : {kLeast, 0x1p-1022, 0x1p1019}) {
    SCOPED_TRACE(unit);
    const std::vector<Point> points = lattice(9, 9, unit, {-4 * unit, -4 * unit});
    EXPECT_EQ(check_triangulation(points, delaunay(points)), "");
    EXPECT_EQ(checked_hull(points, testing::kConvexHull).size(), 1U);
  }
  const std::vector<Point> corners = {
      {-kLargest, -kLargest}, {kLargest, -kLargest}, {kLargest, kLargest}, {-kLargest, kLargest}, {0, 0},
      {kLargest / 2, 1e300}};
  EXPECT_EQ(check_triangulation(corners, delaunay(corners)), "");
  EXPECT_EQ(checked_hull(corners, {}).size(), 1U);
}

}  // namespace
}  // namespace polylidar
