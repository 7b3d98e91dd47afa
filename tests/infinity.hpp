// What many tests give for a limit, or find for an error.
#pragma once

#include <limits>

namespace hullbench::testing {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace hullbench::testing
