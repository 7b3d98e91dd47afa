// Workers that do everything a method may do to the harness, and the statuses that come of it.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "adapters/wkb.hpp"
#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/huge_pages.hpp"
#include "benchmarks/base/interrupt.hpp"
#include "benchmarks/worker/method_session.hpp"
#include "benchmarks/worker/protocol.hpp"
#include "benchmarks/worker/stray_processes.hpp"
#include "benchmarks/worker/worker_process.hpp"
#include "tests/complaint.hpp"
#include "tests/program.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

using namespace std::chrono_literals;

std::vector<std::string> misbehaving(const std::string& mode) {
  return {MISBEHAVING_WORKER, mode};
}

worker::Method method_of(const std::string& name, const std::vector<std::string>& command) {
  worker::Method method;
  method.name = method.title = name;
  method.command = command;
  return method;
}

/// As a manifest describes it: all but the version is known beforehand.
worker::Method described_method(const std::string& name, const std::vector<std::string>& command) {
  worker::Method method = method_of(name, command);
  method.info.emplace();
  method.info->name = name;
  method.install = "sudo apt-get install it";
  return method;
}

class MethodSessionTest : public ::testing::Test {
 protected:
  /// A run of the worker that misbehaves in this way, with what ctest's machine allows as a limit where it
  /// does not matter.
  worker::Attempt attempt(const std::string& mode, std::chrono::milliseconds timeout = 30s) {
    start(method_of(mode, misbehaving(mode)));
    return run(timeout);
  }

  void start(const worker::Method& method, const worker::WorkerLimits& limits = {256, std::nullopt, 8}) {
    session_ = std::make_unique<worker::MethodSession>(method, limits);
  }

  worker::Attempt run(std::chrono::milliseconds timeout = 30s,
                      worker::Watch watch = worker::Watch::kNothing) {
    return session_->run(square(), {{"size", 1}}, folder_.path(), timeout, watch);
  }

  /// A session with a method that compiles while it runs, and its warm-up.
  worker::Attempt warm_up(const std::string& mode) {
    worker::Method method = method_of(mode, misbehaving(mode));
    method.jit = true;
    start(method);
    EXPECT_TRUE(session_->is_cold());
    return session_->warm_up(square(), {{"size", 1}}, folder_.path(), 30s);
  }

  /// Its corners, in a file.
  worker::LoadedPoints square() const {
    const std::vector<Point> points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    worker::write_points_file(folder_.path() / "points", points);
    return {"square", folder_.path() / "points", points.size()};
  }

  TemporaryFolder folder_;
  std::unique_ptr<worker::MethodSession> session_;
};

TEST_F(MethodSessionTest, AGoodWorkerGivesResultAndTimes) {
  const worker::Attempt result = attempt("good");
  ASSERT_EQ(result.status, record::Status::kOk) << result.detail;
  EXPECT_EQ(result.time_ns(), 1010);
  EXPECT_EQ(result.phases_ns.at("load"), 5);
  EXPECT_EQ(result.phases_ns.at("outside"), result.elapsed.count());
  EXPECT_GT(result.phases_ns.at("outside"), result.time_ns());
  EXPECT_EQ(result.phases_ns.at("run.shape"), 900);
  EXPECT_EQ(polylidar::area(from_wkb(result.wkb)), 1.0);
  // Only the points are left: results are removed once they are read.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(MethodSessionTest, PeakMemoryIsThatOfTheRunThatIsWatched) {
  start(method_of("borrows_memory_once", misbehaving("borrows_memory_once")));
  const worker::Attempt large = run(30s, worker::Watch::kMemory);
  ASSERT_EQ(large.status, record::Status::kOk) << large.detail;
  if (!large.peak_memory_bytes)
    GTEST_SKIP() << "skipped: this system does not tell the peak of a process's memory";
  constexpr std::int64_t kBorrowed = std::int64_t{64} * 1024 * 1024;
  EXPECT_GT(*large.peak_memory_bytes, kBorrowed);
  EXPECT_EQ(run().peak_memory_bytes, std::nullopt);
  const worker::Attempt small = run(30s, worker::Watch::kMemory);
  EXPECT_GT(small.peak_memory_bytes.value(), 0);
  EXPECT_LT(small.peak_memory_bytes.value(), *large.peak_memory_bytes - kBorrowed / 2);
}

