#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "datasets/datasets.hpp"
#include "datasets/sampling.hpp"
#include "tests/boost_checks.hpp"

namespace hullbench::testing {
namespace {

using polylidar::MultiPolygon;
using polylidar::Point;

/// Even-odd over every edge in plain floating point: shares nothing with PointLocator. Rounding could mislead
/// it only within about 1e-13 of an edge, where no sample of these tests lies.
bool is_inside(const MultiPolygon& shape, const Point& point) {
  bool inside = false;
  for (const polylidar::Ring& ring : rings_of(shape)) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Point& a = ring[i];
      const Point& b = ring[j];
      const bool straddles = (a.y > point.y) != (b.y > point.y);
      if (straddles && point.x < a.x + (b.x - a.x) * (point.y - a.y) / (b.y - a.y)) inside = !inside;
    }
  }
  return inside;
}

struct Variant {
  std::string name;
  bool holes;

  friend std::ostream& operator<<(std::ostream& out, const Variant& variant) {
    return out << variant.name << (variant.holes ? " with holes" : "");
  }
};

class SamplesOf : public ::testing::TestWithParam<Variant> {};

INSTANTIATE_TEST_SUITE_P(States, SamplesOf,
                         ::testing::Values(Variant{"ca", false}, Variant{"ca", true}, Variant{"hi", false},
                                           Variant{"hi", true}),
                         [](const auto& variant) {
                           return variant.param.name + (variant.param.holes ? "_with_holes" : "");
                         });

TEST_P(SamplesOf, LieInsideByASimpleTest) {
  const PointSet set = make_point_set(GetParam().name, GetParam().holes, 8000, 5);
  ASSERT_EQ(set.points.size(), 8000U);
  for (const Point& point : set.points)
    ASSERT_TRUE(is_inside(set.ground_truth, point)) << point.x << ' ' << point.y;
}

TEST_P(SamplesOf, LieInsideByBoostGeometry) {
  const PointSet set = make_point_set(GetParam().name, GetParam().holes, 3000, 6);
  EXPECT_EQ(boost_outside(set.ground_truth, set.points), std::vector<Point>{});
}

TEST_P(SamplesOf, ReachEveryPolygonInProportionToItsArea) {
  constexpr std::size_t kPoints = 100'000;
  const PointSet set = make_point_set(GetParam().name, GetParam().holes, kPoints, 7);
  for (const polylidar::Polygon& polygon : set.ground_truth) {
    std::size_t count = 0;
    for (const Point& point : set.points) count += is_inside({polygon}, point) ? 1U : 0U;
    const double share = polylidar::area({polygon}) / set.ground_truth_area;
    // Five standard deviations of the binomial distribution, and one point for the smallest islands.
    const double spread = 5 * std::sqrt(kPoints * share * (1 - share)) + 1;
    EXPECT_NEAR(static_cast<double>(count), kPoints * share, spread);
  }
}

/// The chi-squared statistic of counts by cell against equal expectation, and its degrees of freedom: points
/// outside the cells are one more cell.
double chi_squared(const std::vector<Point>& points, const std::map<std::pair<int, int>, double>& cell_share,
                   double cell_size) {
  std::map<std::pair<int, int>, std::size_t> counts;
  std::size_t elsewhere = 0;
  for (const Point& point : points) {
    const std::pair<int, int> cell{static_cast<int>(std::floor(point.x / cell_size)),
                                   static_cast<int>(std::floor(point.y / cell_size))};
    if (cell_share.contains(cell))
      ++counts[cell];
    else
      ++elsewhere;
  }
  const auto n = static_cast<double>(points.size());
  double statistic = 0;
  double share_elsewhere = 1;
  for (const auto& [cell, share] : cell_share) {
    const double difference = static_cast<double>(counts[cell]) - n * share;
    statistic += difference * difference / (n * share);
    share_elsewhere -= share;
  }
  const double difference = static_cast<double>(elsewhere) - n * share_elsewhere;
  return statistic + difference * difference / (n * share_elsewhere);
}

/// The value that uniform points exceed once in a thousand samples; the samples here are fixed by their
/// seeds.
double critical_value(std::size_t degrees_of_freedom) {
  const boost::math::chi_squared distribution(static_cast<double>(degrees_of_freedom));
  return boost::math::quantile(boost::math::complement(distribution, 0.001));
}

/// The cells of a grid that lie wholly in `shape`, each with its share of the shape's area.
std::map<std::pair<int, int>, double> cells_within(const MultiPolygon& shape, double cell_size,
                                                   int cells_a_side) {
  std::map<std::pair<int, int>, double> shares;
  for (int column = 0; column < cells_a_side; ++column) {
    for (int row = 0; row < cells_a_side; ++row) {
      const double x = column * cell_size;
      const double y = row * cell_size;
      const MultiPolygon cell{
          {.shell = {{x, y}, {x + cell_size, y}, {x + cell_size, y + cell_size}, {x, y + cell_size}},
           .holes = {}}};
      const double area = cell_size * cell_size;
      // An overlay's area is rounded: a cell that misses a trillionth of its area is still a whole cell.
      if (boost_common_area(cell, shape) > area * (1 - 1e-12))
        shares[{column, row}] = area / polylidar::area(shape);
    }
  }
  return shares;
}

TEST_P(SamplesOf, AreUniformByAChiSquaredTest) {
  const MultiPolygon shape = make_ground_truth(GetParam().name, GetParam().holes);
  const double cell_size = GetParam().name == "ca" ? 5 : 2;
  const auto cells = cells_within(shape, cell_size, static_cast<int>(200 / cell_size));
  ASSERT_GT(cells.size(), 200U);
  const std::vector<Point> points = sample_uniform(shape, 200'000, 8);
  EXPECT_LT(chi_squared(points, cells, cell_size), critical_value(cells.size()));
}

TEST(SampleUniform, FirstPointsDoNotDependOnTheirNumber) {
  const MultiPolygon shape{{.shell = {{0, 0}, {4, 0}, {0, 3}}, .holes = {}}};
  const std::vector<Point> few = sample_uniform(shape, 10, 3);
  std::vector<Point> many = sample_uniform(shape, 1000, 3);
  EXPECT_EQ(few.size(), 10U);
  many.resize(10);
  EXPECT_EQ(few, many);
  EXPECT_NE(few, sample_uniform(shape, 10, 4));
  EXPECT_TRUE(sample_uniform(shape, 0, 3).empty());
}

TEST(SampleUniform, ShapesWithHardlyAnyAreaAreRefused) {
  const auto sliver = [](double width) {
    return MultiPolygon{{.shell = {{0, 0}, {width, 0}, {100 + width, 100}, {100, 100}}, .holes = {}}};
  };
  EXPECT_EQ(sample_uniform(sliver(0.01), 5, 1).size(), 5U);
  EXPECT_THROW(sample_uniform(sliver(0.00005), 5, 1), std::invalid_argument);
  EXPECT_THROW(sample_uniform({}, 5, 1), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sample_uniform({{.shell = {{0, 0}, {1, 0}, {nan, 1}}, .holes = {}}}, 5, 1),
               std::invalid_argument);
}

}  // namespace
}  // namespace hullbench::testing
