// How a program ends, the same for hullbench, bench_gate, core_benchmarks and fit_rules: the codes of
// core/tool/program, and what they mean here.
#pragma once

#include "tool/program/exit_code.hpp"

namespace hullbench {

using polylidar::tool::exit_code_of;
using polylidar::tool::ExitCode;
using enum polylidar::tool::ExitCode;

/// What they mean, for help.
inline constexpr const char* kExitCodesHelp =
    "Exit codes:\n"
    "    0  everything was done; no check and no gate failed\n"
    "    1  an error of the program, or a check found faults\n"
    "    2  wrong usage or configuration\n"
    "    3  a regression, a changed result or a missed goal\n"
    "    4  methods failed (their rows say how) or break the contract, or runs of a merge are missing\n"
    "    5  inconclusive: too noisy, or two copies of one program differ\n"
    "    6  nothing was measured, or there is nothing to compare\n"
    "  130  interrupted";

}  // namespace hullbench
