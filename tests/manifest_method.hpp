// A method of adapters/manifests, started as the harness starts it.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "adapters/wkb.hpp"
#include "benchmarks/run/method_catalog.hpp"
#include "benchmarks/worker/method_session.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {

class ManifestMethod {
 public:
  explicit ManifestMethod(const std::string& name)
      : session_(run::MethodCatalog(run::manifest_folders({})).find(name), {4096, std::nullopt}) {
    session_.begin_start();
    session_.finish_start();
  }

  /// Why it cannot run here, and what helps; empty when it can.
  std::string missing() const {
    return session_.start_reply().status == record::Status::kNotInstalled ? session_.start_failure() : "";
  }

  const MethodInfo& info() const { return session_.info().value(); }

  /// One run with `parameters` and the defaults of the others.
  worker::Attempt run(const std::vector<Point>& points, const Parameters& parameters) {
    const worker::LoadedPoints loaded =
        worker::write_points(std::to_string(++loads_), points, folder_.path());
    return session_.run(loaded, complete_parameters(info(), parameters), folder_.path(),
                        std::chrono::seconds(60));
  }

  /// The result of such a run, which must succeed.
  MultiPolygon hull(const std::vector<Point>& points, const Parameters& parameters) {
    const worker::Attempt attempt = run(points, parameters);
    EXPECT_EQ(attempt.status, record::Status::kOk) << attempt.detail;
    return attempt.status == record::Status::kOk ? from_wkb(attempt.wkb) : MultiPolygon();
  }

 private:
  TemporaryFolder folder_;
  worker::MethodSession session_;
  int loads_ = 0;
};

}  // namespace hullbench::testing
