// What a user can mend: as in the tool, core/tool/program.
#pragma once

#include "tool/program/configuration_error.hpp"

namespace hullbench {

using polylidar::tool::ConfigurationError;

}  // namespace hullbench
