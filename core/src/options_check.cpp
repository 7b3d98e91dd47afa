#include "options_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace polylidar::detail {

namespace {

/// A limit by its name and by where it stands in what is asked for and in what is kept to.
struct LimitField {
  const char* name;
  std::optional<double> Options::*option;
  double Limits::*limit;
};
constexpr std::array kLimitFields{
    LimitField{"alpha", &Options::alpha, &Limits::alpha},
    LimitField{"max_edge_length", &Options::max_edge_length, &Limits::max_edge_length},
    LimitField{"max_perimeter", &Options::max_perimeter, &Limits::max_perimeter}};

}  // namespace

void check_threads(unsigned threads) {
  if (threads == 0) throw std::invalid_argument("threads must be one or more");
}

Limits checked_limits(const Options& options) {
  Limits limits;
  for (const auto& [name, option, limit] : kLimitFields) {
    limits.*limit = (options.*option).value_or(kNoLimit);
    if (!(limits.*limit >= 0)) throw std::invalid_argument(std::string(name) + " must be zero or more");
  }
  if (!(options.detail > 0 && std::isfinite(options.detail))) {
    throw std::invalid_argument("detail must be positive and finite");
  }
  check_threads(options.threads);
  return limits;
}

bool is_any_limit_given(const Options& options) {
  return std::any_of(kLimitFields.begin(), kLimitFields.end(),
                     [&](const LimitField& field) { return (options.*field.option).has_value(); });
}

bool is_filled(const Options& options) {
  return options.fill_single_triangles.value_or(!is_any_limit_given(options));
}

Options widened(Options options, double factor) {
  const bool is_convex = std::isinf(factor);
  if (!is_any_limit_given(options)) {
    if (is_convex) {
      options.alpha = kNoLimit;
    } else {
      options.detail /= factor;
    }
  }
  for (const LimitField& field : kLimitFields) {
    std::optional<double>& limit = options.*field.option;
    if (limit) *limit = is_convex ? kNoLimit : *limit * factor;  // infinity times 0 is no number
  }
  return options;
}

Limits scaled(Limits limits, int exponent) {
  for (const LimitField& field : kLimitFields) {
    limits.*field.limit = std::ldexp(limits.*field.limit, exponent);
  }
  return limits;
}

}  // namespace polylidar::detail
