// All points, for what looks at them more than once: they are in memory, or are read again each time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>

#include "polylidar/geometry.hpp"
#include "thread_pool.hpp"

namespace polylidar::detail {

/// Takes a block of points of a share.
using TakeOfShare = std::function<void(std::size_t share, std::span<const Point> block)>;

struct PointPasses {
  std::uint64_t points = 0;  ///< how many there are
  std::size_t shares = 1;    ///< into how many they are divided, which is not the same in every pass
  /// One pass: calls take() for every point once. Blocks of one share come one after the other, those of
  /// different shares also at the same time, from several threads.
  std::function<void(const TakeOfShare& take)> pass = {};
};

/// What to throw where a pass gives other points than one before: a file that was written in between.
inline std::runtime_error has_changed() {
  return std::runtime_error("the source has other points than when it was read before");
}

/// Points in memory, a share for each thread, but of many threads not all take part: each share may need
/// memory of its own. The result must not live longer than what it is made of.
inline PointPasses passes_over(std::span<const Point> points, ThreadPool& pool) {
  constexpr std::size_t kMostShares = 8;
  const std::size_t shares = std::min<std::size_t>(pool.threads(), kMostShares);
  return {points.size(), shares, [points, shares, &pool](const TakeOfShare& take) {
            pool.for_each(shares, [&](std::size_t s) {
              const std::size_t begin = points.size() * s / shares;
              take(s, points.subspan(begin, points.size() * (s + 1) / shares - begin));
            });
          }};
}

}  // namespace polylidar::detail
