// One PostGIS server for all tests of a program, which takes seconds to start.
#pragma once

#include <gtest/gtest.h>
#include <libpq-fe.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "adapters/private_postgres.hpp"

namespace hullbench::testing {

inline constexpr const char* kDsnVariable = "HULLBENCH_POSTGIS_DSN";
inline constexpr const char* kLegacyDsnVariable = "HULLBENCH_POSTGIS_LEGACY_DSN";

/// Started before the first test of a program whose main adds it, stopped after the last.
class PostgisServer : public ::testing::Environment {
 public:
  void SetUp() override { server.emplace(); }
  void TearDown() override { server.reset(); }
  static std::string dsn() { return server->dsn(); }

 private:
  static inline std::optional<PrivatePostgres> server;
};

/// A test whose adapters, the legacy one too, find that server by their environment variables.
class PostgisTest : public ::testing::Test {
 protected:
  void SetUp() override { name_server(PostgisServer::dsn()); }
  void TearDown() override { name_none(); }

  static void name_server(const std::string& dsn) {
    setenv(kDsnVariable, dsn.c_str(), 1);
    setenv(kLegacyDsnVariable, dsn.c_str(), 1);
  }

  static void name_none() {
    unsetenv(kDsnVariable);
    unsetenv(kLegacyDsnVariable);
  }

  /// Runs `sql` on that server, in a connection of its own.
  static void execute(const std::string& sql) {
    const std::unique_ptr<PGconn, decltype(&PQfinish)> connection(PQconnectdb(PostgisServer::dsn().c_str()),
                                                                  &PQfinish);
    const std::unique_ptr<PGresult, decltype(&PQclear)> result(
        PQexec(connection.get(), ("SET client_min_messages = warning;" + sql).c_str()), &PQclear);
    const ExecStatusType status = PQresultStatus(result.get());
    if (status != PGRES_COMMAND_OK && status != PGRES_TUPLES_OK)
      throw std::runtime_error(PQerrorMessage(connection.get()));
  }
};

}  // namespace hullbench::testing
