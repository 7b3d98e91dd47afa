// The real bench_gate with probes that are scripts: they say whatever times the test wants.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

/// A probe whose every time is `ns` and whose results are `result`. `first` is what it does before; it may
/// set `outline` and `once`, the times of these steps.
fs::path make_probe(const fs::path& path, int ns, const std::string& result, const std::string& first = "") {
  const std::string start = "#!/bin/bash\nns=" + std::to_string(ns) + "\nresult=" + result + "\n" + first;
  write_text(path, start + R"(
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
  [ -z "$folder" ] || printf '%s' "$result" >"$folder/$name.wkb"
  line+="${line:+,}\"$name\":{\"triangulation\":[$ns],\"outline\":[${outline:-$ns}],"
  line+="\"concave_hull_once\":[${once:-$ns}],\"result\":\"$result\"}"
done
echo "{$line}"
)");
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

/// For make_probe: its outline takes 1000 and 1200 in turns of two runs, which are a block of the first
/// round.
constexpr const char* kNoisyOutline = R"(
echo >>"$0.runs"
outline=$((($(wc -l <"$0.runs") - 1) % 4 < 2 ? 1000 : 1200))
)";

Outcome run_gate(const fs::path& base, const fs::path& head, const fs::path& out,
                 const std::vector<std::string>& options = {"--blocks", "12"}) {
  return run_program(joined({BENCH_GATE, "--base-probe", base, "--head-probe", head, "--out", out}, options));
}

json report_of(const fs::path& out) {
  return json::parse(read_text(out / "gate.json"));
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
  expect_end(run_gate(probe("base", 1000), probe("head", 1000), out()), 0, "", "no regression");
  const json report = report_of(out());
  EXPECT_EQ(report.at("exit_code"), 0);
  EXPECT_EQ(report.at("samples").at("first").at("change").at("outline ca-8000").size(), 12U);
  EXPECT_TRUE(report.at("second").empty());
}

TEST_F(GateProgram, WhatElseIsInTheFolderOfResultsStays) {
  const std::vector<fs::path> kept = {out() / "results" / "kept", out() / "programs" / "kept"};
  for (const fs::path& path : kept) {
    fs::create_directories(path.parent_path());
    write_text(path, "");
  }
  EXPECT_EQ(run_gate(probe("base", 1000), probe("head", 1000), out()).code, 0);
  for (const fs::path& path : kept) EXPECT_TRUE(fs::exists(path)) << path;
}

TEST_F(GateProgram, ANoisyRoundGoesOnUnlessItFoundSomethingSlower) {
  const auto blocks_of = [&](const char* round) {
    return report_of(out()).at("samples").at(round).at("change").at("concave_hull_once ca-8000").size();
  };
  const fs::path noisy = make_probe(folder_.path() / "noisy", 1000, "same", kNoisyOutline);
  EXPECT_EQ(run_gate(probe("base", 1000), noisy, out()).code, 5);
  EXPECT_EQ(blocks_of("first"), 24U);

  const std::string slower = std::string("once=1100") + kNoisyOutline;
  const fs::path head = make_probe(folder_.path() / "slower", 1000, "same", slower);
  EXPECT_EQ(run_gate(probe("base", 1000), head, out()).code, 3);
  EXPECT_EQ(blocks_of("first"), 12U);

  // Faster does not keep it from going on, and is confirmed with as many blocks.
  const std::string faster = std::string("once=900") + kNoisyOutline;
  EXPECT_EQ(
      run_gate(probe("base", 1000), make_probe(folder_.path() / "faster", 1000, "same", faster), out()).code,
      5);
  EXPECT_EQ(blocks_of("first"), 24U);
  EXPECT_EQ(blocks_of("second"), 24U);
}

TEST_F(GateProgram, TooFewBlocksForItsStatisticsAreAUsageError) {
  expect_end(run_gate(probe("base", 1000), probe("head", 1000), out(), {"--blocks", "9"}), 2, "--blocks");
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(GateProgram, TheFewestBlocksFindASlowerHead) {
  EXPECT_EQ(run_gate(probe("base", 1000), probe("head", 1100), out(), {"--blocks", "10"}).code, 3);
}

TEST_F(GateProgram, WithoutTimeForAFirstRoundItIsInconclusive) {
  expect_end(run_gate(probe("base", 1000), probe("head", 1100), out(), {"--time-limit", "0"}), 5, "",
             "inconclusive: the time limit");
  EXPECT_EQ(report_of(out()).at("exit_code"), 5);
}

TEST_F(GateProgram, WithoutTimeToConfirmItIsInconclusive) {
  // Head takes a second in the place that base has in the first round and head itself in the second: the
  // limit is over after the second round's first block, whatever the machine does besides.
  const fs::path head =
      make_probe(folder_.path() / "head", 1100, "same", "[[ $0 != */1/gate_probe ]] || sleep 1");
  expect_end(run_gate(probe("base", 1000), head, out(), {"--blocks", "10", "--time-limit", "2"}), 5, "",
             "inconclusive: the time limit");
  EXPECT_TRUE(report_of(out()).at("second").empty());
}

TEST_F(GateProgram, ASlowerHeadFailsAndIsConfirmed) {
  expect_end(run_gate(probe("base", 1000), probe("head", 1100), out()), 3, "",
             "regression: concave_hull ca-64000");
  const json report = report_of(out());
  ASSERT_FALSE(report.at("second").empty());
  // Measured with the roles reversed, said the right way round.
  EXPECT_NEAR(report.at("second").at(0).at("ratio").get<double>(), 1.1, 1e-9);
}

TEST_F(GateProgram, AFasterHeadIsAnImprovement) {
  expect_end(run_gate(probe("base", 1100), probe("head", 1000), out()), 0, "",
             "improvement: outline ca-8000\n");
}

TEST_F(GateProgram, AChangedResultFails) {
  expect_end(run_gate(probe("base", 1000), probe("head", 1000, "other"), out()), 3, "",
             "result changed: ca-8000");
}

TEST_F(GateProgram, AProbeThatFailsIsAnErrorWithItsWords) {
  const fs::path broken = folder_.path() / "broken";
  write_text(broken, "#!/bin/bash\necho 'out of order' >&2\nexit 2\n");
  fs::permissions(broken, fs::perms::owner_all);
  expect_end(run_gate(probe("base", 1000), broken, out()), 1, "out of order");
}

TEST_F(GateProgram, AMissingProbeIsAUsageError) {
  const Outcome outcome = run_gate(probe("base", 1000), folder_.path() / "nothing", out());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err.find("bench_gate: "), 0U) << outcome.err;
}

TEST_F(GateProgram, InstructionsWithoutValgrindAreAConfigurationError) {
  ProgramOptions no_valgrind;
  no_valgrind.environment["PATH"] = folder_.path().string();
  expect_end(run_program({BENCH_GATE, "--instructions", "--base-probe", probe("base", 1000).string(),
                          "--head-probe", probe("head", 1000).string(), "--out", out().string()},
                         no_valgrind),
             2, "apt-get install valgrind");
}

}  // namespace
}  // namespace hullbench::testing
