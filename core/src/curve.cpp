#include "curve.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>
#include <vector>

namespace polylidar::detail {

namespace {

constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// How often each digit occurs in a chunk; then the place of the chunk's next entry with that digit.
using Counters = std::array<std::uint32_t, kDigits>;

std::size_t digit(CurveEntry entry, int digit_index) {
  return (entry >> static_cast<unsigned>(32 + digit_index * kDigitBits)) & (kDigits - 1);
}

/// Turns counts into places: by digit first, then by chunk, which keeps the order of equal digits.
void sum_up(std::span<Counters> counters) {
  std::uint32_t total = 0;
  for (std::size_t d = 0; d < kDigits; ++d) {
    for (Counters& chunk : counters) total += std::exchange(chunk[d], total);
  }
}

}  // namespace

Curve::Curve(const Box& box, std::size_t points) : minimum_(box.min) {
  const int bits = std::clamp(static_cast<int>(std::bit_width(points)) / 2 + 3, 4, 16);
  const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
  cells_per_length_ = extent > 0 ? ((1U << static_cast<unsigned>(bits)) - 1) / extent : 0;
  key_bits_ = 2 * bits;
}

CurveEntry* sort_along(const Curve& curve, std::span<const Point> points, CurveEntry* entries,
                       CurveEntry* spare, ThreadPool& pool) {
  constexpr std::size_t kSmallestChunk = 4096;  // a step does little to a point
  const Chunks chunks(pool, points.size(), kSmallestChunk);
  const auto for_each_chunk = [&](const auto& task) {
    pool.for_each(chunks.size(), [&](std::size_t c) { task(c, chunks.begin(c), chunks.end(c)); });
  };
  for_each_chunk([&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) entries[i] = (CurveEntry{curve.key(points[i])} << 32U) | i;
  });
  constexpr std::size_t kWorthCounting = 1024;
  if (points.size() < kWorthCounting) {  // clearing and summing the counters would cost more than comparing
    std::sort(entries, entries + points.size());
    return entries;
  }
  std::vector<Counters> counters(chunks.size());
  for (int d = 0; d * kDigitBits < curve.key_bits(); ++d) {
    for_each_chunk([&](std::size_t c, std::size_t begin, std::size_t end) {
      Counters& count = counters[c];
      count.fill(0);
      for (std::size_t i = begin; i < end; ++i) ++count[digit(entries[i], d)];
    });
    sum_up(counters);
    for_each_chunk([&](std::size_t c, std::size_t begin, std::size_t end) {
      Counters& place = counters[c];
      for (std::size_t i = begin; i < end; ++i) spare[place[digit(entries[i], d)]++] = entries[i];
    });
    std::swap(entries, spare);
  }
  return entries;
}

}  // namespace polylidar::detail
