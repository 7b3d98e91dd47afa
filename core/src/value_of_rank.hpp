// The median and its like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace polylidar::detail {

/// The value that would be at `rank` < values.size() if `values`, of which none is negative or NaN, were
/// sorted. `room` is for as many, and does not overlap them. O(n) for values in random order.
float value_of_rank(std::span<const float> values, std::size_t rank, std::uint32_t* room);

}  // namespace polylidar::detail
