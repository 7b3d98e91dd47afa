// Standard error, where people see what a long work is at.
#pragma once

#include <vector>

#include "benchmarks/run/progress.hpp"
#include "tool/program/surroundings.hpp"

namespace hullbench::cli {

using polylidar::tool::is_terminal;

/// The progress of these sections, on standard error.
run::Progress make_progress(std::vector<run::ProgressSection> sections);

}  // namespace hullbench::cli
