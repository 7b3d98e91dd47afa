// What a long work is at: as in the tool, core/tool/program.
#pragma once

#include "tool/program/status_line.hpp"

namespace hullbench {

using polylidar::tool::StatusLine;

}  // namespace hullbench
