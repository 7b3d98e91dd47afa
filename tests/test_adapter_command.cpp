// Adding a method from nothing: the skeletons work, the contract finds what is wrong, and a method of a
// folder of one's own is measured beside the others.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"
#include "tests/complaint.hpp"
#include "tests/hullbench_test.hpp"

namespace hullbench::testing {
namespace {

class AdapterCommandTest : public HullbenchTest {
 protected:
  // What hullbench_worker.py and hullbench_worker.mjs need.
  void SetUp() override {
    const std::string why = missing({SYSTEM_PYTHON ":numpy", "node"});
    if (!why.empty()) GTEST_SKIP() << why;
  }

  /// A method in Python whose `run(points)` is `body`.
  void python_method(const std::string& body) {
    if (!fs::exists(methods())) {
      succeeded(hullbench({"adapter", "new", "sample", "--lang", "python", "--out", methods().string()}));
    }
    write_text(methods() / "sample_worker.py", "import hullbench_worker\n\ndef run(points):\n" + body +
                                                   "\n\nhullbench_worker.serve(version='1', run=run)\n");
    // Debian's Python, which has numpy.
    change_json(methods() / "sample.json", [](json& manifest) { manifest["command"][0] = SYSTEM_PYTHON; });
  }

  Outcome test_sample(const std::string& timeout = "20") const {
    return hullbench({"adapter", "test", "sample", "--adapters", methods().string(), "--timeout", timeout});
  }

  void expect_broken(const std::string& point, const std::string& words,
                     const std::string& timeout = "20") const {
    const Outcome tested = test_sample(timeout);
    EXPECT_EQ(tested.code, 4) << tested.out << tested.err;
    const std::size_t line = tested.out.find("FAIL  " + point);
    ASSERT_NE(line, std::string::npos) << tested.out;
    const std::string said = tested.out.substr(line, tested.out.find('\n', line) - line);
    expect_says(said, words);
    expect_says(tested.out, "sample keeps part of the contract");
  }

