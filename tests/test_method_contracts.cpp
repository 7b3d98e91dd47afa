// The methods that run in this process: who each says it is, which steps it names, and the contract of every
// adapter.
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "adapters/adapter.hpp"
#include "polylidar/concave_hull.hpp"
#include "tests/adapter_contract.hpp"
#include "tests/hull_input.hpp"
#include "tests/infinity.hpp"

namespace hullbench::testing {
namespace {

const std::string kNumbers = "[0-9.]+";

/// What a method is to say of itself.
struct Identity {
  std::string name;
  std::string version;  ///< a regular expression
  Capabilities capabilities;
  std::string steps;  ///< of run and extract
};

/// With what it is tried.
struct Method {
  Identity identity;
  Parameters defaults;    ///< of all parameters that have one
  Parameters parameters;  ///< give a shape with an area for square_points
  Parameters others;      ///< legal, and give another shape
};

/// What GoogleTest says of it.
// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it
void PrintTo(const Method& method, std::ostream* out) {
  *out << method.identity.name;
}

const std::vector<Method>& methods() {
  constexpr Capabilities kRing = {.holes = false, .several_polygons = false};
  constexpr Capabilities kPolygon = {.holes = true, .several_polygons = false};
  constexpr Capabilities kPolygons = {.holes = true, .several_polygons = true};
  static const Parameters no_limits = {
      {"alpha", kInfinity}, {"max_edge_length", kInfinity}, {"max_perimeter", kInfinity}};
  static const Identity geos = {"geos_concave_hull", kNumbers, kPolygon, "shape polygon"};
  static const Parameters no_ratio = {
      {"length_ratio", kInfinity}, {"max_edge_length", kInfinity}, {"allow_holes", 0}};
  static const Parameters three = {{"c", 3}, {"allow_holes", 0}};
  static const Parameters three_or_length = {{"c", 3}, {"max_edge_length", kInfinity}, {"allow_holes", 0}};
  // Five standard deviations: no spurious holes at this density.
  static const Parameters filled = {{"c", 5}, {"allow_holes", 0}};
  static const Parameters open = {{"c", 5}, {"allow_holes", 1}};
  static const Parameters by_density = {
      {"alpha", 0}, {"max_edge_length", kInfinity}, {"max_perimeter", kInfinity}, {"detail", 1}};
  static const std::vector<Method> all = {
      {{"polylidar", ".+", kPolygons, "hull polygon"}, by_density, {{"alpha", 0.1}}, {{"max_perimeter", 1}}},
      {{"polylidar_steps", ".+", kPolygons, "triangulation shape polygon polygon"},
       by_density,
       {{"alpha", 0.1}},
       {{"max_perimeter", 1}}},
      {{"cgal_alpha_shape", kNumbers, kPolygons, "triangulation alpha_shape polygon"},
       {{"alpha", 0}},
       {{"alpha", 0.01}},
       {{"alpha", 0.09}}},
      {{"cgal_delaunay", kNumbers, kPolygons, "triangulation shape polygon"},
       no_limits,
       {{"alpha", 0.1}},
       {{"max_perimeter", 1}}},
      {{"sfcgal_alpha_shape", kNumbers, kPolygon, ""},
       {{"alpha", 0}, {"allow_holes", 0}},
       {},
       {{"alpha", 0.04}, {"allow_holes", 1}}},
      {{"spatialite", "[0-9].* \\(GEOS .*", kPolygons, ""}, three_or_length, open, filled},
      {{"spatialite_steps", "[0-9].* \\(GEOS .*", kPolygons, "triangulation shape polygon polygon"},
       three,
       open,
       filled},
      {geos, no_ratio, {{"length_ratio", 0.4}, {"allow_holes", 1}}, {{"length_ratio", 0.2}}},
      {geos, no_ratio, {{"max_edge_length", 0.1}, {"allow_holes", 1}}, {{"max_edge_length", 0.2}}},
      {{"chi_shape", ".+", kRing, "triangulation shape polygon"},
       {{"max_edge_length", kInfinity}},
       {{"max_edge_length", 0.05}},
       {{"max_edge_length", 0.2}}},
      {{"knn_hull", ".+", kRing, "neighbours shape polygon"}, {{"k", 3}}, {{"k", 5}}, {{"k", 40}}},
      {{"convex_hull", kNumbers, kRing, "shape polygon"}, {}, {}, {}},
  };
  return all;
}

class MethodContract : public ::testing::TestWithParam<Method> {
 protected:
  void SetUp() override {
    const AdapterEntry* found = find_adapter(identity_.name);
    ASSERT_NE(found, nullptr);
    make_ = found->make;
    try {
      adapter_ = make_();
    } catch (const NotInstalled& missing) {
      GTEST_SKIP() << "skipped: " << missing.what();
    }
  }

