// The step-by-step PostGIS adapter, against the core whose method it is.
#include <gtest/gtest.h>

#include <cmath>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"
#include "tests/adapter_contract.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/hull_samples.hpp"
#include "tests/infinity.hpp"
#include "tests/postgis_server.hpp"

namespace hullbench::testing {
namespace {

class PostgisSteps : public PostgisTest {
 protected:
  /// Names the server with `function`, an SQL definition of a function in the schema `pretended`, in front of
  /// PostGIS's own.
  static void pretend(const std::string& function) {
    execute("DROP SCHEMA IF EXISTS pretended CASCADE; CREATE SCHEMA pretended;" + function);
    name_server(PostgisServer::dsn() + " options='-csearch_path=pretended,public'");
  }
};

TEST_F(PostgisSteps, SaysWhoItIs) {
  const auto adapter = make_postgis_steps();
  const MethodInfo& info = adapter->info();
  EXPECT_EQ(info.name, "postgis_steps");
  EXPECT_EQ(info.title, "PostGIS, step by step");
  expect_says(info.version, " (GEOS 3.");
  expect_says(info.version, ", PostgreSQL ");
  EXPECT_TRUE(info.capabilities.holes);
  EXPECT_TRUE(info.capabilities.several_polygons);
}

TEST_F(PostgisSteps, KeepsTheContract) {
  expect_adapter_contract(&make_postgis_steps, {{"alpha", 0.1}}, {{"alpha", 0.03}});
}

// Not nearly: ring for ring and bit for bit, once both start and sort their rings alike.
TEST_F(PostgisSteps, GivesTheShapeOfPolylidar) {
  const auto steps = make_postgis_steps();
  const auto original = make_polylidar();
  std::size_t holes = 0;
  std::size_t several = 0;
  for (const auto& [name, points, area] : hull_samples()) {
    for (const double factor : {0.7, 1.0, 2.0, 4.0}) {
      const double alpha = factor * std::sqrt(area / static_cast<double>(points.size()));
      SCOPED_TRACE(name + ", alpha " + std::to_string(alpha));
      const MultiPolygon expected = hull_of(*original, points, {{"alpha", alpha}});
      const MultiPolygon got = hull_of(*steps, points, {{"alpha", alpha}});
      EXPECT_EQ(got.size(), expected.size());
      EXPECT_EQ(hole_count(got), hole_count(expected));
      // The same rings summed in another order.
      EXPECT_NEAR(polylidar::area(got), polylidar::area(expected), 1e-9 * polylidar::area(expected));
      EXPECT_EQ(canonical(got), canonical(expected));
      holes += hole_count(expected);
      if (expected.size() > 1) ++several;
    }
  }
  EXPECT_GT(holes, 100U) << "too few holes to have tested them";
  EXPECT_GT(several, 5U) << "too few shapes of several polygons to have tested them";
}

TEST_F(PostgisSteps, KeepsATriangleAtTheLimitAndNoneBeyond) {
  const auto adapter = make_postgis_steps();
  // Circumradius 2.5, exactly.
  const std::vector<Point> triangle = {{0, 0}, {4, 0}, {0, 3}};
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, triangle, {{"alpha", 2.5}})), 6);
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, triangle, {{"alpha", kInfinity}})), 6);
  EXPECT_EQ(hull_of(*adapter, triangle, {{"alpha", std::nextafter(2.5, 0)}}), MultiPolygon());
  EXPECT_EQ(hull_of(*adapter, triangle, {{"alpha", 0}}), MultiPolygon());
}

TEST_F(PostgisSteps, SaysWhenLengthsLeaveTheRangeOfDoubles) {
  const auto adapter = make_postgis_steps();
  for (const double unit : {1e-55, 1e52}) {
    expect_complaint(
        [&] {
          hull_of(*adapter, {{0, 0}, {unit, 0}, {0, unit}}, {{"alpha", kInfinity}});
        },
        "out of range");
  }
  for (const double unit : {1e-50, 1e50}) {
    const MultiPolygon hull = hull_of(*adapter, {{0, 0}, {unit, 0}, {0, unit}}, {{"alpha", unit}});
    EXPECT_DOUBLE_EQ(polylidar::area(hull), unit * unit / 2);
  }
}

TEST_F(PostgisSteps, TellsTheStepsOfThePaper) {
  const auto adapter = make_postgis_steps();
  StepNames steps;
  adapter->load(square_points(100, 6, false));
  adapter->run({{"alpha", 0.2}}, steps);
  EXPECT_EQ(steps.names(), (std::vector<std::string>{"triangulation", "shape", "polygon"}));
  adapter->extract(steps);
  EXPECT_EQ(steps.names().back(), "polygon");
  EXPECT_EQ(steps.names().size(), 4U);
}

TEST_F(PostgisSteps, SaysWhenThereIsNoTriangulation) {
  pretend(
      "CREATE FUNCTION pretended.st_delaunaytriangles(geom geometry) RETURNS geometry LANGUAGE sql "
      "AS $$ SELECT NULL::geometry $$");
  EXPECT_THROW(hull_of(*make_postgis_steps(), square_points(10, 1, false), {{"alpha", 1}}),
               std::runtime_error);
}

TEST_F(PostgisSteps, ReportsAFailureAndGoesOn) {
  // Fails between the steps, with triangles already written: by how many points there are.
  pretend(
      "CREATE FUNCTION pretended.st_exteriorring(geom geometry) RETURNS geometry LANGUAGE plpgsql AS $$ "
      "DECLARE points int := (SELECT ST_NumGeometries(p.geom) FROM pg_temp.hullbench_points AS p); BEGIN "
      "IF points = 4 THEN RAISE 'no space' USING ERRCODE = '53200'; END IF;"
      "IF points = 5 THEN PERFORM pg_terminate_backend(pg_backend_pid()); PERFORM pg_sleep(60); END IF;"
      "RETURN public.ST_ExteriorRing(geom); END $$");
  const auto adapter = make_postgis_steps();
  std::vector<Point> points = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {3, 3}};
  const Parameters all = {{"alpha", kInfinity}};
  EXPECT_THROW(hull_of(*adapter, points, all), std::runtime_error);
  adapter->reset();
  points.pop_back();
  EXPECT_THROW(hull_of(*adapter, points, all), std::bad_alloc);
  points.pop_back();
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, points, all)), 0.5);
}

}  // namespace
}  // namespace hullbench::testing