TEST_F(MethodSessionTest, PeakMemoryOfAMethodInAServerIsNotKnown) {
  start(method_of("in_server", misbehaving("in_server")));
  const worker::Attempt result = run(30s, worker::Watch::kMemory);
  EXPECT_EQ(result.status, record::Status::kOk) << result.detail;
  EXPECT_EQ(result.peak_memory_bytes, std::nullopt);
  EXPECT_TRUE(session_->info()->capabilities.in_server);
}

/// A way to fail, and what becomes of it.
struct Failure {
  const char* name;
  const char* mode;
  record::Status status;
  const char* words;
  std::chrono::milliseconds timeout = 30s;
};

/// What GoogleTest says of it.
// NOLINTNEXTLINE(readability-identifier-naming): GoogleTest calls it
void PrintTo(const Failure& failure, std::ostream* out) {
  *out << failure.mode;
}

class FailingWorker : public MethodSessionTest, public ::testing::WithParamInterface<Failure> {};

TEST_P(FailingWorker, HasAStatusAndSaysWhy) {
  const Failure& failure = GetParam();
  const worker::Attempt result = attempt(failure.mode, failure.timeout);
  EXPECT_EQ(to_string(result.status), to_string(failure.status)) << result.detail;
  expect_says(result.detail, failure.words);
  EXPECT_TRUE(result.wkb.empty());
}

using enum record::Status;
constexpr Failure kFailures[] = {
    {"Crash", "crash", kCrash, "SIGSEGV"},
    {"CrashAtStart", "crash_at_start", kCrash, "SIGSEGV"},
    {"CrashOnLoad", "crash_on_load", kCrash, "SIGBUS"},
    {"Hang", "hang", kTimeout, "no answer within 0.2 s", 200ms},
    {"HangThatIgnoresTermination", "hang_hard", kTimeout, "0.2 s", 200ms},
    {"MemoryUsedUp", "memory", kMemory, "256 MiB"},
    {"MemoryAsTheWorkerSays", "says_memory", kMemory, "no room"},
    {"Unsupported", "says_unsupported", kUnsupported, "this many points"},
    {"Error", "says_error", kError, "no luck"},
    {"NotInstalledAfterItsStart", "says_not_installed", kError, "the server went down"},
    {"EarlyExit", "early_exit", kCrash, "exit code 7 without an answer; it said: I have seen enough"},
    {"ClosedOutput", "close_output", kError, "closed its output"},
    {"GarbageOnTheProtocol", "garbage", kError, "answered 'lorem ipsum'"},
    {"EndlessLine", "long_line", kError, "more than 1 MiB"},
    {"ErrorWithoutKind", "error_without_kind", kError, "has no kind"},
    {"OtherName", "other_name", kError, "calls itself 'somebody'"},
    {"OtherProtocol", "other_protocol", kError, "another version"},
    {"WrongNonce", "wrong_nonce", kInvalidOutput, "another run"},
    {"NoPhases", "no_phases", kInvalidOutput, "no phases_ns"},
    {"NegativeTime", "negative_time", kInvalidOutput, "'run' is not a time"},
    {"MoreTimeThanPassed", "too_much_time", kInvalidOutput, "more time than"},
    {"NoResult", "no_result", kInvalidOutput, "there is no file"},
    // The first of them is taken for the answer.
    {"FloodOfLines", "flood_output", kInvalidOutput, "the reply is to another run"},
    {"FloodWithoutALineFeed", "flood_line", kError, "sent a line of more than 1 MiB"},
    {"FloodOfErrorOutputWithoutEnd", "flood_errors_for_ever", kTimeout, "no answer within 0.5 s", 500ms},
    {"FloodOfItsResult", "flood_result", kCrash, "SIGXFSZ"},
    {"ForkingWithoutRest", "fork_and_fork", kTimeout, "no answer within 0.5 s", 500ms},
};
INSTANTIATE_TEST_SUITE_P(Worker, FailingWorker, ::testing::ValuesIn(kFailures),
                         [](const auto& failure) { return std::string(failure.param.name); });

TEST_F(MethodSessionTest, ALimitInWhichNoWorkerCanStartIsALackOfMemory) {
  // Less than the C++ library takes that every worker of ours is linked with.
  start(method_of("good", misbehaving("good")), {2, std::nullopt, 8});
  const worker::Attempt result = run();
  EXPECT_EQ(to_string(result.status), "memory") << result.detail;
}

