// The median and its like.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace polylidar::detail {

/// The value that would be at `rank` < values.size() if `values`, of which none is negative or NaN, were
/// sorted. `room` is for as many, and does not overlap them. O(n) for values in random order.
double value_of_rank(std::span<const double> values, std::size_t rank, std::uint64_t* room);

}  // namespace polylidar::detail
