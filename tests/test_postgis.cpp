// The two PostGIS adapters, each on a real server of its own, and on pretended ones where a test needs
// another version or a failure: a schema that comes before PostGIS's own in the search path replaces single
// functions.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "adapters/adapter.hpp"
#include "adapters/postgis_session.hpp"
#include "adapters/private_postgres.hpp"
#include "tests/adapter_contract.hpp"
#include "tests/complaint.hpp"
#include "tests/hull_input.hpp"
#include "tests/hull_oracle.hpp"
#include "tests/postgis_server.hpp"

namespace hullbench::testing {
namespace {

// The longest Delaunay edge spans the hole (0.4); 0.4 of that leaves no spurious holes at this density.
const Parameters kFilled = {{"length_ratio", 0.4}, {"allow_holes", 0}};
const Parameters kWithHoles = {{"length_ratio", 0.4}, {"allow_holes", 1}};
const Parameters kByLength = {{"max_edge_length", 0.16}, {"allow_holes", 1}};

class Postgis : public PostgisTest {
 protected:
  /// Names the same server with a schema `pretended` in front, whose ST_ConcaveHull has `body`, in PL/pgSQL.
  static void pretend(const std::string& body, const std::string& more_options = "") {
    execute(
        "DROP SCHEMA IF EXISTS pretended CASCADE; CREATE SCHEMA pretended;"
        "CREATE FUNCTION pretended.postgis_lib_version() RETURNS text LANGUAGE sql AS $$ SELECT '2.5.2' $$;"
        "CREATE FUNCTION pretended.st_concavehull(geom geometry, share float8, holes boolean) RETURNS "
        "geometry "
        "LANGUAGE plpgsql AS $$ BEGIN " +
        body + " END $$");
    name_server(PostgisServer::dsn() + " options='-csearch_path=pretended,public " + more_options + "'");
  }

  static std::string refusal(std::unique_ptr<Adapter> (*make)()) {
    try {
      return "made " + make()->info().version;
    } catch (const NotInstalled& error) {
      return std::string(error.what()) + " -> " + error.remedy();
    }
  }
};

TEST_F(Postgis, SaysWhoItIs) {
  const auto adapter = make_postgis();
  const MethodInfo& info = adapter->info();
  EXPECT_EQ(info.name, "postgis");
  EXPECT_EQ(info.title, "PostGIS");
  expect_says(info.version, " (GEOS 3.");
  expect_says(info.version, ", PostgreSQL ");
  EXPECT_TRUE(info.capabilities.holes);
  EXPECT_FALSE(info.capabilities.several_polygons);
  EXPECT_EQ(complete_parameters(info, {{"length_ratio", 0.5}}),
            (Parameters{{"length_ratio", 0.5},
                        {"max_edge_length", std::numeric_limits<double>::infinity()},
                        {"allow_holes", 0}}));
}

TEST_F(Postgis, KeepsOrFillsTheHole) {
  expect_hole_to_be_filled_or_kept(*make_postgis(), kFilled, kWithHoles);
}

TEST_F(Postgis, KeepsTheContract) {
  expect_adapter_contract(&make_postgis, kWithHoles, kFilled);
  expect_adapter_contract(&make_postgis, kByLength, kFilled);
}

// The server's library is the one that the GEOS adapter is built with, and that takes the length itself.
TEST_F(Postgis, TurnsALengthIntoTheRatioOfItsOwnTriangulation) {
  const auto postgis = make_postgis();
  const auto geos = make_geos_concave_hull();
  if (postgis->info().version.find("(GEOS " + geos->info().version + ",") == std::string::npos) {
    GTEST_SKIP() << "skipped: PostGIS " << postgis->info().version << " has another GEOS than "
                 << geos->info().version;
  }
  for (const double scale : {1.0, 1000.0}) {
    std::vector<Point> points = square_points(kPoints, 7, true);
    for (Point& point : points) point = {scale * point.x + 3 * scale, scale * point.y};
    for (const double length : {0.05, 0.0731, 0.16}) {
      const Parameters parameters = {{"max_edge_length", scale * length}, {"allow_holes", 1}};
      const MultiPolygon hull = hull_of(*postgis, points, parameters);
      EXPECT_FALSE(hull.empty());
      EXPECT_EQ(canonical(hull), canonical(hull_of(*geos, points, parameters))) << scale * length;
    }
  }
}

TEST_F(Postgis, TakesALengthBeyondItsEdgesAsTheLastOne) {
  const auto adapter = make_postgis();
  const std::vector<Point> points = square_points(200, 9, false);
  EXPECT_EQ(hull_of(*adapter, points, {{"max_edge_length", 0}}),
            hull_of(*adapter, points, {{"length_ratio", 0}}));
  EXPECT_EQ(hull_of(*adapter, points, {{"max_edge_length", 1e300}}), hull_of(*adapter, points, {}));
}

TEST_F(Postgis, TakesARatioOrALength) {
  const auto adapter = make_postgis();
  adapter->load(square_points(100, 6, false));
  NoSteps steps;
  EXPECT_THROW(adapter->run({{"length_ratio", 0.5}, {"max_edge_length", 0.5}}, steps), std::invalid_argument);
}

TEST_F(Postgis, StartsAPrivateServerWhenNoneIsNamed) {
  for (const char* unset : {"", static_cast<const char*>(nullptr)}) {
    if (unset == nullptr)
      unsetenv(kDsnVariable);
    else
      setenv(kDsnVariable, unset, 1);
    const auto adapter = make_postgis();
    EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, {{0, 0}, {2, 0}, {0, 2}}, {{"length_ratio", 1}})), 2);
  }
}

