#include "adapters/adapter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "polylidar/predicates.hpp"

namespace hullbench {
namespace {

void require_finite(std::span<const Point> points) {
  for (std::size_t index = 0; index < points.size(); ++index) {
    if (!std::isfinite(points[index].x) || !std::isfinite(points[index].y)) {
      throw std::invalid_argument("point " + std::to_string(index) + " is not finite");
    }
  }
}

/// Exact; O(n) at worst.
bool span_an_area(std::span<const Point> points) {
  std::size_t second = 1;
  while (second < points.size() && points[second] == points[0]) ++second;
  for (std::size_t third = second + 1; third < points.size(); ++third) {
    if (polylidar::orient2d(points[0], points[second], points[third]) != 0) return true;
  }
  return false;
}

}  // namespace

ParameterInfo length_limit(std::string name, std::string description, std::optional<double> default_value) {
  return {std::move(name), "length", std::move(description), 0, std::numeric_limits<double>::infinity(),
          default_value};
}

ParameterInfo off_switch(std::string name, std::string description) {
  return {std::move(name), "switch", std::move(description), 0, 1, 0};
}

void Adapter::load(std::span<const Point> points) {
  require_finite(points);
  has_run_ = false;
  has_area_ = span_an_area(points);
  do_load(points);
}

void Adapter::run(const Parameters& parameters, Steps& steps) {
  const Parameters complete = complete_parameters(info_, parameters);
  reset();
  do_run(complete, steps);
  has_run_ = true;
}

MultiPolygon Adapter::extract(Steps& steps) {
  if (!has_run_) throw std::logic_error("extract comes after run");
  return do_extract(steps);
}

void Adapter::reset() {
  has_run_ = false;
  do_reset();
}

Parameters complete_parameters(const MethodInfo& info, const Parameters& parameters) {
  for (const auto& given : parameters) {
    const std::string& name = given.first;  // clang 14 captures no structured binding
    const bool known = std::any_of(info.parameters.begin(), info.parameters.end(),
                                   [&](const ParameterInfo& parameter) { return parameter.name == name; });
    if (!known) throw std::invalid_argument(info.name + " has no parameter '" + name + "'");
  }
  Parameters complete;
  for (const ParameterInfo& parameter : info.parameters) {
    const auto given = parameters.find(parameter.name);
    if (given == parameters.end() && !parameter.default_value) {
      throw std::invalid_argument(info.name + " needs the parameter '" + parameter.name + "'");
    }
    const double value = given == parameters.end() ? *parameter.default_value : given->second;
    const bool in_range = value >= parameter.minimum && value <= parameter.maximum;
    if (!in_range && value != parameter.default_value) {
      std::ostringstream message;
      message << info.name << " takes '" << parameter.name << "' from " << parameter.minimum << " to "
              << parameter.maximum << ", not " << value;
      throw std::invalid_argument(message.str());
    }
    if (parameter.unit == "switch" && value != 0 && value != 1) {
      throw std::invalid_argument(info.name + " takes '" + parameter.name + "' as 0 or 1");
    }
    complete[parameter.name] = value;
  }
  return complete;
}

bool has_defaults(const MethodInfo& info) {
  return std::all_of(info.parameters.begin(), info.parameters.end(), [](const ParameterInfo& parameter) {
    return parameter.default_value && *parameter.default_value <= parameter.maximum;
  });
}

}  // namespace hullbench
