#include "benchmarks/run/canary.hpp"

#include <sched.h>
#include <sys/mman.h>

#include <cmath>
#include <new>
#include <utility>

#include "benchmarks/statistics/statistics.hpp"

namespace hullbench::run {
namespace {

using Clock = std::chrono::steady_clock;

/// 64 MiB, more than the caches that a core has for itself.
constexpr std::uint32_t kLines = 1U << 20U;
// About 5 ms each on the machines of today: long against a clock's resolution and an interrupt, short against
// a round.
constexpr int kReads = 30'000;
constexpr int kSteps = 3'000'000;

/// Keeps the thread on a core while it lives.
class OnCore {
 public:
  explicit OnCore(std::optional<int> core) {
    if (!core || ::sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    cpu_set_t only;
    CPU_ZERO(&only);
    CPU_SET(static_cast<std::size_t>(*core), &only);
    moved_ = ::sched_setaffinity(0, sizeof only, &only) == 0;
  }
  ~OnCore() {
    if (moved_) ::sched_setaffinity(0, sizeof before_, &before_);
  }
  OnCore(const OnCore&) = delete;
  OnCore& operator=(const OnCore&) = delete;

 private:
  cpu_set_t before_ = {};
  bool moved_ = false;
};

std::int64_t nanoseconds_since(Clock::time_point start) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
}

bool differs(std::int64_t value, double usual) {
  return std::abs(static_cast<double>(value) - usual) > MachineWatch::kTolerance * usual;
}

}  // namespace

void Canary::Free::operator()(Line* lines) const {
  ::munmap(lines, kLines * sizeof(Line));
}

std::unique_ptr<Canary::Line[], Canary::Free> Canary::reserve_lines() {
  void* memory =
      ::mmap(nullptr, kLines * sizeof(Line), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  // The system may turn it into huge pages in the middle of a run, and the same reads would be faster then.
  ::madvise(memory, kLines * sizeof(Line), MADV_NOHUGEPAGE);
  return std::unique_ptr<Line[], Free>(new (memory) Line[kLines]);
}

Canary::Canary(std::optional<int> core) : core_(core) {
  // On that core, so that the memory is the one that is nearest to it.
  const OnCore here(core_);
  lines_ = reserve_lines();
  // One cycle through all lines, without an order that a processor could foresee: Hull, T. E. and Dobell, A.
  // R. 1962. Random number generators. SIAM Rev. 4(3), theorem 1. The factor is Numerical Recipes' one.
  for (std::uint32_t i = 0; i < kLines; ++i) lines_[i].next = (1664525U * i + 1013904223U) % kLines;
}

record::CanaryTimes Canary::look() {
  const OnCore here(core_);
  const std::int64_t memory = time_memory();
  return {memory, time_arithmetic()};
}

std::int64_t Canary::time_memory() {
  const auto start = Clock::now();
  for (int i = 0; i < kReads; ++i) line_ = lines_[line_].next;
  result_ = line_;
  return nanoseconds_since(start);
}

std::int64_t Canary::time_arithmetic() {
  const auto start = Clock::now();
  // Each step needs the one before. The values go to 500 and stay there, far from those that slow a processor
  // down.
  double value = 1;
  for (int i = 0; i < kSteps; ++i) value = value * 0.999 + 0.5;
  result_ = value;
  return nanoseconds_since(start);
}

MachineWatch::MachineWatch(std::function<record::CanaryTimes()> look, std::chrono::nanoseconds lifetime)
    : look_(std::move(look)), lifetime_(lifetime) {}

record::CanaryTimes MachineWatch::recent() {
  if (memory_.empty() || Clock::now() - taken_ >= lifetime_) return fresh();
  return {memory_.back(), compute_.back()};
}

record::CanaryTimes MachineWatch::fresh() {
  const record::CanaryTimes canary = look_();
  taken_ = Clock::now();
  memory_.push_back(canary.memory);
  compute_.push_back(canary.compute);
  usual_memory_ = statistics::median(memory_);
  usual_compute_ = statistics::median(compute_);
  return canary;
}

bool MachineWatch::is_off(const record::CanaryTimes& canary) const {
  if (memory_.size() < kFewest) return false;
  return differs(canary.memory, usual_memory_) || differs(canary.compute, usual_compute_);
}

bool MachineWatch::wants_again(const record::CanaryTimes& canary, int tries, std::chrono::nanoseconds took) {
  (tries == 1 ? first_tries_ : later_tries_) += took;
  return is_off(canary) && tries < kMostTries &&
         later_tries_ + took <= kRepeatShare * first_tries_ + kRepeatTime;
}

}  // namespace hullbench::run