  fs::path methods() const { return folder() / "methods"; }
};

TEST_F(AdapterCommandTest, TheSkeletonsKeepTheContract) {
  for (const std::string language : {"python", "js"}) {
    const Outcome made = succeeded(hullbench({"adapter", "new", "my_" + language, "--lang", language}));
    const fs::path adapters = folder() / "config" / "hullbench" / "adapters";
    const fs::path written = adapters / ("my_" + language + ".json");
    expect_says(made.out, written.string());
    json manifest = json::parse(read_text(written));
    EXPECT_EQ(manifest["jit"].get<bool>(), language == "js");
    if (language == "python") {
      manifest["command"][0] = SYSTEM_PYTHON;
      write_text(written, manifest.dump());
    }
    const Outcome tested = hullbench({"adapter", "test", "my_" + language});
    EXPECT_EQ(tested.code, 0) << tested.out << tested.err;
    expect_says(tested.out, "my_" + language + " keeps the contract: ");
    EXPECT_EQ(tested.out.find("FAIL"), std::string::npos) << tested.out;
  }
}

TEST_F(AdapterCommandTest, AMethodOfOnesOwnIsMeasuredBesideTheOthers) {
  python_method(
      "    xs, ys = points.T\n    return [[[(xs.min(), ys.min()), (xs.max(), ys.min()), (xs.max(), "
      "ys.max())]]]");
  const Outcome run =
      hullbench({"run", "states", "--filter", "^(convex_hull|sample)/ca/n:2000/holes:0", "--repetitions", "2",
                 "--adapters", methods().string(), "--with", "sample", "--out", "run"});
  ASSERT_EQ(run.code, 0) << run.out << run.err;
  const json report = read_json("run/report.json");
  ASSERT_EQ(report["runs"].size(), 2U);
  const json& row = report["runs"][1];
  EXPECT_EQ(row["name"].get<std::string>(), "sample/ca/n:2000/holes:0/protocol:default");
  const auto hash = report["manifests"]["sample"].get<std::string>().substr(0, 8);
  EXPECT_EQ(row["method_version"].get<std::string>(), "1+" + hash);
  for (const json& phases : row["phases_ns"]) {
    EXPECT_GT(phases["outside"].get<std::int64_t>(),
              phases["run"].get<std::int64_t>() + phases["extract"].get<std::int64_t>());
  }
  expect_says(run.out, "| sample");
  expect_valid("run/report.json");
}

TEST_F(AdapterCommandTest, AnotherProgramIsAnotherRun) {
  const std::vector<std::string> words = {"run",    "states", "--filter",      "^sample/ca/n:2000/holes:0",
                                          "--out",  "run",    "--repetitions", "1",
                                          "--with", "sample", "--adapters",    methods().string()};
  python_method("    return []");
  ASSERT_EQ(hullbench(words).code, 0);
  EXPECT_EQ(hullbench(words).code, 0) << "the same run goes on";
  const std::string helper = read_text(methods() / "hullbench_worker.py");
  write_text(methods() / "hullbench_worker.py", helper + "# changed\n");
  expect_refusal(hullbench(words), 2, "holds another run");
  write_text(methods() / "hullbench_worker.py", helper);
  EXPECT_EQ(hullbench(words).code, 0);
  write_text(methods() / "sample_worker.py", read_text(methods() / "sample_worker.py") + "# changed\n");
  expect_refusal(hullbench(words), 2, "holds another run");
}

TEST_F(AdapterCommandTest, TheContractSaysWhatToMend) {
  python_method("    return [[points[:3]]]");
  expect_broken("one point", "return no polygon for points without an area");
  python_method("    import random\n    return [[random.sample(sorted(map(tuple, points)), 3)]]");
  expect_broken("the same points again", "start every run from nothing");
  python_method("    return [[points[[0, 1, 2]]]] if len(points) > 2 else []");
  expect_broken("the points in another order", "let nothing depend on the order of the points");
  python_method("    return [[[(0, 0), (9, 0), (9, 9)]]]");
  expect_broken("a square of points", "larger than the points' convex hull");
  python_method(
      "    x, y = points.min(axis=0); w, z = points.max(axis=0)\n    return [[[(x, y), (w, z), (w, y), (x, "
      "z)]]]");
  expect_broken("a square of points", "invalid polygon");
  python_method("    return [[points[:3]], [points[:3] + 2]]");
  expect_broken("a square of points", "several polygons, which the method says it cannot have");
  python_method("    import time; time.sleep(60 if len(points) > 1000 else 0); return []");
  expect_broken("20000 points within the limits", "timeout", "3");
  python_method("    import os; os.abort()");
  expect_broken("one point", "SIGABRT");
  python_method("    import time; time.sleep(60)");
  expect_end(hullbench({"adapter", "test", "sample", "--adapters", methods().string(), "--timeout", "0.2"}),
             4, "", "keeps part of the contract: 1 of 3 points");
}

TEST_F(AdapterCommandTest, APolygonOfPointsThatAreNotFiniteIsToBeRefused) {
  python_method("    return [[[(0, 0), (1, 0), (0, 1)]]]");
  std::string helper = read_text(methods() / "hullbench_worker.py");
  const std::string check = "if not finite.all():";
  ASSERT_NE(helper.find(check), std::string::npos);
  write_text(methods() / "hullbench_worker.py",
             helper.replace(helper.find(check), check.size(), "if False:"));
  for (const char* point : {"a point that is not a number", "a point at infinity"})
    expect_broken(point, "1 polygon, 0 holes; refuse it in 'load' as 'invalid_argument'");
}

TEST_F(AdapterCommandTest, WhatIsPrintedDoesNotBreakTheProtocol) {
  python_method("    print('hello'); import sys; print('there', file=sys.stderr); return []");
  const Outcome tested = test_sample();
  EXPECT_EQ(tested.out.find("protocol"), std::string::npos) << tested.out;
  expect_says(tested.out, "ok    one point");
}

TEST_F(AdapterCommandTest, AModuleThatIsMissingIsNotInstalled) {
  python_method("    return []");
  write_text(methods() / "sample_worker.py", "import hullbench_worker\nimport no_such_module\n");
  const Outcome tested = test_sample();
  EXPECT_EQ(tested.code, 6) << tested.out;
  expect_says(tested.out,
              "not_installed: No module named 'no_such_module', looked for by /usr/bin/python3; "
              "remedy: sudo apt-get install python3-numpy");
}

// Node ends before the worker's first word, so what is printed names it and the command that installs
// packages.
TEST_F(AdapterCommandTest, APackageThatNodeLacksIsNamedWithNodeAndTheCommandThatInstallsIt) {
  ASSERT_EQ(hullbench({"adapter", "new", "lacking", "--lang", "js"}).code, 0);
  const fs::path adapters = folder() / "config" / "hullbench" / "adapters";
  write_text(adapters / "lacking_worker.mjs", "import \"no-such-package\";\n");
  change_json(adapters / "lacking.json",
              [](json& manifest) { manifest["install"] = "npm install no-such-package"; });
  const Outcome tested = hullbench({"adapter", "test", "lacking"});
  EXPECT_EQ(tested.code, 4) << tested.out;
  expect_says(tested.out, "no-such-package");
  expect_says(tested.out,
              "started by 'node', and what it needs is installed by 'npm install no-such-package'");
}

TEST_F(AdapterCommandTest, AWorkerThatBreaksAtItsStartIsNotMissing) {
  python_method("    return []");
  write_text(methods() / "sample_worker.py", "raise SystemExit(3)\n");
  EXPECT_EQ(test_sample().code, 4);
}

TEST_F(AdapterCommandTest, NamesOfModulesAndOfNpmsFilesAreGoodNames) {
  for (const std::string name : {"json", "package_hull"}) {
    const Outcome made = succeeded(hullbench({"adapter", "new", name, "--lang", "js"}));
    const bool has_new_helper = made.out.find("hullbench_worker.mjs") != std::string::npos;
    EXPECT_EQ(has_new_helper, name == "json") << made.out;
    EXPECT_EQ(hullbench({"adapter", "test", name}).code, 0) << name;
  }
}

TEST_F(AdapterCommandTest, NamesAndFilesThatAreTaken) {
  expect_refusal(hullbench({"adapter", "new", "My-Hull", "--lang", "js"}), 2, "small letters");
  for (const std::string taken : {"polylidar", "concaveman", "hullbench"}) {
    expect_refusal(hullbench({"adapter", "new", taken, "--lang", "js"}), 2, "already");
  }
  expect_refusal(hullbench({"adapter", "new", "sample", "--lang", "fortran"}), 2, "--lang");
  expect_refusal(hullbench({"adapter", "test", "nothing"}), 2, "there is no method 'nothing'");
  expect_refusal(hullbench({"adapter", "test", "polylidar", "--adapters", "nowhere"}), 2,
                 "there is no folder nowhere");
  fs::create_directories(methods());
  write_text(methods() / "sample_worker.mjs", "mine");
  expect_refusal(hullbench({"adapter", "new", "sample", "--lang", "js", "--out", methods().string()}), 2,
                 "is there already");
  EXPECT_EQ(read_text(methods() / "sample_worker.mjs"), "mine");
  EXPECT_FALSE(fs::exists(methods() / "sample.json"));
  expect_refusal(hullbench({"run", "states", "--with", "polylidar", "--dry-run"}), 2, "built in");
}

TEST_F(AdapterCommandTest, ACppMethodIsAFileAndALine) {
  succeeded(hullbench({"adapter", "new", "sample_hull", "--lang", "cpp", "--out", methods().string()}));
  EXPECT_EQ(read_text(methods() / "adapters.cmake"), "add_adapter(NAME sample_hull TITLE \"sample_hull\")\n");
  EXPECT_EQ(read_text(methods() / "sample_hull.cpp").find('@'), std::string::npos);
}

}  // namespace
}  // namespace hullbench::testing