TEST_F(Postgis, StartsAPrivateServerAgainThatHasDied) {
  name_none();
  PostgisConnection connection(kCurrentServer);
  const Result folder = connection.session().execute("SELECT current_setting('data_directory')");
  std::ifstream in(std::string(PQgetvalue(folder.get(), 0, 0)) + "/postmaster.pid");
  pid_t postmaster = 0;
  in >> postmaster;
  ASSERT_GT(postmaster, 1);
  EXPECT_FALSE(connection.reopen_if_lost());
  ASSERT_EQ(::kill(postmaster, SIGQUIT), 0);
  const auto answers = [&] {
    try {
      connection.session().execute("SELECT 1");
      return true;
    } catch (const std::runtime_error&) {
      return false;
    }
  };
  while (answers()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(connection.reopen_if_lost());
  EXPECT_NO_THROW(connection.session().execute("SELECT postgis_lib_version()"));
}

TEST_F(Postgis, HasNoLegacyMethodOnACurrentServer) {
  const std::string named = refusal(&make_postgis_legacy);
  expect_says(named, "length-ratio hull; the paper's target-percent method ended with PostGIS 3.2");
  expect_says(named, "unset HULLBENCH_POSTGIS_LEGACY_DSN and run make deps-legacy");
  expect_says(named, "postgis-legacy");
  name_none();
  setenv("HULLBENCH_POSTGRES_LEGACY_BIN", find_postgres(postgres_bin_folders()).c_str(), 1);
  EXPECT_EQ(refusal(&make_postgis_legacy), named) << "told from the installed files, without a server";
  setenv("HULLBENCH_POSTGRES_LEGACY_BIN", "/nowhere", 1);
  EXPECT_EQ(refusal(&make_postgis_legacy), "PostgreSQL is not installed -> make deps-legacy");
  unsetenv("HULLBENCH_POSTGRES_LEGACY_BIN");
}

TEST_F(Postgis, HasAServerForEachOfTheTwoMethods) {
  pretend("RETURN ST_ConvexHull(geom);");
  setenv(kDsnVariable, PostgisServer::dsn().c_str(), 1);
  const std::vector<Point> corners = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const auto current = make_postgis();
  const auto legacy = make_postgis_legacy();
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*current, corners, {{"length_ratio", 1}})), 4);
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*legacy, corners, {{"target_percent", 1}})), 4);
}

/// The paper's PostGIS itself, as `make deps-legacy` gets it.
class LegacyPostgis : public ::testing::Test {
 protected:
  void SetUp() override {
    unsetenv(kLegacyDsnVariable);
    try {
      adapter_ = make_postgis_legacy();
    } catch (const NotInstalled& error) {
      GTEST_SKIP() << "skipped: " << error.what() << "; " << error.remedy();
    }
  }

  std::unique_ptr<Adapter> adapter_;
};

TEST_F(LegacyPostgis, IsThePapersMethodBesideTheCurrentOne) {
  EXPECT_EQ(adapter_->info().name, "postgis_legacy");
  const auto current = make_postgis();
  EXPECT_NE(adapter_->info().version, current->info().version);
  const std::vector<Point> points = square_points(500, 11, true);
  const MultiPolygon hull = hull_of(*adapter_, points, {{"target_percent", 0.9}});
  ASSERT_EQ(hull.size(), 1U);
  EXPECT_EQ(hole_count(hull), 0U);
  // It stops when the area is at most the target's share of the convex hull's, or at an outline it cannot
  // better.
  const double convex = polylidar::area(hull_of(*current, points, {{"length_ratio", 1}}));
  EXPECT_LT(polylidar::area(hull), convex);
  EXPECT_GT(polylidar::area(hull), 0.8 * convex);
}

