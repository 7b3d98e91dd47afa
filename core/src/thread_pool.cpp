#include "thread_pool.hpp"

#ifndef POLYLIDAR_ONE_THREAD

namespace polylidar::detail {

namespace {

/// Waits until `value` is no longer `old`. The steps of a pipeline follow one another within microseconds,
/// and waking a sleeping thread takes longer than that: so a thread only yields at first, and sleeps when
/// that was in vain.
template <class T>
void wait_while(const std::atomic<T>& value, T old) {
  constexpr int kOffers = 1024;
  for (int i = 0; i < kOffers; ++i) {
    if (value.load(std::memory_order_acquire) != old) return;
    std::this_thread::yield();
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

/// Starts as many threads as are wanted, in place of those that run.
void ThreadPool::start() {
  if (started_.size() + 1 == used_) return;
  stop();
  shares_ = std::vector<Share>(used_);
  started_.reserve(used_ - 1);
  while (started_.size() + 1 < used_) started_.emplace_back(&ThreadPool::serve, this, started_.size() + 1);
}

void ThreadPool::run(Call call, const void* task, std::uint32_t count, std::size_t most_threads) {
  start();
  const std::size_t taking_part = std::min(shares_.size(), most_threads);
  const std::uint32_t job = job_.load(std::memory_order_relaxed) + 1;
  call_.store(call, std::memory_order_relaxed);
  task_.store(task, std::memory_order_relaxed);
  taking_part_.store(taking_part, std::memory_order_relaxed);
  tasks_left_.store(count, std::memory_order_relaxed);
  has_failed_.store(false, std::memory_order_relaxed);
  for (std::size_t t = 0; t < taking_part; ++t) {
    const std::uint64_t begin = std::uint64_t{count} * t / taking_part;
    const std::uint64_t end = std::uint64_t{count} * (t + 1) / taking_part;
    shares_[t].end.store(static_cast<std::uint32_t>(end), std::memory_order_relaxed);
    shares_[t].left.store(std::uint64_t{job} << 32U | (end - begin), std::memory_order_relaxed);
  }
  job_.store(job, std::memory_order_release);
  job_.notify_all();
  work(0, job);
  for (std::uint32_t left = 0; (left = tasks_left_.load(std::memory_order_acquire)) != 0;) {
    wait_while(tasks_left_, left);
  }
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

/// Takes the thread's own tasks of a job, then those that the others have left; none if the job is over.
void ThreadPool::work(std::size_t thread, std::uint32_t job) {
  const std::size_t taking_part = taking_part_.load(std::memory_order_relaxed);
  std::uint32_t done = 0;
  for (std::size_t t = 0; thread < taking_part && t < taking_part; ++t) {
    Share& share = shares_[(thread + t) % taking_part];
    std::uint64_t left = share.left.load(std::memory_order_relaxed);
    while (left >> 32U == job && static_cast<std::uint32_t>(left) != 0) {
      if (!share.left.compare_exchange_weak(left, left - 1, std::memory_order_acquire)) continue;
      const std::uint32_t end = share.end.load(std::memory_order_relaxed);
      try {
        if (!has_failed_.load(std::memory_order_relaxed)) {
          call_.load(std::memory_order_relaxed)(task_.load(std::memory_order_relaxed), thread,
                                                end - static_cast<std::uint32_t>(left));
        }
      } catch (...) {
        const std::lock_guard lock(error_mutex_);
        if (!error_) error_ = std::current_exception();
        has_failed_.store(true, std::memory_order_relaxed);
      }
      ++done;
      left = share.left.load(std::memory_order_relaxed);
    }
  }
  if (done != 0 && tasks_left_.fetch_sub(done, std::memory_order_acq_rel) == done) tasks_left_.notify_one();
}

/// The life of a started thread.
void ThreadPool::serve(std::size_t thread) {
  for (std::uint32_t seen = 0;;) {
    wait_while(job_, seen);
    seen = job_.load(std::memory_order_acquire);
    if (call_.load(std::memory_order_relaxed) == nullptr) return;
    work(thread, seen);
  }
}

void ThreadPool::stop() {
  call_.store(nullptr, std::memory_order_relaxed);
  job_.fetch_add(1, std::memory_order_release);
  job_.notify_all();
  for (std::thread& thread : started_) thread.join();
  started_.clear();
  job_.store(0, std::memory_order_relaxed);
}

}  // namespace polylidar::detail

#endif
