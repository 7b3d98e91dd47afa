// The real bench_gate with probes that are scripts: they say whatever times the test wants.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

namespace fs = std::filesystem;

/// A probe whose every time is `ns` and whose results are `result`.
fs::path make_probe(const fs::path& path, int ns, const std::string& result) {
  const std::string times = "[" + std::to_string(ns) + "]";
  write_text(path, R"(#!/bin/bash
read -r request
shift
cases=()
folder=
while [ $# -gt 0 ]; do
  case "$1" in
    --results) folder=$2; shift ;;
    --repeats | --once) shift ;;
    *) cases+=("$1") ;;
  esac
  shift
done
line=
for name in "${cases[@]}"; do
  [ -z "$folder" ] || printf '%s' ')" +
                       result + R"(' >"$folder/$name.wkb"
  line+="${line:+,}\"$name\":{\"triangulation\":)" +
                       times + R"(,\"outline\":)" + times + R"(,\"concave_hull_once\":)" + times +
                       R"(,\"result\":\")" + result + R"(\"}"
done
echo "{$line}"
)");
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

Outcome run_gate(const fs::path& base, const fs::path& head, const fs::path& out) {
  return run_program({BENCH_GATE, "--base-probe", base.string(), "--head-probe", head.string(), "--out",
                      out.string(), "--blocks", "12"});
}

nlohmann::json report_of(const fs::path& out) {
  return nlohmann::json::parse(read_text(out / "gate.json"));
}

class GateProgram : public ::testing::Test {
 protected:
  fs::path probe(const std::string& name, int ns, const std::string& result = "same") const {
    return make_probe(folder_.path() / name, ns, result);
  }
  fs::path out() const { return folder_.path() / "out"; }

  TemporaryFolder folder_;
};

TEST_F(GateProgram, EqualProbesPass) {
  const Outcome outcome = run_gate(probe("base", 1000), probe("head", 1000), out());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("no regression"), std::string::npos) << outcome.out;
  const nlohmann::json report = report_of(out());
  EXPECT_EQ(report.at("exit_code"), 0);
  EXPECT_EQ(report.at("samples").at("first").at("change").at("outline ca-8000").size(), 12U);
  EXPECT_TRUE(report.at("second").empty());
}

TEST_F(GateProgram, ASlowerHeadFailsAndIsConfirmed) {
  const Outcome outcome = run_gate(probe("base", 1000), probe("head", 1100), out());
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("regression: concave_hull ca-64000"), std::string::npos) << outcome.out;
  const nlohmann::json report = report_of(out());
  ASSERT_FALSE(report.at("second").empty());
  // Measured with the roles reversed, said the right way round.
  EXPECT_NEAR(report.at("second").at(0).at("ratio").get<double>(), 1.1, 1e-9);
}

TEST_F(GateProgram, AFasterHeadIsAnImprovement) {
  const Outcome outcome = run_gate(probe("base", 1100), probe("head", 1000), out());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("improvement: outline ca-8000\n"), std::string::npos) << outcome.out;
}

TEST_F(GateProgram, AChangedResultFails) {
  const Outcome outcome = run_gate(probe("base", 1000), probe("head", 1000, "other"), out());
  EXPECT_EQ(outcome.code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("result changed: ca-8000"), std::string::npos) << outcome.out;
}

TEST_F(GateProgram, AProbeThatFailsIsAnErrorWithItsWords) {
  const fs::path broken = folder_.path() / "broken";
  write_text(broken, "#!/bin/bash\necho 'out of order' >&2\nexit 2\n");
  fs::permissions(broken, fs::perms::owner_all);
  const Outcome outcome = run_gate(probe("base", 1000), broken, out());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("out of order"), std::string::npos) << outcome.err;
}

TEST_F(GateProgram, AMissingProbeIsAUsageError) {
  const Outcome outcome = run_gate(probe("base", 1000), folder_.path() / "nothing", out());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err.find("bench_gate: "), 0U) << outcome.err;
}

TEST_F(GateProgram, InstructionsWithoutValgrindAreAConfigurationError) {
  ProgramOptions no_valgrind;
  no_valgrind.environment["PATH"] = folder_.path().string();
  const Outcome outcome =
      run_program({BENCH_GATE, "--instructions", "--base-probe", probe("base", 1000).string(), "--head-probe",
                   probe("head", 1000).string(), "--out", out().string()},
                  no_valgrind);
  EXPECT_EQ(outcome.code, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("apt-get install valgrind"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace hullbench::testing
