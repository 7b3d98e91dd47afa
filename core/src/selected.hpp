// Finds numbers that pass a test, without branches that the processor cannot predict.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace polylidar::detail {

/// Calls visit(i) for the numbers i from `begin` to one before `end`, all below 2^32, for which test(i) is
/// true, in ascending order. For tests that many numbers pass and many fail, in no regular order.
template <class Test, class Visit>
void for_each_selected(std::size_t begin, std::size_t end, const Test& test, const Visit& visit) {
  constexpr std::size_t kAtOnce = 512;
  std::array<std::uint32_t, kAtOnce> selected;
  for (; begin < end; begin += kAtOnce) {
    const std::size_t stop = std::min(begin + kAtOnce, end);
    std::size_t count = 0;
    for (std::size_t i = begin; i < stop; ++i) {
      selected[count] = static_cast<std::uint32_t>(i);
      count += test(i) ? 1U : 0U;
    }
    for (std::size_t k = 0; k < count; ++k) visit(selected[k]);
  }
}

}  // namespace polylidar::detail
