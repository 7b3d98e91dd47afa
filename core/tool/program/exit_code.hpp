// How a program ends: one meaning for each number, the same for polylidar, hullbench and the programs beside
// it.
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace polylidar::tool {

/// Not an enum class, as main() returns one as it is; a bare number is no ExitCode all the same.
enum ExitCode : int {
  kExitOk = 0,
  kExitError = 1,
  kExitUsage = 2,
  kExitRegression = 3,  ///< hullbench only, as 5 and 6 are
  kExitFailures = 4,
  kExitInconclusive = 5,
  kExitNothing = 6,
  kExitInterrupted = 130
};

/// What those of the tool mean, for help.
inline constexpr const char* kToolExitCodesHelp =
    "Exit codes:\n"
    "    0  everything was done\n"
    "    1  an error of the program, or the result could not be written\n"
    "    2  wrong usage, or an input that cannot be read\n"
    "    4  some of many inputs could not be read; the others were done\n"
    "  130  interrupted";

/// What `work` returns. When it throws, one line on `err` after the name of the program: kExitUsage for a
/// ConfigurationError, kExitInterrupted for Interrupted, kExitError for any other std::exception.
ExitCode exit_code_of(const std::string& program, std::ostream& err, const std::function<ExitCode()>& work);

}  // namespace polylidar::tool
