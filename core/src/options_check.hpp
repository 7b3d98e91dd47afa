// What the callers of a hull may ask for.
#pragma once

#include "polylidar/concave_hull.hpp"

namespace polylidar::detail {

/// Throws std::invalid_argument where there is none.
void check_threads(unsigned threads);

/// The limits that were given. Throws std::invalid_argument where an option has no meaning.
Limits checked_limits(const Options& options);

bool is_any_limit_given(const Options& options);

/// `limits` in the unit of coordinates that are 2^exponent times as large.
Limits scaled(Limits limits, int exponent);

}  // namespace polylidar::detail
