// Checks the options that a caller gives.
#pragma once

#include "polylidar/concave_hull.hpp"

namespace polylidar::detail {

/// Throws std::invalid_argument if `threads` is 0.
void check_threads(unsigned threads);

/// The limits that were given. Throws std::invalid_argument if an option is invalid.
Limits checked_limits(const Options& options);

bool is_any_limit_given(const Options& options);
/// Whether fill_single_triangles is asked for, or meant.
bool is_filled(const Options& options);

/// `limits` in the unit of coordinates that are 2^exponent times as large.
Limits scaled(Limits limits, int exponent);

}  // namespace polylidar::detail
