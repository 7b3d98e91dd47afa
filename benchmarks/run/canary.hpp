// The machine's state, told by two fixed pieces of the harness's own work: what takes a different time now
// than before is the machine and not a method.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "benchmarks/record/record.hpp"

namespace hullbench::run {

/// Two pieces of work of about 5 ms each on the workers' core: reads from 64 MiB of which each says where the
/// next one is, bound by memory, and a chain of multiplications and additions, bound by arithmetic.
class Canary {
 public:
  /// Prepares the memory. The work is done on `core`; without one, or where the system refuses it, on any.
  explicit Canary(std::optional<int> core);

  /// Does both once. The thread that asks is back on its own cores when this returns.
  record::CanaryTimes look();

 private:
  /// As long as a line of a processor's cache, so that every read fetches another one.
  struct alignas(64) Line {
    std::uint32_t next = 0;  ///< the line to read after this one
  };
  struct Free {
    void operator()(Line* lines) const;
  };
  static std::unique_ptr<Line[], Free> reserve_lines();

  std::int64_t time_memory();
  std::int64_t time_arithmetic();

  std::optional<int> core_;
  std::unique_ptr<Line[], Free> lines_;  ///< one cycle through all of them, in random order
  std::uint32_t line_ = 0;      ///< where the next read goes on, so that none finds what an earlier one left
  volatile double result_ = 0;  ///< else the compiler may see that nobody looks
};

/// Tells whether the machine is as it mostly was in this run.
class MachineWatch {
 public:
  /// A canary may differ by this part from the median of all so far.
  static constexpr double kTolerance = 0.15;
  /// With fewer canaries nothing is off: there is no median to believe.
  static constexpr std::size_t kFewest = 5;

  /// `look` gives a new canary, which holds for `lifetime`.
  explicit MachineWatch(std::function<record::CanaryTimes()> look,
                        std::chrono::nanoseconds lifetime = std::chrono::seconds(1));

  /// A new canary, or the last one when it is not older than its lifetime: rounds of a few milliseconds would
  /// take twice as long otherwise.
  record::CanaryTimes recent();
  record::CanaryTimes fresh();

  /// Whether one of both times differs from its median by more than kTolerance, up or down.
  bool is_off(const record::CanaryTimes& canary) const;

  /// A round is measured at most so often.
  static constexpr int kMostTries = 3;
  /// All repeated rounds together take at most this part of the time of the others, and this time: a machine
  /// that is never steady, or a round of minutes, must not make a run three times as long.
  static constexpr double kRepeatShare = 0.2;
  static constexpr std::chrono::seconds kRepeatTime{10};

  /// Whether a round with that canary is to be measured again, which took `took` at its try number `tries`,
  /// counted from 1. To be asked once after every try.
  bool wants_again(const record::CanaryTimes& canary, int tries, std::chrono::nanoseconds took);

 private:
  std::function<record::CanaryTimes()> look_;
  std::chrono::nanoseconds lifetime_;
  std::chrono::steady_clock::time_point taken_;
  // Of every canary so far, the last one at the end.
  std::vector<std::int64_t> memory_;
  std::vector<std::int64_t> compute_;
  // Their medians, which do not change before the next canary: there are many more rounds than canaries.
  double usual_memory_ = 0;
  double usual_compute_ = 0;
  std::chrono::nanoseconds first_tries_{0};
  std::chrono::nanoseconds later_tries_{0};
};

}  // namespace hullbench::run
