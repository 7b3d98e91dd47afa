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

void ThreadPool::run(const Job& job) {
  start();
  job_ = job;
  for (std::size_t t = 0; t < shares_.size(); ++t) {
    shares_[t].next.store(job.count * t / shares_.size(), std::memory_order_relaxed);
    shares_[t].end = job.count * (t + 1) / shares_.size();
  }
  still_working_.store(static_cast<std::uint32_t>(started_.size()), std::memory_order_relaxed);
  jobs_given_.fetch_add(1, std::memory_order_release);
  jobs_given_.notify_all();
  work(0);
  for (std::uint32_t left = 0; (left = still_working_.load(std::memory_order_acquire)) != 0;) {
    wait_while(still_working_, left);
  }
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

/// Takes the thread's own tasks, then those that the others have left.
void ThreadPool::work(std::size_t thread) {
  for (std::size_t t = 0; t < shares_.size(); ++t) {
    Share& share = shares_[(thread + t) % shares_.size()];
    while (share.next.load(std::memory_order_relaxed) < share.end) {
      const std::size_t i = share.next.fetch_add(1, std::memory_order_relaxed);
      if (i >= share.end) break;
      try {
        job_.call(job_.task, i);
      } catch (...) {
        const std::lock_guard lock(error_mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
  }
}

/// The life of a started thread.
void ThreadPool::serve(std::size_t thread) {
  for (std::uint32_t seen = 0;; ++seen) {
    wait_while(jobs_given_, seen);
    if (job_.call == nullptr) return;
    work(thread);
    if (still_working_.fetch_sub(1, std::memory_order_acq_rel) == 1) still_working_.notify_one();
  }
}

void ThreadPool::stop() {
  job_ = {};
  jobs_given_.fetch_add(1, std::memory_order_release);
  jobs_given_.notify_all();
  for (std::thread& thread : started_) thread.join();
  started_.clear();
  jobs_given_.store(0, std::memory_order_relaxed);
}

}  // namespace polylidar::detail

#endif
