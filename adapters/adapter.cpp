#include "adapters/adapter.hpp"

#include <algorithm>
#include <sstream>

namespace hullbench {

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
