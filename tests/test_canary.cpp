// The canaries that tell of the machine's state, and what is made of them.
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <vector>

#include "benchmarks/base/cores.hpp"
#include "benchmarks/run/canary.hpp"
#include "benchmarks/worker/worker_process.hpp"

namespace hullbench {
namespace {

using namespace std::chrono_literals;

TEST(Canary, TakesTheTimeOfItsWork) {
  run::Canary canary(allowed_cores().back());
  for (int i = 0; i < 3; ++i) {
    const record::CanaryTimes times = canary.look();
    // 30,000 reads of which each waits for the one before, and 3 million steps of a multiplication and an
    // addition that do so too: not even a cache's answer or a step takes less than a third of a nanosecond.
    EXPECT_GT(times.memory, 30'000 / 3);
    EXPECT_GT(times.compute, 3'000'000 / 3);
  }
}

TEST(Canary, LeavesTheThreadOnItsCores) {
  const std::vector<int> before = allowed_cores();
  run::Canary canary(before.back());
  EXPECT_EQ(allowed_cores(), before);
  canary.look();
  EXPECT_EQ(allowed_cores(), before);
}

TEST(Canary, WorksWhereItMayNotUseTheCore) {
  constexpr int kNoSuchCore = CPU_SETSIZE - 1;
  const std::vector<int> allowed = allowed_cores();
  ASSERT_EQ(std::ranges::count(allowed, kNoSuchCore), 0);
  EXPECT_GT(run::Canary(kNoSuchCore).look().memory, 0);
  EXPECT_GT(run::Canary(std::nullopt).look().memory, 0);
}

/// A watch that sees these canaries, one after the other.
class Watched {
 public:
  explicit Watched(std::chrono::nanoseconds lifetime = 0s) : machine([this] { return next(); }, lifetime) {}

  record::CanaryTimes next() {
    const record::CanaryTimes canary = coming.front();
    coming.pop_front();
    return canary;
  }

  /// As many canaries of 100 and 1000.
  void look(int count) {
    for (int i = 0; i < count; ++i) {
      coming.push_back({100, 1000});
      machine.fresh();
    }
  }

  std::deque<record::CanaryTimes> coming;
  run::MachineWatch machine;
};

TEST(MachineWatch, FindsWhatIsOffInEitherDirectionAndKind) {
  Watched watched;
  watched.look(9);
  for (const record::CanaryTimes& fine :
       {record::CanaryTimes{115, 1150}, record::CanaryTimes{85, 850}, record::CanaryTimes{100, 1000}})
    EXPECT_FALSE(watched.machine.is_off(fine)) << fine.memory << " " << fine.compute;
  for (const record::CanaryTimes& off : {record::CanaryTimes{116, 1000}, record::CanaryTimes{84, 1000},
                                         record::CanaryTimes{100, 1151}, record::CanaryTimes{100, 849}})
    EXPECT_TRUE(watched.machine.is_off(off)) << off.memory << " " << off.compute;
}

TEST(MachineWatch, HasNoOpinionBeforeFiveCanaries) {
  Watched watched;
  watched.look(4);
  EXPECT_FALSE(watched.machine.is_off({1000, 1000}));
  watched.look(1);
  EXPECT_TRUE(watched.machine.is_off({1000, 1000}));
}

TEST(MachineWatch, GoesWithAMachineThatStaysInAnotherState) {
  Watched watched;
  watched.look(5);
  for (int i = 0; i < 6; ++i) {
    watched.coming.push_back({200, 1000});
    watched.machine.fresh();
  }
  EXPECT_FALSE(watched.machine.is_off({200, 1000}));
  EXPECT_TRUE(watched.machine.is_off({100, 1000}));
}

TEST(MachineWatch, SharesACanaryWhileItLives) {
  Watched watched(1h);
  watched.coming = {{1, 1}, {2, 2}};
  EXPECT_EQ(watched.machine.recent().memory, 1);
  EXPECT_EQ(watched.machine.recent().memory, 1);
  EXPECT_EQ(watched.machine.fresh().memory, 2);
  EXPECT_EQ(watched.machine.recent().memory, 2);
  Watched short_lived(0s);
  short_lived.coming = {{1, 1}, {2, 2}};
  EXPECT_EQ(short_lived.machine.recent().memory, 1);
  EXPECT_EQ(short_lived.machine.recent().memory, 2);
}

TEST(MachineWatch, HasARoundMeasuredThreeTimesAtMost) {
  Watched watched;
  watched.look(9);
  const record::CanaryTimes off = {200, 1000};
  EXPECT_FALSE(watched.machine.wants_again({100, 1000}, 1, 1ms));
  EXPECT_TRUE(watched.machine.wants_again(off, 1, 1ms));
  EXPECT_TRUE(watched.machine.wants_again(off, 2, 1ms));
  EXPECT_FALSE(watched.machine.wants_again(off, 3, 1ms));
}

TEST(MachineWatch, RepeatsNoMoreThanAFifthOfTheTime) {
  Watched watched;
  watched.look(9);
  const record::CanaryTimes off = {200, 1000};
  // One minute is more than ten seconds and a fifth of a minute.
  EXPECT_FALSE(watched.machine.wants_again(off, 1, 60s));
  for (int i = 0; i < 4; ++i) EXPECT_FALSE(watched.machine.wants_again({100, 1000}, 1, 60s));
  // 10 s and a fifth of six minutes are 82 s: one minute fits, two do not.
  EXPECT_TRUE(watched.machine.wants_again(off, 1, 60s));
  EXPECT_FALSE(watched.machine.wants_again(off, 2, 60s));
  // 10 s and a fifth of seven minutes are 94 s.
  EXPECT_FALSE(watched.machine.wants_again(off, 1, 60s));
  EXPECT_TRUE(watched.machine.wants_again(off, 1, 5s)) << "a short one still fits";
}

}  // namespace
}  // namespace hullbench
