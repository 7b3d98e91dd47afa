#include "benchmarks/tune/search_axis.hpp"

#include <algorithm>
#include <cmath>

namespace hullbench::tune {
namespace {

/// Where the window of octaves begins that is searched of a length in spacings and of a plain number.
constexpr double kUsualLow = 0.125;

bool is_length(const ParameterInfo& parameter) {
  return parameter.unit == "length" || parameter.unit == "length^2";
}

/// Null when the method has none.
const ParameterInfo* searched_parameter(const MethodInfo& info, const std::string& wanted) {
  const auto& all = info.parameters;
  const auto named =
      std::ranges::find_if(all, [&](const ParameterInfo& parameter) { return parameter.name == wanted; });
  if (named != all.end()) return &*named;
  const auto first =
      std::ranges::find_if(all, [](const ParameterInfo& parameter) { return parameter.unit != "switch"; });
  if (first == all.end()) return nullptr;
  if (first->unit != "ratio") return &*first;
  const auto length = std::find_if(first, all.end(), is_length);
  return length == all.end() ? &*first : &*length;
}

double rounded(const SearchAxis& axis, double value) {
  return axis.unit == "count" ? std::round(value) : value;
}

}  // namespace

std::optional<SearchAxis> search_axis(const MethodInfo& info, const std::string& wanted) {
  const ParameterInfo* searched = searched_parameter(info, wanted);
  if (searched == nullptr || searched->minimum < 0) return std::nullopt;
  for (const ParameterInfo& other : info.parameters) {
    if (&other != searched && !other.default_value) return std::nullopt;
  }
  SearchAxis axis = {.parameter = searched->name,
                     .unit = searched->unit,
                     .spacings = is_length(*searched),
                     .power = searched->unit == "length^2" ? 2 : 1,
                     .low = kUsualLow,
                     .high = std::ldexp(kUsualLow, kAxisOctaves),
                     .minimum = searched->minimum,
                     .maximum = searched->maximum};
  if (axis.spacings) return axis;
  if (axis.maximum < axis.high) {
    axis.high = axis.maximum;
    axis.low = std::ldexp(axis.high, -kAxisOctaves);
  }
  if (axis.minimum > axis.low) {
    axis.low = axis.minimum;
    axis.high = std::min(std::ldexp(axis.low, kAxisOctaves), axis.maximum);
  }
  // A range of one value, or of zero alone, has nothing to search.
  if (!(axis.low > 0 && axis.low < axis.high)) return std::nullopt;
  return axis;
}

std::vector<double> grid(const SearchAxis& axis, int count) {
  std::vector<double> positions;
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const double position = rounded(axis, axis.low * std::pow(axis.high / axis.low, share));
    if (positions.empty() || position > positions.back()) positions.push_back(position);
  }
  return positions;
}

double value_at(const SearchAxis& axis, double position, double spacing) {
  const double length = axis.spacings ? position * spacing : position;
  return std::clamp(rounded(axis, axis.power == 2 ? length * length : length), axis.minimum, axis.maximum);
}

Parameters fixed_parameters(const MethodInfo& info, bool holes) {
  Parameters fixed;
  for (const ParameterInfo& parameter : info.parameters) {
    const bool of_holes = parameter.unit == "switch" && parameter.name.find("hole") != std::string::npos;
    if (of_holes && info.capabilities.holes) fixed[parameter.name] = holes ? 1 : 0;
  }
  return fixed;
}

std::vector<bool> choices_of_holes(const MethodInfo& info) {
  if (fixed_parameters(info).empty()) return {true};
  return {true, false};
}

}  // namespace hullbench::tune
