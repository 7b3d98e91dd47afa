#include "tool/program/exit_code.hpp"

#include <exception>

#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"

namespace polylidar::tool {
ExitCode exit_code_of(const std::string& program, std::ostream& err, const std::function<ExitCode()>& work) {
  const auto complain = [&](const std::string& what, ExitCode code) {
    err << program << ": " << what << "\n";
    return code;
  };
  try {
    return work();
  } catch (const ConfigurationError& error) {
    return complain(error.what(), kExitUsage);
  } catch (const Interrupted&) {
    return complain("interrupted", kExitInterrupted);
  } catch (const std::exception& error) {
    return complain(error.what(), kExitError);
  }
}

}  // namespace polylidar::tool
