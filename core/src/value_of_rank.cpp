#include "value_of_rank.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace polylidar::detail {

// The wanted value and not many others nearly always lie between two of a few of the values, so that the rest
// need only be counted, and without a branch. nth_element would take a third more instructions, and guess at
// every value. What is compared are the bits, as integers: those of numbers that are not negative are in
// the numbers' order.
float value_of_rank(std::span<const float> values, std::size_t rank, std::uint32_t* room) {
  constexpr std::size_t kFew = 256;
  const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  std::uint32_t low = 0;
  std::uint32_t width = bits(std::numeric_limits<float>::infinity());
  if (values.size() >= 4 * kFew) {
    for (std::size_t i = 0; i < kFew; ++i) room[i] = bits(values[i * values.size() / kFew]);
    // Three standard deviations of a few values' rank about the wanted one, 3 / (2 sqrt(kFew)), are a tenth.
    const std::size_t middle = rank * kFew / values.size();
    std::uint32_t* const lower = room + (middle < kFew / 10 ? 0 : middle - kFew / 10);
    std::uint32_t* const upper = room + std::min(middle + kFew / 10, kFew - 1);
    std::nth_element(room, upper, room + kFew);
    std::nth_element(room, lower, upper);
    low = *lower;
    width = *upper - low;
  }
  std::size_t below = 0;
  std::size_t within = 0;
  for (const float value : values) {
    const std::uint32_t key = bits(value);
    room[within] = key;
    within += key - low <= width ? 1U : 0U;  // no: below, where the difference wraps
    below += key < low ? 1U : 0U;
  }
  if (rank < below || rank >= below + within) {
    std::transform(values.begin(), values.end(), room, bits);
    below = 0;
    within = values.size();
  }
  std::nth_element(room, room + (rank - below), room + within);
  return std::bit_cast<float>(room[rank - below]);
}

}  // namespace polylidar::detail
