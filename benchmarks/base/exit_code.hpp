// How a program ends: one meaning for each number, the same for hullbench, bench_gate, core_benchmarks and
// fit_rules.
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace hullbench {

/// Not an enum class, as main() returns one as it is; a bare number is no ExitCode all the same.
enum ExitCode : int {
  kExitOk = 0,
  kExitError = 1,
  kExitUsage = 2,
  kExitRegression = 3,
  kExitFailures = 4,
  kExitInconclusive = 5,
  kExitNothing = 6,
  kExitInterrupted = 130
};

/// What they mean, for help.
inline constexpr const char* kExitCodesHelp =
    "Exit codes:\n"
    "    0  everything was done; no check and no gate objects\n"
    "    1  an error of the program, or a check found faults\n"
    "    2  wrong usage or configuration\n"
    "    3  a regression, a changed result or a missed goal\n"
    "    4  methods failed (their rows say how) or break the contract, or runs of a merge are missing\n"
    "    5  inconclusive: too noisy, or the same program differs from itself\n"
    "    6  nothing was measured, or there is nothing to compare\n"
    "  130  interrupted";

/// What `work` returns. When it throws, one line on `err` after the name of the program: kExitUsage for a
/// ConfigurationError, kExitInterrupted for Interrupted, kExitError for any other std::exception.
ExitCode exit_code_of(const std::string& program, std::ostream& err, const std::function<ExitCode()>& work);

}  // namespace hullbench