TEST_F(LegacyPostgis, KeepsTheContract) {
  const Parameters parameters = {{"target_percent", 0.95}};
  expect_nothing_without_area(&make_postgis_legacy, parameters);
  expect_bad_arguments_to_be_refused(&make_postgis_legacy, parameters);
}

TEST_F(Postgis, HasOnlyTheLegacyMethodOnAnOldServer) {
  pretend(
      "RETURN CASE WHEN holes THEN ST_Scale(ST_ConvexHull(geom), share, 1) ELSE ST_ConvexHull(geom) END;");
  const std::string current = refusal(&make_postgis);
  expect_says(current, "the server runs PostGIS 2.5.2");
  const auto adapter = make_postgis_legacy();
  EXPECT_EQ(adapter->info().name, "postgis_legacy");
  EXPECT_EQ(adapter->info().title, "PostGIS <= 3.2");
  EXPECT_TRUE(adapter->info().version.starts_with("2.5.2 (GEOS ")) << adapter->info().version;
  const std::vector<Point> corners = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, corners, {{"target_percent", 0.5}})), 4);
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, corners, {{"target_percent", 0.5}, {"allow_holes", 1}})),
                   2);
  NoSteps steps;
  EXPECT_THROW(adapter->run({{"target_percent", 0}}, steps), std::invalid_argument);
  EXPECT_THROW(adapter->run({{"target_percent", 1.5}}, steps), std::invalid_argument);
  EXPECT_THROW(adapter->run({{"length_ratio", 0.5}}, steps), std::invalid_argument);
}

TEST_F(Postgis, TurnsOffParallelQueriesAndTheCompiler) {
  pretend(
      "RAISE 'jit=% workers=%', current_setting('jit'), current_setting('max_parallel_workers_per_gather');",
      "-cjit=on -cmax_parallel_workers_per_gather=4");
  const auto adapter = make_postgis_legacy();
  EXPECT_EQ(complaint_of([&] {
              hull_of(*adapter, square_points(10, 1, false), {{"target_percent", 0.5}});
            }),
            "PostGIS: jit=off workers=0");
}

TEST_F(Postgis, ReportsAFailureAndGoesOn) {
  pretend(
      "IF share < 0.5 THEN RAISE 'no space' USING ERRCODE = '53200'; END IF;"
      "IF share < 0.7 THEN RETURN NULL; END IF;"
      "IF share < 0.9 THEN PERFORM pg_terminate_backend(pg_backend_pid()); PERFORM pg_sleep(60); END IF;"
      "RETURN ST_ConvexHull(geom);");
  const auto adapter = make_postgis_legacy();
  const std::vector<Point> points = {{0, 0}, {1, 0}, {0, 1}};
  EXPECT_THROW(hull_of(*adapter, points, {{"target_percent", 0.4}}), std::bad_alloc);
  EXPECT_THROW(hull_of(*adapter, points, {{"target_percent", 0.6}}), std::runtime_error);
  EXPECT_THROW(hull_of(*adapter, points, {{"target_percent", 0.8}}), std::runtime_error);
  EXPECT_DOUBLE_EQ(polylidar::area(hull_of(*adapter, points, {{"target_percent", 1}})), 0.5);
}

TEST_F(Postgis, SaysWhenTheNamedServerDoesNotAnswer) {
  const auto advice = [](const std::string& variable) {
    return "the server named by " + variable + " does not answer -> start it or correct " + variable +
           ", or unset it for a private server";
  };
  for (const char* dsn :
       {"host=127.0.0.1 port=1 password=sesame", "host=/nowhere", "host=127.0.0.1 password=open sesame",
        "postgresql://user:ses@me@nowhere.invalid/db"}) {
    name_server(dsn);
    EXPECT_EQ(refusal(&make_postgis), advice(kDsnVariable)) << dsn;
    EXPECT_EQ(refusal(&make_postgis_legacy), advice(kLegacyDsnVariable)) << dsn;
  }
}

TEST_F(Postgis, DoesNotWaitForASilentServer) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(listener, 1), 0);
  socklen_t size = sizeof address;
  ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  name_server("host=127.0.0.1 port=" + std::to_string(ntohs(address.sin_port)));
  expect_says(refusal(&make_postgis), "does not answer");
  close(listener);
}

TEST_F(Postgis, SaysWhyTheNamedServerRefuses) {
  name_server(PostgisServer::dsn() + " user=stranger");
  expect_says(refusal(&make_postgis), "refuses the connection: role \"stranger\" does not exist");
  name_server(PostgisServer::dsn() + " dbname=template1");
  expect_says(refusal(&make_postgis), "no PostGIS extension -> run CREATE EXTENSION postgis");
}

}  // namespace
}  // namespace hullbench::testing

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ::testing::AddGlobalTestEnvironment(new hullbench::testing::PostgisServer);
  return RUN_ALL_TESTS();
}
