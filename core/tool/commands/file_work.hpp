// Many files: as many at a time as there are threads and as memory holds, and what became of each.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "tool/points/crs.hpp"
#include "tool/program/exit_code.hpp"
#include "tool/program/status_line.hpp"
#include "tool/program/surroundings.hpp"

namespace polylidar::tool {

/// What files may take of memory together, in bytes.
class MemoryGate {
 public:
  explicit MemoryGate(std::uint64_t budget) : budget_(budget) {}

  /// Waits until so much more is within the budget, or nobody has any.
  void enter(std::uint64_t bytes);
  void leave(std::uint64_t bytes);

 private:
  std::uint64_t budget_;
  std::uint64_t taken_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

/// What one of them has of it; given back in the end.
class MemoryShare {
 public:
  explicit MemoryShare(MemoryGate& gate) : gate_(gate) {}
  ~MemoryShare() { gate_.leave(bytes_); }
  MemoryShare(const MemoryShare&) = delete;
  MemoryShare& operator=(const MemoryShare&) = delete;

  /// Takes so much instead of what it has, which is given back first: two that want more do not wait for each
  /// other.
  void take(std::uint64_t bytes);

 private:
  MemoryGate& gate_;
  std::uint64_t bytes_ = 0;
};

/// What a point takes of memory with its triangles, and some to spare, in bytes.
inline constexpr std::uint64_t kBytesOfPoint = 200;

/// The size of a file, in bytes, when it is unpacked, about: that of LAZ is told by its number of points,
/// that of what gzip compressed is guessed.
std::uint64_t unpacked_size(const std::string& path);
/// What all points of a file and their triangles take of memory, about, in bytes.
std::uint64_t memory_to_triangulate(const std::string& path);
/// What a file takes that is streamed.
std::uint64_t memory_to_stream(const std::string& path);
/// What of it the map of cells may take.
std::uint64_t map_bytes_to_stream(const std::string& path);

/// Throws ConfigurationError where two of these are the same file.
void check_each_once(const std::vector<std::string>& paths);
/// Throws ConfigurationError where one of these is standard input, a pipe or a terminal, which cannot be read
/// several times as `option` does.
void check_readable_again(const std::vector<std::string>& paths, const std::string& option);

class FileWork {
 public:
  /// Does what is to be done with a file, by its place among all, on so many threads, and says what
  /// coordinate system it is in; takes the memory for it before. What it throws makes the file one that
  /// failed, and the other files are done.
  using Work = std::function<Crs(std::size_t file, unsigned threads, MemoryShare& memory)>;

  /// All must live as long. Throws as check_each_once.
  FileWork(const std::vector<std::string>& paths, const Surroundings& surroundings, StatusLine& status);

  /// The files one after the other, each taken by the next of `threads` that is free. Together they take no
  /// more than `memory`, in bytes, or one is alone. Says which files failed, a line each. Throws
  /// ConfigurationError where all did, and Interrupted.
  void run(unsigned threads, std::uint64_t memory, const Work& work);

  /// What is being done with a file, for the status line; by any thread. Throws Interrupted.
  void show(std::size_t file, const std::string& doing);

  bool is_done(std::size_t file) const { return outcomes_[file].is_done; }
  /// The coordinate system of the files that were done: nothing known where there is none of these, no value
  /// where two differ.
  std::optional<Crs> common_crs() const;
  /// The systems of the files that were done, as in "EPSG:25832 (a.las and 12 more), none (b.las)".
  std::string systems() const;
  /// Says how many files are in `result`, such as "the index". kExitFailures where one is not.
  ExitCode summary(const std::string& result) const;

 private:
  struct Outcome {
    bool is_done = false;
    std::string failure;  ///< why not
    Crs crs;
  };

  std::string tried() const;
  void work_on(std::size_t file, unsigned threads, MemoryShare& memory, const Work& work);

  const std::vector<std::string>& paths_;
  const Surroundings& surroundings_;
  StatusLine& status_;
  std::atomic<std::size_t> tried_ = 0;  ///< files
  std::vector<Outcome> outcomes_;       ///< one a file, in their order
};

}  // namespace polylidar::tool
