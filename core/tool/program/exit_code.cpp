#include "tool/program/exit_code.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "tool/program/configuration_error.hpp"
#include "tool/program/interrupt.hpp"

namespace polylidar::tool {
namespace {

/// Whether standard output is a pipe that is closed at its other end, as by `head`, which has what it wants.
bool has_nobody_who_reads() {
  ::pollfd output = {STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
}

/// Takes the place of standard streams that are closed, in which reading and writing fail as before: else the
/// next file that is opened has its number, and gets whatever is said.
void hold_standard_streams() {
  int held = 0;
  while (held >= 0 && held <= STDERR_FILENO) held = ::open("/", O_PATH);
  if (held > STDERR_FILENO) ::close(held);
}

}  // namespace

ExitCode exit_code_of(const std::string& program, std::ostream& err, const std::function<ExitCode()>& work) {
  const auto complain = [&](const std::string& what, ExitCode code) {
    err << program << ": " << what << "\n";
    return code;
  };
  try {
    hold_standard_streams();
    const ExitCode code = work();
    const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (is_written || has_nobody_who_reads()) return code;
    return complain("cannot write standard output; is the disk full?", kExitError);
  } catch (const ConfigurationError& error) {
    return complain(error.what(), kExitUsage);
  } catch (const Interrupted&) {
    return complain("interrupted", kExitInterrupted);
  } catch (const std::exception& error) {
    return complain(error.what(), kExitError);
  }
}

}  // namespace polylidar::tool
