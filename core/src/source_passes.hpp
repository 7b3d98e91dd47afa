// Reads the sources of a stream again and again, on one thread or on several.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <span>
#include <vector>

#include "polylidar/stream.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// A block of a source, or a part of one, on its way through a pass.
struct SourceBlock {
  std::size_t source;
  /// The number of its first point among all; in a first pass over sources that are read at the same time,
  /// among those of its source.
  std::uint64_t first;
  std::span<const Point> points;
};

/// The passes over the sources, which are one after the other as one source.
///
/// Points come in *slots*. If sources are read one after the other, the threads share each block, and its
/// parts are the slots. If they are read at the same time, each source is a slot. What is found in a slot is
/// kept apart, and put behind that of the slots before.
class SourcePasses {
 public:
  /// What is done in a pass: which sources are read, what is done with a block, by any thread but only by one
  /// at a time for each slot, and with the first `slots` slots after that. Of sources that are read one after
  /// the other that is after each block, otherwise when all were read.
  struct Pass {
    std::function<bool(std::size_t source)> is_read;
    std::function<void(std::size_t slot, const SourceBlock& block)> take;
    std::function<void(std::size_t slots)> end;
  };

  /// All of these must live as long. `pool` has its threads by now.
  SourcePasses(std::span<const PointSource> sources, const StreamOptions& options, ThreadPool& pool)
      : sources_(sources), options_(options), pool_(pool), firsts_(sources.size(), 0) {}

  std::size_t source_count() const { return sources_.size(); }
  bool are_read_at_once() const {
    return options_.reads_at_once && pool_.threads() > 1 && sources_.size() > 1;
  }
  /// How many slots there are at most.
  std::size_t slot_count() const;

  /// Throws what a source or the caller's StreamOptions::progress throws; after know_counts(), has_changed()
  /// where a source that is read has another number of points.
  void run(const Pass& pass);
  /// After the first pass: source -> how many points it has.
  void know_counts(std::vector<std::uint64_t> counts);
  /// The number of the first point of a source, as far as it is known.
  std::uint64_t first_of(std::size_t source) const { return firsts_[source]; }

  /// How many passes there were.
  int passes() const { return progress_.pass; }
  /// What is told of how many there will be.
  void expect_passes(int passes) { progress_.passes = passes; }
  void expect_another() { ++progress_.passes; }

 private:
  void read_at_once(const Pass& pass);
  void read_in_order(const Pass& pass);
  void check_count(std::size_t source, std::uint64_t end) const;
  void tell(std::size_t points);

  std::span<const PointSource> sources_;
  const StreamOptions& options_;
  ThreadPool& pool_;
  Turns turns_;  ///< to change the next two
  StreamProgress progress_;
  std::exception_ptr error_;           ///< the first of sources that are read at once
  std::vector<std::uint64_t> counts_;  ///< source -> how many points it has; empty in the first pass
  std::vector<std::uint64_t> firsts_;  ///< source -> the number of its first point
};

}  // namespace polylidar::detail
