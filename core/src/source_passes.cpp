#include "source_passes.hpp"

#include <numeric>
#include <utility>

#include "point_passes.hpp"
#include "polylidar/delaunay.hpp"

namespace polylidar::detail {

std::size_t SourcePasses::slot_count() const {
  if (are_read_at_once()) return sources_.size();
  return Chunks(pool_, kMaxPoints).size();
}

void SourcePasses::run(const Pass& pass) {
  ++progress_.pass;
  progress_.points = 0;
  if (are_read_at_once()) {
    read_at_once(pass);
  } else {
    read_in_order(pass);
  }
}

void SourcePasses::read_at_once(const Pass& pass) {
  error_ = nullptr;
  const auto read = [&](std::size_t s) {
    std::uint64_t number = firsts_[s];
    sources_[s]([&](std::span<const Point> block) {
      pass.take(s, {s, number, block});
      number += block.size();
      tell(block.size());
    });
    check_count(s, number);
  };
  pool_.for_each(sources_.size(), [&](std::size_t s) {
    if (!pass.is_read(s)) return;
    try {
      read(s);
    } catch (...) {
      // Ends the sources that are being read on other threads.
      turns_.take([&] {
        if (!error_) error_ = std::current_exception();
      });
      throw;
    }
  });
  pass.end(sources_.size());
}

void SourcePasses::read_in_order(const Pass& pass) {
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    if (!pass.is_read(s)) {
      progress_.points += counts_[s];
      continue;
    }
    std::uint64_t number = firsts_[s];
    sources_[s]([&](std::span<const Point> block) {
      const Chunks chunks(pool_, block.size());
      pool_.for_each(chunks.size(), [&](std::size_t c) {
        const std::size_t begin = chunks.begin(c);
        pass.take(c, {s, number + begin, block.subspan(begin, chunks.end(c) - begin)});
      });
      pass.end(chunks.size());
      number += block.size();
      tell(block.size());
    });
    if (s + 1 < sources_.size()) firsts_[s + 1] = number;
    check_count(s, number);
  }
}

/// `end`: the number after the last point of the source.
void SourcePasses::check_count(std::size_t source, std::uint64_t end) const {
  if (!counts_.empty() && end != firsts_[source] + counts_[source]) throw has_changed();
}

void SourcePasses::know_counts(std::vector<std::uint64_t> counts) {
  counts_ = std::move(counts);
  std::exclusive_scan(counts_.begin(), counts_.end(), firsts_.begin(), std::uint64_t{0});
}

void SourcePasses::tell(std::size_t points) {
  turns_.take([&] {
    if (error_) std::rethrow_exception(error_);
    progress_.points += points;
    if (options_.progress) options_.progress(progress_);
  });
}

}  // namespace polylidar::detail
