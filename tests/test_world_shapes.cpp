#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "datasets/shapes.hpp"
#include "datasets/world_shapes.hpp"
#include "polylidar/geometry.hpp"
#include "tests/boost_checks.hpp"

namespace hullbench::testing {
namespace {

// Coordinates are written with four decimals.
constexpr double kWorldRounding = 1e-4;
constexpr double kSide = 200;

const char* stratum_of(const MultiPolygon& shape) {
  if (shape.size() > 1) return "parts";
  return shape.front().holes.empty() ? "simple" : "holes";
}

TEST(WorldShapes, EveryOneIsAValidOutlineOfTheSizePromised) {
  for (const ShapeFamily& family : world_families()) {
    for (std::size_t index = 0; index < family.count; ++index) {
      SCOPED_TRACE(family.name + "-" + std::to_string(index + 1));
      const MultiPolygon shape = family.make(index);
      EXPECT_EQ(boost_fault(shape), "");
      Point most{0, 0};
      Point least{kSide, kSide};
      std::size_t vertices = 0;
      const double area = polylidar::area(shape);
      for (const Ring& ring : rings_of(shape)) {
        vertices += ring.size();
        EXPECT_GE(std::abs(polylidar::signed_area(ring)), 0.99e-3 * area);
        for (const Point& p : ring) {
          most = {std::max(most.x, p.x), std::max(most.y, p.y)};
          least = {std::min(least.x, p.x), std::min(least.y, p.y)};
        }
      }
      EXPECT_LE(vertices, 900U);
      // Simplifying may take a little from the box, whose corners it does not know.
      EXPECT_NEAR(std::max(most.x, most.y), kSide, 0.05 * kSide);
      EXPECT_LE(std::max(most.x, most.y), kSide + kWorldRounding);
      EXPECT_GE(std::min(least.x, least.y), -kWorldRounding);
    }
  }
}

TEST(WorldShapes, AreMoreThanTwoHundredOfEveryStratumAndNoSourceHasMoreThanSixty) {
  std::size_t shapes = 0;
  std::map<std::string, int> strata;
  for (const ShapeFamily& family : world_families()) {
    EXPECT_LE(family.count, 60U) << family.name;
    shapes += family.count;
    for (std::size_t index = 0; index < family.count; ++index) ++strata[stratum_of(family.make(index))];
  }
  EXPECT_GE(shapes, 200U);
  for (const char* stratum : {"simple", "holes", "parts"}) EXPECT_GE(strata[stratum], 60) << stratum;
}

TEST(WorldShapes, AreWhatTheManifestSays) {
  std::ifstream file(default_data_directory() / "world" / "manifest.json");
  const json manifest = json::parse(file);
  const std::vector<ShapeFamily> families = world_families();
  ASSERT_EQ(manifest.at("sets").size(), families.size());
  for (std::size_t f = 0; f < families.size(); ++f) {
    const json& set = manifest["sets"][f];
    std::map<std::string, int> strata = {{"simple", 0}, {"holes", 0}, {"parts", 0}};
    ASSERT_EQ(set.at("areas").size(), families[f].count) << families[f].name;
    for (std::size_t index = 0; index < families[f].count; ++index) {
      const MultiPolygon shape = families[f].make(index);
      EXPECT_NEAR(polylidar::area(shape), set["areas"][index].get<double>(), kWorldRounding)
          << families[f].name;
      ++strata[stratum_of(shape)];
    }
    const auto said = set.at("strata").get<std::map<std::string, int>>();
    EXPECT_EQ(strata, said) << families[f].name;
    EXPECT_FALSE(set.at("source_package").at("version").get<std::string>().empty());
  }
}

TEST(WorldShapes, OneMoreThanThereAreIsRefused) {
  for (const ShapeFamily& family : world_families()) {
    EXPECT_THROW(family.make(family.count), std::invalid_argument) << family.name;
  }
}

TEST(WorldShapes, SeveralThreadsMayAskForTheFirst) {
  const std::vector<ShapeFamily> families = world_families();
  const MultiPolygon expected = world_families().front().make(7);
  std::vector<MultiPolygon> got(4);
  std::vector<std::thread> threads;
  threads.reserve(got.size());
  for (MultiPolygon& one : got) threads.emplace_back([&] { one = families.front().make(7); });
  for (std::thread& thread : threads) thread.join();
  for (const MultiPolygon& one : got) EXPECT_EQ(one, expected);
}

}  // namespace
}  // namespace hullbench::testing
