// Threads that wait for work between the steps of the pipeline.
#pragma once

#include <algorithm>
#include <cstddef>

#ifdef __wasm__
#define POLYLIDAR_ONE_THREAD
#else
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>
#endif

namespace polylidar::detail {

#ifdef POLYLIDAR_ONE_THREAD

/// WebAssembly's standard library has no threads: the caller's thread does everything, whatever number is
/// asked for.
class ThreadPool {
 public:
  void use(unsigned /*threads*/) {}
  unsigned threads() const { return 1; }

  template <class Task>
  void for_each(std::size_t count, const Task& task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
  template <class Task>
  void for_each_by_thread(std::size_t count, std::size_t /*most_threads*/, const Task& task) {
    for (std::size_t i = 0; i < count; ++i) task(std::size_t{0}, i);
  }
};

class Turns {
 public:
  template <class Work>
  void take(const Work& work) {
    work();
  }
};

#else

/// Runs tasks on the caller's thread and, if more than one is wanted, on threads that it starts when there
/// are tasks for them, and keeps. With one thread nothing is started, locked or counted. Not for use from
/// several threads at once.
///
/// Of every step a thread takes the same share of consecutive tasks first, then what others left of theirs.
/// So most of what a step reads is in the cache of the core that wrote it: fetching it from another takes
/// about 40 ns a cache line, and 200 where the two cores share no cache.
///
/// Nobody waits for a thread that has no task: one that slept takes some 50 microseconds to wake up, and
/// comes in at a later step.
class ThreadPool {
 public:
  static constexpr unsigned kMostThreads = 1024;

  ThreadPool() = default;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool() { stop(); }

  /// How many threads to use from now on, the caller's among them; >= 1. More than a thousand are not used.
  void use(unsigned threads) { used_ = std::min(threads, kMostThreads); }
  unsigned threads() const { return used_; }

  /// task(i) for every i below `count`, in any order and on any of the threads. Returns when all are done. If
  /// one throws, those that have not begun are left out, and this throws the first exception.
  template <class Task>
  void for_each(std::size_t count, const Task& task) {
    for_each_by_thread(count, used_, [&task](std::size_t, std::size_t i) { task(i); });
  }

  /// As for_each(), but calls task(thread, i), on at most `most_threads` threads; `thread` is below their
  /// number, and no two run tasks under one such number at the same time.
  template <class Task>
  void for_each_by_thread(std::size_t count, std::size_t most_threads, const Task& task) {
    if (used_ == 1 || count < 2 || most_threads < 2) {
      for (std::size_t i = 0; i < count; ++i) task(std::size_t{0}, i);
      return;
    }
    run([](const void* t, std::size_t thread, std::size_t i) { (*static_cast<const Task*>(t))(thread, i); },
        &task, static_cast<std::uint32_t>(count), most_threads);
  }

 private:
  using Call = void (*)(const void* task, std::size_t thread, std::size_t i);

  void start();
  void run(Call call, const void* task, std::uint32_t count, std::size_t most_threads);
  void work(std::size_t thread, std::uint32_t job);
  void serve(std::size_t thread);
  void stop();

  // What every thread reads, what all of them write, and what they wait for: each on its own cache lines.
  static constexpr std::size_t kCacheLine = 64;
  /// A thread that comes late may read what belongs to two jobs. So it first takes a task of the job whose
  /// number it knows: until that is done, nothing of the job changes.
  struct alignas(kCacheLine) Share {
    std::atomic<std::uint64_t> left = 0;  ///< tasks not taken yet; in the upper half the number of their job
    std::atomic<std::uint32_t> end = 0;   ///< one past the last task
  };
  std::atomic<Call> call_ = nullptr;  ///< null tells the threads to end
  std::atomic<const void*> task_ = nullptr;
  std::atomic<std::size_t> taking_part_ = 0;  ///< so many threads
  unsigned used_ = 1;
  std::vector<std::thread> started_;
  std::vector<Share> shares_;  ///< of the tasks: the caller's, then one of each started thread
  std::exception_ptr error_;
  std::mutex error_mutex_;
  std::atomic<bool> has_failed_ = false;                    ///< in this job
  alignas(kCacheLine) std::atomic<std::uint32_t> job_ = 0;  ///< the number of the last one
  alignas(kCacheLine) std::atomic<std::uint32_t> tasks_left_ = 0;
};

/// Lets threads work one after the other.
class Turns {
 public:
  template <class Work>
  void take(const Work& work) {
    const std::lock_guard lock(mutex_);
    work();
  }

 private:
  std::mutex mutex_;
};

#endif

/// Splits `count` things into consecutive chunks of nearly equal size: one chunk for a single thread, else
/// several for each thread, so that the others do not wait for a thread that is held up.
class Chunks {
 public:
  /// Fewer than `smallest` things are not worth handing out.
  Chunks(const ThreadPool& pool, std::size_t count, std::size_t smallest = 2048) : count_(count) {
    constexpr std::size_t kChunksPerThread = 4;
    const std::size_t wanted = pool.threads() == 1 ? 1 : kChunksPerThread * pool.threads();
    chunks_ = std::clamp(count / smallest, std::size_t{1}, wanted);
  }
  std::size_t size() const { return chunks_; }
  std::size_t begin(std::size_t chunk) const { return count_ * chunk / chunks_; }
  std::size_t end(std::size_t chunk) const { return begin(chunk + 1); }

 private:
  std::size_t count_;
  std::size_t chunks_;
};

}  // namespace polylidar::detail
