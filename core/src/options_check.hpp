// What a caller asks for: checked, scaled, widened.
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

/// `options` with each limit that is given wider by `factor`, or with less detail if none is; those of the
/// convex hull if the factor is infinite.
Options widened(Options options, double factor);

/// `limits` in the unit of coordinates that are 2^exponent times as large.
Limits scaled(Limits limits, int exponent);

}  // namespace polylidar::detail
