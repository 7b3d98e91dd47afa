// Numbers as people read them: enough digits to compare, not more.
#pragma once

#include <optional>
#include <string>

#include "benchmarks/base/names.hpp"

namespace hullbench {

/// `value` >= 0 with three significant digits, never fewer than its whole part has and never an exponent:
/// "0.531", "5.31", "53.1", "531", "53100" for 53100.4. Zero is "0".
std::string three_digits(double value);

/// `value` with `decimals` digits after the point.
std::string fixed(double value, int decimals);

/// How many digits after the point three_digits shows of `value`.
int decimals_of(double value);

/// In JSON, which has no infinity, null stands for it too.
json finite_or_null(const std::optional<double>& value);

}  // namespace hullbench
