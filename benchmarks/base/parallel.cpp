#include "benchmarks/base/parallel.hpp"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

namespace hullbench {
namespace {

/// Lets the calling thread run on `core` only. The harness keeps off the workers' core; its threads, which
/// work while no worker does, may use that core too.
void move_to_core(int core) {
  if (core == kAnyCore) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(core), &set);
  ::sched_setaffinity(0, sizeof set, &set);  // a thread that has to stay where it is works all the same
}

}  // namespace

void for_each_in_parallel(std::size_t count, const std::vector<int>& cores,
                          const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> errors(count);
  const auto take_turns = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  };
  if (cores.size() < 2 || count < 2) {
    take_turns();
  } else {
    std::vector<std::jthread> threads;
    for (std::size_t t = 0; t < std::min(cores.size(), count); ++t) {
      threads.emplace_back([&, core = cores[t]] {
        move_to_core(core);
        take_turns();
      });
    }
  }
  const auto error = std::ranges::find_if(errors, [](const std::exception_ptr& e) { return e != nullptr; });
  if (error != errors.end()) std::rethrow_exception(*error);
}

}  // namespace hullbench
