// The one parameter of a method that is searched, and the axis it is searched on. Nothing is known of a
// method here but the ranges of its parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/adapter.hpp"

namespace hullbench::tune {

/// How many octaves (factors of two) of a parameter are searched.
inline constexpr int kAxisOctaves = 8;

/// A logarithmic axis from `low` to `high`, both > 0. Where a position stands for a length it is in mean
/// spacings of the points (mean_spacing in parameter_rules.hpp), so that all lengths of all methods on all
/// shapes share one axis; otherwise it is the parameter itself.
struct SearchAxis {
  std::string parameter;
  std::string unit;       ///< of the parameter, as in ParameterInfo
  bool spacings = false;  ///< whether positions are in mean spacings
  int power = 1;          ///< of the position in the parameter: 2 for a squared length
  double low = 0;
  double high = 0;
  double minimum = 0;  ///< of the parameter
  double maximum = 0;  ///< of the parameter; infinity when there is none
};

/// The axis of the parameter `wanted` or, if that is empty, of the method's first parameter that is no
/// switch; a first parameter that is a ratio gives way to a length, which lies on the common axis. From 1/8
/// to 32 (spacings, or the number itself), moved as little as needed to lie in the parameter's range and cut
/// where the range is shorter. None when the method has no such parameter, when the parameter may be negative
/// (there is no logarithm), or when it has another one that it cannot do without.
std::optional<SearchAxis> search_axis(const MethodInfo& info, const std::string& wanted = "");

/// `count` >= 2 positions, evenly spaced in the logarithm from low to high, ascending; of a count only those
/// that are whole numbers after rounding, each once.
std::vector<double> grid(const SearchAxis& axis, int count);

/// The parameter's value at a position: clamped to its range, whole for a count. `spacing` is the points'
/// mean spacing.
double value_at(const SearchAxis& axis, double position, double spacing);

/// What is given besides the searched parameter, of a method whose result can have holes: every switch for
/// holes set to 1 or, without `holes`, to 0.
Parameters fixed_parameters(const MethodInfo& info, bool holes = true);

/// Whether holes can be switched on or off: {true, false}; else {true}.
std::vector<bool> choices_of_holes(const MethodInfo& info);

}  // namespace hullbench::tune
