#include "benchmarks/base/number_format.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace hullbench {

std::string fixed(double value, int decimals) {
  // Room for the largest double written out, 309 digits, and the decimals.
  std::array<char, 330> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr;
  return {text.data(), end};
}

int decimals_of(double value) {
  constexpr int kMostDecimals = 9;
  if (!(value > 0) || std::isinf(value)) return 0;
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(value))), 0, kMostDecimals);
  // Rounding may carry into a further digit: 9.999 is "10.0", not "10.00".
  const bool carries = std::round(value * std::pow(10.0, decimals)) >= 1000 && decimals > 0;
  return carries ? decimals - 1 : decimals;
}

std::string three_digits(double value) {
  return fixed(value, decimals_of(value));
}

json finite_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

}  // namespace hullbench