TEST_F(MethodSessionTest, FloodOfErrorOutputDoesNotBlockTheWorker) {
  EXPECT_EQ(attempt("flood_errors").status, record::Status::kOk);
  EXPECT_EQ(run().status, record::Status::kOk);
}

TEST_F(MethodSessionTest, AnAnswerThatNobodyAskedForIsNotTakenForTheNextOne) {
  ASSERT_EQ(attempt("unasked").status, record::Status::kOk);
  const worker::Attempt second = run();
  EXPECT_EQ(second.status, record::Status::kError);
  expect_says(second.detail, "spoke without being asked");
}

TEST_F(MethodSessionTest, PointsAreLoadedAgainAfterAnError) {
  EXPECT_EQ(attempt("loses_points").detail, "the points are gone");
  EXPECT_EQ(to_string(run().status), "ok");
}

TEST_F(MethodSessionTest, AFullDiskIsNoFailureOfTheMethod) {
  const fs::path disk = folder_.path() / "disk";
  fs::create_directory(disk);
  if (::unshare(CLONE_NEWNS) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      ::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=4m") != 0)
    GTEST_SKIP() << "skipped: a small disk can be made by root alone";
  start(method_of("fills_disk", misbehaving("fills_disk")));
  expect_complaint<std::runtime_error>([&] { session_->run(square(), {{"size", 1}}, disk, 30s); }, "is full");
  session_.reset();
  ::umount(disk.c_str());
}

TEST_F(MethodSessionTest, AWorkerThatDiedIsStartedAgain) {
  ASSERT_EQ(attempt("crash_on_second").status, record::Status::kOk);
  const pid_t first = session_->pid();
  EXPECT_EQ(run().detail, "SIGABRT");
  EXPECT_EQ(run().status, record::Status::kOk);
  EXPECT_NE(session_->pid(), first);
}

TEST_F(MethodSessionTest, AMethodThatCompilesIsWarmWhenItGetsNoFaster) {
  const worker::Attempt first = warm_up("gets_faster");
  EXPECT_EQ(to_string(first.status), "ok") << first.detail;
  EXPECT_EQ(first.time_ns(), 8'000'000 + 1) << "the time of the first run";
  EXPECT_FALSE(session_->is_cold());
  // From the 90th run on it is faster: after 100 runs the best of the last 25 is below that of the 25 before.
  EXPECT_EQ(run().time_ns(), 800'000 + 116) << "the runs 66 to 90 were no slower than 91 to 115";
  session_->quit(10s);
  EXPECT_TRUE(session_->is_cold()) << "the next process is another one";
  run();
  EXPECT_TRUE(session_->is_cold()) << "nobody has warmed it up";
}

TEST_F(MethodSessionTest, AWarmProcessIsWarmedUpForOtherParametersInFewerRuns) {
  warm_up("gets_faster");  // 115 runs
  const worker::LoadedPoints points = square();
  const Parameters other = {{"size", 2}};
  EXPECT_FALSE(session_->is_cold(points, {{"size", 1}}));
  EXPECT_TRUE(session_->is_cold(points, other));
  EXPECT_EQ(to_string(session_->warm_up(points, other, folder_.path(), 30s).status), "ok");
  EXPECT_FALSE(session_->is_cold(points, other));
  EXPECT_EQ(run().time_ns(), 800'000 + 115 + 20 + 1);
}

TEST_F(MethodSessionTest, AMethodThatTakesLongIsWarmAfterAWhile) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(to_string(warm_up("takes_long").status), "ok");
  EXPECT_GE(std::chrono::steady_clock::now() - start, worker::kWarmUpOfProcess.time);
  EXPECT_FALSE(session_->is_cold());
}

TEST_F(MethodSessionTest, AWarmUpThatFailsSaysWhy) {
  const worker::Attempt result = warm_up("crash_on_second");
  EXPECT_EQ(to_string(result.status), "crash");
  EXPECT_EQ(result.detail, "SIGABRT");
  EXPECT_TRUE(session_->is_cold());
}

TEST_F(MethodSessionTest, AMethodThatDoesNotCompileIsNeverCold) {
  attempt("good");
  EXPECT_FALSE(session_->is_cold());
  session_->quit(10s);
  EXPECT_FALSE(session_->is_cold());
}

TEST_F(MethodSessionTest, AWorkerThatIsKilledFromOutsideIsACrash) {
  ASSERT_EQ(attempt("good").status, record::Status::kOk);
  ::kill(session_->pid(), SIGKILL);
  const worker::Attempt result = run();
  EXPECT_EQ(to_string(result.status), "crash");
  expect_says(result.detail, "SIGKILL");
}

/// Each way to end, with what it leaves: a child in the worker's own group, in a session of its own, one that
/// does not hear SIGTERM either, and a hundred of them.
TEST_F(MethodSessionTest, WhatAWorkerLeavesBehindGoesWithIt) {
  for (const char* mode : {"orphan", "fork", "fork_and_crash", "fork_and_fork"}) {
    const record::Status status = attempt(mode, 500ms).status;
    EXPECT_EQ(status == record::Status::kOk, std::string(mode) == "fork") << to_string(status);
    session_.reset();
    // Killed, but by whom it is reaped is out of our hands.
    EXPECT_TRUE(wait_until([&] { return !runs_somewhere(misbehaving(mode)); })) << mode;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1)
        << mode << " leaves a file beside the points";
  }
}

TEST_F(MethodSessionTest, WhatAKilledHarnessLeftIsCleanedUpByTheNextOne) {
  const auto leaves_a_stray = [&] {
    const pid_t harness = ::fork();
    if (harness == 0) {
      attempt("fork");
      (void)std::raise(SIGKILL);
    }
    EXPECT_GT(harness, 0);
    EXPECT_EQ(::waitpid(harness, nullptr, 0), harness);
    // The worker went with the harness; its child is in a session of its own and lives.
    return runs_somewhere(misbehaving("fork"));
  };
  // A harness that another test starts just then cleans up as well: what it took is left once more.
  bool is_left = leaves_a_stray();
  for (int again = 0; again < 20 && !is_left; ++again) is_left = leaves_a_stray();
  ASSERT_TRUE(is_left);
  worker::end_strays_of_dead_harnesses();
  EXPECT_TRUE(wait_until([&] { return !runs_somewhere(misbehaving("fork")); }));
}

TEST_F(MethodSessionTest, WhatALiveHarnessStartedIsNotCleanedUp) {
  worker::WorkerProcess worker(misbehaving("good"), {});
  worker::end_strays_of_dead_harnesses();
  EXPECT_TRUE(is_running(worker.pid()));
}

TEST_F(MethodSessionTest, AProgramThatIsNotThereIsAnError) {
  start(method_of("good", {"/nowhere/worker"}), {});
  const worker::Attempt result = run();
  EXPECT_EQ(to_string(result.status), "error");
  EXPECT_EQ(result.detail, "cannot start the worker /nowhere/worker: No such file or directory");
}

TEST_F(MethodSessionTest, AManifestsProgramThatIsNotThereIsNotInstalled) {
  start(described_method("good", {"/nowhere/worker"}), {});
  const worker::Attempt result = run();
  EXPECT_EQ(to_string(result.status), "not_installed");
  EXPECT_EQ(result.detail, "there is no program /nowhere/worker");
  EXPECT_EQ(session_->start_reply().remedy, "sudo apt-get install it");
}

TEST_F(MethodSessionTest, AFileThatAManifestNeedsIsNotInstalled) {
  worker::Method method = described_method("good", misbehaving("good"));
  method.needs = {"/", "/nowhere/library"};
  start(method, {});
  const worker::Attempt result = run();
  EXPECT_EQ(to_string(result.status), "not_installed");
  EXPECT_EQ(result.detail, "there is no /nowhere/library");
}

TEST_F(MethodSessionTest, AWorkerThatTellsItsVersionIsDescribedByItsManifest) {
  const std::string script =
      "read line; echo '{\"protocol\": 1, \"version\": \"1.2\"}'; read line; echo "
      "'{\"error\": {\"kind\": \"unsupported\", \"message\": \"no\"}}'; read line";
  start(described_method("good", {"/bin/sh", "-c", script}), {});
  EXPECT_EQ(to_string(run().status), "unsupported");
  ASSERT_TRUE(session_->info());
  EXPECT_EQ(session_->info()->version, "1.2");
}

TEST_F(MethodSessionTest, TheVersionEndsWithTheHashOfTheSources) {
  worker::Method method = method_of("good", misbehaving("good"));
  method.sources = "0123abcd";
  start(method);
  ASSERT_EQ(run().status, record::Status::kOk);
  EXPECT_EQ(session_->info()->version, "1+0123abcd");
  EXPECT_EQ(worker::describe_method(*session_)["version"].get<std::string>(), "1+0123abcd");
}

TEST_F(MethodSessionTest, AnInterruptionEndsTheWaitAndTheWorker) {
  ASSERT_EQ(attempt("hang", 100ms).status, record::Status::kTimeout);
  set_interrupted(true);
  EXPECT_THROW(run(), Interrupted);
  set_interrupted(false);
  EXPECT_LE(session_->pid(), 0);
}

TEST_F(MethodSessionTest, ASignalThatEndsTheWholeJobIsAnInterruptionWhoeverItReachesFirst) {
  ASSERT_EQ(attempt("good").status, record::Status::kOk);
  const pid_t worker = session_->pid();
  ::kill(worker, SIGTERM);
  std::thread later([] {
    std::this_thread::sleep_for(100ms);
    set_interrupted(true);
  });
  EXPECT_THROW(run(), Interrupted);
  later.join();
  set_interrupted(false);
  EXPECT_EQ(run().status, record::Status::kOk);
}

TEST_F(MethodSessionTest, ASignalToTheWorkerAloneIsItsCrash) {
  ASSERT_EQ(attempt("good").status, record::Status::kOk);
  ::kill(session_->pid(), SIGTERM);
  const worker::Attempt result = run();
  EXPECT_EQ(to_string(result.status), "crash");
  EXPECT_EQ(result.detail, "SIGTERM");
}

TEST(WorkerProcess, KeepsALowerLimitOfTheHarness) {
  const pid_t harness = ::fork();
  if (harness == 0) {
    const rlimit low = {300U << 20U, 300U << 20U};
    setrlimit(RLIMIT_AS, &low);
    const std::string script = R"(read line; echo "{\"memory\": $(ulimit -v)}"; read line)";
    worker::WorkerProcess worker({"/bin/sh", "-c", script}, {512, std::nullopt});
    const worker::Reply reply = worker.request({{"request", "hello"}}, 30s);
    ::_exit(reply.status == record::Status::kOk && reply.body["memory"] == 300 * 1024 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(harness, &status, 0), harness);
  EXPECT_EQ(status, 0);
}

// Python says so without a reply, by a traceback.
TEST(WorkerProcess, APythonWithoutMemoryLacksMemory) {
  worker::WorkerProcess worker({SYSTEM_PYTHON, "-c", "input(); bytes(8 << 30)"}, {512, std::nullopt});
  EXPECT_EQ(to_string(worker.request({{"request", "hello"}}, 30s).status), "memory");
}

TEST_F(MethodSessionTest, AScratchFolderThatAMethodRemovedIsMadeAgain) {
  start(method_of("good", misbehaving("good")));
  const worker::Attempt result = session_->run(square(), {{"size", 1}}, folder_.path() / "gone", 30s);
  EXPECT_EQ(to_string(result.status), "ok") << result.detail;
}

TEST(WorkerProcess, EndsWithItsInput) {
  worker::WorkerProcess worker(misbehaving("good"), {});
  const pid_t pid = worker.pid();
  worker.quit(10s);
  EXPECT_FALSE(worker.alive());
  EXPECT_FALSE(is_running(pid));
}

TEST(WorkerProcess, SeveralEndAtTheSameTime) {
  std::vector<std::unique_ptr<worker::WorkerProcess>> workers;
  for (int i = 0; i < 5; ++i) {
    workers.push_back(std::make_unique<worker::WorkerProcess>(
        std::vector<std::string>{"/bin/sh", "-c", "read line; sleep 1"}, worker::WorkerLimits()));
  }
  const auto start = std::chrono::steady_clock::now();
  for (const auto& worker : workers) worker->ask_to_quit();
  for (const auto& worker : workers) EXPECT_TRUE(worker->quit(10s));
  EXPECT_LT(std::chrono::steady_clock::now() - start, 4s);
}

TEST(WorkerProcess, RunsOnTheCoreAndWithTheMemoryItIsGiven) {
  const int core = allowed_cores().back();
  // A shell is a worker that answers with what it sees.
  const std::string script =
      "read line; core=$(grep Cpus_allowed_list /proc/self/status | cut -f2); "
      "echo \"{\\\"core\\\": \\\"$core\\\", \\\"memory\\\": $(ulimit -v), \\\"dump\\\": $(ulimit -c)}\"; "
      "read line";
  worker::WorkerProcess worker({"/bin/sh", "-c", script}, {512, core});
  const worker::Reply reply = worker.request({{"request", "hello"}}, 30s);
  ASSERT_EQ(reply.status, record::Status::kOk) << reply.detail;
  EXPECT_EQ(reply.body["core"], std::to_string(core));
  EXPECT_EQ(reply.body["memory"], 512 * 1024);
  EXPECT_EQ(reply.body["dump"], 0);
}

// What the core asks for by itself, the malloc of every worker asks for too.
TEST(WorkerProcess, AsksForHugePages) {
  const std::string script = R"(read line; echo "{\"tunables\": \"$GLIBC_TUNABLES\"}"; read line)";
  const char* const own = std::getenv("GLIBC_TUNABLES");
  worker::WorkerProcess worker({"/bin/sh", "-c", script}, {});
  const worker::Reply reply = worker.request({{"request", "hello"}}, 30s);
  ASSERT_EQ(reply.status, record::Status::kOk) << reply.detail;
  EXPECT_EQ(reply.body["tunables"], worker_tunables(own == nullptr ? "" : own));
}

TEST(HugePages, AUsersOwnTunablesAreKept) {
  EXPECT_EQ(worker_tunables(""), "glibc.malloc.hugetlb=1");
  EXPECT_EQ(worker_tunables("glibc.malloc.check=3"), "glibc.malloc.check=3:glibc.malloc.hugetlb=1");
  EXPECT_EQ(worker_tunables("glibc.malloc.hugetlb=0:a=1"), "glibc.malloc.hugetlb=0:a=1");
  EXPECT_EQ(worker_tunables("not.glibc.malloc.hugetlb=0"),
            "not.glibc.malloc.hugetlb=0:glibc.malloc.hugetlb=1");
}

TEST(WorkerProcess, AReplyThatComesJustBeforeTheEndCounts) {
  const std::string script = R"(read line; echo '{"last": "word"}')";
  worker::WorkerProcess worker({"/bin/sh", "-c", script}, {});
  const worker::Reply reply = worker.request({{"request", "hello"}}, 30s);
  EXPECT_EQ(reply.status, record::Status::kOk) << reply.detail;
  EXPECT_EQ(reply.body["last"], "word");
}

TEST(Protocol, PointsSurviveTheFile) {
  const TemporaryFolder folder;
  const std::vector<Point> points = {{1.5, -2.25}, {1e300, 5e-324}};
  worker::write_points_file(folder.path() / "points", points);
  EXPECT_EQ(fs::file_size(folder.path() / "points"), 32U);
  EXPECT_EQ(worker::read_points_file(folder.path() / "points", 2), points);
  EXPECT_THROW(worker::read_points_file(folder.path() / "points", 3), std::runtime_error);
  EXPECT_THROW(worker::read_points_file(folder.path() / "none", 0), std::runtime_error);
}

TEST(Protocol, MethodsSurviveJson) {
  MethodInfo info;
  info.name = "some";
  info.version = "2.1";
  info.parameters = {{"alpha", "length", "A radius.", 0, std::numeric_limits<double>::infinity(), 4.5},
                     {"c", "1", "Required.", 1, 2, std::nullopt}};
  info.capabilities = {true, false};
  const MethodInfo copy = worker::method_from_json(json::parse(worker::method_to_json(info).dump()));
  EXPECT_EQ(copy.name, "some");
  ASSERT_EQ(copy.parameters.size(), 2U);
  EXPECT_EQ(copy.parameters[0].maximum, std::numeric_limits<double>::infinity());
  EXPECT_EQ(copy.parameters[0].default_value, 4.5);
  EXPECT_FALSE(copy.parameters[1].default_value.has_value());
  EXPECT_TRUE(copy.capabilities.holes);
  EXPECT_FALSE(copy.capabilities.several_polygons);
}

TEST(Protocol, LastWordsAreMadePrintable) {
  EXPECT_EQ(worker::printable("  a\nb\tc\x01\xC3\xA9 \n", 100), "a b c ??");
  EXPECT_EQ(worker::printable("0123456789", 4), "6789");
  EXPECT_EQ(worker::printable("\n\n", 10), "");
}

}  // namespace
}  // namespace hullbench::testing