  const Identity& identity_ = GetParam().identity;
  MakeAdapter make_;
  std::unique_ptr<Adapter> adapter_;
};

TEST_P(MethodContract, SaysWhoItIs) {
  const MethodInfo& info = adapter_->info();
  EXPECT_EQ(info.name, identity_.name);
  EXPECT_TRUE(std::regex_match(info.version, std::regex(identity_.version))) << info.version;
  EXPECT_EQ(info.capabilities.holes, identity_.capabilities.holes);
  EXPECT_EQ(info.capabilities.several_polygons, identity_.capabilities.several_polygons);
  EXPECT_EQ(complete_parameters(info, {}), GetParam().defaults);
}

TEST_P(MethodContract, NamesItsSteps) {
  StepNames steps;
  adapter_->load(square_points(100, 1, false));
  adapter_->run(GetParam().parameters, steps);
  adapter_->extract(steps);
  std::string names;
  for (const std::string& name : steps.names()) names += (names.empty() ? "" : " ") + name;
  EXPECT_EQ(names, identity_.steps);
}

TEST_P(MethodContract, ExtractComesAfterRun) {
  NoSteps steps;
  adapter_->load(square_points(100, 1, false));
  EXPECT_THROW(adapter_->extract(steps), std::logic_error);
  adapter_->run(GetParam().parameters, steps);
  const MultiPolygon first = adapter_->extract(steps);
  EXPECT_EQ(adapter_->extract(steps), first) << "extracted again";
  adapter_->reset();
  EXPECT_THROW(adapter_->extract(steps), std::logic_error);
}

TEST_P(MethodContract, IsKept) {
  expect_adapter_contract(make_, GetParam().parameters, GetParam().others);
}

INSTANTIATE_TEST_SUITE_P(Methods, MethodContract, ::testing::ValuesIn(methods()), [](const auto& tested) {
  return std::to_string(tested.index) + "_" + tested.param.identity.name;
});

// Large enough that the one call leaves the interior out.
TEST(PolylidarSteps, GiveTheCoresPolygonsAsOneCallDoes) {
  const auto make = [](const char* name) { return find_adapter(name)->make(); };
  const std::vector<Point> points = square_points(40000, 8, true);
  EXPECT_NE(core_hull(points, {.detail = 2}), core_hull(points, {}));
  for (const auto& [parameters, options] :
       {std::pair{Parameters{}, polylidar::Options{}},
        {Parameters{{"detail", 2}}, polylidar::Options{.detail = 2}},
        {Parameters{{"alpha", 0.02}}, polylidar::Options{.alpha = 0.02}},
        {Parameters{{"max_perimeter", 0.1}}, polylidar::Options{.max_perimeter = 0.1}}}) {
    for (const char* name : {"polylidar", "polylidar_steps"})
      EXPECT_EQ(hull_of(*make(name), points, parameters), core_hull(points, options)) << name;
  }
}

}  // namespace
}  // namespace hullbench::testing
