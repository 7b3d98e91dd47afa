// Work on several cores: everything once, whatever some of it throws.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "benchmarks/base/cores.hpp"
#include "benchmarks/base/parallel.hpp"
#include "benchmarks/worker/worker_process.hpp"
#include "tests/complaint.hpp"

namespace hullbench::testing {
namespace {

using namespace std::chrono_literals;

/// No cores, one, and more threads than most machines have cores; a core that there is not does no harm.
const std::vector<std::vector<int>> kCoreLists = {
    {}, {0}, {0, 1}, {kAnyCore, kAnyCore}, {0, 0, 0, 0, 0, 0, 0, 1000}};

TEST(ForEachInParallel, CallsEveryIndexOnce) {
  for (const std::vector<int>& cores : kCoreLists) {
    for (const std::size_t count : {0U, 1U, 2U, 3U, 1000U}) {
      std::vector<std::atomic<int>> calls(count);
      for_each_in_parallel(count, cores, [&](std::size_t i) { ++calls.at(i); });
      EXPECT_TRUE(std::ranges::all_of(calls, [](const auto& call) { return call == 1; }))
          << count << " on " << cores.size() << " cores";
    }
  }
}

TEST(ForEachInParallel, ThrowsTheExceptionOfTheSmallestIndexAfterAllOthersRan) {
  for (const std::vector<int>& cores : kCoreLists) {
    std::vector<std::atomic<int>> calls(100);
    const auto count_calls = [&](std::size_t i) {
      ++calls[i];
      // The smaller index throws later than the larger ones do.
      if (i == 3) std::this_thread::sleep_for(20ms);
      if (i == 3 || i == 4 || i == 99) throw std::runtime_error(std::to_string(i));
    };
    EXPECT_EQ(complaint_of([&] { for_each_in_parallel(calls.size(), cores, count_calls); }), "3");
    EXPECT_TRUE(std::ranges::all_of(calls, [](const auto& call) { return call == 1; }));
  }
}

TEST(ForEachInParallel, ThrowsWhatIsNoStandardExceptionToo) {
  for (const std::vector<int>& cores : kCoreLists)
    EXPECT_THROW(for_each_in_parallel(2, cores, [](std::size_t i) { throw static_cast<int>(i); }), int);
}

std::set<std::thread::id> threads_of(std::size_t count, const std::vector<int>& cores) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  for_each_in_parallel(count, cores, [&](std::size_t) {
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  return threads;
}

TEST(ForEachInParallel, StaysOnTheCallersThreadWithoutSeveralCoresOrSeveralItems) {
  const std::set<std::thread::id> here = {std::this_thread::get_id()};
  EXPECT_EQ(threads_of(10, {}), here);
  EXPECT_EQ(threads_of(10, {0}), here);
  EXPECT_EQ(threads_of(1, {0, 1}), here);
  EXPECT_TRUE(threads_of(0, {0, 1}).empty());
}

// Each of two items waits until the other one has begun, which one thread alone could never do.
TEST(ForEachInParallel, UsesTwoThreadsAtATimeOnTwoCores) {
  std::atomic<int> begun{0};
  std::atomic<int> met{0};
  for_each_in_parallel(2, {0, 1}, [&](std::size_t) {
    ++begun;
    const auto deadline = std::chrono::steady_clock::now() + 10s;
    while (begun < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(1ms);
    if (begun == 2) ++met;
  });
  EXPECT_EQ(met, 2);
}

TEST(ForEachInParallel, LeavesTheCallersCoresAsTheyWere) {
  const std::vector<int> before = allowed_cores();
  for_each_in_parallel(100, before, [](std::size_t) {});
  EXPECT_EQ(allowed_cores(), before);
}

TEST(ForEachInParallel, LeavesAThreadOfAnyCoreWhereItMayBe) {
  const std::vector<int> all = allowed_cores();
  for_each_in_parallel(2, {kAnyCore, kAnyCore}, [&](std::size_t) { EXPECT_EQ(allowed_cores(), all); });
}

}  // namespace
}  // namespace hullbench::testing
