// benchmarks/gate/gate.sh with a compiler and a bench_gate that are scripts: what it builds first, where it
// puts things, and how it ends.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

namespace fs = std::filesystem;

void make_script(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  write_text(path, "#!/bin/bash\n" + text);
  fs::permissions(path, fs::perms::owner_all);
}

/// A checkout of one commit, whose "cmake" builds nothing and succeeds.
class GateScript : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string why = missing({"git"}); !why.empty()) GTEST_SKIP() << why;
    for (const char* part : {"core", "cmake"}) {
      fs::create_directories(tree() / part);
      write_text(tree() / part / "file", "");
    }
    ProgramOptions options;
    options.folder = tree();
    succeeded(run_program({"/bin/bash", "-c",
                           "export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_NOSYSTEM=1; git init --quiet && "
                           "git add --all && git -c user.name=gate -c user.email=gate@example.org "
                           "-c core.hooksPath=/dev/null commit --quiet --message only"},
                          options));
    make_cmake("exit 0\n");
    make_script(folder_.path() / "driver", "printf '%s\\n' \"$@\"\n");
  }

  void make_cmake(const std::string& text) const { make_script(folder_.path() / "bin" / "cmake", text); }

  Outcome gate(const fs::path& out) const {
    ProgramOptions options;
    options.environment["PATH"] = (folder_.path() / "bin").string() + ":" + std::getenv("PATH");
    return run_program({GATE_SCRIPT, "--head", tree().string(), "--base", "HEAD", "--driver",
                        (folder_.path() / "driver").string(), "--out", out.string()},
                       options);
  }

  fs::path tree() const { return folder_.path() / "tree"; }
  fs::path out() const { return folder_.path() / "out"; }

  TemporaryFolder folder_;
};

TEST_F(GateScript, LeavesWhatElseIsInItsFolder) {
  const std::vector<fs::path> kept = {out() / "results" / "kept", out() / "base" / "tree" / "kept",
                                      out() / "callgrind" / "kept"};
  for (const fs::path& path : kept) {
    fs::create_directories(path.parent_path());
    write_text(path, "");
  }
  const Outcome outcome = succeeded(gate(out()));
  for (const fs::path& path : kept) EXPECT_TRUE(fs::exists(path)) << path;
  EXPECT_TRUE(fs::exists(out() / "gate-work" / "base" / "tree" / "core" / "file"));
  EXPECT_TRUE(fs::exists(out() / "log" / "build-head.txt"));
  expect_says(outcome.out, "--out\n" + out().string() + "\n");
}

TEST_F(GateScript, AFolderThatCannotBeMadeIsAUsageError) {
  write_text(out(), "a file");
  const Outcome outcome = gate(out() / "below");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err.find("error: the folders log and gate-work cannot be made in "), 0U) << outcome.err;
}

TEST_F(GateScript, ACompilerThatBuildsNothingIsNoFaultOfTheBase) {
  make_cmake("exit 1\n");
  expect_end(gate(out()), 1, "error: the work tree of ");
}

TEST_F(GateScript, ABaseThatDoesNotBuildIsNoBase) {
  make_cmake("[[ \"$*\" != */gate-work/base/* ]]\n");
  expect_end(gate(out()), 6, "error: the base ");
}

}  // namespace
}  // namespace hullbench::testing
