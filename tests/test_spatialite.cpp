// The SpatiaLite adapter on the real library.
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/wkb.hpp"
#include "tests/hull_input.hpp"

namespace hullbench {

std::unique_ptr<Adapter> make_spatialite();

namespace {

using test::hole_count;
using test::hull_of;
using test::kAreaTolerance;
using test::kHoleArea;
using test::kPoints;
using test::NoSteps;
using test::square_points;

// Five standard deviations: no spurious holes at this density.
const Parameters kFilled = {{"c", 5}, {"allow_holes", 0}};
const Parameters kWithHoles = {{"c", 5}, {"allow_holes", 1}};

TEST(Spatialite, SaysWhoItIs) {
  const auto adapter = make_spatialite();
  const MethodInfo& info = adapter->info();
  EXPECT_EQ(info.name, "spatialite");
  EXPECT_EQ(info.title, "SpatiaLite");
  EXPECT_NE(info.version.find(" (GEOS "), std::string::npos) << info.version;
  EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(info.version.at(0)))) << info.version;
  EXPECT_TRUE(info.capabilities.holes);
  EXPECT_TRUE(info.capabilities.several_polygons);
  EXPECT_EQ(complete_parameters(info, {}), (Parameters{{"c", 3}, {"allow_holes", 0}}));
}

TEST(Spatialite, KeepsOrFillsTheHole) {
  const auto adapter = make_spatialite();
  const std::vector<Point> points = square_points(kPoints, 7, true);
  const MultiPolygon filled = hull_of(*adapter, points, kFilled);
  EXPECT_NEAR(polylidar::area(filled), 1, kAreaTolerance);
  EXPECT_EQ(hole_count(filled), 0U);
  const MultiPolygon with_hole = hull_of(*adapter, points, kWithHoles);
  EXPECT_NEAR(polylidar::area(with_hole), 1 - kHoleArea, kAreaTolerance);
  EXPECT_EQ(hole_count(with_hole), 1U);
}

TEST(Spatialite, GivesSeveralPolygons) {
  const auto adapter = make_spatialite();
  std::vector<Point> points = square_points(500, 1, false);
  for (const Point& point : square_points(500, 2, false)) points.push_back({point.x + 3, point.y});
  EXPECT_EQ(hull_of(*adapter, points, {{"c", 2.5}}).size(), 2U);
}

TEST(Spatialite, GivesTheSameBytesAgain) {
  const auto adapter = make_spatialite();
  const std::vector<Point> points = square_points(kPoints, 3, true);
  const auto first = to_wkb(hull_of(*adapter, points, kWithHoles));
  NoSteps steps;
  adapter->run(kFilled, steps);
  adapter->run(kWithHoles, steps);
  EXPECT_EQ(to_wkb(adapter->extract(steps)), first);
  EXPECT_EQ(to_wkb(hull_of(*make_spatialite(), points, kWithHoles)), first);
}

TEST(Spatialite, LoadReplacesWhatWasLoaded) {
  const auto adapter = make_spatialite();
  hull_of(*adapter, square_points(kPoints, 3, true), kFilled);
  const std::vector<Point> others = square_points(300, 4, false);
  EXPECT_EQ(hull_of(*adapter, others, kFilled), hull_of(*make_spatialite(), others, kFilled));
  EXPECT_EQ(hull_of(*adapter, {}, kFilled), MultiPolygon());
}

TEST(Spatialite, GivesNothingForWhatHasNoArea) {
  const auto adapter = make_spatialite();
  for (const auto& [name, points] : test::degenerate_inputs()) {
    EXPECT_EQ(hull_of(*adapter, points, kFilled), MultiPolygon()) << name;
    EXPECT_EQ(hull_of(*adapter, points, kWithHoles), MultiPolygon()) << name;
  }
}

TEST(Spatialite, IgnoresDuplicates) {
  const auto adapter = make_spatialite();
  const std::vector<Point> points = square_points(500, 5, true);
  std::vector<Point> twice = points;
  twice.insert(twice.end(), points.begin(), points.end());
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, twice, kWithHoles)),
                   polylidar::area(hull_of(*adapter, points, kWithHoles)));
}

TEST(Spatialite, SaysWhenNoTriangleIsKept) {
  const auto adapter = make_spatialite();
  try {
    hull_of(*adapter, square_points(100, 6, false), {{"c", 0}});
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no triangle"), std::string::npos) << error.what();
  }
  // The failed run leaves the adapter usable.
  NoSteps steps;
  adapter->run(kFilled, steps);
  EXPECT_NEAR(polylidar::area(adapter->extract(steps)), 1, 0.2) << "100 points leave a wide rim";
}

TEST(Spatialite, KeepsEveryTriangleWithoutALimit) {
  const auto adapter = make_spatialite();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Point> corners = {{0, 0}, {4, 0}, {4, 3}, {0, 3}, {1, 1}};
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, corners, {{"c", infinity}})), 12);
}

TEST(Spatialite, RefusesBadArguments) {
  const auto adapter = make_spatialite();
  adapter->load(square_points(100, 6, false));
  NoSteps steps;
  EXPECT_THROW(adapter->run({{"c", -1}}, steps), std::invalid_argument);
  EXPECT_THROW(adapter->run({{"c", std::nan("")}}, steps), std::invalid_argument);
  EXPECT_THROW(adapter->run({{"allow_holes", 2}}, steps), std::invalid_argument);
  EXPECT_THROW(adapter->run({{"allow_holes", 0.5}}, steps), std::invalid_argument);
  EXPECT_THROW(adapter->run({{"alpha", 1}}, steps), std::invalid_argument);
  EXPECT_THROW(adapter->load(std::vector<Point>{{0, 0}, {std::nan(""), 1}}), std::invalid_argument);
}

}  // namespace
}  // namespace hullbench
