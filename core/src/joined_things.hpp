// Things that are joined, directly or through others: union-find.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace polylidar::detail {

/// Things by their numbers from 0 on. Of those that are joined one stands for all.
class JoinedThings {
 public:
  /// So many things, none of them joined.
  void reset(std::size_t count) {
    first_.resize(count);
    std::iota(first_.begin(), first_.end(), std::uint32_t{0});
  }
  /// One more thing, joined to none.
  void add() { first_.push_back(static_cast<std::uint32_t>(first_.size())); }
  /// The thing that stands for all that `thing` is joined to. Halves the way to it for the next time.
  std::uint32_t standing_for(std::uint32_t thing) {
    while (first_[thing] != thing) {
      first_[thing] = first_[first_[thing]];
      thing = first_[thing];
    }
    return thing;
  }
  /// What stands for `b` then stands for both.
  void join(std::uint32_t a, std::uint32_t b) { first_[standing_for(a)] = standing_for(b); }

 private:
  std::vector<std::uint32_t> first_;  ///< thing -> one that it was joined to, or itself
};

}  // namespace polylidar::detail
