// `polylidar hull --stream`: files that are read again and again instead of being kept in memory.
#pragma once

#include <string>

#include "polylidar/stream.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/shape_output.hpp"
#include "tool/points/crs.hpp"
#include "tool/program/status_line.hpp"

namespace polylidar::tool {

/// make_hull() where that is asked for.
ExitCode stream_hull(const HullCommand& command, const Surroundings& surroundings);

/// Writes the hull as `output` has it; `options` are those that it was made with. Says first how many points
/// were triangulated, behind the name of the program.
void write_streamed_hull(const StreamedHull& hull, const Options& options, const Crs& crs,
                         const ShapeOutput& output, const std::string& program, StatusLine& status);

}  // namespace polylidar::tool
