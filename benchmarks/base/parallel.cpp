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
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(core), &set);
  ::sched_setaffinity(0, sizeof set, &set);  // a thread that has to stay where it is works all the same
}

void rethrow_first(const std::vector<std::exception_ptr>& errors) {
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
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
    run_on_threads(std::min(cores.size(), count), [&](std::size_t thread) {
      move_to_core(cores[thread]);
      take_turns();
    });
  }
  rethrow_first(errors);
}

void run_on_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::exception_ptr> errors(count);
  {
    std::vector<std::jthread> threads;
    for (std::size_t thread = 0; thread < count; ++thread) {
      threads.emplace_back([&work, &error = errors[thread], thread] {
        try {
          work(thread);
        } catch (...) {
          error = std::current_exception();
        }
      });
    }
  }
  rethrow_first(errors);
}

}  // namespace hullbench
