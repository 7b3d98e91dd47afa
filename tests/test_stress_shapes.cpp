// Shapes with one feature of a given size, and points that break assumptions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/datasets.hpp"
#include "datasets/degenerate.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/sha256.hpp"
#include "datasets/stress_shapes.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/boost_checks.hpp"

namespace hullbench::testing {
namespace {

// Of lengths up to 100, rounded to 1.4e-14, after a few operations.
constexpr double kStressRounding = 1e-12;

MultiPolygon member(const std::string& family, int number) {
  return make_ground_truth(family + "-" + std::to_string(number), false);
}

TEST(GradedShapes, AllCoverTheSameAreaAndAreValid) {
  EXPECT_EQ(graded_shapes().size(), 9U);
  for (const GradedShape& kind : graded_shapes()) {
    for (std::size_t size = 1; size <= kGradedMembers; ++size) {
      const MultiPolygon shape = kind.make(static_cast<double>(size));
      EXPECT_NEAR(polylidar::area(shape), kGradedArea, kGradedArea * 1e-14) << kind.name << size;
      EXPECT_EQ(boost_fault(shape), "") << kind.name << size;
      EXPECT_EQ(shape, member(kind.name, static_cast<int>(size)));
    }
  }
}

TEST(GradedShapes, HolesHaveTheirRadius) {
  const std::map<std::string, std::size_t> holes{{"pierced", 4}, {"annulus", 1}, {"windows", 9}};
  for (const auto& [name, count] : holes) {
    for (const int size : {1, 4, 10}) {
      const Polygon polygon = member(name, size).at(0);
      ASSERT_EQ(polygon.holes.size(), count) << name;
      for (const Ring& hole : polygon.holes) {
        const polylidar::Box box = polylidar::bounding_box(hole);
        EXPECT_NEAR(box.max.x - box.min.x, 2 * size, kStressRounding) << name;
        EXPECT_NEAR(box.max.y - box.min.y, 2 * size, kStressRounding) << name;
        EXPECT_LT(polylidar::signed_area(hole), 0) << name;
        // So wide that what is between two holes, or a hole and the shell, is no feature itself.
        for (const Point& corner : hole) EXPECT_GT(boost_distance(corner, polygon.shell), 2) << name << size;
      }
    }
  }
}

/// The lengths into which the ring cuts the horizontal line at `y`, from left to right: in the ring, out of
/// it, in it ...
std::vector<double> stretches(const Ring& ring, double y) {
  std::vector<double> crossings;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point& a = ring[i];
    const Point& b = ring[(i + 1) % ring.size()];
    if ((a.y < y) != (b.y < y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::ranges::sort(crossings);
  std::vector<double> lengths;
  for (std::size_t i = 1; i < crossings.size(); ++i) lengths.push_back(crossings[i] - crossings[i - 1]);
  return lengths;
}

TEST(GradedShapes, FeaturesHaveTheirWidth) {
  for (const int size : {1, 4, 10}) {
    const Ring channel = member("channel", size).at(0).shell;
    const double side = polylidar::bounding_box(channel).max.y;
    EXPECT_EQ(stretches(channel, 0.39 * side).size(), 1U);
    EXPECT_NEAR(stretches(channel, 0.41 * side).at(1), size, kStressRounding);

    const Ring peninsula = member("peninsula", size).at(0).shell;
    const double top = polylidar::bounding_box(peninsula).max.y;
    EXPECT_NEAR(stretches(peninsula, 0.99 * top).at(0), size, kStressRounding);
    EXPECT_GT(stretches(peninsula, top / 1.6 * 0.99).at(0), 30);

    const Ring teeth = member("teeth", size).at(0).shell;
    const double tips = polylidar::bounding_box(teeth).max.y;
    const std::vector<double> along = stretches(teeth, tips - 24);
    EXPECT_GE(along.size(), 3U);
    for (const double length : along) EXPECT_NEAR(length, size, kStressRounding);
    EXPECT_EQ(stretches(teeth, tips - 26).size(), 1U);
  }
}

TEST(GradedShapes, PartsHaveTheirGap) {
  const std::map<std::string, std::size_t> parts{{"squares", 4}, {"discs", 9}, {"strips", 5}};
  for (const auto& [name, count] : parts) {
    for (const int size : {1, 4, 10}) {
      const MultiPolygon shape = member(name, size);
      ASSERT_EQ(shape.size(), count) << name;
      for (const Polygon& polygon : shape) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Polygon& other : shape) {
          if (other == polygon) continue;
          for (const Point& corner : other.shell)
            nearest = std::min(nearest, boost_distance(corner, polygon.shell));
        }
        EXPECT_NEAR(nearest, size, kStressRounding) << name;
      }
    }
  }
}

const DegenerateInput& input(const std::string& name) {
  return *std::find_if(degenerate_inputs().begin(), degenerate_inputs().end(),
                       [&](const DegenerateInput& one) { return one.name == "degenerate_" + name; });
}

/// Boost.Geometry's fault in the shape of 2^27 times the size: it takes lengths of 1e-8 for rounding. The
/// factor changes no digit.
std::string fault_of(MultiPolygon shape) {
  const auto enlarge = [](Ring& ring) {
    for (Point& point : ring) point = {point.x * 0x1p27, point.y * 0x1p27};
  };
  for (Polygon& polygon : shape) {
    enlarge(polygon.shell);
    for (Ring& hole : polygon.holes) enlarge(hole);
  }
  return boost_fault(shape);
}

TEST(DegenerateInputs, AreDataSetsWithTheirOwnPoints) {
  for (const DegenerateInput& one : degenerate_inputs()) {
    const PointSet set = make_point_set(one.name, false, 0, 1);
    EXPECT_EQ(set.points, one.points) << one.name;
    EXPECT_EQ(set.ground_truth, one.ground_truth) << one.name;
    EXPECT_EQ(set.ground_truth_area, polylidar::area(one.ground_truth)) << one.name;
    EXPECT_EQ(make_ground_truth(one.name, false), one.ground_truth) << one.name;
    EXPECT_EQ(make_point_set(one.name, false, 0, 2).points, one.points) << one.name;
    EXPECT_THROW(make_point_set(one.name, false, 10, 1), std::invalid_argument) << one.name;
    EXPECT_EQ(fault_of(one.ground_truth), "") << one.name;
  }
}

TEST(DegenerateInputs, AreWhatTheirNamesSay) {
  EXPECT_EQ(input("empty").points.size(), 0U);
  EXPECT_EQ(input("one").points.size(), 1U);
  EXPECT_EQ(input("two").points.size(), 2U);
  EXPECT_EQ(input("three").points.size(), 3U);
  for (const Point& point : input("equal").points) EXPECT_EQ(point, input("equal").points.front());
  for (const Point& point : input("collinear").points) EXPECT_EQ(point.y, 2 * point.x);
  const auto& plus_one = input("collinear_plus_one").points;
  EXPECT_EQ(std::ranges::count_if(plus_one, [](const Point& point) { return point.y != 2 * point.x; }), 1);
  std::map<std::pair<double, double>, int> times;
  for (const Point& point : input("duplicates").points) ++times[{point.x, point.y}];
  EXPECT_EQ(times.size(), 100U);
  for (const auto& [place, count] : times) EXPECT_EQ(count, 10);
  std::set<std::pair<double, double>> on_circle;
  for (const Point& point : input("cocircular").points) {
    EXPECT_EQ(point.x * point.x + point.y * point.y, 32045.0 * 32045.0);  // whole numbers below 2^53: exact
    on_circle.insert({point.x, point.y});
  }
  EXPECT_EQ(on_circle.size(), 324U);  // 4 * 3^4 ways to write 5^2 13^2 17^2 29^2 as a sum of two squares
  EXPECT_EQ(input("lattice").points.size(), 1024U);
}

TEST(DegenerateInputs, Golden) {
  std::string bytes;
  for (const DegenerateInput& one : degenerate_inputs()) bytes += one.name + point_bytes(one.points);
  EXPECT_EQ(sha256_hex(bytes), "acf7551d50f0e454b3ad3e82e8a29ea14a1579e9499600d77e7fc8985d089c63");
}

// What every method is asked for in the plan stress_degenerate, of the core: a valid shape, and an empty one
// where the points have none.
TEST(DegenerateInputs, TheCoreHasAnAnswerToEach) {
  for (const DegenerateInput& one : degenerate_inputs()) {
    const double n = std::max<double>(1, static_cast<double>(one.points.size()));
    const double alpha = 2 * std::sqrt(polylidar::area(one.ground_truth) / n);
    for (const double limit : {std::numeric_limits<double>::infinity(), alpha, 0.0}) {
      polylidar::Options options;
      options.alpha = limit;
      const MultiPolygon shape =
          polylidar::to_coordinates(polylidar::concave_hull(one.points, options), one.points);
      EXPECT_EQ(fault_of(shape), "") << one.name << " " << limit;
      if (limit > alpha) {
        EXPECT_EQ(shape.empty(), one.ground_truth.empty()) << one.name;
      }
      if (limit == 0) {
        EXPECT_TRUE(shape.empty()) << one.name;
      }
    }
  }
}

}  // namespace
}  // namespace hullbench::testing
