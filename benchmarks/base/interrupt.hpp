// Ctrl-C: as in the tool, core/tool/program.
#pragma once

#include "tool/program/interrupt.hpp"

namespace hullbench {

using polylidar::tool::catch_interruptions;
using polylidar::tool::interrupted;
using polylidar::tool::Interrupted;
using polylidar::tool::set_interrupted;
using polylidar::tool::throw_if_interrupted;

}  // namespace hullbench
